"""One mass over a support that may move: free impact, drop, slap. The smallest rig, and the yardstick of the integrator.

``m z'' = F(x, x') - m g``, ``x = A sin(w t) - z``. State [z, v]; event functions: the approach x, and the tension margin.
"""

from __future__ import annotations

import math

from ..effects.normal_force import normal_force, tension_margin
from ..jit import kernel
from ..parameters import PointContact
from .interface import register

STATES = 2
MARGINS = 2
PIECES_A_PERIOD = 16


@kernel
def longest_piece(rig):
    """A 16th of the support's period in [s], so that no touch falls between the points where events are looked for."""
    if rig.support_frequency == 0.0:
        return math.inf
    return 2.0 * math.pi / abs(rig.support_frequency) / PIECES_A_PERIOD


@kernel
def approach_of(rig, time, state):
    phase = rig.support_frequency * time
    approach = rig.support_amplitude * math.sin(phase) - state[0]
    approach_rate = rig.support_amplitude * rig.support_frequency * math.cos(phase) - state[1]
    return approach, approach_rate


@kernel
def _rate(rig, drive, mode, time, state, out):
    approach, approach_rate = approach_of(rig, time, state)
    out[0] = state[1]
    force = normal_force(rig.elastic, rig.dissipative, approach, approach_rate, 1.0)
    out[1] = force / rig.mass - rig.gravity


@kernel
def _margins(rig, drive, mode, time, state, derivative, out):
    approach, approach_rate = approach_of(rig, time, state)
    out[0] = approach
    out[1] = tension_margin(rig.elastic, rig.dissipative, approach, approach_rate, 1.0)


@kernel
def _switch(rig, drive, mode, time, state, event, side):
    return side


@kernel
def _need_rate(rig, mode):
    return False


register(PointContact, _rate, _margins, _switch, _need_rate)
