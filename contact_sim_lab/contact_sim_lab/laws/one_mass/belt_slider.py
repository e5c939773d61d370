"""One mass on a spring, rubbed by a belt: the classic stick-slip oscillator, yardstick of the
friction effect.

``m x'' = -k x + F_t``, F_t the friction of the belt on the mass under the constant load N, driven
by v = v_b - x'. State [x, v_x, s]; event function: margin of stick or of slip, whichever holds.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.integrate import dormand_prince
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.friction import STICK, following_deflection, friction_force, slip_event, stick_event
from contact_sim_pkg.laws.one_mass.single import undriven
from contact_sim_pkg.laws.parameters import Friction

STATES = 3
EVENT_FUNCTIONS = 1


class BeltSlider(NamedTuple):
    """One mass on a spring, rubbed by a belt under a constant load. State [x, v, deflection of the
    friction spring].
    """

    mass: float  # [kg]
    spring: float  # [N/m]
    belt_speed: float  # [m/s]
    load: float  # [N]
    friction: Friction


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

_integrate = dormand_prince.integrate
_set_event_directions = dormand_prince.set_event_directions


@entry
def run_with_friction(
    rig: BeltSlider,
    mode: Modes,
    state: Vector,
    scale: Vector,
    work: dormand_prince.DormandPrinceWorkspace,
    times: Vector,
    out: Vector,
) -> int:
    """As ``single.run``, by the integrator of the driven rigs: friction events have no root of time beside
    them that steps could use.

    state, scale: [states]; times: [n] [s]; out: [n, states].
    """
    drive = undriven(times[0], times[-1])
    _set_event_directions(rig, drive, mode, times[0], state, work)
    copy_row(state, out[0])
    # One segment between two output times after the other
    status = 0
    for i in range(times.shape[0] - 1):
        drive = undriven(times[i], times[i + 1])
        status = _integrate(rig, drive, mode, times[i + 1], state, scale, work)
        if status != 0:
            return status
        copy_row(state, out[i + 1])
    return status
