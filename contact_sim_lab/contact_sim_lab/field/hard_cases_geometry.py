"""Hard cases of the elliptic Hertz contact and of the Lame fit."""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
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
    small, large = 0.5 / radius, 0.5 / radius
    found = hertz_contact(small, large, MODULUS, LOAD)
    a = (3.0 * LOAD * radius / (4.0 * MODULUS)) ** (1.0 / 3.0)
    expected = (a, a * a / radius, 1.5 * LOAD / (math.pi * a * a))
    values = (found.a, found.approach, found.peak_pressure)
    return at_most(max(abs(v / e - 1.0) for v, e in zip(values, expected, strict=True)), 1e-13, hard=large - small)


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
    return at_most(worst, 1e-9, hard=large / small)


def no_load() -> Finding:
    """Sum of all results at P = 0 and at a negative approach."""
    load, approach = 0.0, -1e-3
    results = (hertz_contact(1.0, 2.0, MODULUS, load), hertz_contact_at_approach(1.0, 2.0, MODULUS, approach))
    return exactly(
        sum(abs(r.load) + abs(r.approach if r.load else 0.0) + r.a + r.b + r.peak_pressure for r in results),
        0.0,
        hard=max(load, approach),
    )


def refused_surfaces() -> Finding:
    """How many of four surfaces without elliptic contact are refused: conforming, saddle, line,
    practically a line.
    """
    refused, surfaces = 0, ((-1.0, -2.0), (-0.1, 1.0), (0.0, 1.0), (1e-14, 1.0))
    for curvatures in surfaces:
        try:
            hertz_contact(*curvatures, MODULUS, LOAD)
        except HertzError:
            refused += 1
    return exactly(refused, 4, hard=max(map(min, surfaces)))


def exchanged_axes() -> Finding:
    """Change of the law when the two curvatures change places."""
    small, large = 0.5, 1.7
    return exactly(abs(power_law(small, large, MODULUS) - power_law(large, small, MODULUS)), 0.0, hard=large / small)


def nearly_rectangle() -> Finding:
    """Area over 4ab at exponent 100."""
    exponent = 100.0
    return close_to(lame_area(1.0, 1.0, exponent) / 4.0, 1.0, 1e-3, hard=exponent)


def cusps() -> Finding:
    """Area at the smallest exponent 0.1: 4 / binomial(20, 10)."""
    area = lame_area(1.0, 1.0, 0.1)
    return close_to(area, 4.0 / math.comb(20, 10), 1e-17, hard=0.25 * area)


def too_sharp() -> Finding:
    """Exponents below 0.1 that are refused."""
    refused, exponents = 0, (0.0999, 0.0, -1.0, math.nan)
    for exponent in exponents:
        try:
            lame_area(1.0, 1.0, exponent)
        except ValueError:
            refused += 1
    return exactly(refused, 4, hard=sum(exponent >= 0.1 for exponent in exponents))


def few_points() -> Finding:
    """Patches of 1 to 4 cells that are not fitted, and say so with exponent 2."""
    flagged, loaded = 0, 0
    for cells in range(1, 5):
        pressure = numpy.zeros((16, 16))
        pressure.ravel()[120 : 120 + cells] = 1.0
        loaded = max(loaded, int((pressure > 0.0).sum()))
        fit = fit_patch(pressure, 0.01, 0.01, 0.0, 0.0)
        flagged += int(fit.exponent == 2.0 and not fit.fitted)
    return exactly(flagged, 4, hard=loaded)


CASES = (
    HardCase("hertz", "Ω = 0, sphere: relative error", sphere, guard.zero("difference of the curvatures [1/m]")),
    HardCase("hertz", "Ω → 1, 1-Ω down to 2e-12: relative error", slender, guard.scales("curvatures", 5e11)),
    HardCase("hertz", "P = 0 and δ < 0: zeros", no_load, guard.at_most("load [N] and approach [m]", 0.0)),
    HardCase("hertz", "conforming, saddle, line: refused", refused_surfaces,
        guard.at_most("largest of the smaller curvatures [1/m]", 1e-14)),
    HardCase("hertz", "curvatures exchanged: change of the law", exchanged_axes, guard.scales("curvatures", 3.0)),
    HardCase("lame", "n = 100: area over 4ab", nearly_rectangle, guard.at_least("exponent", 100.0)),
    HardCase("lame", "n = 0.1, cusps: area", cusps, guard.at_most("area over that of the rectangle", 1e-5)),
    HardCase("lame", "n < 0.1: refused", too_sharp, guard.zero("exponents from 0.1 on")),
    HardCase("lame fit", "1 to 4 cells: not fitted, flagged", few_points, guard.at_most("loaded cells, most", 4)),
)  # fmt: skip
