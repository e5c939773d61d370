"""Work-precision study of the identification: m/J of a block from tables of impacts by the
two-point formula, least squares on one impact, and the stacked least squares with errors in all
variables.

The median error of the two-point formula and of one impact is taken over single impacts; the mean
of two-point values over ten impacts shows what its unequal errors cost; all see the same noise.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy

from contact_sim_lab.identify.twins.block_impacts import random_block_impacts
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, row
from contact_sim_pkg.identify.contact.coulomb import one_impact, two_point
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.table import ImpactTable, estimate_from_impacts, problem_of_impacts

__all__ = ["PART", "WORK_PRECISION", "rows"]

PART = "identification of m/J"
QUANTITY = "m/J"
REFERENCE = "6/s² of the square, s = 0.1 m; median of the relative error over 40 draws"
SIDE, IMPACTS, DRAWS = 0.1, 10, 40
TRUTH = 6.0 / SIDE**2
SQUARE = geometry.box([SIDE] * 3)
PITCH = numpy.array([0.0, 1.0, 0.0])
NOISES = (0.0, 1e-4, 1e-3, 1e-2)  # [m/s]; ten times as much in [rad/s]
SPIN_SHARE = 10.0

Way = Callable[[ImpactTable, float], float]


def rows() -> list[Row]:
    """Each noise, each way."""
    found = []
    ways: dict[str, Way] = {
        "two-point formula, one impact": _first_two_point,
        "least squares, one impact": _first_least_squares,
        f"two-point formula, median of {IMPACTS} impacts": _median_two_point,
        f"stacked least squares, {IMPACTS} impacts": _stacked,
    }
    for noise in NOISES:
        tables = _tables(noise)
        for name, way in ways.items():
            values = numpy.array([way(table, noise) for table in tables])
            error = float(numpy.median(abs(values / TRUTH - 1.0)))
            level = FidelityLevel(name, milliseconds(lambda way=way, table=tables[0], noise=noise: way(table, noise)))  # type: ignore[misc]
            case = f"noise {noise:g} m/s, {SPIN_SHARE * noise:g} rad/s"
            found.append(
                row(PART, case, QUANTITY, level, REFERENCE, error, value=float(numpy.median(values)), expected=TRUTH)
            )
    return found


def _tables(noise: float) -> list[ImpactTable]:
    random, found = numpy.random.default_rng(3), []
    for _ in range(DRAWS):
        exact = random_block_impacts(random, IMPACTS)
        spreads = (noise, noise, SPIN_SHARE * noise, SPIN_SHARE * noise)
        fields = [
            field + spread * random.normal(size=field.shape) for field, spread in zip(exact[1:], spreads, strict=True)
        ]
        found.append(ImpactTable(exact.rotation, *fields))
    return found


def _reach(rotation: Array) -> Array:
    corners = SQUARE.points @ rotation.T
    return numpy.asarray(corners[corners[:, 2].argmin()] * numpy.array([1.0, 0.0, 1.0]))


def _two_point(table: ImpactTable, place: int) -> float:
    sides = ((table.velocity_before, table.spin_before), (table.velocity_after, table.spin_after))
    states = [numpy.array([speed[place, 0], speed[place, 2], -spin[place, 1]]) for speed, spin in sides]
    reach = _reach(table.rotation[place])
    return two_point(states[0], states[1], (float(reach[0]), float(reach[2]))).mass_over_inertia


def _first_two_point(table: ImpactTable, _: float) -> float:
    return _two_point(table, 0)


def _median_two_point(table: ImpactTable, _: float) -> float:
    return float(numpy.median([_two_point(table, place) for place in range(IMPACTS)]))


def _first_least_squares(table: ImpactTable, _: float) -> float:
    before, after = (table.velocity_before[0], table.spin_before[0]), (table.velocity_after[0], table.spin_after[0])
    inertia, _rank = one_impact(table.rotation[0], before, after, _reach(table.rotation[0]))
    return float(1.0 / inertia[1, 1])


def _stacked(table: ImpactTable, noise: float) -> float:
    spreads = (max(noise, 1e-13), max(SPIN_SHARE * noise, 1e-12))
    return float(1.0 / estimate_from_impacts(problem_of_impacts(table, SQUARE, spreads, PITCH)).parameters[0])


WORK_PRECISION = (WorkPrecision(PART, rows),)
