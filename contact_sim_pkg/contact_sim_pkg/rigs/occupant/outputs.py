"""Outputs of the occupant: those of seat and backrest; motion, energy and cost are combined."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.definitions import definition_of
from contact_sim_pkg.records.messages import BodyMotion, EnergyLedger, SolverCost


def combined(parts: list[list[Output]]) -> list[Output]:
    """The outputs of all parts; motions side by side, energies and costs added up."""
    outputs = [each for part in parts for each in part]
    own = [each for each in outputs if each.topic not in COMBINED]
    for topic, combine in COMBINED.items():
        same = [each for each in outputs if each.topic == topic]
        own.append(same[0]._replace(record=combine([each.record for each in same])))
    return own


def _motion(parts: list[BodyMotion]) -> BodyMotion:
    """The coordinates of all parts."""
    names = ("position", "velocity", "acceleration")
    rows = {name: numpy.vstack([getattr(part, name) for part in parts]) for name in names}
    return parts[0]._replace(bodies=tuple(body for part in parts for body in part.bodies), **rows)


def _energy(parts: list[EnergyLedger]) -> EnergyLedger:
    """The sum of each energy [J]."""
    names = [name for name in EnergyLedger._fields if name != "block"]
    return parts[0]._replace(**{name: sum(getattr(part, name) for part in parts) for name in names})


def _cost(parts: list[SolverCost]) -> SolverCost:
    """Wall times and counts add up; of residuals, jumps and errors the largest counts."""
    values: dict[str, Any] = {}
    for field in definition_of("SolverCost").record_fields:
        add_up = field.name == "wall_time" or not field.type.startswith("float")
        values[field.name] = (sum if add_up else max)(getattr(part, field.name) for part in parts)
    simulated = parts[0].real_time_factor * parts[0].wall_time
    factor = simulated / values["wall_time"]
    return SolverCost(**{**values, "block": parts[0].block, "real_time_factor": factor})


COMBINED: dict[str, Callable[[list[Any]], Any]] = {
    "bench/motion": _motion, "bench/energy": _energy, "bench/cost": _cost,
}  # fmt: skip
"""Topic that every part has -> what makes one record of those of all parts."""
