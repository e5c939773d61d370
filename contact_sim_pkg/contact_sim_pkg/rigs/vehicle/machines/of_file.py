"""The same rows as `measured.py` of a property file by the Magic Formula: drawn beside those of the bench."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy

from contact_sim_pkg.records.procedure import Rows
from contact_sim_pkg.rigs.vehicle.machines.measured import FALLEN, slip_row
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import MagicFormula, magic_formula
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.formulas import AtLoad, at_load, forces_at
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.relaxation import relaxation_lengths
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import contact_of, law_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile, read_property_file

__all__ = ["relaxation", "rolling", "standing", "steady_slip"]

Conditions = Mapping[str, float]
Sheets = dict[str, Rows]
NAN = math.nan
WAY, SPACING = 2.0, 0.01  # [m]


def standing(file: str, conditions: Conditions) -> Sheets:
    """Deflection, stiffness and contact by the law of `tire/property_file/magic_formula.py` under any load."""
    tire, formula = _read(file)
    nominal, radius, load = formula.keys["FNOMIN"], formula.keys["UNLOADED_RADIUS"], conditions["load"]
    law = law_tire(tire, radius, formula.keys["NOMPRES"], formula.keys["NOMPRES"], nominal)
    if law is None:
        return {"": []}
    square = tire.get("Q_FZ2") or 0.0
    linear = math.sqrt((law.stiffness * radius / nominal) ** 2 - 4.0 * square)
    growth = 1.0 + (tire.get("PFZ1") or 0.0) * (conditions["inflation"] / formula.keys["NOMPRES"] - 1.0)
    part = load / (nominal * growth)
    slope = math.sqrt(linear**2 + 4.0 * square * part)
    coefficients = [tire.get(f"Q_R{axis}{place}") or 0.0 for axis in "AB" for place in (1, 2)]
    length, width = contact_of(coefficients, radius, tire.get("WIDTH") or 0.0, load / (law.stiffness * growth * radius))
    return {"": [{
        "deflection": radius * 2.0 * part / (linear + slope), "stiffness": nominal * growth / radius * slope,
        "length": length or NAN, "width": width or NAN,
    }]}  # fmt: skip


def steady_slip(file: str, conditions: Conditions) -> Sheets:
    """Forces at a slip and a slip angle."""
    at = _at(_read(file)[1], conditions)
    forces = forces_at(at, conditions.get("slip", 0.0), conditions.get("slip_angle", 0.0))
    return {"": [slip_row(at.load, forces.longitudinal, forces.lateral, forces.aligning)]}


def relaxation(file: str, conditions: Conditions) -> Sheets:
    """Way to 63 % of the change of force after a step of the slip that grows as of first order; and the responses."""
    formula = _read(file)[1]
    at, step = _at(formula, conditions), conditions["slip_step"]
    along, across = relaxation_lengths(formula, at, conditions["inflation"])
    distance = numpy.arange(0.0, WAY, SPACING)

    def part(length: float, force: int, slip: float, angle: float) -> list[float]:
        if length <= 0.0:
            return [NAN] * len(distance)
        grown = -numpy.expm1(-distance / length)
        before, end = forces_at(at, 0.0, 0.0)[force], forces_at(at, slip, angle)[force]
        return [(forces_at(at, slip * each, angle * each)[force] - before) / (end - before) for each in grown.tolist()]

    response = [
        {"distance": place, "lateral_part": side, "longitudinal_part": brake}
        for place, side, brake in zip(
            distance.tolist(), part(across, 1, 0.0, step), part(along, 0, -step, 0.0), strict=True
        )
    ]

    def way(name: str) -> float:
        return next((row["distance"] for row in response if row[name] > FALLEN), NAN)

    row = {"relaxation_side": way("lateral_part"), "relaxation_along": way("longitudinal_part")}
    return {"": [row], "response": response}


def rolling(file: str, conditions: Conditions) -> Sheets:
    """Rolling resistance -M_y / R_0 at no slip, on flat ground."""
    at = _at(_read(file)[1], conditions)
    force = -forces_at(at, 0.0, 0.0).rolling / at.radius
    return {"": [{"resistance": force, "resistance_coefficient": force / at.load}]}


def _read(file: str) -> tuple[PropertyFile, MagicFormula]:
    tire = read_property_file(Path(file))
    return tire, magic_formula(tire)


def _at(formula: MagicFormula, conditions: Conditions) -> AtLoad:
    inflation = conditions["inflation"] if formula.inflation else formula.keys["NOMPRES"]
    return at_load(formula.keys, conditions["load"], inflation, conditions["speed"])
