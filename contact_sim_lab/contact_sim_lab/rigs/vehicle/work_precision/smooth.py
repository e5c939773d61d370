"""Work-precision study of the pressure field on a smooth road: closed forms and grids against Hertz
in 50 digits.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form.lame_pressure import (
    LamePressure,
    ansatz_of_curvatures,
    ansatz_on_domain,
    equivalent_ellipse,
    lame_pressure,
)
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds
from contact_sim_lab.rigs.vehicle.work_precision.fields import (
    GIVEN,
    Answer,
    FieldFidelity,
    rows_of,
    solve,
    timed,
)
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import (
    CURVATURES,
    LOAD,
    MODULUS,
    PATCH,
    Cells,
    patch_problem,
)
from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.pressure.closed_form.hertz import HertzContact, hertz_contact, hertz_contact_at_approach
from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_patch, lame_area

__all__ = ["FIELD_CELLS", "LEVELS", "PART", "REFERENCE", "WORK_PRECISION", "exact_answer", "rows"]

Field = NDArray[numpy.float64]

PART = "pressure field, smooth road"
REFERENCE = "elliptic Hertz, mpmath, 50 digits, no shared code"
FIELD_CELLS = (128, 96)
LEVELS = (
    FieldFidelity("FFT-CG force", (64, 48), 1e-2),
    FieldFidelity("FFT-CG field", FIELD_CELLS, 1e-3),
    FieldFidelity("FFT-CG reference", (256, 192), 1e-6),
)
SAMPLES = 8  # along a side of a cell, for the mean of the closed form over it


def rows() -> list[Row]:
    """At the load of the patch, and at the approach that Hertz has there."""
    found: list[Row] = []
    exact = {level.cells: exact_answer(level.cells) for level in LEVELS}
    for given in GIVEN:
        value = LOAD if given == GIVEN[0] else exact[FIELD_CELLS].approach
        found += _closed_forms(given, value, exact[FIELD_CELLS])
        for level in LEVELS:
            problem = patch_problem(level.cells)
            fidelity, answer = timed(level, problem, given, value)
            converged = solve(problem, given, value, 1e-10)
            found += rows_of(PART, given, fidelity, REFERENCE, answer, exact[level.cells], converged)
    return found


def exact_answer(cells: Cells) -> Answer:
    """Hertz at the load of the patch; the field as means over the cells."""
    contact = reference.contact_at_load(min(CURVATURES), max(CURVATURES), MODULUS, LOAD)
    along_x, along_y = _along_axes(contact.a, contact.b)
    area = math.pi * contact.a * contact.b
    pressure = cell_means(LamePressure(LOAD, contact.approach, along_x, along_y, 2.0, contact.peak_pressure), cells)
    return Answer(LOAD, contact.approach, contact.peak_pressure, area, pressure)


def cell_means(contact: LamePressure, cells: Cells) -> Field:
    """Means over the cells of a patch of a closed-form pressure, by `SAMPLES` points each way."""
    x, y = (
        (numpy.arange(count * SAMPLES) - 0.5 * (count * SAMPLES - 1)) * length / (count * SAMPLES)
        for count, length in zip(cells, PATCH, strict=True)
    )
    fine = lame_pressure(contact, x[:, None], y[None, :])
    return numpy.asarray(fine.reshape(cells[0], SAMPLES, cells[1], SAMPLES).mean(axis=(1, 3)))


def _along_axes(a: float, b: float) -> tuple[float, float]:
    """Semi-axes along x and y: the larger one lies along the smaller curvature."""
    return (a, b) if CURVATURES[0] <= CURVATURES[1] else (b, a)


def _closed_forms(given: str, value: float, exact: Answer) -> list[Row]:
    hertz = hertz_contact if given == GIVEN[0] else hertz_contact_at_approach
    arguments = (*CURVATURES, MODULUS, value)
    fidelity = FidelityLevel("Hertz ellipse", milliseconds(lambda: hertz(*arguments)))
    found = rows_of(PART, given, fidelity, REFERENCE, _of_hertz(hertz(*arguments)), exact)
    if given != GIVEN[0]:
        return found  # the domain of an ansatz is known for a load only
    fidelity = FidelityLevel(
        "Lamé ansatz of A, B, n", milliseconds(lambda: ansatz_of_curvatures(*CURVATURES, 2.0, MODULUS, LOAD))
    )
    answer = _of_lame(ansatz_of_curvatures(*CURVATURES, 2.0, MODULUS, LOAD))
    found += rows_of(PART, given, fidelity, REFERENCE, answer, exact)
    fit = _fitted()
    for name, form in (("Lamé ansatz, domain fitted", ansatz_on_domain), ("equivalent ellipse", equivalent_ellipse)):
        domain = (fit.a, fit.b, fit.exponent, MODULUS, LOAD)
        fidelity = FidelityLevel(name, milliseconds(lambda form=form, domain=domain: form(*domain)))  # type: ignore[misc]
        found += rows_of(PART, given, fidelity, REFERENCE, _of_lame(form(*domain)), exact)
    return found


def _fitted() -> LameFit:
    """Lame curve of the patch by the finest field."""
    problem = patch_problem(FIELD_CELLS)
    pressure = solve(problem, GIVEN[0], LOAD, 1e-3).pressure
    assert pressure is not None
    return fit_patch(pressure, problem.half_space.cell_x, problem.half_space.cell_y, 0.0, 0.0)


def _of_hertz(contact: HertzContact) -> Answer:
    along_x, along_y = _along_axes(contact.a, contact.b)
    return _of_lame(LamePressure(contact.load, contact.approach, along_x, along_y, 2.0, contact.peak_pressure))


def _of_lame(contact: LamePressure) -> Answer:
    area = lame_area(contact.a, contact.b, contact.exponent)
    return Answer(contact.load, contact.approach, contact.peak_pressure, area, cell_means(contact, FIELD_CELLS))


WORK_PRECISION = (WorkPrecision(PART, rows),)
