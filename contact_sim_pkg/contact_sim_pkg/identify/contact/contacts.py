"""Each contact of a motion: instant, mode, impulses over mass with their standard deviations."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.balance import Side, impulse
from contact_sim_pkg.identify.contact.instant import Mode, classify, instant
from contact_sim_pkg.identify.contact.noise import ContactNote, NoteKind
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.motion.flight import FlightState, motion, rates
from contact_sim_pkg.identify.motion.geometry import arm
from contact_sim_pkg.identify.motion.rotation import Array, cross_matrix, logarithm
from contact_sim_pkg.identify.motion.segments import Segments
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["ContactFinding", "findings"]


class ContactFinding(NamedTuple):
    """One contact; `mode` is None where it was not used, `note` then gives the reason.

    Its impulse is given nevertheless where two flights identify it.
    """

    begin: float  # [s]
    end: float  # [s]; equal to begin for a located impact
    point: int | None  # of the shape
    mode: Mode | None
    normal: float | None  # c_n/m, [m/s]
    tangential: float | None  # |c_t|/m, [m/s]
    normal_deviation: float | None  # of c_n/m, [m/s]
    tangential_deviation: float | None  # of |c_t|/m, [m/s]
    friction_deviation: float | None  # of |c_t|/c_n
    arm: Array | None  # [3], [m], world axes
    push: Array | None  # impulse over mass, [3], [m/s], world axes
    note: str


def findings(
    problem: IdentificationProblem,
    found: ParameterEstimate,
    parts: Segments,
    places: list[int],
    notes: dict[int, ContactNote],
) -> list[ContactFinding]:
    """One entry for each contact of the motion, in the order of time."""
    used = {place: number for number, place in enumerate(places)}
    lines = []
    for place, (first, last) in enumerate(parts.contacts):
        if place in used and place not in notes:
            lines.append(_used(problem, found, used[place]))
        else:
            lines.append(_unused(problem, found, (first, last), notes.get(place)))
    return lines


def _unused(
    problem: IdentificationProblem, found: ParameterEstimate, interval: tuple[int, int], note: ContactNote | None
) -> ContactFinding:
    """A contact of the intervals first to last; with its impulse where it is one impact of several
    corners at once.

    Where the impulse acts is not known then, but its size follows from the velocities of the centre
    of mass alone.
    """
    begin, end = float(problem.states.time[interval[0]]), float(problem.states.time[interval[1] + 1])
    nothing = ContactFinding(
        begin=begin,
        end=end,
        point=None,
        mode=None,
        normal=None,
        tangential=None,
        normal_deviation=None,
        tangential_deviation=None,
        friction_deviation=None,
        arm=None,
        push=None,
        note="" if note is None else note.sentence,
    )
    numbers = [number for number, (_first, last) in enumerate(problem.flights) if last == interval[0]]
    later = [number for number, (first, _last) in enumerate(problem.flights) if first == interval[1] + 1]
    several = note is not None and note.kind is NoteKind.SEVERAL_CORNERS
    if not (several and numbers and later):
        return nothing
    sides = [_side(problem, found, number, 0.5 * (begin + end)) for number in (numbers[0], later[0])]
    push = impulse(sides[0].state, sides[1].state, problem.model.inverse_mass(found.parameters), problem.model)
    spread, normal = _push_covariance(found, numbers[0], later[0], *sides), problem.ground.normal
    along = push - (push @ normal) * normal
    across = _deviation_along(along, spread)
    return nothing._replace(
        normal=float(push @ normal), tangential=float(numpy.linalg.norm(along)), push=push, tangential_deviation=across,
        normal_deviation=float(numpy.sqrt(normal @ spread @ normal)),
    )  # fmt: skip


def _side(problem: IdentificationProblem, found: ParameterEstimate, number: int, time: float) -> Side:
    """A flight at an instant."""
    state = found.flights[number]
    at = motion(state, found.parameters, found.scale, problem.model, numpy.array([time]))
    there = FlightState(time, at.position[0], at.velocity[0], at.rotation[0], at.angular_velocity[0])
    return Side(there, at.by_state[0], at.by_parameters[0])


def _deviation_along(vector: Array, spread: Array) -> float:
    """Standard deviation along a vector; the mean of all directions where it has none."""
    direction = _along(vector)
    return float(numpy.sqrt(direction @ spread @ direction if vector.any() else numpy.trace(spread) / 3.0))


def _along(vector: Array) -> Array:
    """Its direction; zero where it has none."""
    length = float(numpy.linalg.norm(vector))
    return vector / length if length > 0.0 else vector


def _used(problem: IdentificationProblem, found: ParameterEstimate, number: int) -> ContactFinding:
    contact, (before, after) = problem.contacts[number], found.sides[number]
    inverse_mass = problem.model.inverse_mass(found.parameters)
    push = impulse(before.state, after.state, inverse_mass, problem.model)
    spread = _push_covariance(found, contact.before, contact.after, before, after)
    turned = [side.state.rotation for side in (before, after)]
    if contact.sweep is None:
        turned = [0.5 * (turned[0] + turned[1])] * 2
    reaches = [arm(problem.shape, problem.ground, rotation, contact.point) for rotation in turned]
    normal, kept = problem.ground.normal, numpy.eye(3)
    if problem.axis is not None:
        kept = kept - numpy.outer(problem.axis, problem.axis)  # noise across the plane of motion is no slip
    velocities = [
        side.state.velocity + numpy.cross(side.state.angular_velocity, reach)
        for side, reach in zip((before, after), reaches, strict=True)
    ]
    deviation = _slip_deviation(problem, found, number, reaches[1], kept)
    along = push - (push @ normal) * normal
    direction, across = _along(along), _deviation_along(along, spread)
    mode = classify(kept @ push, kept @ velocities[0], kept @ velocities[1], deviation, problem.ground, across)
    ratio = None
    if mode.friction_at_least is not None:
        slope = (direction - mode.friction_at_least * normal) / mode.normal
        ratio = float(numpy.sqrt(slope @ spread @ slope))
    upward = float(numpy.sqrt(normal @ spread @ normal))
    return ContactFinding(
        begin=contact.begin,
        end=contact.end,
        point=contact.point,
        mode=mode,
        normal=mode.normal,
        tangential=mode.tangential,
        normal_deviation=upward,
        tangential_deviation=across,
        friction_deviation=ratio,
        arm=0.5 * (reaches[0] + reaches[1]),
        push=push,
        note="" if contact.sweep is None else _course(contact, turned),
    )


def _course(contact: ContactSpan, turned: list[Array]) -> str:
    """How long a contact lasted, and how far the body turned meanwhile."""
    angle = float(numpy.linalg.norm(logarithm(turned[1] @ turned[0].T)))
    samples = 0 if contact.sweep is None else contact.sweep.samples
    return f"lasted {1e3 * (contact.end - contact.begin):.3g} ms over {samples} samples; the body turned by {angle:.2g} rad"


def _push_covariance(found: ParameterEstimate, first: int, second: int, before: Side, after: Side) -> Array:
    """Covariance [3, 3] of the impulse over mass: of the states, and of the parameters they depend
    on.
    """
    jacobian = numpy.zeros((3, len(found.state_covariance)))
    jacobian[:, 12 * first : 12 * first + 12] -= before.by_state[3:6]
    jacobian[:, 12 * second : 12 * second + 12] += after.by_state[3:6]
    return _covariance(found, jacobian, after.by_parameters[3:6] - before.by_parameters[3:6])


def _slip_deviation(
    problem: IdentificationProblem, found: ParameterEstimate, number: int, reach: Array, kept: Array
) -> float:
    """Largest standard deviation of the contact point's velocity after along `kept` directions,
    [m/s].
    """
    contact, (before, after) = problem.contacts[number], found.sides[number]
    turning = -cross_matrix(reach)
    swung = cross_matrix(after.state.angular_velocity) @ turning  # w x (d x r) for a small rotation d
    local = kept @ numpy.concatenate([numpy.zeros((3, 3)), numpy.eye(3), swung, turning], axis=1)
    jacobian = numpy.zeros((3, len(found.state_covariance)))
    jacobian[:, 12 * contact.after : 12 * contact.after + 12] += local @ after.by_state
    direct = local @ after.by_parameters
    if contact.located:  # the slip changes until another instant
        root = instant(before, problem.shape, problem.ground, contact.point)
        slope = local @ rates(after.state, found.parameters, problem.model)
        jacobian[:, 12 * contact.before : 12 * contact.before + 12] += numpy.outer(slope, root.by_state)
        direct = direct + numpy.outer(slope, root.by_parameters)
    return float(numpy.sqrt(numpy.linalg.eigvalsh(_covariance(found, jacobian, direct)).max(initial=0.0)))


def _covariance(found: ParameterEstimate, jacobian: Array, direct: Array) -> Array:
    """Covariance [3, 3] of what depends on all states by `jacobian` and on the parameters by
    `direct` besides.
    """
    shared = jacobian @ found.state_by_parameters + direct
    return numpy.asarray(jacobian @ found.state_covariance @ jacobian.T + shared @ found.covariance @ shared.T)
