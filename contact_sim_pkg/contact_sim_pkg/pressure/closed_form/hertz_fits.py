"""Less expensive formulas for the shape of a Hertz ellipse than the exact root of
`pressure/closed_form/hertz.py`, each with its error.

With Omega = (B - A)/(A + B), m = 1 - (b/a)^2:

* polynomial: `m = sum c_i Omega^i`, i = 1..10 (Rolling Contact, eq 10). b/a is 1 % high from Omega
= 0.853 and never falls
  below 0.032; p0 is off by 1 % from 0.932, the approach from 0.923. Not for Omega above 0.85 where
  the axes matter.
* power: `b/a = (A/B)^(2/3)`, 0.5 % low at A/B = 0.3, 3 % at 0.1, 16 % at 0.01.
* table: ln(1 - m), ln K and ln E over ln(1 - Omega), cubic between equal steps; 385 nodes leave
  5e-6 near the circle and below 1e-6 from Omega = 0.2.

K and E of the first two come from the arithmetic-geometric mean, as in the exact solution; only the
root is saved. The table saves both.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.hertz import (
    LARGEST_OMEGA,
    EllipseShape,
    contact_of_shape,
    ellipse_shape,
    elliptic_integrals,
)

__all__ = ["EXACT", "POLYNOMIAL", "POWER", "TABLE", "contacts_at_load", "make_shape_table"]

Field = NDArray[numpy.float64]

EXACT, POLYNOMIAL, POWER, TABLE = range(4)

COEFFICIENTS = (2.667, -3.577, 4.244, -5.871, 10.312, -18.202, 24.577, -21.858, 11.213, -2.506)
"""Of Omega^1 to Omega^10, as printed."""

TABLE_NODES = 385
TABLE_END = -math.log1p(-LARGEST_OMEGA)


def make_shape_table() -> Field:
    """ln(1 - m), ln K, ln E, [nodes, 3], at equal steps of -ln(1 - Omega) from 0 to the end of
    Hertz's range.
    """
    rows = []
    for steepness in numpy.linspace(0.0, TABLE_END, TABLE_NODES):
        gap = math.exp(-steepness)  # 1 - Omega
        rows.append([math.log(value) for value in ellipse_shape(gap, 2.0 - gap)])
    return numpy.array(rows)


@entry
def contacts_at_load(
    kind: int, table: Field, curvature_a: Field, curvature_b: Field, modulus: float, load: float, out: Field
) -> None:
    """Approach [m], a [m], b [m] and peak pressure [Pa] of many contacts under one load, into `out`
    [n, 4].

    kind: EXACT, POLYNOMIAL, POWER or TABLE; table: of `make_shape_table`; curvature_a <=
    curvature_b [1/m], both above 0; modulus: E* [Pa]; load: [N], zeros where it is not above 0. Not
    checked.
    """
    for k in range(curvature_a.shape[0]):
        a, b = curvature_a[k], curvature_b[k]
        if not load > 0.0:
            out[k, 0], out[k, 1], out[k, 2], out[k, 3] = 0.0, 0.0, 0.0, 0.0
            continue
        # Shape of the ellipse from the ratio of the curvatures, then its size from the load
        if kind == POLYNOMIAL:
            shape = shape_of_polynomial(a, b)
        elif kind == POWER:
            shape = shape_of_power(a, b)
        elif kind == TABLE:
            shape = shape_of_table(table, a, b)
        else:
            shape = ellipse_shape(a, b)
        contact = contact_of_shape(shape, a + b, modulus, load)
        out[k, 0], out[k, 1], out[k, 2], out[k, 3] = contact.approach, contact.a, contact.b, contact.peak_pressure


@kernel
def shape_of_polynomial(curvature_a: float, curvature_b: float) -> EllipseShape:
    """Shape by the polynomial of Rolling Contact, eq 10; curvatures: [1/m], A <= B."""
    omega = (curvature_b - curvature_a) / (curvature_a + curvature_b)
    parameter = 0.0
    for i in range(10):
        parameter = (parameter + COEFFICIENTS[9 - i]) * omega
    integral_k, integral_e, _ = elliptic_integrals(1.0 - parameter)
    return EllipseShape(1.0 - parameter, integral_k, integral_e)


@kernel
def shape_of_power(curvature_a: float, curvature_b: float) -> EllipseShape:
    """Shape by `b/a = (A/B)^(2/3)`; curvatures: [1/m], A <= B."""
    complement = (curvature_a / curvature_b) ** (4.0 / 3.0)
    integral_k, integral_e, _ = elliptic_integrals(complement)
    return EllipseShape(complement, integral_k, integral_e)


@kernel
def shape_of_table(table: Field, curvature_a: float, curvature_b: float) -> EllipseShape:
    """Lagrange's cubic through the four nearest nodes.

    table: [nodes, 3] of `make_shape_table`; curvatures: [1/m], A <= B.
    """
    nodes = table.shape[0]
    place = -math.log(2.0 * curvature_a / (curvature_a + curvature_b)) / TABLE_END * (nodes - 1)
    first = min(max(int(place) - 1, 0), nodes - 4)
    t = place - first
    w0, w1 = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0, 0.5 * t * (t - 2.0) * (t - 3.0)
    w2, w3 = -0.5 * t * (t - 1.0) * (t - 3.0), t * (t - 1.0) * (t - 2.0) / 6.0
    complement = w0 * table[first, 0] + w1 * table[first + 1, 0] + w2 * table[first + 2, 0] + w3 * table[first + 3, 0]
    integral_k = w0 * table[first, 1] + w1 * table[first + 1, 1] + w2 * table[first + 2, 1] + w3 * table[first + 3, 1]
    integral_e = w0 * table[first, 2] + w1 * table[first + 1, 2] + w2 * table[first + 2, 2] + w3 * table[first + 3, 2]
    return EllipseShape(math.exp(complement), math.exp(integral_k), math.exp(integral_e))
