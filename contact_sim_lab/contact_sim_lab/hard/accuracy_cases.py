"""Hard scenes of `bench hard --accuracy`: what a user tries, short enough to be run at 3e-5, each with
the guard that its run must meet to be hard.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.guard import Guard
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.body.model import build_block
from contact_sim_pkg.run.scene_outputs import records_of
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["CASES", "AccuracyCase"]

Measure = Callable[[ResolvedScene, list[Output]], float]
"""Figure of a guard, from a scene and the outputs of its whole run."""


class AccuracyCase(NamedTuple):
    """A scene that is hard to compute accurately."""

    name: str
    hard: str  # what is hard about it
    scene: str
    values: tuple[str, ...]  # as of `--set`
    is_hard: Guard
    measure: Measure
    span: float = 0.03  # [s] that is compared, round the event of the excitation; back, block and impact: all


def _column(outputs: list[Output], topic: str, column: str) -> Vector:
    return numpy.concatenate([getattr(record, column) for record in records_of(outputs, topic)])


def _leap(_scene: ResolvedScene, outputs: list[Output]) -> float:
    force = _column(outputs, "tire/force", "normal")
    return float(force.max() / force[0])


def _aloft(contact: str, _scene: ResolvedScene, outputs: list[Output]) -> float:
    return float((_column(outputs, f"{contact}/force", "normal") == 0.0).sum())


def _footprints(outputs: list[Output]) -> list[float]:
    """Length [m] of each pressure map."""
    maps = records_of(outputs, "tire/patch")
    return [each.cell_x * float((each.pressure > 0.0).any(axis=1).sum()) for each in maps]


def _way_over_footprint(scene: ResolvedScene, outputs: list[Output]) -> float:
    return make_travel(scene).speed(0.0) * scene.block_length / _footprints(outputs)[0]


def _longest_footprint(_scene: ResolvedScene, outputs: list[Output]) -> float:
    return max(_footprints(outputs)) / 0.2


def _loaded_cells(_scene: ResolvedScene, outputs: list[Output]) -> float:
    return float(max((patch.pressure > 0.0).sum() for patch in records_of(outputs, "tire/patch")))


def _tilt_grows(_scene: ResolvedScene, outputs: list[Output]) -> float:
    """Largest swing of the tilt about its mean, in the last tenth of the run over the first."""
    tilt = numpy.concatenate([record.position[1] for record in records_of(outputs, "bench/motion")])
    swing, tenth = abs(tilt - tilt.mean()), len(tilt) // 10
    return float(swing[-tenth:].max() / swing[:tenth].max())


def _touches(_scene: ResolvedScene, outputs: list[Output]) -> float:
    normal = _column(outputs, "backrest/force", "normal")
    return float(((normal[:-1] == 0.0) & (normal[1:] > 0.0)).sum())


def _flight_over_contact(_scene: ResolvedScene, outputs: list[Output]) -> float:
    start, lasts = (_column(outputs, "impact/events", name) for name in ("start", "duration"))
    return float(numpy.diff(start).max() / lasts.min())


def _denominator(scene: ResolvedScene, outputs: list[Output]) -> float:
    """Least ``A_nn - mu s A_nt`` [1/kg] of the lowest corner, from the states before each sample with a force, ``s`` the
    direction in which it slid last.
    """
    body, least, direction = build_block(scene).body, math.inf, 0.0
    for motion, force in zip(records_of(outputs, "bench/motion"), records_of(outputs, "block/force"), strict=True):
        for (_x, _z, pitch), velocity, normal in zip(motion.position.T, motion.velocity.T, force.normal, strict=True):
            turn = numpy.array([[math.cos(pitch), math.sin(pitch)], [-math.sin(pitch), math.cos(pitch)]])
            x, z = min(body.points @ turn.T, key=lambda arm: float(arm[1]))
            slip = velocity[0] + velocity[2] * z
            direction = math.copysign(1.0, slip) if abs(slip) > 1e-6 else direction
            if normal > 0.0:
                nn, nt = 1.0 / body.mass + x * x / body.inertia[0], -x * z / body.inertia[0]
                least = min(least, float(nn - body.friction * direction * nt))
    return least


LEAP = guard.at_least("largest force over the first", 1.05)
SLOW = "travel.speed=5"
CASES = (
    AccuracyCase(
        "kerb up", "a sharp edge of 30 mm between two nodes of the grid", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: step, position: 0.16, height: 0.03}"),
        guard.at_least("largest force over the first", 1.5), _leap,
    ),
    AccuracyCase(
        "kerb down", "a sharp edge of 0.1 m: the wheel is aloft, and lands", "tire_bump",
        ("duration=0.4", "road={kind: step, position: 0.05, height: -0.1}"),
        guard.contact_lost(), partial(_aloft, "tire"), 0.1,
    ),
    AccuracyCase(
        "pothole", "50 mm deep, worn edges of 30 mm: the load leaps from one to the other", "tire_bump",
        ("duration=0.4", "road={kind: pothole, position: 0.3, depth: 0.05, length: 0.3, edge: 0.03}"),
        guard.at_least("largest force over the first", 1.5), _leap, 0.06,
    ),
    AccuracyCase(
        "stones", "bars of 10 mm every 0.1 m, one or two under the footprint", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: cleat, position: 0.15, height: 0.01, length: 0.02, edge: 0.005, period: 0.1}"),
        LEAP, _leap, 0.04,
    ),
    AccuracyCase(
        "cleat, belt, bristles", "belt and bristles swing behind a bar shorter than the footprint", "tire_cleat",
        ("duration=0.4", "road.position=0.2"),
        LEAP, _leap, 0.03,
    ),
    AccuracyCase(
        "class E", "a very poor road, round its steepest place", "tire_rough_road",
        ("duration=0.4", "travel={speed: 8}", "road.roughness_class=E"),
        LEAP, _leap, 0.01,
    ),
    AccuracyCase(
        "texture at 30 m/s", "0.3 m of texture under the tire in each block", "tire_rough_road",
        ("duration=0.4", "travel={speed: 30}"),
        guard.at_least("way of a block over the footprint", 1.0), _way_over_footprint, 0.01,
    ),
    AccuracyCase(
        "loss of 0.3 s/m", "20 times the usual loss: the force follows the rate of the height", "tire_bump",
        ("duration=0.4", "road={kind: bump, position: 0.4, height: 0.03, length: 0.6}",
         "effects.tire.normal_dissipative.damping=0.3"),
        guard.at_least("largest force over the first", 1.5), _leap, 0.06,
    ),
    AccuracyCase(
        "soft tire", "120 kPa over a short bump: a long footprint", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: bump, position: 0.2, height: 0.02, length: 0.2}",
         "effects.tire.inflation.pressure=120000", "tire.body_mass=340"),
        guard.at_least("longest footprint over the bump", 0.85), _longest_footprint, 0.03,
    ),
    AccuracyCase(
        "half-space tire", "every cell presses on every other, over a bump", "tire_half_space",
        ("duration=0.4", "road={kind: bump, position: 0.4, height: 0.03, length: 0.6}"),
        guard.at_least("loaded cells, each with each", 500), _loaded_cells, 0.06,
    ),
    AccuracyCase(
        "seat drop", "the occupant lifts off, falls, and lands on the cushion", "seat_drop",
        ("duration=0.5", "vibration.start=0.05"),
        guard.contact_lost(), partial(_aloft, "seat"), 0.5,
    ),
    AccuracyCase("seat slap", "a back slaps on its seat back, and slides", "seat_slap", ("duration=0.8",),
        guard.touches(2), _touches),
    AccuracyCase("flutter", "tilt and yaw of a roller that grow without bound", "roller_flutter", ("duration=1",),
        guard.at_least("swing of the tilt at the end over that at first", 1.05), _tilt_grows),
    AccuracyCase("jam", "a slipping block jams (Painleve): no sliding motion exists", "block_painleve",
        ("block.rotation=[0, -0.45, 0]",),
        guard.denominator_below_0(), _denominator),
    AccuracyCase(
        "steel on steel", "contacts of 60 microseconds between flights of a fifth of a second", "impact_steel",
        ("duration=0.5", "accuracy=1e-3"),
        guard.scales("flight and contact", 1e3), _flight_over_contact,
    ),
)  # fmt: skip
