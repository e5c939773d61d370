"""Where the contact surface lies: depth h_x, volumes and heating of the half-space, in both
variants (Goloshchapov eqs 10-40).

Half-space: ``x1 = D1 x``. Volume of deformation V_x1, of compression V_c1 from the elastic work,
heating ``dV_T = V_x1 K_T dT``.

Variant 1 (static; the border sinks): ``V_x1 = pi/2 k_c^2 R x1^2``, ``V_c1 = 8/15 k_c (E1'/K1')
sqrt(R) x1^(5/2)``, ``h_x = x1 sqrt(1 - a + K_T dT)``, ``a = 16/(5 pi k_c) sqrt(x1/R)(1 - 2 nu)``;
k_c = k_p (`equal`) or ``k_c^2 = k_p^2 (1 + x2/h_x)`` (`consistent`). Variant 2 (impact; the border
stays on the surface): ``V_x1 = pi/2 k_x1^2 R x1^2``, ``k_x1^2 = k_p^2 x/x1``, ``k_h^2 = k_p^2
x/h_x``, ``h_x = x1 (1 - a + K_T dT)``, ``a = 16 sqrt(D1)/(5 pi k_p) sqrt(x1/R)(1 - 2 nu)``.
``E1'/K1' = 3 (1 - 2 nu)``: nu = 1/2 is allowed and gives h_x = x1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_number, check_poisson_ratio, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import shape_factor

__all__ = ["Position", "SampleHalfSpace", "position_variant_1", "position_variant_2"]

ROUNDS = 200


class SampleHalfSpace(NamedTuple):
    """What the position needs of the half-space."""

    share: float  # D1, 0 to 1: its part of the approach
    poisson_ratio: float  # nu_1
    expansion: float = 0.0  # K_T [1/K], volume thermal expansion
    heating: float = 0.0  # dT [K]


class Position(NamedTuple):
    """Position of the contact surface at one approach, in SI units."""

    share_depth: float  # x1 [m], the half-space's part of the approach
    surface_depth: float  # h_x [m]
    alpha: float  # a = alpha_h, part of the depth lost by compression
    surface_factor: float  # k_c of variant 1, k_h of variant 2: r^2 = k^2 R h_x
    volume: float  # V_x1 [m^3], whole volume of deformation
    compression_volume: float  # V_c1 [m^3]
    heating_volume: float  # dV_T [m^3]
    contact_volume: float  # V_h = V_x1 - V_c1 + dV_T [m^3], in contact with the sphere


def position_variant_1(depth: float, radius: float, half_space: SampleHalfSpace, rule: str = "equal") -> Position:
    """Variant 1 at approach ``depth`` x [m]; ``rule`` for k_c: `equal` or `consistent`.

    Range: 0 < x <= R [m], 0 < D1 <= 1, -1 < nu <= 1/2, alpha_h below 1 + K_T dT. Raises ImpactError
    outside.
    """
    x1, k_p = _parts(depth, radius, half_space)
    k_c, alpha, surface = k_p, 0.0, x1
    for _ in range(_rounds(rule)):
        alpha = 16.0 / (5.0 * math.pi * k_c) * math.sqrt(x1 / radius) * (1.0 - 2.0 * half_space.poisson_ratio)
        surface = x1 * math.sqrt(_left(alpha, half_space))
        following = k_p * math.sqrt(1.0 + (depth - x1) / surface) if rule == "consistent" else k_c
        if abs(following - k_c) <= 4.0e-16 * k_c:
            break
        k_c = following
    volume = 0.5 * math.pi * k_c**2 * radius * x1**2
    return _position(x1, surface, alpha, k_c, volume, half_space)


def position_variant_2(depth: float, radius: float, half_space: SampleHalfSpace) -> Position:
    """Variant 2 at approach ``depth`` x [m]. Range and errors as variant 1."""
    x1, k_p = _parts(depth, radius, half_space)
    alpha = 16.0 * math.sqrt(half_space.share) / (5.0 * math.pi * k_p) * math.sqrt(x1 / radius)
    alpha *= 1.0 - 2.0 * half_space.poisson_ratio
    surface = x1 * _left(alpha, half_space)
    volume = 0.5 * math.pi * k_p**2 * radius * depth * x1
    return _position(x1, surface, alpha, k_p * math.sqrt(depth / surface), volume, half_space)


def _parts(depth: float, radius: float, half_space: SampleHalfSpace) -> tuple[float, float]:
    """x1 and k_p."""
    check_positive("depth", depth, "m")
    check_poisson_ratio(half_space.poisson_ratio)
    check_number("share of the half-space", half_space.share, above=0.0, most=1.0)
    check_fields("half-space", half_space, finite="expansion heating")
    return half_space.share * depth, shape_factor(depth, radius)


def _left(alpha: float, half_space: SampleHalfSpace) -> float:
    """``1 - a + K_T dT``, which must be above 0."""
    left = 1.0 - alpha + half_space.expansion * half_space.heating
    if not left > 0.0:
        raise ImpactError(
            f"alpha_h {alpha:.4g}: the volume of compression is above the whole; so soft, compressible and deep a contact is "
            "outside the model"
        )
    return left


def _rounds(rule: str) -> int:
    if rule not in ("equal", "consistent"):
        raise ValueError(f"k_c '{rule}': equal or consistent is needed")
    return ROUNDS


def _position(
    x1: float, surface: float, alpha: float, factor: float, volume: float, half_space: SampleHalfSpace
) -> Position:
    compression = alpha * volume  # V_c1/V_x1 = alpha in both variants
    heating = volume * half_space.expansion * half_space.heating
    return Position(
        share_depth=x1,
        surface_depth=surface,
        alpha=alpha,
        surface_factor=factor,
        volume=volume,
        compression_volume=compression,
        heating_volume=heating,
        contact_volume=volume - compression + heating,
    )
