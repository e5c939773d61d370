"""Hard cases of the seat back: its shell, and the Lame domain of its contact points."""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.closed_form.lame_domain import (
    inside,
    lame_boundary,
    lame_mesh,
    perimeter,
    radial_variable,
)
from contact_sim_lab.closed_form.lame_points import fit_points
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.rigs.backrest.twin_shell import plate_centre_deflection
from contact_sim_pkg.pressure.closed_form.lame import lame_area
from contact_sim_pkg.rigs.backrest.shell import ShallowShell, ShellError, natural_frequencies, static_deflection

BACK = ShallowShell(
    length_1=0.40, length_2=0.50, thickness=0.030, young=0.6e6, poisson=0.45, density=1050.0, radius_1=0.6, radius_2=1.5
)
PLATE = BACK._replace(radius_1=math.inf, radius_2=math.inf)


def plate_limit() -> Finding:
    """Largest relative error of the 25 frequencies at R = inf and at R = 1e9 m against `sqrt(D/(rho
    h)) (alpha^2+beta^2)`.
    """
    order = numpy.arange(1.0, 6.0) * math.pi
    waves = (order[:, None] / PLATE.length_1) ** 2 + (order / PLATE.length_2) ** 2
    speed = PLATE.thickness * math.sqrt(PLATE.young / (PLATE.density * 12.0 * (1.0 - PLATE.poisson**2)))
    nearly = PLATE._replace(radius_1=1e9, radius_2=-1e9)
    errors = [abs(natural_frequencies(shell, 25) / (speed * waves).ravel() - 1.0).max() for shell in (PLATE, nearly)]
    return at_most(max(errors), 1e-14, hard=nearly.thickness / nearly.radius_1)


def vanishing_thickness() -> Finding:
    """omega R sqrt(rho/E) of the first mode of a spherical shell 1 pm thick."""
    shell = BACK._replace(thickness=1e-12, radius_1=2.0, radius_2=2.0)
    return close_to(
        float(natural_frequencies(shell, 1)[0]) * 2.0 * math.sqrt(1050.0 / 0.6e6),
        1.0,
        1e-12,
        hard=shell.thickness / shell.radius_1,
    )


def thick_shell() -> Finding:
    """How many of four shells thicker than a tenth of the shorter side are refused; one of exactly
    a tenth is not.
    """
    natural_frequencies(BACK._replace(thickness=0.1 * BACK.length_1), 1)
    refused, thick = 0, (0.0401, 0.045, 0.5, math.nan)
    for thickness in thick:
        try:
            natural_frequencies(BACK._replace(thickness=thickness), 1)
        except ShellError:
            refused += 1
    return exactly(refused, 4, hard=min(t for t in thick if not math.isnan(t)) / BACK.length_1)


def point_load() -> Finding:
    """Deflection under a load in the middle of the plate, 10 201 modes, over Levy's single
    series.
    """
    middle = numpy.array([[0.5 * PLATE.length_1, 0.5 * PLATE.length_2]])
    rigidity = PLATE.young * PLATE.thickness**3 / (12.0 * (1.0 - PLATE.poisson**2))
    exact = plate_centre_deflection(PLATE.length_1, PLATE.length_2, rigidity, 20.0)
    few, many = (static_deflection(PLATE, modes, numpy.array([20.0]), middle, middle) for modes in (100, 101**2))
    return close_to(float(many[0]) / exact, 1.0, 1e-4, hard=1.0 - float(few[0]) / float(many[0]))


def corners() -> Finding:
    """Share of 400 boundary points of a square at n = 100 that lie within 10 % of a corner; evenly
    spread: a tenth.
    """
    exponent = 100.0
    x, y = lame_boundary(1.0, 1.0, exponent, 400)
    return close_to(float(((abs(x) > 0.9) & (abs(y) > 0.9)).mean()), 0.1, 0.02, hard=exponent)


def cusp_points() -> Finding:
    """Largest `|rho - 1|` of 400 boundary points at n = 0.1, where x and y span 15 decades."""
    x, y = lame_boundary(0.3, 0.7, 0.1, 400)
    return at_most(
        float(abs(radial_variable(x, y, 0.3, 0.7, 0.1) - 1.0).max()), 1e-12, hard=abs(x).max() / abs(x[x != 0.0]).min()
    )


def cusp_mesh() -> Finding:
    """Area of the mesh at n = 0.1 over that by lgamma."""
    exact = lame_area(1.0, 1.0, 0.1)
    return close_to(float(lame_mesh(1.0, 1.0, 0.1, 4, 32).area.sum()) / exact, 1.0, 1e-12, hard=0.25 * exact)


def tips() -> Finding:
    """How many of the 4 tips and the origin are inside, for nine exponents from 0.1 to 100."""
    x, y = numpy.array([0.3, -0.3, 0.0, 0.0, 0.0]), numpy.array([0.0, 0.0, 0.7, -0.7, 0.0])
    exponents = (0.1, 0.3, 0.5, 1.0, 1.7, 2.0, 4.0, 20.0, 100.0)
    return exactly(
        sum(int(inside(x, y, 0.3, 0.7, exponent).sum()) for exponent in exponents),
        45,
        hard=max(exponents) / min(exponents),
    )


def astroid() -> Finding:
    """Perimeter at n = 2/3: 6 a."""
    exponent = 2.0 / 3.0
    return close_to(perimeter(1.0, 1.0, exponent), 6.0, 1e-12, hard=exponent)


def few_contact_points() -> Finding:
    """Sets of 1 to 4 points, and of 20 on a line, that come back with n = 2 and are marked as not
    fitted.
    """
    corner = numpy.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.2], [0.0, 0.2]])
    line = numpy.linspace(0.0, 1.0, 20)[:, None] * numpy.array([[0.3, 0.1]])
    sets = (corner[:1], corner[:2], corner[:3], corner, line)
    fits = [fit_points(numpy.asarray(points)) for points in sets]
    return exactly(
        sum(fit.exponent == 2.0 and not fit.fitted for fit in fits),
        5,
        hard=sum(len(points) > 4 and numpy.linalg.matrix_rank(points - points.mean(axis=0)) > 1 for points in sets),
    )


def scattered_points() -> Finding:
    """Exponent from 60 points of a curve of n = 6 with 200 points within it."""
    x, y = lame_boundary(0.08, 0.05, 6.0, 60)
    within = numpy.random.default_rng(4).uniform(-0.03, 0.03, (200, 2))
    return close_to(
        fit_points(numpy.concatenate([numpy.stack([x, y], axis=1), within])).exponent,
        6.0,
        1e-3,
        hard=len(within) / (len(within) + len(x)),
    )


CASES = (
    HardCase("lame", "n = 100: share of boundary points near corners", corners, guard.at_least("exponent", 100.0)),
    HardCase("lame", "n = 0.1: boundary points on the curve", cusp_points, guard.scales("places on the curve", 1e14)),
    HardCase("lame", "n = 0.1: area of the mesh over lgamma's", cusp_mesh,
        guard.at_most("area over that of the rectangle", 1e-5)),
    HardCase("lame", "n 0.1 to 100: tips and origin inside", tips, guard.scales("exponents", 1000.0)),
    HardCase("lame", "n = 2/3, astroid: perimeter over a", astroid, guard.below("exponent, of cusps", 1.0)),
    HardCase("lame fit", "1 to 4 contact points, a line: n = 2, flagged", few_contact_points,
        guard.zero("sets of five points and more, off a line")),
    HardCase("lame fit", "points on and within n = 6: exponent", scattered_points,
        guard.at_least("share of the points within the curve", 0.75)),
    HardCase("shell", "R = inf and 1e9 m: plate frequencies", plate_limit,
        guard.at_most("thickness over radius", 1e-10)),
    HardCase("shell", "h → 0: membrane", vanishing_thickness, guard.at_most("thickness over radius", 1e-12)),
    HardCase("shell", "h/L > 0.1: refused", thick_shell, guard.above("least thickness over side", 0.1)),
    HardCase("shell", "point load on a plate: deflection over Lévy's", point_load,
        guard.at_least("part of the deflection beyond 100 modes", 1e-3)),
)  # fmt: skip
