"""Friction of a point that may slide in any direction: a spring and damper that stick, with a
Coulomb limit.

With ``T = C s + D v``, v the slip velocity and s the deflection of the spring, both along the
surface:

* stick, ``|T| <= mu N``: ``F = T``, ``s' = v``;
* slip: ``F = mu N T/|T|``, and the spring follows by its own damper, ``s' = (F - C s)/D``, so that
  ``v - s'`` is along F.

F and s' are continuous where stick and slip meet, so the law has no mode to keep; in stick nothing
creeps. What is lost, ``F (v - s') + D s'^2``, is never negative. Along one line stick and steady
slip are those of ``laws/friction.py``. F acts on the surface, -F on the point. The static and the
kinetic ratio are one. Source: Driver and Seat, eq 9, with the direction of slip free.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel


@kernel
def point_friction(friction, normal, s_1, s_2, v_1, v_2):
    """Force on the surface (2) in [N] and rate of the deflection (2) in [m/s]; ``normal`` [N] >= 0,
    deflection s [m], slip v [m/s].

    ``friction.damping`` must be above 0.
    """
    stiffness, damping = friction.stiffness, friction.damping
    trial_1, trial_2 = stiffness * s_1 + damping * v_1, stiffness * s_2 + damping * v_2
    limit, size = friction.coefficient_kinetic * normal, math.hypot(trial_1, trial_2)
    if size <= limit:
        return trial_1, trial_2, v_1, v_2
    share = limit / size  # first, for the product of limit and trial may underflow
    force_1, force_2 = share * trial_1, share * trial_2
    return force_1, force_2, (force_1 - stiffness * s_1) / damping, (force_2 - stiffness * s_2) / damping


@kernel
def point_stick_event(friction, normal, s_1, s_2, v_1, v_2):
    """``mu N - |C s + D v|`` in [N]: the point sticks where it is not negative."""
    stiffness, damping = friction.stiffness, friction.damping
    trial = math.hypot(stiffness * s_1 + damping * v_1, stiffness * s_2 + damping * v_2)
    return friction.coefficient_kinetic * normal - trial
