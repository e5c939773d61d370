"""One mass on a spring, rubbed by a belt: the classic stick-slip oscillator, yardstick of the
friction effect.

``m x'' = -k x + F_t``, F_t the friction of the belt on the mass under the constant load N, driven
by v = v_b - x'. State [x, v_x, s]; event function: margin of stick or of slip, whichever holds.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.friction import STICK, following_deflection, friction_force, slip_event, stick_event
from contact_sim_pkg.laws.one_mass.parameters import BeltSlider

STATES = 3
EVENT_FUNCTIONS = 1


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    velocity = rig.belt_speed - state[1]
    out[0] = state[1]
    out[1] = (friction_force(rig.friction, mode[0], rig.load, state[2], velocity) - rig.spring * state[0]) / rig.mass
    out[2] = velocity if mode[0] == STICK else 0.0


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    velocity = rig.belt_speed - state[1]
    if mode[0] == STICK:
        out[0] = stick_event(rig.friction, rig.load, state[2], velocity)
    else:
        out[0] = slip_event(rig.friction, mode[0], velocity, -derivative[1], rig.load, 0.0)


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    velocity = rig.belt_speed - state[1]
    if mode[0] == STICK:
        trial = rig.friction.stiffness * state[2] + rig.friction.damping * velocity
        mode[0] = 1 if trial > 0.0 else -1
    else:
        state[2] = following_deflection(rig.friction, mode[0], rig.load, velocity)
        mode[0] = STICK
    return 1.0


@borrowing_kernel
def _need_rate(rig, mode):
    return mode[0] != STICK


register_rig(BeltSlider, _rate, _event_functions, _mode_transition, _need_rate)
