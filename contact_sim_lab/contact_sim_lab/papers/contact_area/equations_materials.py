"""Equations 90 to 125 of *Contact Area*: complex modulus, shift, hereditary integral, relations."""

from __future__ import annotations

from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.paper import Equation, Parameter
from contact_sim_pkg.rigs.impact.theory import moduli, shift
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form import harmonic, operator_form
from contact_sim_pkg.rigs.impact.theory.inverse import material_of_impact
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep, hereditary

__all__ = ["MATERIAL_EQUATIONS"]

Array = NDArray[numpy.float64]
THEORY = "contact_sim_pkg.rigs.impact.theory"

TAN = Parameter("loss_tangent", "", 0.2, least=0.0)
STORAGE = Parameter("storage_modulus", "Pa", 8.0e6, above=0.0)
LOSS_MODULUS = Parameter("loss_modulus", "Pa", 1.6e6, least=0.0)
FREQUENCY = Parameter("frequency", "rad/s", 1750.0, above=0.0)
GLASS = Parameter("glass_temperature", "K", 223.0, above=0.0, help="Tg, of Arrhenius the reference")
TEMPERATURE = Parameter("temperature", "K", 293.0, above=0.0)
LAW = Parameter("law", "", "wlf", choices=("wlf", "arrhenius"))
CONSTANTS = (
    Parameter("c1", "", 17.44, above=0.0), Parameter("c2", "K", 51.6, above=0.0),
    Parameter("activation_energy", "J/mol", 1.0e5, above=0.0),
)  # fmt: skip
CREEP = (
    Parameter("model", "", "maxwell", choices=("maxwell", "kelvin_voigt", "standard_solid")),
    Parameter("modulus", "Pa", 2.7e6, above=0.0, help="G, or G0 of the standard solid"),
    Parameter("viscosity", "Pa s", 1.0e4, above=0.0, help="of maxwell"),
    Parameter("delayed_modulus", "Pa", 5.0e6, above=0.0, help="G1 of the standard solid"),
    Parameter("retardation_time", "s", 1.0e-3, above=0.0, help="of the other two"),
)  # fmt: skip


def _complex_stress(
    storage_modulus: float, loss_tangent: float, strain: float, frequency: float, times: Array, form: str
) -> Any:
    return harmonic.complex_stress(Material(storage_modulus, loss_tangent), strain, frequency, times, form)


def _complex_modulus(storage_modulus: float, loss_tangent: float) -> complex:
    return harmonic.complex_modulus(Material(storage_modulus, loss_tangent))


def _shift(law: str, glass_temperature: float, c1: float, c2: float, activation_energy: float) -> shift.Shift:
    return (
        shift.Wlf(glass_temperature, c1, c2) if law == "wlf" else shift.Arrhenius(glass_temperature, activation_energy)
    )


def _log_shift(temperature: float, **law: Any) -> float:
    return shift.log_shift(_shift(**law), temperature)


def _carried(temperature: float, speed: float, table_speed: float, duration: float, **law: Any) -> tuple[float, float]:
    return (
        shift.equivalent_temperature(_shift(**law), temperature, speed, table_speed),
        shift.carried_duration(duration, speed, table_speed),
    )


def _material(
    mass: float, radius: float, speed: float, duration: float, restitution: float, end: str, form: str
) -> Material:
    return material_of_impact(Sphere(mass, radius), speed, duration, restitution, end, form)


def _creep(
    model: str, modulus: float, viscosity: float, delayed_modulus: float, retardation_time: float
) -> creep.Creep:
    if model == "maxwell":
        return creep.maxwell(modulus, viscosity)
    if model == "kelvin_voigt":
        return creep.kelvin_voigt(modulus, retardation_time)
    return creep.standard_solid(modulus, delayed_modulus, retardation_time)


def _indentation(
    times: Array, force: Array, radius: float, poisson_ratio: float, form: str, **model: Any
) -> hereditary.Indentation:
    return hereditary.indentation(_creep(**model), times, force, radius, poisson_ratio, form)


def _compliance(times: Array, frequency: float, **model: Any) -> tuple[Array, complex]:
    made = _creep(**model)
    return creep.compliance(made, times), creep.complex_compliance(made, frequency)


def _elastic_moduli(young: float, poisson: float) -> tuple[float, float]:
    return moduli.shear_modulus(young, poisson), moduli.bulk_modulus(young, poisson)


def _young_of(shear: float, bulk: float) -> tuple[float, float]:
    return moduli.young_modulus(shear, bulk), moduli.poisson_ratio(shear, bulk)


def _complex_moduli(storage_modulus: float, loss_modulus: float, poisson: float) -> tuple[complex, complex]:
    young = complex(storage_modulus, loss_modulus)
    return moduli.shear_modulus(young, complex(poisson)), moduli.bulk_modulus(young, complex(poisson))


def _viscosities(storage_modulus: float, loss_modulus: float, frequency: float) -> tuple[float, float]:
    return moduli.dynamic_viscosities(complex(storage_modulus, loss_modulus), frequency)


def _operator(
    model: str, modulus: float, viscosity: float, delayed_modulus: float, time: float, frequency: float
) -> complex:
    made = {
        "hooke": lambda: operator_form.hooke(modulus), "kelvin_voigt": lambda: operator_form.kelvin_voigt(modulus, viscosity),
        "maxwell": lambda: operator_form.maxwell(modulus, time),
        "standard_solid": lambda: operator_form.standard_solid(modulus, delayed_modulus, time),
    }[model]()  # fmt: skip
    return operator_form.modulus_at(made, frequency)


_E = (("E'", "Pa"), ("tan β", ""))
MATERIAL_EQUATIONS: tuple[Equation, ...] = (
    Equation("90", "complex modulus", "E* = E' (1 + i tan β)", f"{THEORY}.closed_form.harmonic:complex_modulus", (STORAGE, TAN),
             (("E' and E''", "Pa"),), _complex_modulus),
    Equation("93", "material of the amplitudes of stress and strain (eqs 91-93)", "E' = σ0/ε0 cos β, E'' = σ0/ε0 sin β",
             f"{THEORY}.closed_form.harmonic:material_of_amplitudes",
             (Parameter("stress", "Pa", 8.0e5, above=0.0), Parameter("strain", "", 0.1, above=0.0),
              Parameter("phase", "rad", 0.2, least=0.0, below=1.5707963267948966)), _E),
    Equation("96", "elastic and viscous stress in harmonic motion (eqs 94-102)", "σ' = ε0 E' [cos(ωt−β) − tan β sin(ωt−β)]",
             f"{THEORY}.closed_form.harmonic:complex_stress",
             (STORAGE, TAN, Parameter("strain", "", 0.1, above=0.0), FREQUENCY, Parameter("times", "s", (0.0, 4.0e-4, 8.0e-4)),
              Parameter("form", "", "corrected", choices=("corrected", "printed"))),
             (("elastic", "Pa"), ("viscous", "Pa")), _complex_stress),
    Equation("104", "material of a measured impact (eqs 104, 105)", "E' = h(k) m/(√(V0 R) τ^2.5), tan β = g(k)",
             f"{THEORY}.inverse:material_of_impact",
             (Parameter("mass", "kg", 0.02, above=0.0), Parameter("radius", "m", 0.01, above=0.0), Parameter("speed", "m/s",
             2.0, above=0.0),
              Parameter("duration", "s", 1.0e-3, above=0.0), Parameter("restitution", "", 0.7, above=0.0, most=1.0),
              Parameter("end", "", "force", choices=("force", "gap")),
              Parameter("form", "", "exact", choices=("exact", "corrected", "printed"))), _E, _material),
    Equation("106", "time-temperature shift (eqs 106, 107)", "lg a_T = −C1 (T − Tg)/(C2 + T − Tg)", f"{THEORY}.shift:log_shift",
             (TEMPERATURE, LAW, GLASS, *CONSTANTS), (("lg a_T", ""),), _log_shift),
    Equation("107", "temperature of the same state at another speed, and its contact time",
             "V a_T(T) = V1 a_T(T*), τ (V/V1)^(−1/5)",
             f"{THEORY}.shift:carried_duration",
             (TEMPERATURE, Parameter("speed", "m/s", 100.0, above=0.0), Parameter("table_speed", "m/s", 2.0, above=0.0),
              Parameter("duration", "s", 1.8e-3, above=0.0), LAW, GLASS, *CONSTANTS),
             (("T*", "K"), ("contact time", "s")), _carried),
    Equation("112", "depth under a force by the hereditary integral (eqs 108-113)", "x^1.5 = 3(1−ν)/(8√R) ∫ J(t−s) dF(s)",
             f"{THEORY}.viscoelastic.hereditary:indentation",
             (*CREEP, Parameter("times", "s", (0.0, 1.0e-3, 2.0e-3)), Parameter("force", "N", (0.0, 10.0, 20.0)),
              Parameter("radius", "m", 0.01, above=0.0), Parameter("poisson_ratio", "", 0.5, above=-1.0, most=0.5),
              Parameter("form", "", "corrected", choices=("corrected", "printed"))),
             (("depth", "m"), ("growing", "")), _indentation),
    Equation("113", "creep compliance, in time and complex", "J = 1/G + t/η; (1 − e^(−t/τ))/G",
             f"{THEORY}.viscoelastic.creep:compliance",
             (*CREEP, Parameter("times", "s", (0.0, 1.0e-3, 2.0e-3), least=0.0), FREQUENCY), (("J", "1/Pa"), ("J*", "1/Pa")),
             _compliance),
    Equation("114", "relaxation time of a Maxwell element", "τ_ME = 1/(ω tan β)", f"{THEORY}.viscoelastic.relaxation:maxwell_time",
             (FREQUENCY, TAN), (("time", "s"),)),
    Equation("115", "retardation time of a Kelvin-Voigt element", "τ_KE = tan β/ω",
             f"{THEORY}.viscoelastic.relaxation:retardation_time",
             (FREQUENCY, TAN), (("time", "s"),)),
    Equation("116", "retardation time of an impact", "τ_KE = τ tan β/π",
             f"{THEORY}.viscoelastic.relaxation:retardation_time_of_impact",
             (Parameter("duration", "s", 1.8e-3, above=0.0), TAN), (("time", "s"),)),
    Equation("117", "decay time of a damped oscillation", "τ_ω = 1/δ", f"{THEORY}.viscoelastic.relaxation:decay_time",
             (Parameter("damping", "1/s", 300.0, above=0.0),), (("time", "s"),)),
    Equation("118", "retardation time of a decay", "τ_KE = τ_ω tan β/√((ω0 τ_ω)² − 1)",
             f"{THEORY}.viscoelastic.relaxation:retardation_time_of_decay",
             (Parameter("decay", "s", 3.0e-3, above=0.0), TAN, Parameter("natural_frequency", "rad/s", 1750.0, above=0.0),
              Parameter("form", "", "corrected", choices=("corrected", "printed"))), (("time", "s"),)),
    Equation("119", "shear and bulk modulus of E and ν", "E = 3K(1 − 2ν) = 2G(1 + ν)", f"{THEORY}.moduli:bulk_modulus",
             (Parameter("young", "Pa", 8.0e6, above=0.0), Parameter("poisson", "", 0.45, above=-1.0, below=0.5)),
             (("G", "Pa"), ("K", "Pa")), _elastic_moduli),
    Equation("120", "complex shear and bulk modulus", "G* = E*/(2(1 + ν)), K* = E*/(3(1 − 2ν))", f"{THEORY}.moduli:shear_modulus",
             (STORAGE, LOSS_MODULUS, Parameter("poisson", "", 0.45, above=-1.0, below=0.5)), (("G*", "Pa"), ("K*", "Pa")),
             _complex_moduli),
    Equation("121", "dynamic viscosities", "η' = E''/ω, η'' = E'/ω", f"{THEORY}.moduli:dynamic_viscosities",
             (STORAGE, LOSS_MODULUS, FREQUENCY), (("η'", "Pa s"), ("η''", "Pa s")), _viscosities),
    Equation("122", "E and ν of shear and bulk modulus", "E = 9GK/(G + 3K)", f"{THEORY}.moduli:young_modulus",
             (Parameter("shear", "Pa", 2.7e6, above=0.0), Parameter("bulk", "Pa", 2.7e7, above=0.0, infinite=True)),
             (("E", "Pa"), ("ν", "")), _young_of),
    Equation("124", "complex modulus of the operator form (eqs 124, 125)", "P(D) σ = Q(D) ε, E* = Q(iω)/P(iω)",
             f"{THEORY}.closed_form.operator_form:modulus_at",
             (Parameter("model", "", "kelvin_voigt", choices=("hooke", "kelvin_voigt", "maxwell", "standard_solid")),
              Parameter("modulus", "Pa", 8.0e6, above=0.0), Parameter("viscosity", "Pa s", 900.0, above=0.0,
              help="of kelvin_voigt"),
              Parameter("delayed_modulus", "Pa", 8.0e6, above=0.0, help="of standard_solid"),
              Parameter("time", "s", 1.0e-3, above=0.0, help="of maxwell and standard_solid"),
              Parameter("frequency", "rad/s", 1750.0, least=0.0)),
             (("E' and E''", "Pa"),), _operator),
)  # fmt: skip
