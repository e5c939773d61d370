"""Flights and contacts of a sampled motion.

An interval between two samples holds a contact where `v2 - v1 + h g z - kappa int F dt` is larger
than noise explains (the 0.9999 quantile of chi-square) and the body is close to the ground, or is
far larger; or where the body stays on the ground. Neighbouring ones are one contact; more than
three in a row are a lasting one.

Inertia of a body that tumbles freely, up to its size: where the search in space starts.

In flight the angular momentum over the mass is `R S R^T w = L0 + kappa int tau dt`, linear in the
six numbers of S = I0/m and in kappa = 1/m. What is left of it about its mean over each flight is
made least at a fixed trace of S, weighted by the noise, with the guess as it is where the motion
does not identify it: five numbers of a body that tumbles in all directions.

Source: Identifiability eqs 19 to 31 without an impulse.

Whether a motion stays in a plane.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from scipy.stats import chi2

from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.geometry import UP, GroundPlane, Shape, gaps, size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.motion.wrench import ExternalWrench

__all__ = [
    "LONGEST_IMPACT",
    "SHORTEST_FLIGHT",
    "Segments",
    "body_axis",
    "gap_uncertainty",
    "inverse_mass_guess",
    "plane_of_motion",
    "segments",
    "tumbling_start",
    "velocity_noise",
]


QUANTILE = 0.9999
LONGEST_IMPACT = 3  # intervals
SHORTEST_FLIGHT = 3  # samples
CERTAIN = 25.0  # times the limit: a jump that counts as a contact wherever it is, so that no flight runs over it
SIGMAS = 6.0
TOUCH = 1e-9  # of the body's size: a gap that counts as none
FLOOR = 1e-9  # of the largest speed: what counts as noise at least
MEDIAN_OF_GAUSS = 0.6744897501960817


class Segments(NamedTuple):
    """Runs of samples in flight, and of intervals in contact; both ends belong to the run."""

    flights: list[tuple[int, int]]  # first and last sample
    contacts: list[tuple[int, int]]  # first and last interval; interval i lies between samples i and i + 1


def velocity_noise(states: BodyStates) -> float:
    """Standard deviation of a velocity component in [m/s], from the median change of the
    acceleration between intervals.

    Impacts do not move the median. Intervals may differ; stamps that are off count as noise of the
    velocity.
    """
    if len(states.time) < 5:
        return 0.0
    steps = numpy.diff(states.time)[:, None]
    change = numpy.diff(numpy.diff(states.velocity, axis=0) / steps, axis=0)
    share = 1.0 / steps[:-1] + 1.0 / steps[1:]
    spread = numpy.sqrt(share**2 + 1.0 / steps[:-1] ** 2 + 1.0 / steps[1:] ** 2)
    return float(numpy.median(abs(change) / spread, axis=0).max() / MEDIAN_OF_GAUSS)


def inverse_mass_guess(
    states: BodyStates, lifts: Array, wrench: ExternalWrench, gravity: float, uncertainty: float = 0.0
) -> float:
    """1/m in [1/kg] from the intervals off the ground: median of e.f/f.f; 0 without a force, or
    where all are on the ground.

    Below zero where the body moves against the force.

    `lifts` [samples]: smallest gaps, known to `uncertainty`, in [m].
    """
    pushes = _pushes(states, wrench)
    strength = numpy.einsum("ni,ni->n", pushes, pushes)
    chosen = (strength > 0.0) & (
        numpy.minimum(lifts[1:], lifts[:-1]) > max(uncertainty, 0.02 * float(numpy.ptp(lifts)))
    )
    if not chosen.any():
        return 0.0
    jumps = _jumps(states, gravity)
    return float(numpy.median(numpy.einsum("ni,ni->n", jumps, pushes)[chosen] / strength[chosen]))


def segments(
    states: BodyStates,
    shape: Shape,
    ground: GroundPlane,
    wrench: ExternalWrench,
    gravity: float,
    noise: float,
    place_noise: tuple[float, float] = (0.0, 0.0),
) -> Segments:
    """Split the motion.

    Args:
        states: the motion.
        shape: of the body.
        ground: below it.
        wrench: known force and torque.
        gravity: [m/s^2], downward.
        noise: of one velocity component, [m/s].
        place_noise: of one component of position [m] and of rotation [rad].
    """
    lifts = gaps(shape, ground, states.position, states.rotation).min(axis=1)
    uncertainty = gap_uncertainty(shape, place_noise)
    inverse_mass = inverse_mass_guess(states, lifts, wrench, gravity, uncertainty)
    # Changes of velocity that gravity and the wrench do not explain
    jumps = _jumps(states, gravity) - inverse_mass * _pushes(states, wrench)
    deviation = max(noise, FLOOR * float(abs(states.velocity).max()))
    strength = numpy.einsum("ni,ni->n", jumps, jumps) / (chi2.ppf(QUANTILE, 3) * 2.0 * deviation**2 + 1e-300)
    # A contact: a change beyond noise near the ground, a certain one anywhere, or rest on it
    near = _near(states, lifts, ground, place_noise[0])
    hit = (strength > 1.0) & (near | (strength > CERTAIN)) | _down(states, lifts, gravity, uncertainty)
    return Segments(*_runs(hit | _pressed_in(jumps, lifts < -uncertainty, deviation)))


def gap_uncertainty(shape: Shape, place_noise: tuple[float, float]) -> float:
    """Largest gap in [m] that noise can feign."""
    length = size(shape)
    return SIGMAS * (place_noise[0] + length * place_noise[1]) + TOUCH * length


def _down(states: BodyStates, lifts: Array, gravity: float, uncertainty: float) -> Array:
    """Intervals in which the body stays on the ground for longer than a hop that noise could hide
    would last.
    """
    low = abs(lifts) <= uncertainty
    joined = low[1:] & low[:-1]
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], joined.astype(int), [0]])))
    longest = numpy.sqrt(8.0 * uncertainty / gravity) if gravity > 0.0 else numpy.inf
    for first, last in edges.reshape(-1, 2):
        joined[first:last] = states.time[last] - states.time[first] > longest
    return numpy.asarray(joined)


def _pressed_in(jumps: Array, below: Array, deviation: float) -> Array:
    """Intervals of soft contacts: the body comes from above, is below the ground, and is pushed
    more than noise explains.

    A push of many short intervals may hide in the noise of each. Where one interval holds all of
    it, it was an impact.
    """
    found = numpy.zeros(len(jumps), dtype=bool)
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], below.astype(int), [0]])))
    limit = chi2.ppf(QUANTILE, 3) * 2.0 * deviation**2
    for first, last in edges.reshape(-1, 2):
        run = slice(max(first - 1, 0), min(last, len(jumps)))
        pushed = numpy.sum(jumps[run], axis=0)
        found[run] = first > 0 and float(pushed @ pushed) > limit and not _at_once(jumps[run], limit)
    return found


def _at_once(jumps: Array, limit: float) -> bool:
    """Whether one interval holds all of a push: it was an impact, and the ground or the shape is
    not where it is specified.
    """
    sizes = numpy.einsum("ni,ni->n", jumps, jumps)
    largest = int(sizes.argmax())
    rest = numpy.sum(jumps, axis=0) - jumps[largest]
    return bool(sizes[largest] > limit >= 0.5 * float(rest @ rest))


def _near(states: BodyStates, lifts: Array, ground: GroundPlane, position_noise: float) -> Array:
    """Intervals in which the body can reach the ground: the gap is within one interval's way."""
    steps = numpy.diff(states.time)
    rates = abs(numpy.diff(lifts)) / steps
    fastest = abs(states.velocity @ ground.normal)
    reach = 2.0 * steps * (numpy.maximum(fastest[1:], fastest[:-1]) + rates) + 6.0 * position_noise + 1e-9
    return numpy.asarray(numpy.minimum(lifts[1:], lifts[:-1]) <= reach)


def _runs(hit: Array) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Runs of samples between hits, and runs of hits."""
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], hit.astype(int), [0]])))
    contacts = [(int(first), int(last) - 1) for first, last in edges.reshape(-1, 2)]
    begins = [0, *(last + 1 for _, last in contacts)]
    ends = [*(first for first, _ in contacts), len(hit)]
    return list(zip(begins, ends, strict=True)), contacts


def _jumps(states: BodyStates, gravity: float) -> Array:
    falling = numpy.diff(states.time)[:, None] * gravity * UP
    return numpy.asarray(numpy.diff(states.velocity, axis=0) + falling)


def _pushes(states: BodyStates, wrench: ExternalWrench) -> Array:
    if wrench.force is None:
        return numpy.zeros((len(states.time) - 1, 3))
    pushes: Array = numpy.diff(wrench.push(float(states.time[0]), states.time), axis=0)
    return pushes


MOST = 200  # samples of a flight that are used
SLACK = 1e-6  # of the trace: second moment below zero that counts as zero
SHAPES = numpy.array([  # changes of (xx, yy, zz, xy, xz, yz) that leave the trace as it is
    [1.0, -1.0, 0.0, 0.0, 0.0, 0.0], [1.0, 1.0, -2.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
])  # fmt: skip


def tumbling_start(
    states: BodyStates, flights: list[tuple[int, int]], model: FlightModel, noise: SampleNoise, guess: Array
) -> Array | None:
    """Parameters to begin with, [parameters]; None where no body has such an inertia, or no flight
    is long enough.

    Args:
        states: the motion.
        flights: first and last sample of each.
        model: in space.
        noise: of the samples.
        guess: parameters of which the trace is kept, and all that the flights do not identify, [p].
    """
    blocks = [
        _about_the_mean(states, flight, model) for flight in flights if flight[1] - flight[0] + 1 >= SHORTEST_FLIGHT
    ]
    if not blocks:
        return None
    rows = numpy.concatenate(blocks)
    size = float(guess[:3].sum()) / 3.0
    fastest = float(numpy.linalg.norm(states.angular_velocity, axis=1).max())
    spread = size * (noise.angular_velocity + fastest * noise.rotation)
    # Unknowns: the shape of the inertia at a given size, and 1/m
    free = numpy.zeros((len(SHAPES) + model.with_mass, len(guess)))
    free[: len(SHAPES), :6] = size * SHAPES
    if model.with_mass:
        free[-1, -1] = guess[-1]
    # Least squares, regularised towards the guess
    system = numpy.concatenate([rows @ free.T / spread, numpy.eye(len(free))])
    right = numpy.concatenate([-rows @ guess / spread, numpy.zeros(len(free))])
    found: Array = guess + numpy.linalg.lstsq(system, right)[0] @ free
    # A body has no negative second moment
    inertia = model.inertia(found)
    trace = float(numpy.trace(inertia))
    moments = numpy.linalg.eigvalsh(0.5 * trace * numpy.eye(3) - inertia)
    return found if moments.min() >= -SLACK * trace else None


def _about_the_mean(states: BodyStates, flight: tuple[int, int], model: FlightModel) -> Array:
    """What each parameter makes of the angular momentum of a flight less its mean and the impulse
    of the torque, [3 n, p].
    """
    first, last = flight
    chosen = numpy.unique(numpy.linspace(first, last, min(MOST, last - first + 1)).round().astype(int))
    turns, spins = states.rotation[chosen], states.angular_velocity[chosen]
    columns = [numpy.einsum("nij,jk,nlk,nl->ni", turns, part, turns, spins) for part in model.basis]
    if model.with_mass:
        columns.append(-model.wrench.twist(float(states.time[first]), states.time[chosen]))
    rows: Array = numpy.stack(columns, axis=2)
    centred: Array = (rows - rows.mean(axis=0)).reshape(-1, rows.shape[2])
    return centred


PLANE_SIGMAS = 5.0
LEVEL = 1e-6  # allowed component of the axis along the ground's normal


def plane_of_motion(states: BodyStates, ground: GroundPlane, noise: SampleNoise) -> Array | None:
    """Normal [x, y, z] of the plane in world axes, its largest component positive; None where the
    motion is spatial.

    In a plane the spin keeps one axis, level with the ground, and the speed along that axis never
    changes.
    """
    spins = states.angular_velocity
    _, values, axes = numpy.linalg.svd(spins / numpy.sqrt(len(spins)), full_matrices=False)
    if values[0] <= PLANE_SIGMAS * noise.angular_velocity + 1e-12:
        return None
    axis = axes[0] * numpy.sign(axes[0][abs(axes[0]).argmax()])
    across = states.velocity @ axis
    straight = values[1] <= max(PLANE_SIGMAS * noise.angular_velocity, FLOOR * values[0])
    speed = float(abs(states.velocity).max())
    kept = float(abs(across - numpy.median(across)).max()) <= max(PLANE_SIGMAS * noise.velocity, FLOOR * speed)
    level = abs(float(axis @ ground.normal)) <= max(LEVEL, PLANE_SIGMAS * noise.angular_velocity / float(values[0]))
    return (
        _named(axis, PLANE_SIGMAS * noise.angular_velocity / float(values[0])) if straight and kept and level else None
    )


def body_axis(states: BodyStates, axis: Array, noise: SampleNoise) -> Array:
    """Normal [x, y, z] of the plane in body axes: the mean over all samples; axis: in world
    axes.
    """
    mean = numpy.einsum("nji,j->i", states.rotation, axis)
    return _named(mean / numpy.linalg.norm(mean), PLANE_SIGMAS * noise.rotation)


def _named(axis: Array, angle_error: float) -> Array:
    """A coordinate axis where one lies within ``angle_error`` [rad], else the axis as it is."""
    nearest = numpy.round(axis)
    return nearest if float(numpy.linalg.norm(axis - nearest)) <= max(angle_error, 1e-9) else axis
