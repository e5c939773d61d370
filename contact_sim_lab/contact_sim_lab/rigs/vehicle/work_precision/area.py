"""Work-precision study of the contact area: Hertz, Lame fit, cells counted, cells with the edge
between them; smooth and rough.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.vehicle.work_precision.fields import AREA, GIVEN, solve
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import CURVATURES, LOAD, MODULUS, patch_problem
from contact_sim_lab.rigs.vehicle.work_precision.rough import OWN, SEED, finest
from contact_sim_lab.rigs.vehicle.work_precision.smooth import LEVELS, REFERENCE, exact_answer
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact
from contact_sim_pkg.pressure.closed_form.lame import fit_patch, lame_area
from contact_sim_pkg.pressure.field.halfspace import HalfSpace
from contact_sim_pkg.pressure.field.patch import contact_area

__all__ = ["PART", "WORK_PRECISION", "rows"]

Field = NDArray[numpy.float64]

PART = "contact area"
TOLERANCE = 1e-6  # of the fields that are measured: what is left is the measure and the grid


def rows() -> list[Row]:
    """Areas of converged fields; time is that of the measure alone."""
    found: list[Row] = []
    smooth = ("smooth road", None, exact_answer(LEVELS[0].cells).area, REFERENCE)
    rough = ("rough road", SEED, finest().area, f"{OWN}, edge between cells")
    for case, seed, expected, reference in (smooth, rough):
        arguments = (*CURVATURES, MODULUS, LOAD)
        fidelity = FidelityLevel("Hertz πab, smooth road", milliseconds(functools.partial(hertz_contact, *arguments)))
        contact = hertz_contact(*arguments)
        found.append(_row(case, fidelity, reference, math.pi * contact.a * contact.b, expected))
        for level in LEVELS:
            problem = patch_problem(level.cells, seed)
            pressure = solve(problem, GIVEN[0], LOAD, TOLERANCE).pressure
            assert pressure is not None
            for name, measure in measures(problem.half_space, pressure).items():
                grid = "{}x{}".format(*level.cells)
                found.append(
                    _row(case, FidelityLevel(name, milliseconds(measure), grid), reference, measure(), expected)
                )
    return found


def measures(half_space: HalfSpace, pressure: Field) -> dict[str, Callable[[], float]]:
    """Functions that measure the area [m^2] of one field."""
    cell = (half_space.cell_x, half_space.cell_y)

    def lame() -> float:
        fit = fit_patch(pressure, *cell, 0.0, 0.0)
        return lame_area(fit.a, fit.b, fit.exponent)

    return {
        "Lamé fit": lame,
        "cells counted": lambda: float(numpy.count_nonzero(pressure)) * cell[0] * cell[1],
        "cells, edge between them": lambda: contact_area(pressure, *cell),
    }


def _row(case: str, fidelity: FidelityLevel, reference: str, value: float, expected: float) -> Row:
    error = relative(value, expected)
    return row(PART, case, AREA, fidelity, reference, error, value=float(value), expected=expected)


WORK_PRECISION = (WorkPrecision(PART, rows),)
