"""What is known of a tire over loads and inflations: of a property file's formulas, or measured, of a table.

    K_x = F_z (PKX1 + PKX2 df) exp(PKX3 df),  K_y = PKY1 F_0 sin(PKY4 atan(F_z / (PKY2 F_0))),
    t = F_z (R_0 / F_0) (QDZ1 + QDZ2 df),  df = F_z / F_0 - 1

Source: Pacejka, Tire and Vehicle Dynamics (2012), 4.3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy

from contact_sim_pkg.excitation.recorded_csv import RecordedTable, read_table
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import ROLLING, Target
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import USUAL_COEFFICIENTS, contact_of, standing_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.size import TireSize

__all__ = ["Measured", "few", "read_measured", "rolling_targets", "standing_targets", "usual_contact"]

PARTS = (0.5, 1.5)  # of the nominal load
INFLATIONS = 0.8, 1.25  # of that of the scene
RANGE = (1.2e5, 3e5)  # [Pa] that the tire is valid for
NOMINAL, USUAL = 2.5, 0.2  # weights of the nominal load, and of a usual contact
UNITS = {
    "inflation": "Pa", "load": "N", "stiffness": "N/m", "deflection": "m", "length": "m", "width": "m", "braking": "N",
    "cornering": "N/rad", "trail": "m",
}  # fmt: skip
"""Columns of a table and their SI units; any unit of the kind is read."""
MOST_INFLATIONS, MOST_LOADS = 3, 4
"""Of a table that are fitted; the others are compared."""


def standing_targets(
    tire: PropertyFile, size: TireSize, pressure: float, nominal: float, load: float | None
) -> list[Target]:
    """The standing tire of a file: under its nominal load first, then at other inflations where PFZ1 says how it goes with
    them, and under half and one and a half of that load where Q_FZ2 or a table does. Empty without load or stiffness.
    """
    first = _standing(tire, size, pressure, nominal, load, 1.0)
    if first is None:
        return []
    targets = [first._replace(weight=NOMINAL)]
    with_loads = tire.get("Q_FZ2") is not None or tire.curve is not None
    others = [pressure] if not tire.get("PFZ1") else [pressure, *(part * pressure for part in INFLATIONS)]
    for each in others:
        for part in (*PARTS, 1.0) if with_loads else (1.0,):
            if (each, part) == (pressure, 1.0) or not (each == pressure or RANGE[0] <= each <= RANGE[1]):
                continue
            found = _standing(tire, size, each, nominal, load, part)
            if found is not None:
                targets.append(found)
    return targets


def _standing(
    tire: PropertyFile, size: TireSize, pressure: float, nominal: float, load: float | None, part: float
) -> Target | None:
    found = standing_tire(tire, size.radius, pressure, nominal, load, part)
    if found is None:
        return None
    known = Target(pressure, found.load, found.stiffness, found.deflection)
    return known._replace(length=found.length or math.nan, width=found.width or math.nan)


def usual_contact(target: Target, size: TireSize) -> Target | None:
    """What of the contact a target leaves open, as that of a usual tire; None where it is all there."""
    if not math.isnan(target.length) and not math.isnan(target.width):
        return None
    length, width = contact_of(
        USUAL_COEFFICIENTS, size.radius, size.width, target.load / (target.stiffness * size.radius)
    )
    return Target(
        target.pressure, target.load, length=length if math.isnan(target.length) else math.nan,
        width=width if math.isnan(target.width) else math.nan, weight=USUAL,
    )  # fmt: skip


def rolling_targets(tire: PropertyFile, size: TireSize, pressure: float) -> list[Target]:
    """The rolling tire of a file at its nominal load, and at half and one and a half where it has coefficients for that."""
    nominal, at_load = tire.get("FNOMIN"), abs(tire.get("PKX1") or 0.0)
    if nominal is None or not at_load:
        return []
    peak, at, shape = tire.get("PKY1"), tire.get("PKY2"), tire.get("PKY4") or 2.0
    trail, with_loads = abs(tire.get("QDZ1") or 0.0), bool(tire.get("PKX2") or tire.get("PKX3"))
    targets = []
    for part in (1.0, *PARTS):
        load, more = part * nominal, part - 1.0
        braking = load * (at_load + (tire.get("PKX2") or 0.0) * more) * math.exp((tire.get("PKX3") or 0.0) * more)
        cornering = abs(peak) * nominal * math.sin(shape * math.atan(abs(part / at))) if peak and at else math.nan
        found = Target(
            pressure, load, braking=braking if part == 1.0 or with_loads else math.nan, cornering=cornering,
            trail=part * size.radius * (trail + (tire.get("QDZ2") or 0.0) * more) if trail else math.nan,
        )  # fmt: skip
        if any(getattr(found, name) > 0.0 for name in ROLLING):
            targets.append(found._replace(**{name: math.nan for name in ROLLING if not getattr(found, name) > 0.0}))
    return targets


class Measured(NamedTuple):
    """A table of measurements."""

    file: PropertyFile  # without keys
    targets: list[Target]


def read_measured(path: Path) -> Measured:
    """Read a table of measurements: columns `UNITS` with their units in brackets, as ``load (N)``; `inflation`, `load` and
    `stiffness` or `deflection` are needed, empty fields are not known.

    Raises PropertyFileError or ExcitationError, with line or column.
    """
    table = read_table(path, section="file")
    columns = {name: table.columns[name] for name in UNITS if name in table.columns}
    missing = [name for name in ("inflation", "load") if name not in columns]
    if missing or not {"stiffness", "deflection"} & set(columns):
        raise PropertyFileError(
            f"{path}: columns inflation, load and deflection or stiffness are needed, with units as 'load (N)'; the header names "
            f"{', '.join(table.columns)}"
        )
    for name in columns:
        _refuse_unit(table, name)
    targets = []
    for number, row in enumerate(zip(*columns.values(), strict=True)):
        known = dict(zip(columns, map(float, row), strict=True))
        if known["load"] == 0.0 and known.get("deflection", 0.0) == 0.0:
            continue  # where a curve begins
        for name, value in known.items():
            needed = name in ("inflation", "load")
            if (needed and math.isnan(value)) or not (value > 0.0 or math.isnan(value)) or math.isinf(value):
                raise PropertyFileError(
                    f"{path}, line {table.lines[number]}: {name} is {value:g}; a number above 0 is needed"
                )
        targets.append(Target(known.pop("inflation"), known.pop("load"), **known))
    if not targets:
        raise PropertyFileError(f"{path}: no row under a load")
    unread = tuple(name for name in table.columns if name not in columns)
    return Measured(PropertyFile(str(path), {}, {}, unread, table.notes, "table"), targets)


def _refuse_unit(table: RecordedTable, name: str) -> None:
    if table.units.get(name) != UNITS[name]:
        said = f"is in {table.units[name]}" if name in table.units else "has no unit"
        raise PropertyFileError(
            f"{table.file}: column {name} {said}; one of {UNITS[name]} is needed, as '{name} ({UNITS[name]})'"
        )


def few(targets: Sequence[Target]) -> list[Target]:
    """At most three inflations and four loads each, ends and what lies evenly between: enough for a fit."""
    pressures = sorted({each.pressure for each in targets})
    chosen = []
    for pressure in _spread(pressures, MOST_INFLATIONS):
        rows = sorted((each for each in targets if each.pressure == pressure), key=lambda each: each.load)
        chosen += list(_spread(rows, MOST_LOADS))
    return chosen


def _spread(items: Sequence, most: int) -> Iterator:  # type: ignore[type-arg]
    for number in sorted({round(float(place)) for place in numpy.linspace(0, len(items) - 1, most)}):
        yield items[number]
