"""Work-precision study of the normal force of the tire: linear spring, power law, the field on
three grids; smooth and rough road.

The inexpensive laws go through the field once: the power law goes through the field at the load P
and at 1.05 P (the law that stands between two field instants of a run), the spring is its tangent
at P. Then each of them gives the force at the approaches, and for the approach at the loads, of
a range around P; the worst error of the range counts. Not in the time of the laws: the two solves
that lay them.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.vehicle.work_precision.fields import (
    APPROACH,
    FORCE,
    GIVEN,
    FieldFidelity,
    PatchSolver,
)
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import LOAD, patch_problem
from contact_sim_lab.rigs.vehicle.work_precision.rough import FINEST, SEED
from contact_sim_lab.rigs.vehicle.work_precision.smooth import LEVELS, REFERENCE, exact_answer
from contact_sim_pkg.laws.normal_elastic import approach_of_force, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.rigs.vehicle.field.contact_field import TANGENT_LOAD_STEP

__all__ = ["PART", "WORK_PRECISION", "laws_through", "rows"]

PART = "normal force"
RANGES = {"0.9 to 1.1 P": (0.9, 1.1), "0.5 to 1.2 P": (0.5, 1.2)}
ROADS = {"smooth road": None, "rough road": SEED}
FINEST_TOLERANCE = 1e-6
FINE = "own code, grid 512x384 to 1e-6"


class TangentLaw(NamedTuple):
    """Force and approach of a fidelity level."""

    fidelity: FidelityLevel
    force: Callable[[float], float]  # [m] -> [N]
    approach: Callable[[float], float]  # [N] -> [m]


def rows() -> list[Row]:
    """Each road, each range."""
    found: list[Row] = []
    for road, seed in ROADS.items():
        laws = [*laws_through(seed), *(_field_law(level, seed) for level in LEVELS)]
        exact = _smooth_approach if seed is None else _rough_approach
        reference = REFERENCE if seed is None else FINE
        for name, factors in RANGES.items():
            points = [(factor * LOAD, exact(factor)) for factor in factors]
            for law in laws:
                worst_force = max(relative(law.force(approach), load) for load, approach in points)
                worst_approach = max(relative(law.approach(load), approach) for load, approach in points)
                found.append(row(PART, f"{road}, {name}", FORCE, law.fidelity, reference, worst_force))
                found.append(row(PART, f"{road}, {name}", APPROACH, law.fidelity, reference, worst_approach))
    return found


def laws_through(seed: int | None) -> list[TangentLaw]:
    """Spring and power law through the field of the finest level."""
    solver, tolerance = PatchSolver(patch_problem(LEVELS[-1].cells, seed)), LEVELS[-1].tolerance
    first = solver.solve(GIVEN[0], LOAD, tolerance).approach
    second = solver.solve(GIVEN[0], LOAD * TANGENT_LOAD_STEP, tolerance).approach
    exponent = math.log(TANGENT_LOAD_STEP) / math.log(second / first)
    power = NormalElastic(LOAD / first**exponent, exponent)
    # The spring touches the power law at the load: same force, same stiffness.
    spring = NormalElastic(float(elastic_stiffness(power, first)), 1.0)
    offset = first - LOAD / spring.coefficient
    return [
        TangentLaw(
            FidelityLevel("linear spring", milliseconds(lambda: elastic_force(spring, first - offset))),
            lambda approach: float(elastic_force(spring, approach - offset)),
            lambda load: offset + float(approach_of_force(spring, load)),
        ),
        TangentLaw(
            FidelityLevel("power law", milliseconds(lambda: elastic_force(power, first))),
            lambda approach: float(elastic_force(power, approach)),
            lambda load: float(approach_of_force(power, load)),
        ),
    ]


def _field_law(level: FieldFidelity, seed: int | None) -> TangentLaw:
    solver, tolerance = PatchSolver(patch_problem(level.cells, seed)), level.tolerance
    standing = solver.solve(GIVEN[0], LOAD, tolerance).approach
    cost = milliseconds(lambda: solver.solve(GIVEN[1], standing, tolerance))
    return TangentLaw(
        FidelityLevel(level.name, cost, "{}x{}".format(*level.cells), tolerance),
        lambda approach: solver.solve(GIVEN[1], approach, tolerance).force,
        lambda load: solver.solve(GIVEN[0], load, tolerance).approach,
    )


def _smooth_approach(factor: float) -> float:
    """Hertz: the approach goes with the load to the power of 2/3."""
    return exact_answer(LEVELS[0].cells).approach * float(factor ** (2.0 / 3.0))


@functools.cache
def _rough_approach(factor: float) -> float:
    return _finest_solver().solve(GIVEN[0], factor * LOAD, FINEST_TOLERANCE).approach


@functools.cache
def _finest_solver() -> PatchSolver:
    return PatchSolver(patch_problem(FINEST, SEED))


WORK_PRECISION = (WorkPrecision(PART, rows),)
