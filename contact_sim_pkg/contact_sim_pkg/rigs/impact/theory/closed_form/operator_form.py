"""Linear viscoelasticity in operator form, ``P(D) sigma = Q(D) eps`` with polynomials in ``D =
d/dt`` (Goloshchapov eqs 124, 125).

n = 0 is Hooke; Kelvin-Voigt is P = 1, Q = E + eta D; Maxwell P = 1 + tau D, Q = E tau D. In
harmonic motion ``E* = Q(i w)/P(i w)``. Moduli [Pa], viscosities [Pa s] and times [s] are above 0;
other values raise ImpactError.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = ["Operators", "hooke", "kelvin_voigt", "maxwell", "modulus_at", "standard_solid"]


class Operators(NamedTuple):
    """Coefficients by rising order of D."""

    stress: tuple[float, ...]  # of P [s^k]
    strain: tuple[float, ...]  # of Q [Pa s^k]


def hooke(modulus: float) -> Operators:
    """``sigma = E eps``.

    modulus: [Pa].
    """
    check_positive("modulus", modulus, "Pa")
    return Operators((1.0,), (modulus,))


def kelvin_voigt(modulus: float, viscosity: float) -> Operators:
    """``sigma = (E + eta D) eps``.

    modulus: [Pa]; viscosity: [Pa s].
    """
    check_positive("modulus", modulus, "Pa")
    check_positive("viscosity", viscosity, "Pa s")
    return Operators((1.0,), (modulus, viscosity))


def maxwell(modulus: float, relaxation_time: float) -> Operators:
    """``(1 + tau D) sigma = E tau D eps``.

    modulus: [Pa]; relaxation_time: [s].
    """
    check_positive("modulus", modulus, "Pa")
    check_positive("relaxation time", relaxation_time, "s")
    return Operators((1.0, relaxation_time), (0.0, modulus * relaxation_time))


def standard_solid(glassy_modulus: float, delayed_modulus: float, retardation_time: float) -> Operators:
    """A spring E0 in series with a Kelvin-Voigt element E1, tau: ``(E0 + E1 + E1 tau D) sigma = E0
    E1 (1 + tau D) eps``.

    Moduli: [Pa]; retardation_time: [s].
    """
    check_positive("glassy modulus", glassy_modulus, "Pa")
    check_positive("delayed modulus", delayed_modulus, "Pa")
    check_positive("retardation time", retardation_time, "s")
    both = glassy_modulus * delayed_modulus
    return Operators(
        (glassy_modulus + delayed_modulus, delayed_modulus * retardation_time), (both, both * retardation_time)
    )


def modulus_at(operators: Operators, frequency: float) -> complex:
    """``E* = Q(i w)/P(i w)`` in [Pa] at ``frequency`` w >= 0 [rad/s]. Raises ImpactError where P(i
    w) is 0.
    """
    check_not_negative("frequency", frequency, "rad/s")
    for name, coefficients in zip(("stress", "strain"), operators, strict=True):
        check_values(f"operator of the {name}", coefficients, shape=(None,))
    stress, strain = _value(operators.stress, frequency), _value(operators.strain, frequency)
    if stress == 0.0:
        raise ImpactError(f"frequency {frequency:g} rad/s: the operator of the stress is zero there")
    return strain / stress


def _value(coefficients: tuple[float, ...], frequency: float) -> complex:
    total = 0.0 + 0.0j
    for coefficient in reversed(coefficients):
        total = total * (1.0j * frequency) + coefficient
    return total
