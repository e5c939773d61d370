"""Work-precision study of a contact whose gap is no paraboloid, `(|x|^g + |y|^g)/g`: closed forms
on the Lame domain against the field.

E* = 1, P = 1. The domain (a, b, n) of the closed forms is fitted to the reference, so what is left
is the error of the pressure that they put on it.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form.lame_pressure import (
    LamePressure,
    ansatz_on_domain,
    equivalent_ellipse,
    lame_pressure,
)
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.vehicle.work_precision.fields import (
    CONVERGED,
    GIVEN,
    Answer,
    FieldFidelity,
    rows_of,
    solve,
    timed,
)
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import PatchProblem
from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_patch, lame_area
from contact_sim_pkg.pressure.field.halfspace import make_half_space

__all__ = ["EXPONENTS", "PART", "WORK_PRECISION", "power_gap", "rows"]

Field = NDArray[numpy.float64]

PART = "gap of exponent above 2"
EXPONENTS = (3.0, 4.0)
SIDE, FINEST = 2.3, 384  # length of the grid; cells along it
REFERENCE = "own code, grid 384x384 to 1e-8"
FIDELITIES = (
    FieldFidelity("FFT-CG", (48, 48), 1e-2),
    FieldFidelity("FFT-CG", (96, 96), 1e-3),
    FieldFidelity("FFT-CG", (192, 192), 1e-6),
)
CENTRE = "pressure in the centre"


def rows() -> list[Row]:
    """Each gap exponent under the load 1."""
    found: list[Row] = []
    for exponent in EXPONENTS:
        case = f"gap exponent {exponent:g}"
        finest = power_gap(FINEST, exponent)
        exact = solve(finest, GIVEN[0], 1.0, 1e-8)
        fit = _fit(finest, exact)
        found += _closed_forms(f"{case}, domain n = {fit.exponent:.2g}", fit, exact)
        for fidelity in FIDELITIES:
            problem = power_gap(fidelity.cells[0], exponent)
            described, answer = timed(fidelity, problem, GIVEN[0], 1.0)
            converged = solve(problem, GIVEN[0], 1.0, CONVERGED)
            head = (PART, f"{case}, domain n = {fit.exponent:.2g}")
            found += rows_of(*head, described, REFERENCE, answer, exact, converged)
            found.append(_centre(head[1], described, centre_of(answer), centre_of(exact)))
    return found


def power_gap(cells: int, exponent: float) -> PatchProblem:
    """Gap of bodies with a power-law profile on a square grid, dimensionless, E* = 1."""
    cell = SIDE / cells
    height = abs((numpy.arange(cells) - 0.5 * (cells - 1)) * cell) ** exponent / exponent
    return PatchProblem(make_half_space(cells, cells, cell, cell, 1.0), height[:, None] + height[None, :])


def centre_of(answer: Answer) -> float:
    """Mean pressure [Pa] of the four cells around the centre."""
    assert answer.pressure is not None
    middle = answer.pressure.shape[0] // 2
    return float(answer.pressure[middle - 1 : middle + 1, middle - 1 : middle + 1].mean())


def _fit(problem: PatchProblem, answer: Answer) -> LameFit:
    assert answer.pressure is not None
    cell, start = problem.half_space.cell_x, -0.5 * (FINEST - 1) * problem.half_space.cell_x
    return fit_patch(answer.pressure, cell, cell, start, start)


def _closed_forms(case: str, fit: LameFit, exact: Answer) -> list[Row]:
    found: list[Row] = []
    domain = (fit.a, fit.b, fit.exponent, 1.0, 1.0)
    for name, form in (("Lamé ansatz", ansatz_on_domain), ("equivalent ellipse", equivalent_ellipse)):
        fidelity = FidelityLevel(name, milliseconds(lambda form=form, domain=domain: form(*domain)))  # type: ignore[misc]
        contact = form(*domain)
        found += rows_of(PART, case, fidelity, REFERENCE, _answer(contact), exact)
        found.append(_centre(case, fidelity, contact.peak_pressure, centre_of(exact)))
    return found


def _answer(contact: LamePressure) -> Answer:
    """A closed form as an answer on the finest grid."""
    x = (numpy.arange(FINEST) - 0.5 * (FINEST - 1)) * SIDE / FINEST
    area = lame_area(contact.a, contact.b, contact.exponent)
    pressure = lame_pressure(contact, x[:, None], x[None, :])
    return Answer(contact.load, contact.approach, contact.peak_pressure, area, pressure)


def _centre(case: str, fidelity: FidelityLevel, value: float, expected: float) -> Row:
    return row(PART, case, CENTRE, fidelity, REFERENCE, relative(value, expected), value=value, expected=expected)


WORK_PRECISION = (WorkPrecision(PART, rows),)
