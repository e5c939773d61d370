"""Friction with true stick: a spring-damper that sticks, limited by Coulomb's law (SEEDS 2.6, P0 eq 9).

* stick: ``F_t = C s + D v``, ``s' = v``;
* slip: ``F_t = sigma mu_k N``, and the spring follows, ``C s = F_t - D v``, never beyond ``|s| = mu_k N / C``;
* stick ends where ``|C s + D v|`` reaches ``mu_s N``; slip ends where the slip rate ``v - s'`` passes zero;
* without a normal force (bodies apart, or parting faster than the material recovers) ``F_t = 0``, ``s = 0``.

v is the velocity of the upper body relative to the lower, F_t the force on the lower body; on the upper body acts
-F_t. The transitions are located events, not smoothed: no creep in stick.
"""

from __future__ import annotations

from ..jit import kernel
from ..parameters import Friction

STICK = 0
SLIP_FORWARD = 1
SLIP_BACKWARD = -1
APART = 2


@kernel
def friction_force(friction: Friction | None, mode: int, normal: float, deflection: float, velocity: float) -> float:
    """Force F_t on the lower body in [N]; ``normal`` [N] >= 0, ``deflection`` s [m], ``velocity`` v [m/s]."""
    if friction is None:
        return 0.0
    if mode == APART:
        return 0.0
    if mode == STICK:
        return friction.stiffness * deflection + friction.damping * velocity
    return mode * friction.coefficient_kinetic * normal


@kernel
def following_deflection(friction: Friction, mode: int, normal: float, velocity: float) -> float:
    """Deflection of the spring in [m] while slipping: ``(F_t - D v)/C`` within ``+-mu_k N/C``."""
    limit = friction.coefficient_kinetic * normal / friction.stiffness
    free = mode * limit - friction.damping * velocity / friction.stiffness
    return min(max(free, -limit), limit)


@kernel
def stick_margin(friction: Friction, normal: float, deflection: float, velocity: float) -> float:
    """``mu_s N - |C s + D v|`` in [N]: sticking lasts while it is positive."""
    return friction.coefficient_static * normal - abs(friction.stiffness * deflection + friction.damping * velocity)


@kernel
def spring_limit(friction: Friction, mode: int, normal: float, velocity: float) -> int:
    """Where the following spring stands while slipping: 0 free, 1 at its limit ``mu_k N/C`` along the slip, -1 against it."""
    dragged = mode * friction.damping * velocity
    if dragged <= 0.0:
        return 1
    return -1 if dragged >= 2.0 * friction.coefficient_kinetic * normal else 0


@kernel
def slip_margin(
    friction: Friction, mode: int, velocity: float, acceleration: float, normal: float, normal_rate: float
) -> float:
    """``sigma (v - s')`` in [m/s]: slipping lasts while it is positive.

    ``C s' = sigma mu_k N' - D v'`` where the spring is free, ``sigma mu_k N'`` where it stands at its limit along the slip.
    Where it stands at the limit against the slip, the damper alone holds the trial force beyond the limit, and ``sigma v``
    is returned. ``normal_rate`` N' in [N/s], ``acceleration`` v' in [m/s^2].
    """
    limit = spring_limit(friction, mode, normal, velocity)
    if limit < 0:
        return mode * velocity
    spring_rate = mode * friction.coefficient_kinetic * normal_rate
    if limit == 0:
        spring_rate -= friction.damping * acceleration
    return mode * (velocity - spring_rate / friction.stiffness)
