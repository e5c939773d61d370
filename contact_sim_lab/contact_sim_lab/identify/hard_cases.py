"""Hard cases of the identification: what must be named instead of computed, impacts between
samples, noise in everything.
"""

from __future__ import annotations

import functools

import numpy

from contact_sim_lab.identify.twins.block_impacts import random_block_impacts
from contact_sim_lab.identify.twins.falling_body import FallingBody, Record, fall
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.identify import Identification, Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.rotation import Array, exponential
from contact_sim_pkg.identify.motion.states import BodyStates
from contact_sim_pkg.identify.naming import unobservable
from contact_sim_pkg.identify.table import ImpactTable, estimate_from_impacts, problem_of_impacts

SIDE, MASS = 0.1, 1.3  # [m], [kg]
INERTIA = SIDE**2 / 6.0  # J/m of a square, [m^2]
SQUARE = geometry.box([SIDE] * 3)
BOX = geometry.box([0.10, 0.14, 0.20])
PITCH = numpy.array([0.0, 1.0, 0.0])
FORCE = (1.3, 0.0, 0.7)  # [N]
SPEED_NOISE, SPIN_NOISE = 1e-3, 1e-2  # [m/s], [rad/s]
DRAWS, IMPACTS = 60, 10


@functools.cache
def _record(force: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Record:
    """A square that falls and bounces, sampled at 1 kHz; its impacts lie between samples."""
    corners = 0.5 * SIDE * numpy.array([[-1.0, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]])
    body = FallingBody(MASS, MASS * INERTIA * numpy.eye(3), corners, 0.3, 0.6, force=force)
    turned = exponential(0.2 * PITCH)
    return fall(body, numpy.array([0, 0, 0.3]), turned, numpy.array([0.5, 0, 0]), 2.0 * PITCH, 0.7)


@functools.cache
def _found(force: tuple[float, float, float] = (0.0, 0.0, 0.0), *, known: bool = False) -> Identification:
    setup = Setup(SQUARE, wrench=wrench.constant(force) if known else wrench.NO_WRENCH)
    return identify(BodyStates(*_record(force)[:5]), setup)


def _table(count: int, *, central: bool = False) -> ImpactTable:
    """Random impacts of a box in space; the spin after follows from the balance."""
    random = numpy.random.default_rng(4)
    inertia = numpy.diag([4e-3, 3e-3, 2e-3])
    rotation = exponential(random.normal(size=(count, 3)))
    before, spin = random.normal(size=(2, count, 3))
    reach = numpy.stack([_lowest(turned) for turned in rotation])
    push = -reach if central else random.normal(size=(count, 3))
    world = rotation @ inertia @ numpy.swapaxes(rotation, 1, 2)
    change = numpy.linalg.solve(world, numpy.cross(reach, push)[..., None])[..., 0]
    return ImpactTable(rotation, before, before + push, spin, spin + change)


def _lowest(rotation: Array) -> Array:
    corners = BOX.points @ rotation.T
    return numpy.asarray(corners[corners[:, 2].argmin()])


def _spatial(table: ImpactTable) -> ParameterEstimate:
    return estimate_from_impacts(problem_of_impacts(table, BOX, (1e-12, 1e-11)))


def through_the_centre() -> Finding:
    """Rank from four impulses through the centre of mass."""
    table = _table(4, central=True)
    return exactly(_spatial(table).directions.rank, 0, hard=abs(table.spin_after - table.spin_before).max())


def two_impacts() -> Finding:
    """Rank from two impacts in space."""
    table = _table(2)
    return exactly(_spatial(table).directions.rank, 5, hard=len(table.rotation))


def two_impacts_named() -> Finding:
    """Distance of the unobservable direction, as a matrix, from c c^T with c across both changes of
    spin.
    """
    table = _table(2)
    found = _spatial(table)
    line = found.directions.missing[0] * found.scale
    matrix = numpy.array([[line[0], line[3], line[4]], [line[3], line[1], line[5]], [line[4], line[5], line[2]]])
    changes = table.spin_after - table.spin_before
    across = numpy.cross(*(turned.T @ change for turned, change in zip(table.rotation, changes, strict=True)))
    expected = numpy.outer(across, across)
    alike = numpy.sum(matrix * expected) / numpy.linalg.norm(matrix) / numpy.linalg.norm(expected)
    named = any(
        "body axis" in words
        for words in unobservable(found.directions.missing, found.parameters, found.scale, True, False)
    )
    return at_most(1.0 - abs(float(alike)) if named else numpy.inf, 1e-9, hard=len(table.rotation))


def _off_samples() -> float:
    record = _record()
    interval = record.time[1] - record.time[0]
    return min(float(abs(record.time - bounce.time).min() / interval) for bounce in record.bounces)


def between_samples() -> Finding:
    """Relative error of m/J from impacts between samples."""
    return at_most(abs(INERTIA / _found().parameters[0].value - 1.0), 1e-9, hard=_off_samples())


def impulses() -> Finding:
    """Largest relative error of c_n/m and c_t/m over all impacts."""
    worst = 0.0
    for contact, bounce in zip(_found().contacts, _record().bounces, strict=True):
        if contact.push is None:
            return at_most(numpy.inf, 1e-9, hard=_off_samples())
        push = bounce.impulse / MASS
        worst = max(worst, *(abs(contact.push[axis] / push[axis] - 1.0) for axis in (0, 2)))
    return at_most(worst, 1e-9, hard=_off_samples())


def mass_without_force() -> Finding:
    """Sentences that name the mass as not identifiable; no parameter is a mass."""
    force = (0.0, 0.0, 0.0)
    found = _found(force)
    named = sum(words.startswith("mass is not identifiable without an external force") for words in found.unobservable)
    return exactly(
        named + sum(parameter.name == "1/m" for parameter in found.parameters), 1, hard=float(numpy.linalg.norm(force))
    )


def mass_with_force() -> Finding:
    """The mass with a known force."""
    return close_to(
        1.0 / _found(FORCE, known=True).parameters[-1].value, MASS, 1e-9 * MASS, hard=len(_record(FORCE).bounces)
    )


@functools.cache
def _noisy() -> tuple[Array, Array, float]:
    """Relative errors of m/J and reported standard deviations over the draws; the noise that was added [m/s]."""
    random, errors, reported, added = numpy.random.default_rng(11), [], [], []
    for _ in range(DRAWS):
        exact = random_block_impacts(random, IMPACTS)
        velocities = [field + SPEED_NOISE * random.normal(size=field.shape) for field in exact[1:3]]
        added.append(velocities[0] - exact[1])
        spins = [field + SPIN_NOISE * random.normal(size=field.shape) for field in exact[3:5]]
        table = ImpactTable(exact.rotation, velocities[0], velocities[1], spins[0], spins[1])
        found = estimate_from_impacts(problem_of_impacts(table, SQUARE, (SPEED_NOISE, SPIN_NOISE), PITCH))
        errors.append(INERTIA / found.parameters[0] - 1.0)
        reported.append(float(numpy.sqrt(found.covariance[0, 0])) / found.parameters[0])
    return numpy.array(errors), numpy.array(reported), float(numpy.std(added))


def noise() -> Finding:
    """Root mean square of the relative error of m/J over the draws."""
    return at_most(float(numpy.sqrt(numpy.mean(_noisy()[0] ** 2))), 1.5e-3, hard=_noisy()[2])


def reported_noise() -> Finding:
    """The same over the standard deviation that is reported."""
    errors, reported, _added = _noisy()
    return close_to(float(numpy.sqrt(numpy.mean(errors**2) / numpy.mean(reported**2))), 1.0, 0.3, hard=_noisy()[2])


CASES = (
    HardCase("identification", "impulses through the centre of mass: rank", through_the_centre,
        guard.at_most("change of the spin [rad/s]", 1e-12)),
    HardCase("identification", "two impacts, six unknowns: rank", two_impacts,
        guard.at_most("impacts, of three that are needed", 2)),
    HardCase("identification", "two impacts: direction that is named, distance", two_impacts_named,
        guard.at_most("impacts, of three that are needed", 2)),
    HardCase("identification", "impacts between samples: error of m/J", between_samples,
        guard.at_least("distance of an impact from its samples, over their interval", 1e-3)),
    HardCase("identification", "impacts between samples: error of the impulses", impulses,
        guard.at_least("distance of an impact from its samples, over their interval", 1e-3)),
    HardCase("identification", "no external force: mass named, not computed", mass_without_force,
        guard.zero("force from outside [N]")),
    HardCase("identification", "known force: mass [kg]", mass_with_force, guard.impacts(3)),
    HardCase("identification", "10 impacts, 1 mm/s, 10 mrad/s: rms error of m/J", noise,
        guard.at_least("standard deviation of the speeds [m/s]", 9e-4)),
    HardCase("identification", "the same: error over reported deviation", reported_noise,
        guard.at_least("standard deviation of the speeds [m/s]", 9e-4)),
)  # fmt: skip
