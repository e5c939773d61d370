"""Hard cases of what a back touches with and what it touches: foam at the seat back, and the search
of the contact point.
"""

from __future__ import annotations

import numpy
from scipy.optimize import minimize

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.rigs.backrest.drive import BackrestMotion, drive_of, fast_run
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.backrest.contact_search import nearest_point
from contact_sim_pkg.rigs.backrest.parameters import ContactSearch
from contact_sim_pkg.scene.resolve import load_resolved

FOAM, SEARCH = "foam at the back", "contact search"
TIGHT = "integrator.relative_tolerance=1e-9"
FOAM_BACK = (
    "seat_slap", TIGHT, "effects.backrest.normal_elastic={}", "effects.backrest.normal_dissipative={damping: 0.5}",
    "effects.backrest.foam={area: 0.12, thickness: 0.08}", "effects.backrest.foam_hysteresis={share: 0.12, energy: 1.0}",
)  # fmt: skip
THIN = "effects.backrest.foam={area: 0.12, thickness: 0.02}"
SHELL = (
    "seat_slap", TIGHT, "effects.backrest.shell_modes={modes: 9}", "effects.backrest.contact_search={}", "backrest.preload=20",
)  # fmt: skip
WIDTH, HEIGHT, RADII = 0.40, 0.50, (0.6, 1.5)  # [m], of the back of `seat_slap`


def _run(*scene: str, duration: float) -> BackrestMotion:
    drive = drive_of(load_resolved(*scene), duration)
    return fast_run(drive, drive.model.scale)


def _unbalanced(motion: BackrestMotion) -> float:
    return abs(motion.residual / motion.supplied)


def slaps_on_foam() -> Finding:
    """Residual of the energy over the work supplied: foam with hysteresis and damping, 1.5
    g, 2 s.
    """
    found = _run(*FOAM_BACK, duration=2.0)
    return at_most(_unbalanced(found), 1e-7, hard=len(found.touches))


def foam_that_bottoms_out() -> Finding:
    """The same where 6 g crush 20 mm of foam, 1 s."""
    found = _run(*FOAM_BACK, THIN, "vibration.amplitude=58.86", duration=1.0)
    return at_most(_unbalanced(found), 1e-7, hard=found.approach.max() / 0.02)


def foam_that_is_left() -> Finding:
    """Samples with a force below zero, or with one where the back is off the foam, 6 g for 1 s."""
    found = _run(*FOAM_BACK, "vibration.amplitude=58.86", duration=1.0)
    separated = found.approach[:, 0] <= 0.0
    wrong = (found.normal < 0.0).sum() + (found.normal[separated] != 0.0).sum()
    return exactly(int(wrong), 0, hard=separated.sum())


def _search() -> ContactSearch:
    search = drive_of(load_resolved(*SHELL), 0.01).model.rig.search
    assert search is not None
    return search


def _depth(shape: Vector, place: Vector) -> float:
    """Depth in [m] of the shell at a place, from the sines and the paraboloid: nothing of the
    search's.
    """
    orders = numpy.arange(1, round(len(shape) ** 0.5) + 1) * numpy.pi
    sines = numpy.outer(numpy.sin(orders * place[0] / WIDTH), numpy.sin(orders * place[1] / HEIGHT)).ravel()
    away = numpy.array([place[0] - 0.5 * WIDTH, place[1] - 0.5 * HEIGHT])
    return float(sines @ shape - 0.5 * (away**2 / RADII).sum())


def _crests(shape: Vector) -> list[float]:
    """Largest depths about 25 starts, by scipy."""
    starts = numpy.stack(numpy.meshgrid(numpy.linspace(0.0, WIDTH, 5), numpy.linspace(0.0, HEIGHT, 5)), -1).reshape(
        -1, 2
    )
    bounds = [(0.0, WIDTH), (0.0, HEIGHT)]
    found = [minimize(lambda p: -1e3 * _depth(shape, p), s, bounds=bounds, options={"ftol": 1e-15}) for s in starts]
    return [-1e-3 * float(each.fun) for each in found]


def nearest_of_many_crests() -> Finding:
    """Ten shells bent by 2 and by 50 mm in nine modes: by how much a place lies deeper than the one
    found [m].
    """
    search, random = _search(), numpy.random.default_rng(7)
    short, apart = 0.0, 0.0
    for size in (0.002, 0.05) * 5:
        shape = size * random.normal(size=9) / numpy.arange(1, 10)
        crests = _crests(shape)
        apart = max(apart, max(crests) - min(crests))
        short = max(short, max(crests) - _depth(shape, numpy.array(nearest_point(search, shape))))
    return at_most(short, 1e-9, hard=apart)


def nearest_on_the_rim() -> Finding:
    """A shell bent hollow by 1 m touches where its sines are zero: depth in the middle of its
    shorter gap, -L2^2/(8 R2) [m].
    """
    search = _search()
    hollow = numpy.zeros(9)
    hollow[0] = -1.0
    place = numpy.array(nearest_point(search, hollow))
    found = _depth(hollow, place)
    rim = min(*place, *(numpy.array([WIDTH, HEIGHT]) - place))
    return close_to(found, -(HEIGHT**2) / (8.0 * RADII[1]), 1e-12, hard=rim)


def point_that_moves() -> Finding:
    """Residual of the energy over the work supplied: a force whose point moves keeps its potential,
    9 modes, 1 s.
    """
    found = _run(*SHELL, duration=1.0)
    assert found.place is not None
    way = float(numpy.linalg.norm(numpy.ptp(found.place, axis=0)))
    return at_most(_unbalanced(found), 1e-6, hard=way)


CASES = (
    HardCase(FOAM, "1.5 g slaps, memory and loss: energy not accounted for", slaps_on_foam, guard.touches(5)),
    HardCase(FOAM, "6 g on 20 mm of foam, bottoms out: energy not accounted for", foam_that_bottoms_out,
        guard.at_least("largest approach over thickness", 0.85)),
    HardCase(FOAM, "6 g slaps: negative forces, and forces without overlap", foam_that_is_left,
        guard.contact_lost(100)),
    HardCase(SEARCH, "nine modes, many crests: deeper place than the one found [m]", nearest_of_many_crests,
        guard.at_least("depths of crests that a start elsewhere ends on, apart by [m]", 1e-3)),
    HardCase(SEARCH, "hollow shell, nearest on its rim: depth [m]", nearest_on_the_rim,
        guard.at_most("distance of the place from the rim [m]", 1e-9)),
    HardCase(SEARCH, "moving point, 9 modes: energy not accounted for", point_that_moves,
        guard.at_least("way of the contact point [m]", 1e-3)),
)  # fmt: skip
