"""Moment of a contact that lasts: how its arm turns while its impulse grows.

Of a contact from t0 to t1, `int r x dpi = r1 x pi(t1) - int r' x (pi - pi(t0)) dt`, r the arm, r'
its rate and pi the impulse over the mass. The first term comes from the flights before and after.
The last is small, by the angle through which the body turns meanwhile; it is the quadrature of a
cubic spline through t0, the samples in between, and t1: the force needs no law.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from contact_sim_pkg.identify.geometry import UP, gaps
from contact_sim_pkg.identify.motion.flight import FlightState
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import IdentificationProblem, ImpulseMoment

__all__ = ["FEW", "pressed", "sweep"]

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
