"""Shear creep compliance of the usual models, ``J(t) = j0 + t/eta + sum j_i (1 - e^(-t/tau_i))``;
elastic limit 1/G.

Maxwell: ``1/G + t/eta``. Kelvin-Voigt: ``(1 - e^(-t/tau))/G``. Standard solid: ``1/G0 + (1 -
e^(-t/tau))/G1`` (Goloshchapov below eq 113).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "Creep",
    "complex_compliance",
    "compliance",
    "kelvin_voigt",
    "maxwell",
    "standard_solid",
    "standard_solid_at",
]


class Creep(NamedTuple):
    """Parameters of J(t)."""

    glassy: float  # j0 [1/Pa], >= 0
    fluidity: float  # 1/eta [1/(Pa s)], >= 0
    compliances: tuple[float, ...]  # j_i [1/Pa], >= 0
    times: tuple[float, ...]  # tau_i [s], > 0


def maxwell(shear_modulus: float, viscosity: float) -> Creep:
    """Spring and dashpot in series; G > 0 [Pa], eta > 0 [Pa s], which may be infinite; raises
    ImpactError otherwise.
    """
    check_positive("shear modulus", shear_modulus, "Pa")
    check_number("viscosity", viscosity, "Pa s", above=0.0, infinite=True)
    return Creep(1.0 / shear_modulus, 1.0 / viscosity, (), ())


def kelvin_voigt(shear_modulus: float, retardation_time: float) -> Creep:
    """Spring and dashpot side by side; G > 0 [Pa], tau > 0 [s]; raises ImpactError otherwise."""
    check_positive("shear modulus", shear_modulus, "Pa")
    check_positive("retardation time", retardation_time, "s")
    return Creep(0.0, 0.0, (1.0 / shear_modulus,), (float(retardation_time),))


def standard_solid(glassy_modulus: float, delayed_modulus: float, retardation_time: float) -> Creep:
    """A spring G0 [Pa] in series with a Kelvin-Voigt element G1 [Pa], tau [s]; all > 0, raises
    ImpactError otherwise.
    """
    check_positive("glassy modulus", glassy_modulus, "Pa")
    return kelvin_voigt(delayed_modulus, retardation_time)._replace(glassy=1.0 / glassy_modulus)


def standard_solid_at(storage_modulus: float, loss_tangent: float, frequency: float, instant_ratio: float) -> Creep:
    """The standard solid of complex shear modulus ``G' (1 + i tan(beta))`` at a frequency w, with
    the instantaneous modulus ``G0 = r G' (1 + tan^2(beta))``.

    ``J* = (1 - i tan(beta))/(G' (1 + tan^2(beta))) = 1/G0 + 1/(G1 (1 + i w tau))`` gives G1 and
    ``w tau = tan(beta)/(1 - 1/r)``. r to 1 is Maxwell's model, a large r Kelvin and Voigt's.

    G' [Pa], tan(beta) [1], w [rad/s] above 0, r above 1; raises ImpactError otherwise. Source:
    Ferry, Viscoelastic Properties of Polymers, 3.
    """
    check_positive("storage modulus", storage_modulus, "Pa")
    check_positive("loss tangent", loss_tangent)
    check_positive("frequency", frequency, "rad/s")
    check_number("instant ratio", instant_ratio, above=1.0)
    stiff = storage_modulus * (1.0 + loss_tangent**2)
    share = 1.0 - 1.0 / instant_ratio
    lag = loss_tangent / share
    return standard_solid(instant_ratio * stiff, stiff / (share * (1.0 + lag**2)), lag / frequency)


def compliance(creep: Creep, times: Vector) -> Vector:
    """J [times] [1/Pa] at ``times`` >= 0 [s].

    Raises ImpactError for other times, and for parameters that stand for no material.
    """
    check(creep)
    t = check_values("times", times, "s", least=0.0)
    total = creep.glassy + creep.fluidity * t
    for part, tau in zip(creep.compliances, creep.times, strict=True):
        total = total - part * numpy.expm1(-t / tau)
    return total


def complex_compliance(creep: Creep, frequency: float) -> complex:
    """``J*(w) = j0 + 1/(i w eta) + sum j_i/(1 + i w tau_i)`` in [1/Pa].

    The complex shear modulus is its reciprocal. w > 0 [rad/s].
    """
    check(creep)
    check_positive("frequency", frequency, "rad/s")
    delayed = sum(
        part / (1.0 + 1.0j * frequency * tau) for part, tau in zip(creep.compliances, creep.times, strict=True)
    )
    return creep.glassy - 1.0j * creep.fluidity / frequency + delayed


def check(creep: Creep) -> None:
    """Raises ImpactError for parameters that stand for no material."""
    check_not_negative("glassy compliance", creep.glassy, "1/Pa")
    check_not_negative("fluidity", creep.fluidity, "1/(Pa s)")
    if len(creep.compliances) != len(creep.times):
        raise ImpactError(
            f"{len(creep.compliances)} delayed compliances and {len(creep.times)} times: as many are needed"
        )
    for part, tau in zip(creep.compliances, creep.times, strict=True):
        check_not_negative("delayed compliance", part, "1/Pa")
        check_positive("retardation time", tau, "s")
    if math.fsum((creep.glassy, creep.fluidity, *creep.compliances)) == 0.0:
        raise ImpactError("a compliance of zero: a rigid half-space has no indentation")
