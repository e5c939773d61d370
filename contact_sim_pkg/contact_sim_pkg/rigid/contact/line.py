"""A force of a contact that is known but for a part along a line, which redundant contacts leave
open: where it is in its cone.

Source: Identifiability eq 5.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel


@borrowing_kernel
def contact_arm(J, row):
    """Arm of the contact whose rows start at ``row``: half the sum of ``a x (r x a)`` over its
    three axes a.
    """
    x, y, z = 0.0, 0.0, 0.0
    for k in range(row, row + 3):
        x += 0.5 * (J[k, 1] * J[k, 5] - J[k, 2] * J[k, 4])
        y += 0.5 * (J[k, 2] * J[k, 3] - J[k, 0] * J[k, 5])
        z += 0.5 * (J[k, 0] * J[k, 4] - J[k, 1] * J[k, 3])
    return x, y, z


@borrowing_kernel
def reach_in_cone(J, force, friction, row, x, y, z):
    """A force that moves along the unit vector (x, y, z), in the cone of the contact whose rows
    start at ``row``.

    Returns how far from the edge of the cone it can come in [N], and the least and the greatest
    distance in [N] that it may move (`nan` where it never comes into the cone). With ``f + s a``
    the roots of ``(mu f_n + s mu a_n)^2 = |f_t + s a_t|^2`` are both ends; where the line itself
    runs within a cone (``mu |a_n| >= |a_t|``) there is one end, and no limit to the first number.
    """
    # the line in the axes of the contact
    n = J[row, 0] * x + J[row, 1] * y + J[row, 2] * z
    first = J[row + 1, 0] * x + J[row + 1, 1] * y + J[row + 1, 2] * z
    second = J[row + 2, 0] * x + J[row + 2, 1] * y + J[row + 2, 2] * z
    square, steep, limit = first * first + second * second, friction * n, friction * force[row]
    along, across = force[row + 1] * first + force[row + 2] * second, force[row + 1] * second - force[row + 2] * first
    # coefficients of the quadratic equation of both ends
    opening, middle = steep * steep - square, limit * steep - along
    root = limit * limit * square - 2.0 * limit * steep * along - across * across
    root += steep * steep * (force[row + 1] * force[row + 1] + force[row + 2] * force[row + 2])
    # the line runs within the cone in one direction: one end
    if opening >= 0.0:
        end = (-middle + math.copysign(math.sqrt(max(root, 0.0)), n)) / opening
        return math.inf, end if n > 0.0 else -math.inf, math.inf if n > 0.0 else end
    # distance from the edge of the cone at the best place of the line
    room = ((limit * square - steep * along) - abs(across) * math.sqrt(-opening)) / square
    if room < 0.0:
        return room, math.nan, math.nan
    half = math.sqrt(max(root, 0.0))
    return room, (-middle + half) / opening, (-middle - half) / opening
