"""Hard scenes of `bench hard --accuracy`: what a user tries, short enough to be run at 3e-5."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["CASES", "AccuracyCase"]


class AccuracyCase(NamedTuple):
    """A scene that is hard to compute accurately."""

    name: str
    hard: str  # what is hard about it
    scene: str
    values: tuple[str, ...]  # as of `--set`
    span: float = 0.03  # [s] that is compared, round the event of the excitation; back, block and impact: all


SLOW = "travel.speed=5"
CASES = (
    AccuracyCase(
        "kerb up", "a sharp edge of 30 mm between two nodes of the grid", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: step, position: 0.16, height: 0.03}"),
    ),
    AccuracyCase(
        "kerb down", "a sharp edge of 0.1 m: the wheel is aloft, and lands", "tire_bump",
        ("duration=0.4", "road={kind: step, position: 0.05, height: -0.1}"), 0.1,
    ),
    AccuracyCase(
        "pothole", "50 mm deep, worn edges of 30 mm: the load leaps from one to the other", "tire_bump",
        ("duration=0.4", "road={kind: pothole, position: 0.3, depth: 0.05, length: 0.3, edge: 0.03}"), 0.06,
    ),
    AccuracyCase(
        "stones", "bars of 10 mm every 0.1 m, one or two under the footprint", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: cleat, position: 0.15, height: 0.01, length: 0.02, edge: 0.005, period: 0.1}"), 0.04,
    ),
    AccuracyCase(
        "cleat, belt, bristles", "belt and bristles swing behind a bar shorter than the footprint", "tire_cleat",
        ("duration=0.4", "road.position=0.2"), 0.03,
    ),
    AccuracyCase(
        "class E", "a very poor road, round its steepest place", "tire_rough_road",
        ("duration=0.4", "travel={speed: 8}", "road.roughness_class=E"), 0.01,
    ),
    AccuracyCase(
        "texture at 30 m/s", "0.3 m of texture under the tire in each block", "tire_rough_road",
        ("duration=0.4", "travel={speed: 30}"), 0.01,
    ),
    AccuracyCase(
        "loss of 0.3 s/m", "20 times the usual loss: the force follows the rate of the height", "tire_bump",
        ("duration=0.4", "road={kind: bump, position: 0.4, height: 0.03, length: 0.6}",
         "effects.tire.normal_dissipative.damping=0.3"), 0.06,
    ),
    AccuracyCase(
        "soft tire", "120 kPa over a short bump: a long footprint", "tire_bump",
        ("duration=0.4", SLOW, "road={kind: bump, position: 0.2, height: 0.02, length: 0.2}",
         "effects.tire.inflation.pressure=120000"), 0.03,
    ),
    AccuracyCase(
        "half-space tire", "every cell presses on every other, over a bump", "tire_half_space",
        ("duration=0.4", "road={kind: bump, position: 0.4, height: 0.03, length: 0.6}"), 0.06,
    ),
    AccuracyCase(
        "seat drop", "the occupant lifts off, falls, and lands on the cushion", "seat_drop",
        ("duration=0.5", "vibration.start=0.05"), 0.5,
    ),
    AccuracyCase("seat slap", "a back slaps on its seat back, and slides", "seat_slap", ("duration=0.8",)),
    AccuracyCase("flutter", "tilt and yaw of a roller that grow without bound", "roller_flutter", ("duration=1",)),
    AccuracyCase("jam", "a slipping block jams (Painleve): no sliding motion exists", "block_painleve", ()),
    AccuracyCase(
        "steel on steel", "contacts of 60 microseconds between flights of a fifth of a second", "impact_steel",
        ("duration=0.5", "accuracy=1e-3"),
    ),
)  # fmt: skip
