"""Equations of *Contact Area*, each with the shipped function that evaluates it."""

from __future__ import annotations

from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.contact_area.equations_materials import MATERIAL_EQUATIONS
from contact_sim_lab.records.paper import Equation, Parameter
from contact_sim_pkg.rigs.impact.theory import micro_front, stress, surface_wave
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form import force, scalings
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, solve_impact
from contact_sim_pkg.rigs.impact.theory.position import (
    Position,
    SampleHalfSpace,
    position_variant_1,
    position_variant_2,
)

__all__ = ["EQUATIONS"]

Array = NDArray[numpy.float64]
THEORY = "contact_sim_pkg.rigs.impact.theory"

SPEED = Parameter("speed", "m/s", 2.0, above=0.0, help="V0")
RADIUS = Parameter("radius", "m", 0.01, above=0.0)
DEPTH = Parameter("depth", "m", 1.0e-3, least=0.0, help="approach x")
SAMPLE = (
    SPEED, Parameter("mass", "kg", 0.02, above=0.0), RADIUS, Parameter("storage_modulus", "Pa", 8.0e6, above=0.0),
    Parameter("loss_tangent", "", 0.2, least=0.0, most=100.0),
    Parameter("end", "", "force", choices=("force", "gap")), Parameter("shape", "", "small", choices=("small", "iterate")),
)  # fmt: skip
FORM = Parameter("form", "", "corrected", choices=("corrected", "printed"))
PLACES = Parameter("places", "", (0.0, 0.5, 1.0), least=0.0, help="r_i/r")
STRESS_SHAPE = Parameter("stress_shape", "", "parabola", choices=("parabola", "hertz", "printed"))
SHEAR = Parameter("shear_speed", "m/s", 50.0, above=0.0, help="V_s = √(G'/ρ)")
RATE = Parameter("rate", "m/s", 1.0, help="ẋ")
TIME = Parameter("time", "s", 5.0e-4, least=0.0)
LIMITING = Parameter("limiting_depth", "m", 1.0e-6, above=0.0, help="x_s below which no viscous stress is given")
TAN = Parameter("loss_tangent", "", 0.2, least=0.0)
SHAPE_FACTOR = Parameter("shape_factor", "", 1.4142135623730951, above=0.0, help="k_p")
HALF_SPACE = (
    Parameter("share", "", 0.8, above=0.0, most=1.0, help="D1"), Parameter("poisson_ratio", "", 0.45, above=-1.0, most=0.5),
    Parameter("expansion", "1/K", 0.0, help="K_T"), Parameter("heating", "K", 0.0, help="ΔT"),
)  # fmt: skip
POSITION = (
    ("share_depth", "m"), ("surface_depth", "m"), ("alpha", ""), ("surface_factor", ""), ("volume", "m³"),
    ("compression_volume", "m³"), ("heating_volume", "m³"), ("contact_volume", "m³"),
)  # fmt: skip
IMPACT = (("restitution", ""), ("duration", "s"), ("compression_time", "s"), ("depth", "m"), ("peak_force", "N"))


def _impact(values: dict[str, Any]) -> FreeImpact:
    """The impact of the sample's values, which are taken out."""
    take = values.pop
    sphere, material = Sphere(take("mass"), take("radius")), Material(take("storage_modulus"), take("loss_tangent"))
    return solve_impact(sphere, material, take("speed"), take("end"), take("shape"))


def _solved(**values: Any) -> tuple[float, ...]:
    found = _impact(values)
    return found.restitution, found.duration, found.compression_time, found.depth, found.peak_force


def _forces(**values: Any) -> tuple[float, float]:
    depth, rate = values.pop("depth"), values.pop("rate")
    impact = _impact(values)
    return force.elastic_force(impact.elastic, depth), force.viscous_force(impact.viscous, depth, rate)


def _position_1(depth: float, radius: float, rule: str, **half_space: float) -> Position:
    return position_variant_1(depth, radius, SampleHalfSpace(**half_space), rule)


def _position_2(depth: float, radius: float, **half_space: float) -> Position:
    return position_variant_2(depth, radius, SampleHalfSpace(**half_space))


def _contact_ring(**values: Any) -> surface_wave.Ring:
    depth, load, bulk = values.pop("depth"), values.pop("force"), values.pop("bulk_modulus")
    return surface_wave.contact_ring(_impact(values), depth, load, bulk)


def _sine(
    speed: float, mass: float, radius: float, storage_modulus: float, loss_tangent: float, form: str
) -> tuple[float, ...]:
    found = scalings.damped_sine(Sphere(mass, radius), Material(storage_modulus, loss_tangent), speed, form)
    return found.restitution, found.duration, found.compression_time, found.depth, found.peak_force


def _depth_67(speed: float, mass: float, radius: float, storage_modulus: float, restitution: float) -> float:
    return scalings.depth_of_restitution(Sphere(mass, radius), storage_modulus, speed, restitution)


def _duration_71(
    speed: float, mass: float, radius: float, storage_modulus: float, restitution: float, form: str
) -> float:
    return scalings.closed_duration(Sphere(mass, radius), storage_modulus, speed, restitution, form)


def _wave(**values: Any) -> surface_wave.Wave:
    shear, density, poisson = values.pop("shear_modulus"), values.pop("density"), values.pop("poisson_ratio")
    return surface_wave.surface_wave(_impact(values), shear, density, poisson)


def _wave_height(**values: Any) -> Array:
    place, time, form = values.pop("place"), values.pop("time"), values.pop("form")
    return surface_wave.wave_height(_wave(**values), numpy.atleast_1d(place), numpy.atleast_1d(time), form=form)


def _border(**values: Any) -> tuple[float, bool]:
    depth, rate, shear = values.pop("depth"), values.pop("rate"), values.pop("shear_speed")
    return micro_front.border_speed(_impact(values), depth, rate, shear)


def _front(**values: Any) -> tuple[float, bool]:
    depth, rate, shear = values.pop("depth"), values.pop("rate"), values.pop("shear_speed")
    return micro_front.front_speed(_impact(values), depth, rate, shear)


def _front_times(**values: Any) -> tuple[float, float, float]:
    shear = values.pop("shear_speed")
    impact = _impact(values)
    return (
        micro_front.front_time(impact, shear).time, micro_front.front_of_damped_sine(impact, shear),
        micro_front.front_of_small_times(impact, shear).time,
    )  # fmt: skip


def _centre(**values: Any) -> tuple[float, float, float, float, bool]:
    depth, rate, least, shape = (values.pop(name) for name in ("depth", "rate", "limiting_depth", "stress_shape"))
    found = stress.centre_stress(_impact(values), depth, rate, least, shape)
    return found.elastic, found.viscous, found.total, found.amplitude, found.limited


def _distribution(centre: float, places: Array, stress_shape: str) -> Array:
    return stress.distribution(centre, places, stress_shape)


def _retarded(**values: Any) -> tuple[float, float, bool]:
    time, form = values.pop("time"), values.pop("form")
    return stress.retarded_motion(_impact(values), time, form)


def _retarded_stress(**values: Any) -> tuple[float, bool]:
    time, least, shape, form = (values.pop(name) for name in ("time", "limiting_depth", "stress_shape", "form"))
    return stress.retarded_viscous_stress(_impact(values), time, least, shape, form)


_WAVE_KEYS = (
    Parameter("shear_modulus", "Pa", 2.7e6, above=0.0), Parameter("density", "kg/m³", 1100.0, above=0.0),
    Parameter("poisson_ratio", "", 0.49, above=-1.0, most=0.5),
)  # fmt: skip
_PLAIN = SAMPLE[:4]
_RESTITUTION = Parameter("restitution", "", 0.6, above=0.0, most=1.0)

EQUATIONS: tuple[Equation, ...] = (
    Equation("1", "contact radius of a sphere on a plane", "r² = 2 R x − x²", f"{THEORY}.geometry:contact_radius",
             (DEPTH, RADIUS), (("radius", "m"),)),
    Equation("1-spheres", "contact radius of two spheres, exact", "r² = R1² − d1², d1 = (D² + R1² − R2²)/(2 D)",
             f"{THEORY}.geometry:overlap_radius",
             (DEPTH, Parameter("radius_1", "m", 0.01, above=0.0), Parameter("radius_2", "m", 0.01, above=0.0)),
             (("radius", "m"),)),
    Equation("2", "shape factor", "k_p = √(2 − x/R)", f"{THEORY}.geometry:shape_factor", (DEPTH, RADIUS), (("k_p", ""),)),
    Equation("6", "depth of the contact surface over the approach", "k_h = (R − D2 R2)/R2", f"{THEORY}.geometry:depth_factor",
             (RADIUS, Parameter("body_radius", "m", 0.01, above=0.0), Parameter("body_share", "", 0.2, least=0.0, most=1.0,
             help="D2")),
             (("k_h", ""),)),
    Equation("8", "elastic and viscous force (eqs 8, 9)", "F_c = 4/3 k_p E' √R x^1.5, F_b = 4 k_p √R E''/ω ẋ √x",
             f"{THEORY}.closed_form.force:viscous_force", (*SAMPLE, DEPTH, RATE), (("F_c", "N"), ("F_b", "N")), _forces),
    Equation("25", "position of the contact surface, variant 1 (eqs 10-29)", "h_x = x1 √(1 − α_h + K_T ΔT)",
             f"{THEORY}.position:position_variant_1",
             (Parameter("depth", "m", 1.0e-3, above=0.0), RADIUS, Parameter("rule", "", "equal", choices=("equal", "consistent")),
              *HALF_SPACE), POSITION, _position_1),
    Equation("37", "position of the contact surface, variant 2 (eqs 30-40)", "h_x = x1 (1 − α_h + K_T ΔT)",
             f"{THEORY}.position:position_variant_2", (Parameter("depth", "m", 1.0e-3, above=0.0), RADIUS, *HALF_SPACE),
             POSITION, _position_2),
    Equation("41", "velocity of the surface along the normal", "ẋ (1 − r_i²/r²)", f"{THEORY}.stress:normal_velocity",
             (SPEED._replace(above=-numpy.inf), PLACES), (("velocity", "m/s"),)),
    Equation("42", "velocity of the surface along its radius", "ṙ r_i²/r²", f"{THEORY}.stress:radial_velocity",
             (Parameter("border_speed", "m/s", 5.0), PLACES), (("velocity", "m/s"),)),
    Equation("48", "ring of the displaced volume around a contact", "a_k = (K' + p)/(K' − p), r_w = r/2 (√(1 + a_k) − 1)",
             f"{THEORY}.surface_wave:ring",
             (Parameter("radius", "m", 4.5e-3, least=0.0), Parameter("mean_pressure", "Pa", 8.0e5, least=0.0),
              Parameter("bulk_modulus", "Pa", 1.0e9, above=0.0, infinite=True)),
             (("ratio", ""), ("contact_radius", "m"), ("width", "m"), ("front_radius", "m"))),
    Equation("53", "contact ring of an impact at one instant", "eq 48 at p = F/(π r²)",
             f"{THEORY}.surface_wave:contact_ring",
             (*SAMPLE, DEPTH, Parameter("force", "N", 50.0, least=0.0), Parameter("bulk_modulus", "Pa", 1.0e9, above=0.0,
             infinite=True)),
             (("ratio", ""), ("contact_radius", "m"), ("width", "m"), ("front_radius", "m")), _contact_ring),
    Equation("54", "free impact, integrated at its own frequency", "m ẍ + b_x ẋ + c_x x = 0", f"{THEORY}.motion:solve_impact",
             SAMPLE, IMPACT, _solved),
    Equation("58", "damped sine of equal work (eqs 56-60)", "x = V0/ω e^(−δt) sin ωt", f"{THEORY}.closed_form.scalings:damped_sine",
             (*_PLAIN, TAN, FORM), IMPACT, _sine),
    Equation("57", "damping over frequency of the damped sine", "s = c tan β (1 + s²)",
             f"{THEORY}.closed_form.scalings:damping_ratio",
             (TAN, FORM), (("δ/ω", ""),)),
    Equation("66", "restitution of a loss tangent", "k = (π − f tan β)/(π + f tan β)",
             f"{THEORY}.closed_form.scalings:closed_restitution",
             (TAN, Parameter("form", "", "printed", choices=("printed", "mean_speed", "sine"))), (("restitution", ""),)),
    Equation("66-inverse", "loss tangent of a restitution, by the integrated motion", "k(ζ) = k, tan β = π ζ/(3 T_c)",
             f"{THEORY}.closed_form.severity:loss_tangent_of_restitution",
             (_RESTITUTION, Parameter("end", "", "force", choices=("force", "gap"))), (("loss_tangent", ""),)),
    Equation("67", "depth of an impact of known restitution", "x_m = (15 m V0² k/(16 k_p E' √R))^(2/5)",
             f"{THEORY}.closed_form.scalings:depth_of_restitution", (*_PLAIN, _RESTITUTION._replace(above=-numpy.inf, least=0.0)),
             (("depth", "m"),), _depth_67),
    Equation("71", "contact time of known restitution", "τ² = −2 (1+k) ln k/((1−k) V0^(2/5) k^(1/5)) (f m/(k_p E' √R))^(4/5)",
             f"{THEORY}.closed_form.scalings:closed_duration", (*_PLAIN, _RESTITUTION, FORM), (("duration", "s"),), _duration_71),
    Equation("73", "circular surface wave (eqs 72-74)", "λ_w = 2 k_p √(x_m R) (√2 − 1), v_w = λ_w ω/2π",
             f"{THEORY}.surface_wave:surface_wave", (*SAMPLE, *_WAVE_KEYS),
             (("amplitude", "m"), ("length", "m"), ("number", "1/m"), ("frequency", "rad/s"), ("damping", "1/s"), ("speed", "m/s"),
              ("start_time", "s"), ("start_radius", "m"), ("relative_speed", "")), _wave),
    Equation("72", "height of the surface wave", "ξ = x_m e^(−δ(t−τ1)) cos(ω(t−τ1) − k r)",
             f"{THEORY}.surface_wave:wave_height",
             (*SAMPLE, *_WAVE_KEYS, Parameter("place", "m", 6.0e-3, least=0.0), Parameter("time", "s", 2.0e-3, least=0.0), FORM),
             (("height", "m"),), _wave_height),
    Equation("76", "speed of the contact's border", "ṙ = k_p √R ẋ/(2 √x)", f"{THEORY}.micro_front:border_speed",
             (*SAMPLE, DEPTH, RATE, SHEAR), (("speed", "m/s"), ("supersonic", "")), _border),
    Equation("77", "speed of the wave front", "ṙ_AW = (1 + √2)/2 ṙ", f"{THEORY}.micro_front:front_speed",
             (*SAMPLE, DEPTH, RATE, SHEAR), (("speed", "m/s"), ("supersonic", "")), _front),
    Equation("80", "end of the supersonic phase", "ṙ_AW(t_s) = V_s", f"{THEORY}.micro_front:front_time",
             (*SAMPLE, SHEAR), (("integrated", "s"), ("damped_sine", "s"), ("small_times", "s")), _front_times),
    Equation("84", "stress over the contact (eqs 81-86)", "σ_c (1 − ρ²) or σ_c √(1 − ρ²)",
             f"{THEORY}.stress:distribution",
             (Parameter("centre", "Pa", 1.0e6), PLACES, STRESS_SHAPE), (("stress", "Pa"),), _distribution),
    Equation("87", "stress in the centre, and both parts together (eqs 87, 103)", "σ_c = s F_c/(π r²)",
             f"{THEORY}.stress:centre_stress", (*SAMPLE, DEPTH, RATE, LIMITING, STRESS_SHAPE),
             (("elastic", "Pa"), ("viscous", "Pa"), ("sum", "Pa"), ("root of squares", "Pa"), ("limited", "")), _centre),
    Equation("88", "retarded motion and its derivative", "x_σ = V0/ω e^(−δt) sin(ωt(1 − τ_KE/τ_x))",
             f"{THEORY}.stress:retarded_motion", (*SAMPLE, TIME, FORM),
             (("depth", "m"), ("speed", "m/s"), ("defined", "")), _retarded),
    Equation("89", "viscous stress in the centre from the retarded motion", "σ_b = s 4 E'' ẋ_σ/(π ω k_p √R √x_σ)",
             f"{THEORY}.stress:retarded_viscous_stress", (*SAMPLE, TIME, LIMITING, STRESS_SHAPE, FORM),
             (("stress", "Pa"), ("defined", "")), _retarded_stress),
    *MATERIAL_EQUATIONS,
)  # fmt: skip
