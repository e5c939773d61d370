"""Parameter tuples of rigid contact."""

from __future__ import annotations

from typing import NamedTuple

# Restitution rules.
NEWTON = 0  # velocities: u_n+ = -e u_n
POISSON = 1  # impulses: restitution impulse = e times compression impulse
# works: the normal impulse gives back e^2 of the work it took (Stronge); never gains kinetic energy
ENERGETIC = 2
RULE_NAMES = {"newton": NEWTON, "poisson": POISSON, "energetic": ENERGETIC}


class PlanarContact(NamedTuple):
    """One contact in the plane, as its impulses see the bodies: ``u+ = u + [[A_nn, A_nt], [A_nt,
    A_tt]] c``.

    Valid: ``A_nn, A_tt > 0``, ``A_nt^2 < A_nn A_tt``, ``friction >= 0``, ``0 <= restitution <= 1``.
    """

    normal: float  # A_nn = J_n' W J_n in [1/kg], W the inverse inertia
    coupling: float  # A_nt in [1/kg]
    tangential: float  # A_tt in [1/kg]
    friction: float  # Coulomb's ratio mu
    restitution: float  # e, read by the rule in use


class PlanarImpulse(NamedTuple):
    """What one planar contact answers."""

    normal: float  # c_n >= 0 in [N s]
    tangential: float  # c_t in [N s], |c_t| <= mu c_n in the one-step rules
    mode: int  # results.SEPARATE, STICK, SLIDE, REVERSE


class ImpactPath(NamedTuple):
    """One contact in space along its normal impulse: the symmetric ``A`` of normal (n) and tangents
    (1, 2), and friction.
    """

    nn: float
    n1: float
    n2: float
    t11: float
    t12: float
    t22: float
    friction: float
    restitution: float
