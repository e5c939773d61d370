"""Speed and slip of a wheel over time."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, TypeAlias

from pydantic import Field

from contact_sim_pkg.records.fields import Section, number, numbers
from contact_sim_pkg.records.registry import rigs

MOST_POINTS = 10000
SpeedPoint: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=2)]
SlipPoint: TypeAlias = Annotated[list[float], Field(min_length=3, max_length=3)]


class TravelSection(Section):
    """How fast the wheel rolls: `speed`, or `points` of a piecewise linear speed; one of the
    two.
    """

    fixed: ClassVar[str] = "the points of a programme hold from the start"

    speed: float | None = number(0.0, 100.0, "m/s", "constant speed", default=None, live="excitation")
    points: list[SpeedPoint] | None = numbers(
        "s, m/s",
        "speed over time, straight between the points, constant after the last",
        "pairs [time, speed], first time 0, times increasing to at most 3600 s, speeds 0 to 100 m/s",
        default=None,
        shortest=1,
        longest=MOST_POINTS,
    )

    def open_values(self, scene: Any) -> dict[str, Any]:
        points = points_of(scene, "speed")
        return {} if points is None else {"points": points}


class Slip(Section):
    """Slip of the rolling tire over time, for the effects `brush` and `magic_formula`: constant values, or `points`
    straight between them.
    """

    fixed: ClassVar[str] = "the slip of a run is a programme from its start"

    longitudinal: float | None = number(
        -1.0,
        10.0,
        "",
        "(wheel speed times radius - v) / v: braking is negative, -1 is locked; 0 if absent",
        default=None,
    )
    angle: float | None = number(
        -1.5, 1.5, "rad", "slip angle; positive makes the lateral force negative (ISO 8855); 0 if absent", default=None
    )
    points: list[SlipPoint] | None = numbers(
        "s, -, rad",
        "longitudinal slip and slip angle over time, constant after the last point",
        "triples [time, longitudinal, angle], first time 0, times increasing to at most 3600 s, slips as above",
        default=None,
        shortest=1,
        longest=MOST_POINTS,
    )

    def open_values(self, scene: Any) -> dict[str, Any]:
        points = points_of(scene, "slip", "slip_angle")
        return {} if points is None else {"points": points}


def points_of(scene: Any, *quantities: str) -> list[list[float]] | None:
    """Rows of time and quantities that a programme of the rig's contacts gives; None where none does."""
    for contact in rigs()[scene.rig].contacts:
        pairs = getattr(getattr(getattr(scene, contact.name), "programme", None), "pairs", None)
        if pairs is not None and (points := pairs(scene, *quantities)) is not None:
            return points  # type: ignore[no-any-return]
    return None
