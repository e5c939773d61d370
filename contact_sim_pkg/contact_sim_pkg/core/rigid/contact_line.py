"""A force of a contact that is known but for a part along a line, which redundant contacts leave open: where it is in its cone."""

from __future__ import annotations

import math

from ..jit import borrowing_kernel


@borrowing_kernel
def contact_arm(J, row):
    """Arm of the contact whose rows start at ``row``: half the sum of ``a x (r x a)`` over its three axes a."""
    x, y, z = 0.0, 0.0, 0.0
    for k in range(row, row + 3):
        x += 0.5 * (J[k, 1] * J[k, 5] - J[k, 2] * J[k, 4])
        y += 0.5 * (J[k, 2] * J[k, 3] - J[k, 0] * J[k, 5])
        z += 0.5 * (J[k, 0] * J[k, 4] - J[k, 1] * J[k, 3])
    return x, y, z


@borrowing_kernel
def reach_in_cone(J, force, friction, row, x, y, z):
    """A force that moves along the unit vector (x, y, z), in the cone of the contact whose rows start at ``row``.

    Returns how far from the edge of the cone it can come in [N], and the least and the greatest distance that it may move in
    [N], no numbers (`nan`) where the line runs within a cone. With the force's part c along the tangent of the line and o
    across, ``k = mu a_n/a_t`` and ``m = mu f_n - k c``: ``(m + k s)^2 = s^2 + o^2`` at both ends, s from c on.
    """
    n = J[row, 0] * x + J[row, 1] * y + J[row, 2] * z
    first = J[row + 1, 0] * x + J[row + 1, 1] * y + J[row + 1, 2] * z
    second = J[row + 2, 0] * x + J[row + 2, 1] * y + J[row + 2, 2] * z
    share = math.hypot(first, second)
    k = friction * n
    if not abs(k) < share:
        return math.inf, math.nan, math.nan
    k, first, second = k / share, first / share, second / share
    along = force[row + 1] * first + force[row + 2] * second
    across = abs(force[row + 1] * second - force[row + 2] * first)
    limit, square = friction * force[row] - k * along, 1.0 - k * k
    room = limit - across * math.sqrt(square)
    if room < 0.0:
        return room, math.nan, math.nan
    half = math.sqrt(limit**2 - square * across**2)
    return room, ((limit * k - half) / square - along) / share, ((limit * k + half) / square - along) / share
