"""The inexpensive methods: one impact alone, two velocity samples, no noise model.

Source: Identifiability, eq 44 with the sign of its errata, and its form in space: `S a + h W x S W
= R^T (r x pi)`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.geometry import UP
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import PAIRS, spatial_basis

__all__ = ["TwoPoint", "impact_equations", "one_impact", "two_point"]


class TwoPoint(NamedTuple):
    """Impulses over mass and m/J from one planar step."""

    normal: float  # c_n/m, [m/s]
    tangential: float  # c_t/m, [m/s]
    mass_over_inertia: float  # m/J, [1/m^2]


def two_point(
    before: Array, after: Array, reach: tuple[float, float], passed: float = 0.0, gravity: float = 9.81
) -> TwoPoint:
    """Impulses over mass and m/J of a block in the plane; x forward, y up, angle from x to y.

    `c_t/m = dv_x`, `c_n/m = dv_y + h g`, `m/J = dw / (r_x c_n/m - r_y c_t/m)`.

    Args:
        before: [v_x, v_y, spin] before, in [m/s] and [rad/s].
        after: the same after.
        reach: from the centre of mass to the contact, [m].
        passed: time between the two, [s].
        gravity: [m/s^2].

    Raises:
        IdentificationError: the impulse passes through the centre of mass, so that it says nothing
        on the inertia.
    """
    tangential, normal = float(after[0] - before[0]), float(after[1] - before[1]) + passed * gravity
    moment = reach[0] * normal - reach[1] * tangential
    # An impulse through the centre of mass turns no body
    if abs(moment) <= 1e-12 * float(numpy.hypot(*reach)) * float(numpy.hypot(tangential, normal)):
        raise IdentificationError(
            "m/J is not identifiable from this impact: its impulse passes through the centre of mass"
        )
    return TwoPoint(normal, tangential, float(after[2] - before[2]) / moment)


def one_impact(
    rotation: Array,
    before: tuple[Array, Array],
    after: tuple[Array, Array],
    reach: Array,
    passed: float = 0.0,
    gravity: float = 9.81,
) -> tuple[Array, int]:
    """I0/m of smallest norm that fits one impact in space, by linear least squares, and the number of its six that are identified.

    Args:
        rotation: body to world, [3, 3].
        before: velocity and angular velocity before, world axes.
        after: the same after.
        reach: from the centre of mass to the contact, [3], world axes.
        passed: time between the two, [s].
        gravity: [m/s^2].

    Returns:
        I0/m [3, 3] in [m^2] and the rank: 3 from one impact, 0 where its impulse passes through the centre of mass.
    """  # fmt: skip
    regressor, moment = impact_equations(spatial_basis(), rotation, before, after, reach, passed, gravity)
    found, _, rank, _ = numpy.linalg.lstsq(regressor, moment, rcond=1e-10)
    inertia = numpy.zeros((3, 3))
    for value, (row, col) in zip(found, PAIRS, strict=True):
        inertia[row, col] = inertia[col, row] = value
    return inertia, int(rank)


def impact_equations(
    basis: Array, rotation: Array, before: tuple[Array, Array], after: tuple[Array, Array], reach: Array,
    passed: float = 0.0, gravity: float = 9.81,
) -> tuple[Array, Array]:  # fmt: skip
    """Three equations that one impact gives the numbers s of `S = I0/m = sum s_i E_i`: matrix [3, k] and right side [3].

    `S a + h W x S W = R^T (r x pi)` (Identifiability eqs 19 to 31, corrected), a the change of the spin and W its mean in
    body axes, pi the impulse over the mass.

    Args:
        basis: E_i, [k, 3, 3]: six for a general body, three `e_i e_i^T` where the principal axes are known.
        rotation, before, after, reach, passed, gravity: as `one_impact`.
    """
    spin_change, spin = rotation.T @ (after[1] - before[1]), rotation.T @ (0.5 * (before[1] + after[1]))
    push = after[0] - before[0] + passed * gravity * UP
    rows = [part @ spin_change + passed * numpy.cross(spin, part @ spin) for part in basis]
    return numpy.stack(rows, axis=1), rotation.T @ numpy.cross(reach, push)
