"""Friction with true stick: a spring and damper, limited by Coulomb's law (Driver and Seat, eq 9).

* stick: ``F_t = C s + D v``, ``s' = v``;
* slip: ``F_t = sigma mu_k N``, and the spring follows, ``C s = F_t - D v``, never beyond ``mu_k N /
  C`` against the slip;
* stick ends where ``|C s + D v|`` reaches ``mu_s N``; slip ends where the slip rate ``v - s'``
  passes zero;
* ``F_t = 0`` without a normal force (separated, or parting faster than the material recovers),
  ``s = 0``.

v is the velocity of the upper body relative to the lower, F_t the force on the lower body, so that
-F_t acts on the upper one. The transitions are located events, not smoothed: sticking does not
creep. F_t is continuous where slip ends, also where v has reversed before: a load that falls fast
prolongs the slip a little. (With s below mu_k N / C along the slip too, the force would jump by D v
there, repeatedly, at instants that the step decides.)
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.parameters import Friction

STICK = 0
SLIP_FORWARD = 1
SLIP_BACKWARD = -1
SEPARATED = 2


@kernel
def friction_force(friction: Friction | None, mode: int, normal: float, deflection: float, velocity: float) -> float:
    """Force F_t on the lower body in [N]; ``normal`` [N] >= 0, ``deflection`` s [m], ``velocity`` v
    [m/s].
    """
    if friction is None:
        return 0.0
    if mode == SEPARATED:
        return 0.0
    if mode == STICK:
        return friction.stiffness * deflection + friction.damping * velocity
    return mode * friction.coefficient_kinetic * normal


@kernel
def following_deflection(friction: Friction, mode: int, normal: float, velocity: float) -> float:
    """Deflection of the spring in [m] while slipping: ``(F_t - D v)/C``, at most ``mu_k N/C``
    against the slip.
    """
    limit = friction.coefficient_kinetic * normal / friction.stiffness
    along = limit - mode * friction.damping * velocity / friction.stiffness
    return mode * max(along, -limit)


@kernel
def stick_event(friction: Friction, normal: float, deflection: float, velocity: float) -> float:
    """``mu_s N - |C s + D v|`` in [N]: sticking lasts while it is positive."""
    return friction.coefficient_static * normal - abs(friction.stiffness * deflection + friction.damping * velocity)


@kernel
def spring_is_limited(friction: Friction, mode: int, normal: float, velocity: float) -> bool:
    """Whether the following spring is at its limit ``mu_k N/C`` against the slip.

    normal: [N] >= 0; velocity: [m/s].
    """
    return mode * friction.damping * velocity >= 2.0 * friction.coefficient_kinetic * normal


@kernel
def slip_event(
    friction: Friction, mode: int, velocity: float, acceleration: float, normal: float, normal_rate: float
) -> float:
    """``sigma (v - s')`` in [m/s]: slipping lasts while it is positive.

    ``C s' = sigma mu_k N' - D v'``. Where the spring is at that limit, the damper alone
    keeps the trial force beyond it, and ``sigma v`` is returned. ``normal_rate`` N' in
    [N/s], ``acceleration`` v' in [m/s^2].
    """
    if spring_is_limited(friction, mode, normal, velocity):
        return mode * velocity
    spring_rate = mode * friction.coefficient_kinetic * normal_rate - friction.damping * acceleration
    return mode * (velocity - spring_rate / friction.stiffness)
