"""Equations of *Rolling Contact*, each with the shipped function that evaluates it."""

from __future__ import annotations

import math
from typing import Any

import numpy

from contact_sim_lab.records.paper import Equation, Parameter
from contact_sim_lab.rigs.roller.paper_bench import BENDING_COMPLIANCE, CURVATURES, MODULUS, ROLLER
from contact_sim_pkg.pressure.closed_form import hertz, hertz_fits, subsurface
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.rigs.roller.theory import corrugation, heave, moments, stability
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact, contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller
from contact_sim_pkg.rigs.roller.theory.volumes import Volumes, box_volume, dangerous_volumes
from contact_sim_pkg.rigs.roller.theory.yaw_ellipse import exact_ellipse

__all__ = ["EQUATIONS"]

THEORY = "contact_sim_pkg.rigs.roller.theory"

LOAD = Parameter("load", "N", 100.0, least=0.0, most=1e7, help="F_N")
PRESSED = LOAD._replace(above=0.0, least=-math.inf)
E_STAR = Parameter("modulus", "Pa", MODULUS, above=0.0, help="E*")
RADII = (
    Parameter("profile_radius", "m", 0.01, above=0.0, help="R11"), Parameter("radius", "m", 0.02, above=0.0, help="R12"),
    Parameter("shaft_radius", "m", 0.005, above=0.0, help="R21"), Parameter("yaw", "rad", 0.0, least=-1.6, most=1.6),
)  # fmt: skip
ELLIPSE = (("along_x", "m"), ("along_y", "m"), ("angle", "rad"), ("p0", "Pa"), ("approach", "m"), ("load", "N"))
COEFFICIENT = Parameter("contact_coefficient", "m/N^(2/3)", 1.8618e-7, above=0.0, help="k_c")
COMPLIANCE = Parameter("bending_compliance", "m/N", BENDING_COMPLIANCE, least=0.0, help="k_b")
HEAVE = (
    Parameter("mass", "kg", 0.175, above=0.0), Parameter("damping_ratio", "", 0.05, least=0.0), PRESSED, COEFFICIENT, COMPLIANCE,
)  # fmt: skip
SUSPENSION = (
    Parameter("stiffness_tilt", "N m/rad", 60.0, least=0.0), Parameter("stiffness_yaw", "N m/rad", 50.0, least=0.0),
    Parameter("damping", "N m s", 0.0, least=0.0, help="of tilt and yaw"), Parameter("rolling_friction", "", 0.01, least=-1.0,
    most=1.0),
    Parameter("spin", "1/s", 50.0, help="turns of the roller"),
)  # fmt: skip
BENT = (
    Parameter("tilt", "rad", 0.01, least=-0.2, most=0.2), Parameter("yaw", "rad", 0.05, least=-0.2, most=0.2),
    Parameter("bending_load", "N", 225.0, help="Q"), Parameter("contact_distance", "m", 0.06, help="A"),
    Parameter("load_distance", "m", 0.158, help="l"), Parameter("friction", "", 0.1, least=0.0, help="f0"),
)  # fmt: skip
PLACE = (Parameter("x", "m", 1.0e-4), Parameter("y", "m", 0.0), Parameter("z", "m", 6.0e-5, least=0.0))
HALF_AXES = (Parameter("along_x", "m", 2.15e-4, above=0.0), Parameter("along_y", "m", 1.17e-4, above=0.0))
POISSON = Parameter("poisson", "", 0.3, above=-1.0, most=0.5)
TRACTION = (Parameter("traction_x", "", 0.0), Parameter("traction_y", "", 0.0))
SIX = tuple((f"σ_{name}", "Pa") for name in ("xx", "yy", "zz", "xy", "xz", "yz"))


def _curvatures(profile_radius: float, radius: float, shaft_radius: float) -> Curvatures:
    return Curvatures(1.0 / profile_radius, 1.0 / radius, 1.0 / shaft_radius, 0.0)


def _ellipse(
    profile_radius: float, radius: float, shaft_radius: float, yaw: float, modulus: float, load: float
) -> RollingContact:
    return contact_of_rollers(_curvatures(profile_radius, radius, shaft_radius), yaw, modulus, load)


def _polynomial(omega: float) -> tuple[float, float, float, float]:
    """e² and b/a of both; A + B = 1."""
    small, large = 0.5 * (1.0 - omega), 0.5 * (1.0 + omega)
    printed, exact = hertz_fits.shape_of_polynomial(small, large), hertz.ellipse_shape(small, large)
    return 1.0 - printed.complement, 1.0 - exact.complement, math.sqrt(printed.complement), math.sqrt(exact.complement)


def _roller(
    stiffness_tilt: float, stiffness_yaw: float, damping: float, rolling_friction: float, spin: float
) -> Roller:
    return ROLLER._replace(
        stiffness_tilt=stiffness_tilt, stiffness_yaw=stiffness_yaw, damping_tilt=damping, damping_yaw=damping,
        rolling_friction=rolling_friction, spin=2.0 * math.pi * spin,
    )  # fmt: skip


LEAST_LOAD = 1e-3
"""[N] below which a critical load is none: without damping the motion grows at any load."""


def _stability(load: float, **suspension: float) -> tuple[float, float, float, float]:
    roller = _roller(**suspension)
    found = stability.stability(roller, CURVATURES, None, MODULUS, load)
    critical = stability.critical_load(roller, CURVATURES, None, MODULUS, 1.0e4)
    if critical is not None and critical < LEAST_LOAD:  # the floor of the search
        critical = 0.0
    try:
        damping = stability.critical_damping(roller, CURVATURES, None, MODULUS, load)
    except stability.RollerError:
        damping = math.inf
    return found.growth_rate, found.frequency, math.inf if critical is None else critical, damping


def _moments(load: float, tilt: float, yaw: float, rolling_friction: float, **bent: float) -> tuple[float, float]:
    radius = 0.005
    bending = Bending(
        bent["bending_load"], bent["contact_distance"], bent["load_distance"], radius, 0.25 * math.pi * radius**4,
        bent["friction"],
    )  # fmt: skip
    return moments.moments(
        ROLLER._replace(rolling_friction=rolling_friction), CURVATURES, bending, MODULUS, load, tilt, yaw
    )


def _turned(yaw: float) -> tuple[float, float]:
    found = contact_of_rollers(CURVATURES, yaw, MODULUS, 100.0)
    return found.angle, exact_ellipse(CURVATURES, MODULUS, yaw).turned


def _heave(**values: float) -> tuple[float, float]:
    made = heave.make_heave(
        values["mass"],
        values["damping_ratio"],
        values["load"],
        values["contact_coefficient"],
        values["bending_compliance"],
    )
    return heave.linear_stiffness(made), heave.natural_frequency(made)


def _growth(
    waves: int, slope: float, gain: float, turn_time: float, contact_length: float, approach: float, **values: Any
) -> float:
    made = heave.make_heave(
        values["mass"],
        values["damping_ratio"],
        values["load"],
        values["contact_coefficient"],
        values["bending_compliance"],
    )
    table = numpy.array([0.0, values["load"]]), numpy.array([0.0, 0.1])
    track = corrugation.make_track(0.005, turn_time, 256, contact_length, gain, approach, table)
    return corrugation.growth_of_wave(made, track, waves, slope, 256)


def _stress(
    along_x: float,
    along_y: float,
    load: float,
    traction_x: float,
    traction_y: float,
    poisson: float,
    x: float,
    y: float,
    z: float,
) -> tuple[float, ...]:
    pressed = EllipseLoad(along_x, along_y, 1.5 * load / (math.pi * along_x * along_y), traction_x, traction_y)
    six = ellipse_stress(pressed, poisson, numpy.array([[x, y, z]]))
    principal = subsurface.principal_stresses(six)[0]
    return (
        *(float(each) for each in six[0]),
        float(principal[0]),
        float(subsurface.von_mises(six)[0]),
        float(subsurface.max_shear(six)[0]),
    )


def _volumes(
    profile_radius: float, radius: float, shaft_radius: float, yaw: float, modulus: float, load: float, poisson: float,
    normal_limit: float, shear_limit: float,
) -> tuple[float, ...]:  # fmt: skip
    contact = _ellipse(profile_radius, radius, shaft_radius, yaw, modulus, load)
    found: Volumes = dangerous_volumes(contact, poisson, (normal_limit, shear_limit))
    return (*found, box_volume(contact), found.any / box_volume(contact))


EQUATIONS: tuple[Equation, ...] = (
    Equation("3", "contact part of the load on two paths, least complementary energy", "k_c F_c^(2/3) = k_b (F_N − F_c)",
             f"{THEORY}.load_split:parallel_contact_load", (COEFFICIENT, COMPLIANCE, LOAD), (("F_c", "N"),)),
    Equation("5", "load of an approach of contact and bent shaft in series", "k_c F^(2/3) + k_b F = u",
             f"{THEORY}.load_split:load_of_approach", (COEFFICIENT, COMPLIANCE, Parameter("approach", "m", 7.4e-5)), (("F", "N"),)),
    Equation("9", "contact ellipse of the rollers", "Ω(e²) = (B − A)/(A + B)", f"{THEORY}.ellipse:contact_of_rollers",
             (*RADII, E_STAR, LOAD), ELLIPSE, _ellipse),
    Equation("10", "e² of Ω by the printed polynomial and exactly", "e² = 2.667 Ω − 3.577 Ω² + …",
             "contact_sim_pkg.pressure.closed_form.hertz_fits:shape_of_polynomial", (Parameter("omega", "", 0.5, above=0.0,
             below=1.0),),
             (("e² polynomial", ""), ("e² exact", ""), ("b/a polynomial", ""), ("b/a exact", "")), _polynomial),
    Equation("12", "angle of the ellipse of a yawed roller", "tan 2φ = (k11−k12) sin 2θ/[(k11−k12) cos 2θ + k22 − k21]",
             f"{THEORY}.yaw_ellipse:exact_ellipse", (Parameter("yaw", "rad", 0.05, least=-1.5, most=1.5),),
             (("φ", "rad"), ("(a²−b²) a b sin 2φ under 1 N", "m⁴")), _turned),
    Equation("16", "moments of pressure and rolling friction", "M_ψ = F_c R sin ψ, M_θ = f_r F_c R sin ψ",
             f"{THEORY}.moments:moments_of_straight", (LOAD, BENT[0]), (("M_ψ", "N m"), ("M_θ", "N m")),
             lambda load, tilt: moments.moments_of_straight(ROLLER, load, tilt)),
    Equation("17", "moments with the friction of the bent shaft", "M_ψ^σ = −f0 Q π a b h/J_y R cos ψ (A − l + R sin ψ), …",
             f"{THEORY}.moments:moments", (LOAD, *BENT, SUSPENSION[3]), (("M_ψ", "N m"), ("M_θ", "N m")), _moments),
    Equation("18", "stability of tilt and yaw; a critical load of 0: unstable at any load",
             "I_y ψ̈ + iω θ̇ + k1 ψ = 0, I_z θ̈ − iω ψ̇ + k2 θ − c ψ = 0",
             f"{THEORY}.stability:stability",
             (PRESSED._replace(default=300.0), *SUSPENSION),
             (("growth rate", "1/s"), ("frequency", "Hz"), ("critical load", "N"), ("critical damping", "N m s")), _stability),
    Equation("20", "linear heave on the contact", "κ² = k_lin/m, 1/k_lin = 2/3 k_c F_N^(−1/3) + k_b",
             f"{THEORY}.heave:natural_frequency",
             HEAVE, (("k_lin", "N/m"), ("κ", "rad/s")), _heave),
    Equation("20-wave", "growth of a small wave in a turn", "g = −γ δ F ω_T' (k_lin/F_N) Re(1 − H)",
             f"{THEORY}.corrugation:growth_of_wave",
             (*HEAVE, Parameter("waves", "", 2, least=0, most=128), Parameter("slope", "", 0.258, help="F dω_T/dF"),
              Parameter("gain", "", 0.05, least=0.0, help="γ"), Parameter("turn_time", "s", 0.005, above=0.0),
              Parameter("contact_length", "m", 2.34e-4, least=0.0, most=0.03), Parameter("approach", "m", 4.011e-6, least=0.0,
              help="δ(F_N)")),
             (("growth", ""),), _growth),
    Equation("21", "stress under an ellipse with traction", "Boussinesq and Cerruti over the ellipse",
             "contact_sim_pkg.pressure.closed_form.hertz_stress:ellipse_stress", (*HALF_AXES, LOAD, *TRACTION, POISSON, *PLACE),
             (*SIX, ("largest principal", "Pa"), ("von Mises", "Pa"), ("largest shear", "Pa")), _stress),
    Equation("22", "dangerous volumes and damage (eqs 22-24)", "V_ij = ∭ [|σ_ij| > σ_lim], ω_T = V_T/V_k",
             f"{THEORY}.volumes:dangerous_volumes",
             (*RADII, E_STAR, PRESSED, POISSON, Parameter("normal_limit", "Pa", 2.6e8, above=0.0), Parameter("shear_limit",
             "Pa", 1.5e8, above=0.0)),
             (*((f"V_{name}", "m³") for name in ("xx", "yy", "zz", "xy", "xz", "yz", "T")), ("V_k", "m³"), ("ω_T", "")), _volumes),
)  # fmt: skip
