"""The two bodies of an impact: sphere, moduli of half-space and body, and what acts of them
together.

``1/E' = 1/E1' + 1/E2'``, ``D1 = E2'/(E1' + E2')`` the half-space's share of the approach, ``D2 = 1
- D1`` (Goloshchapov, below eq 6). With loss in both bodies the complex moduli stand in series.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number, check_positive

__all__ = ["Material", "Sphere", "hertz_modulus", "pair", "shares"]


class Sphere(NamedTuple):
    """What strikes: a body with a spherical nose."""

    mass: float  # [kg], > 0
    radius: float  # [m], > 0


class Material(NamedTuple):
    """The pair of bodies as the impact sees it; of one body against a rigid one, that body's."""

    storage_modulus: float  # E' [Pa], > 0
    loss_tangent: float  # tan(beta) = E''/E', >= 0

    @property
    def loss_modulus(self) -> float:
        """``E'' = E' tan(beta)`` in [Pa]."""
        return self.storage_modulus * self.loss_tangent


def pair(half_space: Material, body: Material | None) -> Material:
    """Both in series, ``1/E* = 1/E1* + 1/E2*`` with complex moduli; ``None`` is a rigid body.

    Raises ImpactError for a modulus [Pa] that is not above 0 and a loss tangent below 0.
    """
    first = _complex(half_space)
    if body is None:
        return half_space
    second = _complex(body)
    whole = first * second / (first + second)
    return Material(whole.real, whole.imag / whole.real)


def shares(half_space_modulus: float, body_modulus: float) -> tuple[float, float]:
    """D1, D2: parts of the approach taken by the half-space and by the body, moduli > 0 [Pa]; the
    body's may be infinite (rigid).

    Raises ImpactError for other moduli.
    """
    check_positive("modulus of the half-space", half_space_modulus, "Pa")
    check_number("modulus of the body", body_modulus, "Pa", above=0.0, infinite=True)
    body_share = half_space_modulus / (half_space_modulus + body_modulus)
    return 1.0 - body_share, body_share


def hertz_modulus(plane_strain_modulus: float, shape_factor: float) -> float:
    """E' in [Pa] with which the model's force is Hertz's: ``E'/k_p`` of the plane-strain modulus
    E*, ``F = 4/3 E* sqrt(R) x^1.5``.

    At equal moduli the model is k_p (sqrt 2) times stiffer than Hertz. Both > 0; raises ImpactError
    otherwise.
    """
    check_positive("plane-strain modulus", plane_strain_modulus, "Pa")
    check_positive("shape factor", shape_factor)
    return plane_strain_modulus / shape_factor


def _complex(material: Material) -> complex:
    check_positive("storage modulus", material.storage_modulus, "Pa")
    check_not_negative("loss tangent", material.loss_tangent)
    return material.storage_modulus * (1.0 + 1.0j * material.loss_tangent)
