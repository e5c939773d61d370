"""Hard cases of the elliptic Hertz contact and of the Lame fit."""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import hertz as reference
from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact, hertz_contact_at_approach, power_law
from contact_sim_pkg.pressure.closed_form.lame import fit_patch, lame_area

MODULUS, LOAD = 4.0e6, 3335.0


def sphere() -> Finding:
    """Relative error of a, p0 and the approach for equal radii, where the ellipse's relations are
    0/0.
    """
    radius = 0.3
    found = hertz_contact(0.5 / radius, 0.5 / radius, MODULUS, LOAD)
    a = (3.0 * LOAD * radius / (4.0 * MODULUS)) ** (1.0 / 3.0)
    expected = (a, a * a / radius, 1.5 * LOAD / (math.pi * a * a))
    values = (found.a, found.approach, found.peak_pressure)
    return at_most(max(abs(v / e - 1.0) for v, e in zip(values, expected, strict=True)), 1e-13)


def slender() -> Finding:
    """Largest relative error of approach, axes and pressure for 1 - Omega from 1e-1 to 2e-12,
    against 50 digits.
    """
    worst = 0.0
    for gap in (1e-1, 1e-3, 1e-6, 1e-9, 2e-12):
        small, large = 0.5 * gap, 1.0 - 0.5 * gap
        found, exact = (
            hertz_contact(small, large, MODULUS, LOAD),
            reference.contact_at_load(small, large, MODULUS, LOAD),
        )
        pairs = ((found.approach, exact.approach), (found.a, exact.a), (found.b, exact.b))
        worst = max(worst, *(abs(value / true - 1.0) for value, true in pairs))
    return at_most(worst, 1e-9)


def no_load() -> Finding:
    """Sum of all results at P = 0 and at a negative approach."""
    results = (hertz_contact(1.0, 2.0, MODULUS, 0.0), hertz_contact_at_approach(1.0, 2.0, MODULUS, -1e-3))
    return exactly(
        sum(abs(r.load) + abs(r.approach if r.load else 0.0) + r.a + r.b + r.peak_pressure for r in results), 0.0
    )


def refused_surfaces() -> Finding:
    """How many of four surfaces without elliptic contact are refused: conforming, saddle, line,
    practically a line.
    """
    refused = 0
    for curvatures in ((-1.0, -2.0), (-0.1, 1.0), (0.0, 1.0), (1e-14, 1.0)):
        try:
            hertz_contact(*curvatures, MODULUS, LOAD)
        except HertzError:
            refused += 1
    return exactly(refused, 4)


def exchanged_axes() -> Finding:
    """Change of the law when the two curvatures change places."""
    return exactly(abs(power_law(0.5, 1.7, MODULUS) - power_law(1.7, 0.5, MODULUS)), 0.0)


def nearly_rectangle() -> Finding:
    """Area over 4ab at exponent 100."""
    return close_to(lame_area(1.0, 1.0, 100.0) / 4.0, 1.0, 1e-3)


def cusps() -> Finding:
    """Area at the smallest exponent 0.1: 4 / binomial(20, 10)."""
    return close_to(lame_area(1.0, 1.0, 0.1), 4.0 / math.comb(20, 10), 1e-17)


def too_sharp() -> Finding:
    """Exponents below 0.1 that are refused."""
    refused = 0
    for exponent in (0.0999, 0.0, -1.0, math.nan):
        try:
            lame_area(1.0, 1.0, exponent)
        except ValueError:
            refused += 1
    return exactly(refused, 4)


def few_points() -> Finding:
    """Patches of 1 to 4 cells that are not fitted, and say so with exponent 2."""
    flagged = 0
    for cells in range(1, 5):
        pressure = numpy.zeros((16, 16))
        pressure.ravel()[120 : 120 + cells] = 1.0
        fit = fit_patch(pressure, 0.01, 0.01, 0.0, 0.0)
        flagged += int(fit.exponent == 2.0 and not fit.fitted)
    return exactly(flagged, 4)


CASES = (
    HardCase("hertz", "Ω = 0, sphere: relative error", sphere),
    HardCase("hertz", "Ω → 1, 1-Ω down to 2e-12: relative error", slender),
    HardCase("hertz", "P = 0 and δ < 0: zeros", no_load),
    HardCase("hertz", "conforming, saddle, line: refused", refused_surfaces),
    HardCase("hertz", "curvatures exchanged: change of the law", exchanged_axes),
    HardCase("lame", "n = 100: area over 4ab", nearly_rectangle),
    HardCase("lame", "n = 0.1, cusps: area", cusps),
    HardCase("lame", "n < 0.1: refused", too_sharp),
    HardCase("lame fit", "1 to 4 cells: not fitted, flagged", few_points),
)
