"""Equations of *Driver and Seat*, each with the function that evaluates it."""

from __future__ import annotations

import math
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.cnoidal import cnoidal, periodic_contact, theta
from contact_sim_lab.papers.distance.closest import minimum_distance
from contact_sim_lab.papers.distance.convex_body import ConvexBody, ellipsoid
from contact_sim_lab.papers.distance.genetic_search import genetic_distance
from contact_sim_lab.papers.distance.interference import interference
from contact_sim_lab.records.paper import Equation, Parameter
from contact_sim_pkg.laws import friction, restitution_law
from contact_sim_pkg.laws.dynamic_stiffness import dynamic_stiffness
from contact_sim_pkg.laws.general_dissipative import general_force
from contact_sim_pkg.laws.normal_elastic import approach_of_force
from contact_sim_pkg.laws.parameters import Friction, GeneralDissipative, NormalElastic
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.rigs.backrest import shell

__all__ = ["EQUATIONS"]

Array = NDArray[numpy.float64]

COEFFICIENT = Parameter("coefficient", "N/m^n", 2.457e5, above=0.0, help="A")
EXPONENT = Parameter("exponent", "", 1.5, least=1.0, most=10.0, help="n")
APPROACH, RATE = Parameter("approach", "m", 0.015), Parameter("rate", "m/s", 0.2)
POWERS = (Parameter("p", "", 1.5, least=0.0, most=4.0), Parameter("q", "", 1.0, least=0.0, most=3.0))
END = Parameter("end", "", "force", choices=("force", "gap"))
RESTITUTION, SPEED = (
    Parameter("restitution", "", 0.6, least=0.01, most=1.0),
    Parameter("speed", "m/s", 0.5, above=0.0, most=1e6),
)
MASS = Parameter("mass", "kg", 45.6, above=0.0)
BODIES = (
    Parameter("half_axes_1", "m", (0.3, 0.2, 0.1), above=0.0), Parameter("half_axes_2", "m", (0.2, 0.2, 0.2), above=0.0),
    Parameter("centre_2", "m", (0.4, 0.3, 0.1)),
)  # fmt: skip
SHELL = (
    Parameter("length_1", "m", 0.40, above=0.0), Parameter("length_2", "m", 0.50, above=0.0), Parameter("thickness", "m", 0.03,
    above=0.0),
    Parameter("young", "Pa", 6.0e5, above=0.0), Parameter("poisson", "", 0.45, above=-1.0, most=0.5),
    Parameter("density", "kg/m³", 1050.0, above=0.0), Parameter("radius_1", "m", 0.6, above=0.0, infinite=True),
    Parameter("radius_2", "m", 1.5, above=0.0, infinite=True),
)  # fmt: skip
ENTRIES = (Parameter("b11", "", -2.2, below=0.0), Parameter("b22", "", -3.1, below=0.0), Parameter("b12", "", -0.5))
PHASES = (
    Parameter("eta_1", "rad", 0.3),
    Parameter("eta_2", "rad", 1.1),
    Parameter("k_1", "1/m", 1.0),
    Parameter("k_2", "1/m", 1.6),
)
CLOSED = "contact_sim_lab.closed_form"


def _bodies(half_axes_1: Array, half_axes_2: Array, centre_2: Array) -> tuple[ConvexBody, ConvexBody]:
    return ellipsoid(numpy.zeros(3), half_axes_1), ellipsoid(centre_2, half_axes_2)


def _distance(seed: int, **pair: Array) -> tuple[float, Array, Array, float, float]:
    found, searched = minimum_distance(*_bodies(**pair)), genetic_distance(*_bodies(**pair), seed=seed)
    return found.distance, found.point_1, found.point_2, found.residual, searched.value


def _interference(**pair: Array) -> tuple[float, Array, bool]:
    found = interference(*_bodies(**pair))
    return found.depth, found.point, found.one_foot_each


def _frequencies(count: int, **values: float) -> tuple[Array, float]:
    made = shell.ShallowShell(**values)
    middle = numpy.array([[0.5 * made.length_1, 0.5 * made.length_2]])
    found = shell.natural_frequencies(made, count) / (2.0 * math.pi)
    return found, float(shell.static_deflection(made, count, numpy.array([1.0]), middle, middle)[0])


def _normal(
    coefficient: float, exponent: float, b: float, p: float, q: float, end: str, approach: float, rate: float
) -> float:
    law = GeneralDissipative(b, p, q, 1e-9, 0.0 if end == "force" else -math.inf)
    return general_force(NormalElastic(coefficient, exponent), law, approach, rate, 1.0)


def _coefficient(
    restitution: float, speed: float, mass: float, coefficient: float, exponent: float, p: float, q: float, end: str
) -> float:
    lowest = 0.0 if end == "force" else -math.inf
    return restitution_law.coefficient_of_restitution(
        restitution, speed, mass, NormalElastic(coefficient, exponent), p, q, lowest
    )


def _restitution(severity: float, exponent: float, p: float, q: float, end: str) -> float:
    return restitution_law.restitution_of_severity(severity, exponent, p, q, 0.0 if end == "force" else -math.inf)


def _kelvin_voigt(ratio: float, end: str) -> float:
    return restitution_law.kelvin_voigt_restitution(ratio, 0.0 if end == "force" else -math.inf)


def _stick(
    normal: float, deflection: float, velocity: float, stiffness: float, damping: float, ratio: float
) -> tuple[float, float, float]:
    law = Friction(stiffness, damping, ratio, ratio)
    return (
        friction.friction_force(law, 0, normal, deflection, velocity), friction.stick_event(law, normal, deflection, velocity),
        friction.friction_force(law, 1, normal, deflection, velocity),
    )  # fmt: skip


def _dynamic(
    coefficient: float,
    exponent: float,
    load: float,
    amplitude: float,
    frequency: float,
    damping: float,
    share: float,
    energy: float,
) -> tuple[float, float]:
    return dynamic_stiffness(
        NormalElastic(coefficient, exponent), load, amplitude, frequency, damping=damping, share=share, energy=energy
    )


def _matrix(b11: float, b22: float, b12: float) -> Array:
    return numpy.array([[b11, b12], [b12, b22]])


def _two_phases(eta_1: float, eta_2: float, k_1: float, k_2: float, **entries: float) -> tuple[float, float, float]:
    phases, matrix, direction = numpy.array([eta_1, eta_2]), _matrix(**entries), numpy.array([k_1, k_2])
    parts = (theta.theta_wave, theta.plain_sum, theta.interaction)
    return tuple(float(part(phases, matrix, direction)) for part in parts)  # type: ignore[return-value]


def _one_phase(entry: float, wave_number: float) -> theta.OnePhase:
    return theta.one_phase(entry, wave_number)


def _theta(eta_1: float, eta_2: float, **entries: float) -> float:
    return float(theta.theta(numpy.array([eta_1, eta_2]), _matrix(**entries)))


def _oscillator(
    mass: float, coefficient: float, exponent: float, load: float, part: float
) -> tuple[float, float, float, float, float]:
    elastic = NormalElastic(coefficient, exponent)
    oscillator, rest = cnoidal.contact_oscillator(mass, elastic, load)
    motion = cnoidal.released_at(oscillator, part * rest)
    exact = periodic_contact.exact_period(elastic, mass, load, (1.0 + part) * rest)
    return 2.0 * math.pi / oscillator.frequency, motion.period, exact, motion.turn, 1.0 - motion.complement


def _motion(frequency: float, quadratic: float, start: float, times: Array) -> Any:
    return cnoidal.position(cnoidal.released_at(cnoidal.QuadraticOscillator(frequency, quadratic), start), times)


def _rest(coefficient: float, exponent: float, load: float) -> float:
    return approach_of_force(NormalElastic(coefficient, exponent), load)


LOAD = Parameter("load", "N", 447.3, above=0.0)
EQUATIONS: tuple[Equation, ...] = (
    Equation("1", "minimum distance of two ellipsoids, and by the genetic search", "min ½ |p1 − p2|², g_i(p_i) ≤ 0",
             "contact_sim_lab.papers.distance.closest:minimum_distance", (*BODIES, Parameter("seed", "", 1, least=0, most=2**31)),
             (("distance", "m"), ("p1", "m"), ("p2", "m"), ("KKT residual", ""), ("genetic distance", "m")), _distance),
    Equation("2", "interference of two ellipsoids", "max d, g_i(p) ≤ −d/2",
             "contact_sim_lab.papers.distance.interference:interference",
             (*BODIES[:2], BODIES[2]._replace(default=(0.3, 0.1, 0.1))), (("d", "m"), ("p", "m"), ("one foot each", "")),
             _interference),
    Equation("4", "Lamé curve: radial variable", "|x/a|ⁿ + |y/b|ⁿ ≤ 1", f"{CLOSED}.lame_domain:radial_variable",
             (Parameter("x", "m", (0.0, 0.05)), Parameter("y", "m", (0.0, 0.03)), Parameter("a", "m", 0.08, above=0.0),
              Parameter("b", "m", 0.06, above=0.0), Parameter("exponent", "", 2.1, least=0.1, most=100.0)), (("ρ", ""),)),
    Equation("5", "Lamé curve: points at equal arc lengths", "x = a sgn(cos θ)|cos θ|^(2/n), …",
             f"{CLOSED}.lame_domain:lame_boundary",
             (Parameter("a", "m", 0.08, above=0.0), Parameter("b", "m", 0.06, above=0.0),
              Parameter("exponent", "", 2.1, least=0.1, most=100.0), Parameter("count", "", 8, least=4, most=100000)),
             (("x", "m"), ("y", "m"))),
    Equation("6", "natural frequencies of the shallow shell, and its give in the middle",
             "ω² = {D(α²+β²)² + E h[(α²/R2 + β²/R1)/(α²+β²)]²}/(ρ h)", "contact_sim_pkg.rigs.backrest.shell:natural_frequencies",
             (*SHELL, Parameter("count", "", 9, least=1, most=25)), (("frequencies", "Hz"), ("give", "m/N")), _frequencies,
             source="Donnell, Mushtari, Vlasov; the paper's eq 6 in modal form"),
    Equation("7", "approach of a normal force", "F = A δⁿ", "contact_sim_pkg.laws.normal_elastic:approach_of_force",
             (COEFFICIENT, EXPONENT, LOAD), (("approach", "m"),), _rest),
    Equation("8", "normal force with dissipation", "F = A δⁿ + B δᵖ sgn(δ̇)|δ̇|^q",
             "contact_sim_pkg.laws.general_dissipative:general_force",
             (COEFFICIENT, EXPONENT, Parameter("b", "N s^q/m^(p+q)", 4.79e5, least=0.0, help="B"), *POWERS, END, APPROACH, RATE),
             (("F", "N"),), _normal),
    Equation("8-b", "B of a requested restitution", "B = Z A L^(n−p)/v0^q",
             "contact_sim_pkg.laws.restitution_law:coefficient_of_restitution",
             (RESTITUTION, SPEED, MASS, COEFFICIENT, EXPONENT, *POWERS, END), (("B", "N s^q/m^(p+q)"),), _coefficient),
    Equation("8-damping", "damping of Hunt and Crossley of a requested restitution", "d(1+e) = ln[(1+d)/(1−de)], d = λ v0",
             "contact_sim_pkg.laws.restitution:damping_of_restitution",
             (RESTITUTION, Parameter("impact_speed", "m/s", 0.5, above=0.0, most=1e6)), (("λ", "s/m"),), damping_of_restitution),
    Equation("8-stiffness", "dynamic stiffness about a load", "first harmonic of F over δ = δ0 + a sin ωt",
             "contact_sim_pkg.laws.dynamic_stiffness:dynamic_stiffness",
             (COEFFICIENT, EXPONENT, LOAD, Parameter("amplitude", "m", 1e-3, above=0.0), Parameter("frequency", "Hz", 5.0,
             above=0.0),
              Parameter("damping", "s/m", 1.95, least=0.0), Parameter("share", "", 0.0, least=0.0, most=0.9,
              help="of the hysteresis"),
              Parameter("energy", "J", 1.0, above=0.0)), (("stiffness", "N/m"), ("damping", "N s/m")), _dynamic),
    Equation("9", "tangential force: stick, what is left to its limit, slip", "F_t = C δ_t + D δ̇_t, |F_t| ≤ μ F_c",
             "contact_sim_pkg.laws.friction:friction_force",
             (Parameter("normal", "N", 447.3, least=0.0), Parameter("deflection", "m", 3e-3), Parameter("velocity", "m/s", 0.1),
              Parameter("stiffness", "N/m", 3.19e4, above=0.0), Parameter("damping", "N s/m", 619.0, least=0.0),
              Parameter("ratio", "", 0.4, least=0.0)), (("stick", "N"), ("to the limit", "N"), ("slip", "N")), _stick),
    Equation("11", "restitution of a free impact", "e = √(W_r/−W_c)",
             "contact_sim_pkg.laws.restitution_law:restitution_of_severity",
             (Parameter("severity", "", 0.975, least=0.0, most=1e20, help="Z = B L^(p−n) v0^q/A"), EXPONENT, *POWERS, END),
             (("e", ""),),
             _restitution),
    Equation("11-linear", "restitution of spring and damper", "e = exp(−(ζ/s)(π − atan2(2ζs, 1−2ζ²)))",
             "contact_sim_pkg.laws.restitution_law:kelvin_voigt_restitution", (Parameter("ratio", "", 0.3, least=0.0,
             most=1e100), END),
             (("e", ""),), _kelvin_voigt),
    Equation("12", "period of a preloaded contact: linear, cnoidal, exact", "y = y2 + (y3−y2) cn²(Ωt; m)",
             "contact_sim_lab.papers.cnoidal.cnoidal:released_at",
             (MASS, COEFFICIENT, EXPONENT, LOAD, Parameter("part", "", 0.3, above=0.0, below=1.0,
             help="release over the approach at rest")),
             (("linear", "s"), ("cnoidal", "s"), ("exact", "s"), ("other turning point", "m"), ("m", "")), _oscillator),
    Equation("13", "motion of the quadratic oscillator", "ÿ = −ω0² y − κ y²", "contact_sim_lab.papers.cnoidal.cnoidal:position",
             (Parameter("frequency", "rad/s", 31.4, above=0.0), Parameter("quadratic", "1/(m s²)", 1.6e4), Parameter("start",
             "m", 0.005),
              Parameter("times", "s", (0.0, 0.05, 0.1))), (("y", "m"),), _motion),
    Equation("A2", "theta function of two phases", "Θ = Σ exp(i M·η + ½ MᵀBM)", "contact_sim_lab.papers.cnoidal.theta:theta",
             (*ENTRIES, *PHASES[:2]), (("Θ", ""),), _theta),
    Equation("A4", "wave of two phases, plain sum and interaction", "2 ∂² ln Θ/∂x²",
             "contact_sim_lab.papers.cnoidal.theta:interaction",
             (*ENTRIES, *PHASES), (("wave", "1/m²"), ("plain sum", "1/m²"), ("interaction", "1/m²")), _two_phases),
    Equation("A5", "wave of one phase as cn²", "2k²(K/π)² [1 − m − E/K + m cn²]", "contact_sim_lab.papers.cnoidal.theta:one_phase",
             (Parameter("entry", "", -2.2, below=0.0, help="B11"), Parameter("wave_number", "1/m", 1.0, above=0.0)),
             (("amplitude", "1/m²"), ("offset", "1/m²"), ("K/π", ""), ("K", ""), ("1 − m", "")), _one_phase),
)  # fmt: skip
