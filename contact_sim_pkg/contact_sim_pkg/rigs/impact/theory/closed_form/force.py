"""Elastic and viscous force of the impact (Goloshchapov eqs 8, 9), and the same as the general
normal law.

``F_c = 4/3 k_p E' sqrt(R) x^(3/2)``, ``F_b = 4 k_p sqrt(R) (E''/w) x' x^(1/2)``, w the angular
frequency of the impact; x <= 0: no force. It is the case n = 3/2, p = 1/2, q = 1 of
``laws/general_dissipative.py``.
"""

from __future__ import annotations

import math

from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalElastic
from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number, check_positive

__all__ = [
    "ENDS",
    "elastic_coefficient",
    "elastic_force",
    "lowest_force",
    "normal_law",
    "viscous_coefficient",
    "viscous_force",
]

ENDS = ("force", "gap")


def elastic_coefficient(storage_modulus: float, radius: float, shape_factor: float) -> float:
    """A in [N/m^1.5] of E' [Pa], R [m] and k_p, all > 0; raises ImpactError otherwise."""
    check_positive("storage modulus", storage_modulus, "Pa")
    check_positive("radius", radius, "m")
    check_positive("shape factor", shape_factor)
    return 4.0 / 3.0 * shape_factor * storage_modulus * math.sqrt(radius)


def viscous_coefficient(loss_modulus: float, radius: float, shape_factor: float, frequency: float) -> float:
    """B in [N s/m^1.5] of E'' >= 0 [Pa], R [m], k_p and ``frequency`` [rad/s], all > 0; raises
    ImpactError otherwise.
    """
    check_not_negative("loss modulus", loss_modulus, "Pa")
    check_positive("radius", radius, "m")
    check_positive("shape factor", shape_factor)
    check_positive("frequency", frequency, "rad/s")
    return 4.0 * shape_factor * math.sqrt(radius) * loss_modulus / frequency


def elastic_force(coefficient: float, depth: float) -> float:
    """F_c in [N] of A >= 0; 0 for ``depth <= 0`` [m]. Raises ImpactError for a negative A and a
    depth that is not finite.
    """
    check_not_negative("coefficient", coefficient, "N/m^1.5")
    check_number("depth", depth, "m")
    return coefficient * depth * math.sqrt(depth) if depth > 0.0 else 0.0


def viscous_force(coefficient: float, depth: float, speed: float) -> float:
    """F_b in [N] of B >= 0, negative on the way out; 0 for ``depth <= 0`` [m]; speed in [m/s].
    Errors as `elastic_force`.
    """
    check_not_negative("coefficient", coefficient, "N s/m^1.5")
    check_number("depth", depth, "m")
    check_number("speed", speed, "m/s")
    return coefficient * math.sqrt(depth) * speed if depth > 0.0 else 0.0


def lowest_force(end: str) -> float:
    """Bound of the total force in [N] that an end rule sets: 0 for `force` (no pull), -inf for
    `gap`.

    Raises ValueError for another rule.
    """
    if end not in ENDS:
        raise ValueError(f"end rule '{end}': force or gap is needed")
    return 0.0 if end == "force" else -math.inf


def normal_law(elastic: float, viscous: float, end: str) -> tuple[NormalElastic, GeneralDissipative]:
    """The pair of tuples that any rig takes as its contact: A x^1.5 + B x^0.5 x'; A > 0, B >= 0,
    else ImpactError.

    elastic: A [N/m^1.5]; viscous: B [N s/m^1.5].
    """
    check_positive("elastic", elastic, "N/m^1.5")
    check_not_negative("viscous", viscous, "N s/m^1.5")
    return NormalElastic(float(elastic), 1.5), GeneralDissipative(float(viscous), 0.5, 1.0, 0.0, lowest_force(end))
