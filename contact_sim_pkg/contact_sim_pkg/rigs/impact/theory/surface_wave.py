"""Circular surface wave around the contact: ring, length, phase speed, height in place and time
(Goloshchapov eqs 43-53, 72-74).

Ring: ``S_w = a_k S_x``, ``a_k = (K' + p)/(K' - p)`` with the mean pressure p (eq 48 corrected),
``r_w = r/2 (sqrt(1 + a_k) - 1)``, front ``r_AW = r + r_w``. Wave: ``xi = x_m e^(-delta (t - tau_1))
cos(w (t - tau_1) - k r)`` for t >= tau_1, ``lambda = 2 (sqrt 2 - 1) k_p sqrt(x_m R)``, ``v = lambda
w/2 pi``. Its speed is geometry: a forced near field, so the ratio to the Rayleigh wave is reported
with it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.checks import (
    check_not_negative,
    check_number,
    check_poisson_ratio,
    check_positive,
    check_values,
)
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import contact_radius
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact

__all__ = ["Ring", "Wave", "rayleigh_speed", "ring", "shear_speed", "surface_wave", "wave_height"]

SPREADS = ("none", "cylindrical")
STIFF = 1.0  # a_k of a half-space that is hardly compressed


class Ring(NamedTuple):
    """The ring that the displaced volume lifts around the contact, in [m]."""

    ratio: float  # a_k
    contact_radius: float  # r
    width: float  # r_w
    front_radius: float  # r_AW


class Wave(NamedTuple):
    """The circular wave of one impact, in SI units."""

    amplitude: float  # x_m [m]
    length: float  # lambda [m]
    number: float  # k [1/m]
    frequency: float  # w [rad/s]
    damping: float  # delta [1/s]
    speed: float  # v [m/s], phase speed
    start_time: float  # tau_1 [s]
    start_radius: float  # r_AW at tau_1 [m]
    relative_speed: float  # over the Rayleigh wave's


def ring(radius: float, mean_pressure: float, bulk_modulus: float) -> Ring:
    """Ring around a contact of ``radius`` r [m] at ``mean_pressure`` p = F/(pi r^2) [Pa];
    ``bulk_modulus`` K' may be infinite.

    Raises ImpactError for p >= K', where the ratio has no meaning, and for p or r below 0.
    """
    check_not_negative("mean pressure", mean_pressure, "Pa")
    check_not_negative("contact radius", radius, "m")
    check_number("bulk modulus", bulk_modulus, "Pa", above=0.0, infinite=True)
    if not bulk_modulus > mean_pressure:
        raise ImpactError(
            f"mean pressure {mean_pressure:.4g} Pa: the ring's continuity needs less than the bulk modulus {bulk_modulus:.4g} Pa"
        )
    part = mean_pressure / bulk_modulus
    ratio = (1.0 + part) / (1.0 - part)
    width = 0.5 * radius * (math.sqrt(1.0 + ratio) - 1.0)
    return Ring(ratio, radius, width, radius + width)


def surface_wave(impact: FreeImpact, shear_modulus: float, density: float, poisson_ratio: float) -> Wave:
    """The wave that an impact leaves (eqs 72-74); the half-space's G' [Pa], density [kg/m^3] and nu
    give the Rayleigh speed.

    Errors as `rayleigh_speed`.
    """
    radius = impact.shape * math.sqrt(impact.depth * impact.sphere.radius)
    length = 2.0 * (math.sqrt(2.0) - 1.0) * radius
    speed = length * impact.frequency / (2.0 * math.pi)
    rayleigh = rayleigh_speed(shear_modulus, density, poisson_ratio)
    # Radius at which the wave starts.
    front = radius + 0.5 * radius * (math.sqrt(1.0 + STIFF) - 1.0)
    return Wave(
        amplitude=impact.depth,
        length=length,
        number=2.0 * math.pi / length,
        frequency=impact.frequency,
        damping=impact.damping,
        speed=speed,
        start_time=impact.compression_time,
        start_radius=front,
        relative_speed=speed / rayleigh,
    )


def wave_height(wave: Wave, radii: Vector, times: Vector, spread: str = "none", form: str = "corrected") -> Vector:
    """xi [times, radii] in [m] at distances ``radii`` [m] from the impact's centre and ``times``
    [s] from first touch.

    0 before tau_1 and ahead of ``r_AW + v (t - tau_1)``. ``spread`` `cylindrical`: amplitude times
    sqrt(r_AW/r) outside r_AW. ``printed``: decay from first touch on, so that the wave starts below
    x_m. Raises ImpactError for distances below 0 and values that are not finite, ValueError for
    another spread or form.
    """
    if spread not in SPREADS:
        raise ValueError(f"spread '{spread}': none or cylindrical is needed")
    if form not in ("corrected", "printed"):
        raise ValueError(f"form '{form}': corrected or printed is needed")
    r = check_values("radii", radii, "m", shape=(None,), least=0.0)[numpy.newaxis, :]
    since = check_values("times", times, "s", shape=(None,))[:, numpy.newaxis] - wave.start_time
    # The wave is behind its front, and decays from its start.
    reached = (since >= 0.0) & (r <= wave.start_radius + wave.speed * since)
    waited = numpy.maximum(since, 0.0)
    decay = numpy.exp(-wave.damping * (waited + (wave.start_time if form == "printed" else 0.0)))
    height = wave.amplitude * decay * numpy.cos(wave.frequency * waited - wave.number * r)
    if spread == "cylindrical":
        height = height * numpy.sqrt(wave.start_radius / numpy.maximum(r, wave.start_radius))
    return numpy.where(reached, height, 0.0)


def contact_ring(impact: FreeImpact, depth: float, force: float, bulk_modulus: float) -> Ring:
    """Ring at one instant of an impact, from its depth [m] and total force [N]."""
    radius = contact_radius(depth, impact.sphere.radius)
    return ring(radius, max(force, 0.0) / (math.pi * radius**2) if radius > 0.0 else 0.0, bulk_modulus)


def shear_speed(shear_modulus: float, density: float) -> float:
    """``V_s = sqrt(G'/rho)`` in [m/s]; both above 0, else ImpactError."""
    return math.sqrt(
        check_positive("shear modulus", shear_modulus, "Pa") / check_positive("density", density, "kg/m^3")
    )


def rayleigh_speed(shear_modulus: float, density: float, poisson_ratio: float) -> float:
    """Speed of the free surface wave in [m/s]: root of Rayleigh's cubic in ``(c/V_s)^2`` (Johnson
    1985, 11.1).

    G' > 0 [Pa], density > 0 [kg/m^3], -1 < nu <= 1/2; raises ImpactError otherwise.
    """
    nu = check_poisson_ratio(poisson_ratio)
    ratio = 0.5 * (1.0 - 2.0 * nu) / (1.0 - nu)
    roots = numpy.roots([1.0, -8.0, 24.0 - 16.0 * ratio, -16.0 * (1.0 - ratio)])
    real = roots[(abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < 1.0)].real
    return shear_speed(shear_modulus, density) * math.sqrt(float(real.min()))
