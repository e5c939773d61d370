"""Work-precision study of the elliptic contact: polynomial, power fit, table, exact root; against
50 digits.
"""

from __future__ import annotations

import functools

import numpy

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import CURVATURES, LOAD, MODULUS
from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.pressure.closed_form.hertz_fits import (
    EXACT,
    POLYNOMIAL,
    POWER,
    TABLE,
    contacts_at_load,
    make_shape_table,
)

__all__ = ["PART", "WORK_PRECISION", "rows"]

PART = "elliptic contact"
FIDELITIES = (
    ("polynomial (eq 10)", POLYNOMIAL), ("power b/a = (A/B)^(2/3)", POWER), ("table in ln(1-Ω)", TABLE),
    ("AGM and Newton", EXACT),
)  # fmt: skip
OMEGAS = (0.5, 0.75, 0.93, 0.98)
MANY = 500
REFERENCE = "mpmath, 50 digits, no shared code"
QUANTITIES = ("approach", "a", "b", "peak pressure")


def rows() -> list[Row]:
    """The crown of the patch, and the same mean curvature at larger Omega."""
    table, mean = make_shape_table(), sum(CURVATURES)
    pairs = {f"Ω = {abs(CURVATURES[0] - CURVATURES[1]) / mean:.3g}": (min(CURVATURES), max(CURVATURES))}
    pairs |= {f"Ω = {omega:g}": (0.5 * mean * (1.0 - omega), 0.5 * mean * (1.0 + omega)) for omega in OMEGAS}
    found: list[Row] = []
    for case, (smaller, larger) in pairs.items():
        exact = reference.contact_at_load(smaller, larger, MODULUS, LOAD)
        expected = (exact.approach, exact.a, exact.b, exact.peak_pressure)
        curvature_a, curvature_b = numpy.full(MANY, smaller), numpy.full(MANY, larger)
        out = numpy.empty((MANY, 4))
        for name, kind in FIDELITIES:
            arguments = (kind, table, curvature_a, curvature_b, MODULUS, LOAD, out)
            fidelity = FidelityLevel(name, milliseconds(functools.partial(contacts_at_load, *arguments)) / MANY)
            for quantity, value, right in zip(QUANTITIES, out[0].tolist(), expected, strict=True):
                error = relative(value, right)
                found.append(row(PART, case, quantity, fidelity, REFERENCE, error, value=value, expected=right))
    return found


WORK_PRECISION = (WorkPrecision(PART, rows),)
