"""Published curves of tires beside those of the bench, for `bench validation`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.records.published_curve import PublishedCurve, PublishedTable, curves_of, read_published
from contact_sim_pkg.rigs.vehicle.machines.measured import rolling, steady_slip
from contact_sim_pkg.rigs.vehicle.machines.specimen import Effects, table_at
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import measured_tire, scene_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.targets import read_measured
from contact_sim_pkg.rigs.vehicle.tire.published_tables import (
    FOLDER,
    FORMULA_ERROR,
    OWN,
    PRINT_ERROR,
    STANDING,
    published_tire,
)

__all__ = ["CURVES", "HERE"]

HERE = Path(__file__).parent / "published"
SPEED = 60.0 / 3.6  # [m/s] of the flat track
SLIP = 2e-3  # at which a slip stiffness is read
DEGREE = math.pi / 180.0
BRAKING, CORNERING = (0.06, 0.08, 0.1, 0.13, 0.16, 0.2), tuple(each * DEGREE for each in (4.0, 6.0, 8.0, 10.0, 12.0))
"""Slips and slip angles [rad] among which the peaks are."""
FITTED_AT = 206.8  # [kPa] of the 255/40 R17: the middle one of the five
PEAK_OWN = 0.05
MOVING_ERROR = (0.0, 0.1)  # of a formula; none is published
OTHER = (
    "the keys are those of the first tire, which is rounder across; the author calls this one's print a rectangle beside a "
    "football: at the same area it is wider and shorter"
)
WIDER = (
    "inside by what a fit leaves open: the shoulders' round keeps a long contact narrow, so at one load ours grows with the "
    "inflation, the published width falls"
)
NOTES = {"width": WIDER}
SOFT = "the fit is 6 % low there at 260 kPa, and the belt's bending key does not follow the inflation"
FRICTION = "the default's friction was chosen by the 205/60 R15 (peak 1.04, locked wheel 0.74), not by these tires"
RUBBER = "`bench tire` does not take rolling resistance from a file: tread and belt lose as those of the default tire"


@cache
def _default() -> Effects:
    return {"inflation": {}, "contact_field": {}, "brush": {}, "sidewall_compliance": {}}


@cache
def _measured() -> Effects:
    """The tire that is fitted to the middle inflation of the measurements."""
    found = read_measured(FOLDER / "255_40R17.csv")
    chosen = [
        each for each in found.targets if abs(each.pressure - 1e3 * FITTED_AT) < 1.0 and not math.isnan(each.length)
    ]
    return measured_tire(found._replace(targets=chosen), "255/40 R17").effects


@cache
def _of_file() -> Effects:
    return scene_tire(read_property_file(HERE / "255_55R20.tir")).effects


def _measure(tire: Callable[[], Effects], quantity: str, conditions: Mapping[str, Any]) -> float:
    """What the bench has under conditions in the units of the tables."""
    effects, load = tire(), float(conditions["load"])
    case = {"load": load, "inflation": 1e3 * float(conditions.get("inflation", 220.0)), "drum_diameter": 0.0}
    if quantity in {*STANDING, "stiffness", "area"}:
        table = table_at(effects, case)
        law, footprint = table.law(), table.footprint_at(load)
        deflection = float(approach_of_force(law, load))
        return {
            "deflection": 1e3 * deflection, "stiffness": 1e-3 * float(elastic_stiffness(law, deflection)),
            "length": 1e3 * footprint.length, "width": 1e3 * footprint.width, "area": 1e4 * footprint.area,
        }[quantity]  # fmt: skip
    if quantity == "rolling resistance":
        row = rolling(effects, {**case, "speed": float(conditions["speed"]) / 3.6})[""][0]
        return 1e3 * row["resistance_coefficient"]

    def slipping(name: str, **slip: float) -> float:
        return abs(steady_slip(effects, {**case, "speed": SPEED, **slip})[""][0][name])

    return {
        "braking stiffness": lambda: 1e-3 * slipping("longitudinal_force", slip=-SLIP) / SLIP,
        "cornering stiffness": lambda: slipping("lateral_force", slip_angle=SLIP) / SLIP * DEGREE,
        "trail": lambda: 1e3 * slipping("trail", slip_angle=SLIP),
        "peak braking coefficient": lambda: max(slipping("longitudinal_coefficient", slip=-each) for each in BRAKING),
        "peak side coefficient": lambda: max(slipping("lateral_coefficient", slip_angle=each) for each in CORNERING),
    }[quantity]()


def _curves(tire: Callable[[], Effects], table: PublishedTable, picture: str, quantity: str, across: str = "load",
            along: str = "inflation", **options: Any) -> Iterator[PublishedCurve]:  # fmt: skip
    return curves_of(
        table, picture, quantity, across, along, own=OWN[quantity], measure=partial(_measure, tire, quantity), **options
    )


def _formula(name: str, tire: Callable[[], Effects], table: PublishedTable, standing: tuple[float, ...],
             slipping: float, rolling: tuple[float, ...] = (), notes: Mapping[str, str] = MappingProxyType({}),
             ) -> Iterator[PublishedCurve]:  # fmt: skip
    """All of a tire that a formula gives, with the inflations at which it was fitted standing and slipping, the loads at
    which it was fitted rolling, and notes by quantity.
    """
    for quantity in STANDING:
        yield from _curves(
            tire,
            table,
            f"{name}, standing",
            quantity,
            error=FORMULA_ERROR,
            fitted=standing,
            note=NOTES.get(quantity, ""),
        )
    loads = tuple({float(row["load"]) for row in table.rows})  # each has inflations that were fitted
    yield from _curves(
        tire, table, f"{name}, standing", "stiffness", "inflation", "load", error=FORMULA_ERROR, fitted=loads
    )
    for quantity in ("braking stiffness", "cornering stiffness", "trail"):
        yield from _curves(
            tire,
            table,
            f"{name}, slipping",
            quantity,
            error=MOVING_ERROR,
            fitted=(slipping,),
            note=notes.get(quantity, ""),
        )
    for across, at in (("speed", {"inflation": slipping}), ("inflation", {"speed": 60.0})):
        yield from _curves(
            tire, table, f"{name}, rolling", "rolling resistance", across, "load", error=MOVING_ERROR, at=at, fitted=rolling,
            note=notes.get("rolling resistance", ""),
        )  # fmt: skip


def _plate() -> Iterator[PublishedCurve]:
    """The measured 255/40 R17, and another tire of its size."""
    first, other = published_tire("255_40R17"), read_published(HERE / "255_40R17_other.csv")
    for quantity in STANDING:
        yield from _curves(
            _measured,
            first,
            "255/40 R17 on a plate",
            quantity,
            error=PRINT_ERROR[quantity],
            fitted=(FITTED_AT,),
            note=NOTES.get(quantity, ""),
        )
    yield from _curves(
        _measured, first, "255/40 R17 on a plate", "stiffness", "inflation", "load", error=PRINT_ERROR["stiffness"],
        fitted=(3559.0,),
    )  # fmt: skip
    for quantity in ("length", "width", "area"):
        yield from _curves(
            _measured, other, "255/40 R17, another tire", quantity, error=PRINT_ERROR[quantity],
            note={**NOTES, "length": OTHER}.get(quantity, ""),
        )  # fmt: skip


def _three() -> Iterator[PublishedCurve]:
    """The default tire between three others of a car: middle, and half of what lies between them."""
    table = read_published(HERE / "three_car_tires.csv")
    loads = sorted({float(row["load"]) for row in table.rows})

    def among(quantity: str) -> PublishedCurve:
        found = [[float(row[quantity]) for row in table.rows if float(row["load"]) == load] for load in loads]

        def ours(places: Sequence[float]) -> list[float]:
            return [_measure(_default, quantity, {"load": each}) for each in places]

        return PublishedCurve(
            picture="Default tire among three others", name="three tires", across=table.labels["load"],
            up=table.labels[quantity], kind=table.notes["kind"], blind=True, x=tuple(loads),
            y=tuple(0.5 * (min(each) + max(each)) for each in found),
            error=tuple(0.5 * (max(each) - min(each)) for each in found), own=OWN.get(quantity, PEAK_OWN), ours=ours,
            source=f"{table.notes['source']}. Licence: {table.notes['licence']}",
            note=FRICTION if quantity == "peak braking coefficient" else "",
        )  # fmt: skip

    for quantity in ("braking stiffness", "cornering stiffness", "peak braking coefficient", "peak side coefficient"):
        yield among(quantity)


CURVES = [
    *_plate(),
    *_formula("205/60 R15", _default, published_tire("205_60R15"), (160.0, 220.0), 220.0, (4000.0,)),
    *_formula(
        "255/55 R20",
        _of_file,
        read_published(HERE / "255_55R20.csv"),
        (200.0, 260.0),
        260.0,
        notes={"cornering stiffness": SOFT, "rolling resistance": RUBBER},
    ),
    *_three(),
]
"""Curves of a tire that the bench has a law for. Not drawn: a truck tire at 4.8 and 6.5 bar, for the inflation of a scene
ends at 4.
"""
