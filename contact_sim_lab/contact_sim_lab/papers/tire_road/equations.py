"""Equations of *Tire/Road Contact*, printed and corrected, each with the shipped function that evaluates it."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form import axisymmetric, lame_domain, lame_pressure
from contact_sim_lab.closed_form.axisymmetric_profile import PowerProfile, tabulated_profile
from contact_sim_lab.records.paper import Equation, Parameter
from contact_sim_lab.twins.lame_pressure import printed_eccentricity_power, printed_shape_load
from contact_sim_pkg.pressure.closed_form import lame
from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.rigs.vehicle.tire import asperity_impulses

__all__ = ["EQUATIONS"]

Array = NDArray[numpy.float64]
CLOSED = "contact_sim_lab.closed_form"

A = Parameter("a", "m", 0.109, above=0.0, most=1e6, help="half axis along x")
B = Parameter("b", "m", 0.049, above=0.0, most=1e6, help="half axis along y")
N = Parameter("exponent", "", 2.0, least=0.1, most=100.0, help="Lamé exponent n")
MODULUS = Parameter("modulus", "Pa", 4.0e6, above=0.0, help="E*")
LOAD = Parameter("load", "N", 4000.0, least=0.0)
POINTS = (Parameter("x", "m", (0.0, 0.05, 0.1)), Parameter("y", "m", (0.0, 0.0, 0.0)))
CURVATURES = (
    Parameter("curvature_a", "1/m", 0.5, above=0.0, help="A, the smaller"), Parameter("curvature_b", "1/m", 1.6667, above=0.0),
)  # fmt: skip
ANSATZ = (("load", "N"), ("approach", "m"), ("a", "m"), ("b", "m"), ("n", ""), ("p0", "Pa"))
HERTZ = (("load", "N"), ("approach", "m"), ("a", "m"), ("b", "m"), ("p0", "Pa"))
PROFILE = (Parameter("coefficient", "m^(1-k)", 5.0, above=0.0), Parameter("power", "", 2.0, above=0.0, most=50.0))


def _love(cell_x: float, cell_y: float, modulus: float, pressure: float, row: int, col: int) -> float:
    """u a few cells beside one loaded cell."""
    size = max(row, col) + 1
    half_space = make_half_space(size, size, cell_x, cell_y, modulus)
    field, out = numpy.zeros((size, size)), numpy.zeros((size, size))
    field[0, 0] = pressure
    displacement(half_space, make_buffers(half_space), field, out)
    return float(out[row, col])


def _boundary(a: float, b: float, exponent: float, count: int) -> tuple[Array, Array]:
    return lame_domain.lame_boundary(a, b, exponent, count)


def _domain(a: float, b: float, exponent: float) -> tuple[float, float, float, float]:
    second = (lame.lame_moment(a, b, exponent, 2.0, 0.0), lame.lame_moment(a, b, exponent, 0.0, 2.0))
    return lame.lame_area(a, b, exponent), lame_domain.perimeter(a, b, exponent), *second


def _pressure(
    a: float, b: float, exponent: float, modulus: float, load: float, x: Array, y: Array
) -> tuple[Array, float, float]:
    contact = lame_pressure.ansatz_on_domain(a, b, exponent, modulus, load)
    return lame_pressure.lame_pressure(contact, x, y), contact.peak_pressure, contact.approach


def _eccentricity(a: float, b: float, exponent: float) -> tuple[float, float]:
    """Corrected; and the printed one to the power n, at the printed r^n = (a^n + b^n)/2."""
    printed = printed_eccentricity_power(a, b, exponent, 0.5 * (a**exponent + b**exponent))
    return lame_pressure.eccentricity(a, b, exponent), float(printed)


def _asperities(
    load: float,
    spacing: float,
    contact_length: float,
    slope: Array,
    travel: float,
    start: float,
    cell: float,
    cells: int,
) -> tuple[float, Array]:
    made = asperity_impulses.default_asperities(load, spacing, contact_length, slope)
    density = numpy.zeros(cells)
    asperity_impulses.asperity_density(made, travel, start, cell, density)
    return asperity_impulses.asperity_force(made, travel), density


def _sneddon(coefficient: float, power: float, modulus: float, radius: float, r: Array) -> tuple[float, float, Array]:
    profile = PowerProfile(coefficient, power)
    return (
        axisymmetric.approach_at_radius(profile, radius), axisymmetric.load_at_radius(profile, modulus, radius),
        axisymmetric.pressure(profile, modulus, radius, r),
    )  # fmt: skip


def _sneddon_table(places: Array, heights: Array, modulus: float, approach: float) -> tuple[float, float]:
    profile = tabulated_profile(places, heights)
    radius = axisymmetric.radius_at_approach(profile, approach)
    return radius, axisymmetric.load_at_radius(profile, modulus, radius)


EQUATIONS: tuple[Equation, ...] = (
    Equation("1", "displacement beside one loaded cell", "u = 1/(π E*) ∬ p/|r|",
             "contact_sim_pkg.pressure.field.halfspace:displacement",
             (Parameter("cell_x", "m", 0.005, above=0.0), Parameter("cell_y", "m", 0.005, above=0.0), MODULUS,
              Parameter("pressure", "Pa", 1.0e5), Parameter("row", "", 3, least=0, most=255), Parameter("col", "", 0, least=0,
              most=255)),
             (("u", "m"),), _love),
    Equation("5", "radial variable of the Lamé domain", "ρ = (|x/a|ⁿ + |y/b|ⁿ)^(1/n)", f"{CLOSED}.lame_domain:radial_variable",
             (*POINTS, A, B, N), (("ρ", ""),)),
    Equation("5-domain", "area, perimeter and second moments of the Lamé domain", "S = 4ab Γ(1+1/n)²/Γ(1+2/n)",
             "contact_sim_pkg.pressure.closed_form.lame:lame_moment",
             (A, B, N), (("area", "m²"), ("perimeter", "m"), ("∬ x²", "m⁴"), ("∬ y²", "m⁴")),
             _domain),
    Equation("6", "boundary of the Lamé domain, at equal arc lengths", "x = a sgn(cos θ)|cos θ|^(2/n), …",
             f"{CLOSED}.lame_domain:lame_boundary", (A, B, N, Parameter("count", "", 8, least=4, most=100000)),
             (("x", "m"), ("y", "m")), _boundary),
    Equation("7", "pressure of the Lamé ansatz, corrected", "p = p0 (1 − ρⁿ)^½, p0 from the load",
             f"{CLOSED}.lame_pressure:lame_pressure",
             (A, B, N, MODULUS, LOAD, *POINTS), (("p", "Pa"), ("p0", "Pa"), ("approach", "m")), _pressure),
    Equation("7-eccentricity", "eccentricity, corrected and printed", "k̄ = (1 − (b/a)ⁿ)^(1/n); printed k̄ⁿ = (n r̃ⁿ − 2 bⁿ)/aⁿ",
             f"{CLOSED}.lame_pressure:eccentricity", (A, B, N), (("corrected k̄", ""), ("printed k̄ⁿ", "")), _eccentricity),
    Equation("7-printed", "load that the printed shape carries over the right one, circle",
             "Ē(arcsin(1−r), r k̄)^(−2/3) in place of √(1−ρ²)",
             "contact_sim_lab.twins.lame_pressure:printed_shape_load", (), (("load over P", ""),), printed_shape_load),
    Equation("8", "Lamé ansatz of A, B and n (eqs 7-9), corrected", "p0 = [3 P H² E*²/(2π)]^(1/3) E^(−2/3) (1−m)^(1/6)",
             f"{CLOSED}.lame_pressure:ansatz_of_curvatures", (*CURVATURES, N, MODULUS, LOAD), ANSATZ),
    Equation("8-ellipse", "equivalent ellipse of a Lamé domain", "same area, same b/a",
             f"{CLOSED}.lame_pressure:equivalent_ellipse",
             (A, B, N, MODULUS, LOAD), ANSATZ),
    Equation("9", "approach, corrected: Hertz", "Δ = [9 P² H/(4π² E*²)]^(1/3) (1−m)^(1/3) K E^(−1/3)",
             "contact_sim_pkg.pressure.closed_form.hertz:hertz_contact",
             (*CURVATURES, MODULUS, LOAD), HERTZ),
    Equation("9-printed", "approach as printed, with Young's modulus", "low by (2(1+ν))^(−2/3)",
             f"{CLOSED}.lame_pressure:printed_approach",
             (*CURVATURES, Parameter("young", "Pa", 3.0e6, above=0.0), Parameter("poisson", "", 0.5, above=-1.0, most=0.5), LOAD),
             (("approach", "m"),)),
    Equation("10", "travelling impulsive forces: resultant and line density", "f = Σ F_n sin φ_n Π((nΔx − vt)/b) δ_D(x − nΔx)",
             "contact_sim_pkg.rigs.vehicle.tire.asperity_impulses:asperity_density",
             (LOAD, Parameter("spacing", "m", 0.01, above=0.0), Parameter("contact_length", "m", 0.1, above=0.0),
              Parameter("slope", "", (0.0,) * 40), Parameter("travel", "m", 0.2), Parameter("start", "m", 0.14),
              Parameter("cell", "m", 0.02, above=0.0), Parameter("cells", "", 6, least=1, most=10000)),
             (("force", "N"), ("density", "N/m")), _asperities),
    Equation("sneddon", "axisymmetric contact by Sneddon's dual integral equations, f = C rᵏ", "δ = ∫ f'(x)/√(1−x²) dx",
             f"{CLOSED}.axisymmetric:pressure",
             (*PROFILE, MODULUS, Parameter("radius", "m", 0.02, above=0.0), Parameter("r", "m", (0.0, 0.01, 0.019), least=0.0)),
             (("approach", "m"), ("load", "N"), ("p", "Pa")), _sneddon, source="Sneddon 1965, eqs 3.1-3.4"),
    Equation("sneddon-table", "the same of a tabulated profile, at an approach", "monotone cubic through the table",
             f"{CLOSED}.axisymmetric_profile:tabulated_profile",
             (Parameter("places", "m", (0.0, 0.01, 0.02, 0.03), least=0.0), Parameter("heights", "m", (0.0, 5e-4, 2e-3,
             4.5e-3), least=0.0),
              MODULUS, Parameter("approach", "m", 2e-3, above=0.0)), (("radius", "m"), ("load", "N")), _sneddon_table,
             source="Sneddon 1965, eqs 3.1-3.4"),
)  # fmt: skip
