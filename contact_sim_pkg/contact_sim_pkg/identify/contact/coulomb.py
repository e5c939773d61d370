"""Balance of friction over a step of a lasting contact that slides with a known coefficient.

`f = T (pi + mu (n.pi) d)`, T the tangents of the ground, d the direction of slip, pi the contact's
impulse over the mass (see `identify/contact/balance.py`). It is linear in kappa = 1/m with the
factor `-h T (F + mu (n.F) d)`: a known force F identifies the mass, unless it lies along the edge
of the friction cone, where it looks like more contact. The arm of the impulse does not enter:
several points may touch, if all slip alike. Source: Identifiability, eq 39, corrected (F_x other
than sigma mu F_y).

The inexpensive methods: one impact alone, two velocity samples, no noise model.

Source: Identifiability, eq 44 with the sign of its errata, and its form in space: `S a + h W x S W
= R^T (r x pi)`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.balance import Balance, Side, impulse
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.geometry import UP, arm
from contact_sim_pkg.identify.motion.rotation import Array, cross_matrix, mean
from contact_sim_pkg.identify.problem import PAIRS, ContactSpan, IdentificationProblem, spatial_basis

__all__ = ["TwoPoint", "along_the_cone", "friction_balance", "impact_equations", "one_impact", "two_point"]


EDGE = 1e-6  # of the force: what counts as along the edge of the cone


def friction_balance(
    problem: IdentificationProblem, contact: ContactSpan, sides: tuple[Side, Side], parameters: Array
) -> Balance:
    """The balance of one step, on the tangents [k, 3] of the problem: value [k], derivatives [k,
    12] and [k, p].

    IdentificationError: the friction is not known, or the contact does not slip.
    """
    friction, model, tangents = problem.friction, problem.model, problem.tangents
    before, after = sides[0].state, sides[1].state
    direction, by_motion = _direction(problem, contact, sides)
    if friction is None:
        raise IdentificationError("the balance of friction needs a known coefficient")
    push = impulse(before, after, model.inverse_mass(parameters), model)
    weights = tangents + friction * numpy.outer(tangents @ direction, problem.ground.normal)
    strength = friction * float(problem.ground.normal @ push)
    parts = []
    # Derivatives by the velocities before and after: of the impulse, and of the slip
    for sign in (-1.0, 1.0):
        block = strength * tangents @ by_motion
        block[:, 3:6] += sign * weights
        parts.append(block)
    direct = numpy.zeros((len(tangents), model.unknowns))
    if model.with_mass:
        direct[:, -1] = -weights @ model.wrench.push(before.time, after.time)
    by_parameters = direct + parts[0] @ sides[0].by_parameters + parts[1] @ sides[1].by_parameters
    return Balance(weights @ push, parts[0] @ sides[0].by_state, parts[1] @ sides[1].by_state, by_parameters)


def _direction(problem: IdentificationProblem, contact: ContactSpan, sides: tuple[Side, Side]) -> tuple[Array, Array]:
    """Direction of the slip half-way [3], and its derivative [3, 12] by the motion at either
    end.
    """
    before, after = sides[0].state, sides[1].state
    middle = mean(before.rotation, after.rotation)
    reach = arm(problem.shape, problem.ground, middle, contact.point)
    spin = 0.5 * (before.angular_velocity + after.angular_velocity)
    flat = problem.tangents.T @ problem.tangents
    slip = flat @ (0.5 * (before.velocity + after.velocity) + numpy.cross(spin, reach))
    speed = float(numpy.linalg.norm(slip))
    if not speed > 0.0:
        raise IdentificationError(f"the contact at {before.time:.6g} s does not slip: its friction says nothing")
    direction = slip / speed
    turning = 0.5 / speed * (flat - numpy.outer(direction, direction))  # both ends share mean speed and mean rotation
    lever = middle @ problem.shape.points[contact.point]
    by_motion = numpy.zeros((3, 12))
    by_motion[:, 3:6] = turning
    by_motion[:, 6:9] = -turning @ cross_matrix(spin) @ cross_matrix(lever)
    by_motion[:, 9:] = -turning @ cross_matrix(reach)
    return direction, by_motion


def along_the_cone(problem: IdentificationProblem, contact: ContactSpan, sides: tuple[Side, Side]) -> bool:
    """Whether the known force lies along the edge of the friction cone over a step, or there is
    none.
    """
    friction, tangents = problem.friction or 0.0, problem.tangents
    force = problem.model.wrench.push(contact.begin, contact.end)
    direction, _ = _direction(problem, contact, sides)
    rest = tangents @ force + friction * float(problem.ground.normal @ force) * (tangents @ direction)
    return float(numpy.linalg.norm(rest)) <= EDGE * float(numpy.linalg.norm(force))


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
