"""The energetic impact of one contact in space: the path of the slip along the normal impulse, an
equation of its own.

Slip ``u_t = r (cos a, sin a) = r s``, ``dp = r dtau``, ``f = A_tn - mu A_tt s``: ``da/dtau`` is f
across s, ``d ln r/dtau`` f along s, ``du_n/dtau = r (A_nn - mu A_nt s)``; regular as the slip
stops, far out in tau. From a stop on the path is straight: stick where ``|A_tt^-1 A_tn| <= mu``,
else slip along the s with ``A_tn - mu A_tt s = k s, k > 0``. Source: Stronge 1990; Batlle 1996.
Integrated by `integrate/dormand_prince.py`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.integrate.dormand_prince import (
    DormandPrinceWorkspace,
    integrate,
    make_workspace,
    set_event_directions,
)
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.rigid.bodies.body_state import IntegrationSpan
from contact_sim_pkg.rigid.parameters import ImpactPath
from contact_sim_pkg.rigid.results import NOT_CONVERGED, SOLVED

ANGLE, LOG_SLIP, NORMAL, WORK, IMPULSE, FIRST, SECOND, STATES = 0, 1, 2, 3, 4, 5, 6, 7
COMPRESSION, RESTITUTION, STOPPED, ENDED = 0, 1, 2, 3  # phases
STOPPED_SLIP = 34.0  # slip of exp(-34) = 2e-15 of the impact speed counts as none
TOLERANCE = 1.0e-13
LONGEST = 1.0e15  # of tau, in units of 1/A_nn
EVENT_FUNCTIONS = 3
SECULAR_STEPS = 60


class PathWorkspace(NamedTuple):
    """Arrays of the path."""

    state: Vector  # [STATES]
    scale: Vector  # [STATES]
    mode: Modes  # [1], the phase
    wanted: Vector  # [1], work that restitution shall give back, in [J]
    integrator: DormandPrinceWorkspace


class PathRig(NamedTuple):
    """What the integrator sees: the contact, and the work that is wanted back (known when
    compression ends).
    """

    contact: ImpactPath
    wanted: Vector
    speed: float  # |u| before the impact: the unit of slip


def make_path_workspace() -> PathWorkspace:
    """Work space of one path."""
    zeros = numpy.zeros
    return PathWorkspace(
        zeros(STATES), zeros(STATES), zeros(1, numpy.int64), zeros(1), make_workspace(STATES, EVENT_FUNCTIONS)
    )


@kernel
def _rate(rig, drive, mode, time, state, out):
    if mode[0] >= STOPPED:
        for i in range(STATES):
            out[i] = 0.0
        return
    contact = rig.contact
    s_1, s_2 = math.cos(state[ANGLE]), math.sin(state[ANGLE])
    mu = contact.friction
    push_1 = contact.n1 - mu * (contact.t11 * s_1 + contact.t12 * s_2)
    push_2 = contact.n2 - mu * (contact.t12 * s_1 + contact.t22 * s_2)
    slip = rig.speed * math.exp(min(state[LOG_SLIP], 100.0))
    out[ANGLE] = s_1 * push_2 - s_2 * push_1
    out[LOG_SLIP] = s_1 * push_1 + s_2 * push_2
    out[NORMAL] = slip * (contact.nn - mu * (contact.n1 * s_1 + contact.n2 * s_2))
    out[WORK] = slip * state[NORMAL]
    out[IMPULSE] = slip
    out[FIRST] = -mu * slip * s_1
    out[SECOND] = -mu * slip * s_2


@kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    out[0] = -state[NORMAL] if mode[0] == COMPRESSION else 1.0
    out[1] = rig.wanted[0] - state[WORK] if mode[0] == RESTITUTION else 1.0
    out[2] = state[LOG_SLIP] + STOPPED_SLIP if mode[0] < STOPPED else 1.0


@kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    if event == 0:
        mode[0] = RESTITUTION
        rig.wanted[0] = -(rig.contact.restitution**2) * state[WORK]
        state[NORMAL] = 0.0
        state[WORK] = 0.0
        if rig.wanted[0] <= 0.0:
            mode[0] = ENDED
    elif event == 1:
        mode[0] = ENDED
    else:
        mode[0] = STOPPED
    return 1.0


@kernel
def _need_rate(rig, mode):
    return False


register_rig(PathRig, _rate, _event_functions, _mode_transition, _need_rate)


@kernel
def _direction_after_stop(contact):
    """Tangential over normal impulse once slip has stopped, as a vector: it sticks, or slips along
    one direction.
    """
    determinant = contact.t11 * contact.t22 - contact.t12**2
    hold_1 = -(contact.t22 * contact.n1 - contact.t12 * contact.n2) / determinant
    hold_2 = -(contact.t11 * contact.n2 - contact.t12 * contact.n1) / determinant
    mu = contact.friction
    if math.hypot(hold_1, hold_2) <= mu:
        return hold_1, hold_2
    # |(mu A_tt + k)^-1 A_tn| = 1 has one root k in between
    low, high = 0.0, math.hypot(contact.n1, contact.n2)
    for _ in range(SECULAR_STEPS):
        k = 0.5 * (low + high)
        a, b, d = mu * contact.t11 + k, mu * contact.t12, mu * contact.t22 + k
        s_1, s_2 = (
            (d * contact.n1 - b * contact.n2) / (a * d - b * b),
            (a * contact.n2 - b * contact.n1) / (a * d - b * b),
        )
        if math.hypot(s_1, s_2) > 1.0:
            low = k
        else:
            high = k
    length = math.hypot(s_1, s_2)
    return -mu * s_1 / length, -mu * s_2 / length


@kernel
def _straight_end(contact, state, wanted, compressing):
    """From the stop of the slip to the end of the impact, in closed form; with which the path
    ends.
    """
    follow_1, follow_2 = _direction_after_stop(contact)
    slope = contact.nn + contact.n1 * follow_1 + contact.n2 * follow_2
    length, speed = 0.0, state[NORMAL]
    if compressing:
        length = -speed / slope
        wanted = -(contact.restitution**2) * (state[WORK] + 0.5 * speed * length)
        speed = 0.0
        length += math.sqrt(2.0 * max(0.0, wanted) / slope)
    else:
        left = max(0.0, wanted - state[WORK])
        if left > 0.0:
            length = 2.0 * left / (speed + math.sqrt(speed * speed + 2.0 * slope * left))
    state[IMPULSE] += length
    state[FIRST] += follow_1 * length
    state[SECOND] += follow_2 * length


@kernel
def _start(contact, u_n, u_1, u_2, speed, work):
    slip = math.hypot(u_1, u_2)
    for i in range(STATES):
        work.state[i] = 0.0
    work.state[ANGLE] = math.atan2(u_2, u_1)
    work.state[LOG_SLIP] = math.log(slip / speed) if slip > 0.0 else -2.0 * STOPPED_SLIP
    work.state[NORMAL] = u_n
    impulse = speed / contact.nn
    work.scale[ANGLE] = TOLERANCE
    work.scale[LOG_SLIP] = TOLERANCE
    work.scale[NORMAL] = TOLERANCE * speed
    work.scale[WORK] = TOLERANCE * speed * impulse
    work.scale[IMPULSE] = TOLERANCE * impulse
    work.scale[FIRST] = TOLERANCE * impulse
    work.scale[SECOND] = TOLERANCE * impulse


@entry
def spatial_impact(contact: ImpactPath, u_n: float, u_1: float, u_2: float, work: PathWorkspace) -> int:
    """Follow the path from the contact velocity in [m/s] (approaching, ``u_n < 0``) to its end; the
    impulses in [N s] are left in ``work.state``; returns a status.
    """
    speed = math.sqrt(u_n * u_n + u_1 * u_1 + u_2 * u_2)
    _start(contact, u_n, u_1, u_2, speed, work)
    rig = PathRig(contact, work.wanted, speed)
    mode = work.mode
    # without slip the whole path is straight
    mode[0] = STOPPED
    compressing = True
    status = 0
    # slip: compression and restitution by the integrator, until slip stops or the work is back
    if work.state[LOG_SLIP] > -STOPPED_SLIP:
        mode[0] = COMPRESSION
        end = LONGEST / contact.nn
        drive = IntegrationSpan(0.0, end)
        work.integrator.step[0] = 0.01 / (contact.nn + contact.t11 + contact.t22)
        work.wanted[0] = -1.0
        set_event_directions(rig, drive, mode, 0.0, work.state, work.integrator)
        status = integrate(rig, drive, mode, end, work.state, work.scale, work.integrator)
        compressing = work.wanted[0] < 0.0
    # from the stop of the slip on in closed form
    if mode[0] == STOPPED:
        _straight_end(contact, work.state, work.wanted[0], compressing)
    return SOLVED if status == 0 and mode[0] >= STOPPED else NOT_CONVERGED
