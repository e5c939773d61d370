"""Balance of friction over a step of a lasting contact that slides with a known coefficient.

`f = T (pi + mu (n.pi) d)`, T the tangents of the ground, d the direction of slip, pi the contact's
impulse over the mass (see `identify/diagnostics/balance.py`). It is linear in kappa = 1/m with the
factor `-h T (F + mu (n.F) d)`: a known force F identifies the mass, unless it lies along the edge
of the friction cone, where it looks like more contact. The arm of the impulse does not enter:
several points may touch, if all slip alike. Source: Identifiability, eq 39, corrected (F_x other
than sigma mu F_y).
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.diagnostics.balance import Balance, Side, impulse
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.geometry import arm
from contact_sim_pkg.identify.motion.rotation import Array, cross_matrix, mean
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["along_the_cone", "friction_balance"]

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
