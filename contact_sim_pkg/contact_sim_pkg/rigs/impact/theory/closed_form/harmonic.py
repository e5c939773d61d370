"""Steady harmonic motion: complex modulus and complex stress (Goloshchapov eqs 90-102, corrected).

``sigma* = sigma_0 e^(i w t)``, ``eps* = eps_0 e^(i (w t - beta))``, ``E* = sigma*/eps* = E' + i
E''``, ``tan(beta) = E''/E'``. Parts of sigma*: ``sigma' = eps_0 (E' cos(a) - E'' sin(a))``,
``sigma'' = eps_0 (E' sin(a) + E'' cos(a))``, a = w t - beta. As printed (eqs 96, 98, 100) sigma'
has a plus, which makes it ``sigma_0 cos(w t - 2 beta)`` in place of ``sigma_0 cos(w t)``.
"""

from __future__ import annotations

import cmath
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.bodies import Material
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_number, check_positive, check_values

__all__ = ["ComplexStress", "complex_modulus", "complex_stress", "material_of_amplitudes"]


class ComplexStress(NamedTuple):
    """Parts of the complex stress at given times, in [Pa]."""

    elastic: Vector  # sigma', real part
    viscous: Vector  # sigma'', imaginary part


def complex_modulus(material: Material) -> complex:
    """``E* = E' + i E''`` in [Pa]. Raises ImpactError for E' not above 0 and a loss tangent below
    0.
    """
    check_fields("material", material, positive="storage_modulus", not_negative="loss_tangent")
    return complex(material.storage_modulus, material.loss_modulus)


def material_of_amplitudes(stress: float, strain: float, phase: float) -> Material:
    """E' and tan(beta) from the amplitudes of stress [Pa] and strain and the phase beta [rad], 0 to
    below pi/2 (eqs 91-93).

    Amplitudes > 0; raises ImpactError otherwise.
    """
    check_positive("amplitude of the stress", stress, "Pa")
    check_positive("amplitude of the strain", strain)
    modulus = cmath.rect(stress / strain, check_number("phase", phase, "rad", least=0.0, below=0.5 * cmath.pi))
    return Material(modulus.real, modulus.imag / modulus.real)


def complex_stress(
    material: Material, strain: float, frequency: float, times: Vector, form: str = "corrected"
) -> ComplexStress:
    """Elastic and viscous stress [Pa], [times], at ``times`` [s].

    ``strain``: amplitude [1]; ``frequency``: above 0 [rad/s]. No cotangent, so a material without
    loss is no pole. Raises ImpactError for a material, amplitude, frequency or times outside their
    range, ValueError for another form.
    """
    check_positive("amplitude of the strain", strain)
    check_positive("frequency", frequency, "rad/s")
    if form not in ("corrected", "printed"):
        raise ValueError(f"form '{form}': corrected or printed is needed")
    # Stress leads strain by the phase of the complex modulus.
    phase = cmath.phase(complex_modulus(material))
    angle = frequency * check_values("times", times, "s") - phase
    storage, loss = material.storage_modulus, material.loss_modulus
    sign = -1.0 if form == "corrected" else 1.0
    elastic = strain * (storage * numpy.cos(angle) + sign * loss * numpy.sin(angle))
    return ComplexStress(elastic, strain * (storage * numpy.sin(angle) + loss * numpy.cos(angle)))
