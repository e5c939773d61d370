"""What is to be estimated from what: flights, contacts between them, parameters.

Moment of a contact that lasts: how its arm turns while its impulse grows.

Of a contact from t0 to t1, `int r x dpi = r1 x pi(t1) - int r' x (pi - pi(t0)) dt`, r the arm, r'
its rate and pi the impulse over the mass. The first term comes from the flights before and after.
The last is small, by the angle through which the body turns meanwhile; it is the quadrature of a
cubic spline through t0, the samples in between, and t1: the force needs no law.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState
from contact_sim_pkg.identify.motion.geometry import UP, GroundPlane, Shape, gaps, inertia_guess
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise

__all__ = [
    "AXES",
    "FEW",
    "ContactSpan",
    "IdentificationProblem",
    "ImpulseMoment",
    "planar_basis",
    "pressed",
    "spatial_basis",
    "start_of",
    "starting_parameters",
    "sweep",
]


AXES = "xyz"
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


class ImpulseMoment(NamedTuple):
    """Moment of the impulses of a contact from t0 to t1 (`identify/problem.py`): `int r' x (pi -
    pi(t0)) dt`, r' the rate of the arm.

    It is moment - kappa by_inverse_mass - (r1 - r0) x (v0 - velocity)`, v0 the velocity at t0."""

    moment: Array  # [3], [m^2/s], at `velocity` and kappa = 0
    by_inverse_mass: Array  # [3], [kg m^2/s]
    velocity: Array  # [3], [m/s]
    deviation: float  # standard deviation of a component, [m^2/s]: of the quadrature and of the samples
    quadrature: float  # the share of the quadrature in it
    samples: int  # while the contact lasts


class ContactSpan(NamedTuple):
    """One contact between two flights."""

    before: int  # number of the flight
    after: int
    begin: float  # [s]; where the flight before ends
    end: float  # [s]; equal to begin for an impact
    point: int  # of the shape
    turns: bool = True  # its moment counts: it acts at this point alone
    slides: bool = False  # the known friction counts
    sweep: ImpulseMoment | None = None  # of a contact that lasts: the moment of its impulses
    located: bool = False  # an impact whose instant is no more than the root of the gap on the flight before


EXACT = SampleNoise(0.0, 0.0, 0.0, 0.0)


class IdentificationProblem(NamedTuple):
    """Samples, flights, contacts and model."""

    states: BodyStates
    flights: list[tuple[int, int]]  # first and last sample
    contacts: list[ContactSpan]
    shape: Shape
    ground: GroundPlane
    model: FlightModel
    noise: SampleNoise
    axis: Array | None  # normal of the plane of motion in world axes; None in space
    rounding: SampleNoise = EXACT  # standard deviation of the rounding of the samples
    step_noise: SampleNoise | None = (
        None  # of flights of one sample, where it differs: the error of a step counts as noise
    )
    friction: float | None = None  # known coefficient

    @property
    def rows(self) -> Array:
        """What a balance is projected on: [1, 3] in the plane, [3, 3] in space."""
        return numpy.eye(3) if self.axis is None else self.axis[None]

    @property
    def tangents(self) -> Array:
        """Directions along the ground, of length 1: [1, 3] in the plane of motion, [2, 3] in
        space.
        """
        normal = self.ground.normal
        first = numpy.cross(numpy.eye(3)[abs(normal).argmin()] if self.axis is None else self.axis, normal)
        first = first / numpy.linalg.norm(first)
        return first[None] if self.axis is not None else numpy.stack([first, numpy.cross(normal, first)])


def spatial_basis() -> Array:
    """E_i of Ixx, Iyy, Izz, Ixy, Ixz, Iyz (elements of the matrix) over m, [6, 3, 3]."""
    basis = numpy.zeros((6, 3, 3))
    for place, (row, col) in enumerate(PAIRS):
        basis[place, row, col] = basis[place, col, row] = 1.0
    return basis


def planar_basis() -> Array:
    """One unknown, J/m about the normal of the plane; other axes never turn, so any value serves
    them: [1, 3, 3].
    """
    return numpy.eye(3)[None]


def starting_parameters(
    shape: Shape, model: FlightModel, axis: Array | None, inverse_mass: float
) -> tuple[Array, Array]:
    """A start and the size of each parameter, both [parameters]: a homogeneous box, and 1/m as seen
    in the flights.

    axis: normal of the plane of motion in body axes, None in space; inverse_mass: [1/kg].
    """
    guess = inertia_guess(shape)
    size = float(numpy.trace(guess)) / 3.0
    # In a plane one moment of inertia, in space six numbers
    if axis is not None:
        start = [float(axis @ guess @ axis)]
        sizes = list(start)
    else:
        start = [float(guess[row, col]) for row, col in PAIRS]
        sizes = [size] * 6
    if model.with_mass:
        start.append(inverse_mass)
        sizes.append(inverse_mass if inverse_mass > 0.0 else _usual_inverse_mass(model, size))
    return numpy.array(start), numpy.array(sizes)


def _usual_inverse_mass(model: FlightModel, inertia: float) -> float:
    """1/m in [1/kg] of a body that the wrench moves as gravity would."""
    wrench = model.wrench
    time = (
        numpy.array([max(wrench.begin, -1e9), min(wrench.end, 1e9)]) if numpy.isfinite(wrench.begin) else numpy.zeros(1)
    )
    force = 0.0 if wrench.force is None else float(abs(numpy.asarray(wrench.force.value(time))).max())
    torque = float(abs(wrench.torque_at(time)).max()) / numpy.sqrt(inertia)
    return float(max(model.gravity, 1e-3) / max(force, torque, 1e-300))


def start_of(states: BodyStates, flight: tuple[int, int]) -> FlightState:
    """State of a flight at its first sample, as measured."""
    first = flight[0]
    return FlightState(
        float(states.time[first]), states.position[first], states.velocity[first], states.rotation[first],
        states.angular_velocity[first],
    )  # fmt: skip


FEW = (0.5, 0.25)  # of the largest that the integral can be: its error with no sample within, and with one


def inside(problem: IdentificationProblem, begin: float, end: float) -> NDArray[numpy.intp]:
    """Numbers [samples] of the samples strictly between two instants [s]."""
    time = problem.states.time
    return numpy.flatnonzero((time > begin) & (time < end))


def pressed(problem: IdentificationProblem, point: int, begin: float, end: float, uncertainty: float) -> bool:
    """Whether `point`, and no other, is on the ground or below it at all samples while a contact
    lasts.

    `uncertainty`: how large a gap noise can feign, [m].
    """
    states, chosen = problem.states, inside(problem, begin, end)
    lifts = gaps(problem.shape, problem.ground, states.position[chosen], states.rotation[chosen])
    others = numpy.delete(lifts, point, axis=1)
    return bool((lifts[:, point] <= uncertainty).all() and (others > uncertainty).all())


def sweep(problem: IdentificationProblem, point: int, before: FlightState, after: FlightState) -> ImpulseMoment:
    """Of a contact at `point`, from the end `before` of one flight to the begin `after` of the
    next.
    """
    states, chosen = problem.states, inside(problem, before.time, after.time)
    time = numpy.array([before.time, *states.time[chosen], after.time])
    rotation, velocity, spin = (
        numpy.concatenate([getattr(before, name)[None], getattr(states, name)[chosen], getattr(after, name)[None]])
        for name in ("rotation", "velocity", "angular_velocity")
    )
    rate: Array = numpy.cross(spin, rotation @ problem.shape.points[point])
    falling: Array = (time - before.time)[:, None] * problem.model.gravity * UP
    grown = velocity - before.velocity + falling
    wrench = problem.model.wrench.push(before.time, time)
    moment, error = _integral(time, rate, grown)
    by_inverse_mass, _ = _integral(time, rate, wrench)
    spread = _sample_noise(problem, point, time, rate, grown)
    return ImpulseMoment(
        moment, by_inverse_mass, before.velocity, float(numpy.hypot(error, spread)), error, len(chosen)
    )  # fmt: skip


def _integral(time: Array, rate: Array, grown: Array) -> tuple[Array, float]:
    """Integral [3] of `rate x grown` [n, 3], n >= 2, and what its error may be.

    From many samples half of what every second one changes, which chance can make small, and a
    share of the largest that the integral can be, falling with the third power of their number;
    from few that share alone.
    """
    values: Array = numpy.asarray(numpy.cross(rate, grown), dtype=numpy.float64)
    nodes = len(time)
    found = _spline_integral(time, values)
    fastest, largest = (float(numpy.linalg.norm(each, axis=1).max()) for each in (rate, grown))
    most = fastest * largest * float(time[-1] - time[0])
    if nodes < len(FEW) + 2:
        return found, FEW[nodes - 2] * most
    kept = numpy.unique([*range(0, nodes, 2), nodes - 1])
    change = 0.5 * float(numpy.linalg.norm(found - _spline_integral(time[kept], values[kept])))
    return found, float(numpy.hypot(change, FEW[0] * most / (nodes - 1) ** 3))


def _spline_integral(time: Array, values: Array) -> Array:
    spline = make_interp_spline(time, values, k=min(3, len(time) - 1))
    return numpy.asarray(spline.integrate(time[0], time[-1]))


def _sample_noise(problem: IdentificationProblem, point: int, time: Array, rate: Array, grown: Array) -> float:
    """Standard deviation of the integral from the noise of its samples, [m^2/s]."""
    noise, length = problem.noise, float(numpy.linalg.norm(problem.shape.points[point]))
    weight = float(numpy.sqrt(numpy.sum(numpy.gradient(time) ** 2)))
    fastest, largest = (float(numpy.linalg.norm(each, axis=1).max()) for each in (rate, grown))
    turning = length * noise.angular_velocity + fastest * noise.rotation
    return weight * float(numpy.hypot(fastest * noise.velocity, largest * turning))
