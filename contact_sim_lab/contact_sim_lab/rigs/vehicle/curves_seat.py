"""Published pressures of people on seats beside those of the bench, for `bench validation`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from contact_sim_lab.rigs.vehicle.validation_seat import (
    THIGHS_FROM,
    SittingMap,
    sitting,
)
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.published_curve import PublishedCurve, curves_of, read_published
from contact_sim_pkg.rigs.vehicle.seat.occupants import SEATED_MASS

__all__ = ["CURVES"]

HERE = Path(__file__).parent / "published"
SEATED = 0.73  # of the body's weight on the seat, as of `SEATED_MASS`
OWN = {"area": 0.05, "mean pressure": 0.05, "peak pressure": 0.1}
"""Relative: cells of 1 cm, and a peak that one of them holds."""
SOFT = (
    "soft tissue by its measured thickness, fitted to no map; none flows sideways from under a bone, so the peak on firm foam "
    "is low and the thighs of a plate carry little"
)


def _of(found: SittingMap, quantity: str) -> float:
    return {"area": found.area, "mean pressure": found.mean, "peak pressure": found.largest}[quantity]


def _office() -> Iterator[PublishedCurve]:
    """Buttocks and thighs of an office chair under the load that each way of moving had there: area times mean pressure."""
    table = read_published(HERE / "office_chair.csv")

    def measure(quantity: str, conditions: Mapping[str, Any]) -> float:
        load = sum(
            0.1 * float(row["area"]) * float(row["mean pressure"])
            for row in table.rows if float(row["way of moving"]) == conditions["way of moving"]
        )  # fmt: skip
        ends = (-1.0, THIGHS_FROM) if conditions["part"] == "back" else (THIGHS_FROM, 1.0)
        return _of(sitting(load, 50, "office_chair").between(*ends), quantity)

    for quantity in OWN:
        yield from curves_of(
            table, "Office chair", quantity, "way of moving", "part", error=f"{quantity} sd", own=OWN[quantity],
            measure=partial(measure, quantity), note=SOFT,
        )  # fmt: skip


def _firm() -> Iterator[PublishedCurve]:
    """A firm seat bare, which is a plate, and with a cushion of memory foam, for which the default cushion stands."""

    def measure(conditions: Mapping[str, Any]) -> float:
        seated = SEATED * conditions["body mass"]
        percentile = min(SEATED_MASS, key=lambda each: abs(SEATED_MASS[each] - seated))
        return sitting(seated * GRAVITY, percentile, "" if conditions["seat"] == "memory foam" else "plate").mean

    yield from curves_of(
        read_published(HERE / "firm_seat.csv"), "Firm seat, bare and with memory foam", "mean pressure", "body mass", "seat",
        error="mean pressure sd", own=OWN["mean pressure"], measure=measure, note=SOFT,
    )  # fmt: skip


CURVES = [*_office(), *_firm()]
"""Not drawn: the thickness of tissue under the tuberosities, from which that of the bench follows."""
