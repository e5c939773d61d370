"""Elastic and viscous force of the impact (Goloshchapov eqs 8, 9), and the same as the general normal law.

``F_c = 4/3 k_p E' sqrt(R) x^(3/2)``, ``F_b = 4 k_p sqrt(R) (E''/w) x' x^(1/2)``, w the angular frequency of the impact; x <= 0: no
force. It is the case n = 3/2, p = 1/2, q = 1 of ``effects/general_dissipative.py``.
"""

from __future__ import annotations

import math

from ..parameters import GeneralDissipative, NormalElastic

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
    """A in [N/m^1.5]."""
    return 4.0 / 3.0 * shape_factor * storage_modulus * math.sqrt(radius)


def viscous_coefficient(loss_modulus: float, radius: float, shape_factor: float, frequency: float) -> float:
    """B in [N s/m^1.5], ``frequency`` in [rad/s]."""
    return 4.0 * shape_factor * math.sqrt(radius) * loss_modulus / frequency


def elastic_force(coefficient: float, depth: float) -> float:
    """F_c in [N]; 0 for ``depth <= 0``."""
    return coefficient * depth * math.sqrt(depth) if depth > 0.0 else 0.0


def viscous_force(coefficient: float, depth: float, speed: float) -> float:
    """F_b in [N], negative on the way out; 0 for ``depth <= 0``."""
    return coefficient * math.sqrt(depth) * speed if depth > 0.0 else 0.0


def lowest_force(end: str) -> float:
    """Bound of the total force in [N] that an end rule sets: 0 for `force` (no pull), -inf for `gap`.

    Raises ValueError for another rule.
    """
    if end not in ENDS:
        raise ValueError(f"end rule '{end}': force or gap is needed")
    return 0.0 if end == "force" else -math.inf


def normal_law(elastic: float, viscous: float, end: str) -> tuple[NormalElastic, GeneralDissipative]:
    """The pair of tuples that any rig takes as its contact: A x^1.5 + B x^0.5 x'."""
    return NormalElastic(float(elastic), 1.5), GeneralDissipative(float(viscous), 0.5, 1.0, 0.0, lowest_force(end))
