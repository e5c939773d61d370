"""Steady harmonic motion: complex modulus and complex stress (Goloshchapov eqs 90-102, corrected).

``sigma* = sigma_0 e^(i w t)``, ``eps* = eps_0 e^(i (w t - beta))``, ``E* = sigma*/eps* = E' + i E''``, ``tan(beta) = E''/E'``.
Parts of sigma*: ``sigma' = eps_0 (E' cos(a) - E'' sin(a))``, ``sigma'' = eps_0 (E' sin(a) + E'' cos(a))``, a = w t - beta. As
printed (eqs 96, 98, 100) sigma' has a plus, which makes it ``sigma_0 cos(w t - 2 beta)`` in place of ``sigma_0 cos(w t)``.
"""

from __future__ import annotations

import cmath
from typing import NamedTuple

import numpy

from ..parameters import Vector
from .bodies import Material

__all__ = ["ComplexStress", "complex_modulus", "complex_stress", "material_of_amplitudes"]


class ComplexStress(NamedTuple):
    """Parts of the complex stress at given times, in [Pa]."""

    elastic: Vector  # sigma', real part
    viscous: Vector  # sigma'', imaginary part


def complex_modulus(material: Material) -> complex:
    """``E* = E' + i E''`` in [Pa]."""
    return complex(material.storage_modulus, material.loss_modulus)


def material_of_amplitudes(stress: float, strain: float, phase: float) -> Material:
    """E' and tan(beta) from the amplitudes of stress [Pa] and strain and the phase beta [rad], 0 to below pi/2 (eqs 91-93)."""
    modulus = cmath.rect(stress / strain, phase)
    return Material(modulus.real, modulus.imag / modulus.real)


def complex_stress(
    material: Material, strain: float, frequency: float, times: Vector, form: str = "corrected"
) -> ComplexStress:
    """Both parts at ``times`` [s], for the amplitude ``strain`` and ``frequency`` [rad/s]; no cotangent, so no loss is no pole."""
    if form not in ("corrected", "printed"):
        raise ValueError(f"form '{form}': corrected or printed is needed")
    phase = cmath.phase(complex_modulus(material))
    angle = frequency * numpy.asarray(times) - phase
    storage, loss = material.storage_modulus, material.loss_modulus
    sign = -1.0 if form == "corrected" else 1.0
    elastic = strain * (storage * numpy.cos(angle) + sign * loss * numpy.sin(angle))
    return ComplexStress(elastic, strain * (storage * numpy.sin(angle) + loss * numpy.cos(angle)))
