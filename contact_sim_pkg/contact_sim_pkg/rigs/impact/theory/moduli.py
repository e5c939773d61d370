"""Relations of the moduli and viscosities of an isotropic material, real or complex (Goloshchapov
eqs 119-123 and below).

``E = 3 K (1 - 2 nu) = 2 G (1 + nu) = 9 G K/(G + 3 K)``. They hold for complex values as a whole:
part by part (eqs 119, 120) only for a real nu that does not change with frequency. nu = 1/2 is
allowed where 1 - 2 nu does not divide.

Moduli in [Pa] have a real part above 0 (a bulk modulus may be infinite), nu one above -1, at most
1/2 where it is real. Other values raise ImpactError.
"""

from __future__ import annotations

import math
from typing import TypeVar

from contact_sim_pkg.rigs.impact.theory.checks import check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "bulk_modulus",
    "dynamic_viscosities",
    "poisson_ratio",
    "shear_modulus",
    "young_modulus",
]

Number = TypeVar("Number", float, complex)


def shear_modulus(young: Number, poisson: Number) -> Number:
    """``G = E/(2 (1 + nu))``."""
    _check_modulus("Young's modulus", young)
    _check_ratio(poisson)
    return young / (2.0 * (1.0 + poisson))


def bulk_modulus(young: Number, poisson: Number) -> Number:
    """``K = E/(3 (1 - 2 nu))``; raises ImpactError for nu = 1/2, where it has no bound."""
    _check_modulus("Young's modulus", young)
    _check_ratio(poisson)
    if poisson == 0.5:
        raise ImpactError("Poisson ratio 0.5: the bulk modulus has no bound; take 0.499, or a formula without it")
    return young / (3.0 * (1.0 - 2.0 * poisson))


def young_modulus(shear: Number, bulk: Number) -> Number:
    """``E = 9 G K/(G + 3 K)``; 3 G for an infinite K."""
    _check_modulus("shear modulus", shear)
    _check_modulus("bulk modulus", bulk, infinite=True)
    return 3.0 * shear / (1.0 + shear / (3.0 * bulk))


def poisson_ratio(shear: Number, bulk: Number) -> Number:
    """``nu = (3 K - 2 G)/(2 (3 K + G))``; 1/2 for an infinite K."""
    _check_modulus("shear modulus", shear)
    _check_modulus("bulk modulus", bulk, infinite=True)
    ratio = shear / bulk
    return (3.0 - 2.0 * ratio) / (2.0 * (3.0 + ratio))


def dynamic_viscosities(modulus: complex, frequency: float) -> tuple[float, float]:
    """``eta' = E''/w`` and ``eta'' = E'/w`` in [Pa s] of a complex modulus [Pa] at ``frequency``
    [rad/s] (eq 121).
    """
    check_positive("frequency", frequency, "rad/s")
    if not (math.isfinite(modulus.real) and math.isfinite(modulus.imag)):
        raise ImpactError(f"modulus {modulus}: a finite one is needed")
    return modulus.imag / frequency, modulus.real / frequency


def _check_modulus(name: str, value: complex | float, *, infinite: bool = False) -> None:
    check_number(f"imaginary part of the {name}", value.imag, "Pa")
    check_number(name, value.real, "Pa", above=0.0, infinite=infinite)


def _check_ratio(value: complex | float) -> None:
    check_number("imaginary part of the Poisson ratio", value.imag)
    check_number("Poisson ratio", value.real, above=-1.0, most=0.5 if value.imag == 0.0 else math.inf)
