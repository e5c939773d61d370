"""A rigid body on active contacts in time, as a rig of the integrator: what a turn calls for. Each
contact keeps its mode.

A mode ends where a normal force or a slip comes to 0, a sticking force leaves its cone, a free
contact lands, or an active one comes to the end of a face of the ground. The forces:
`rigid/forces/constraint_forces.py`.

State: [place and turn] [v, omega] (`rigid/bodies/body_state.py`) [time in s] [work of friction in J]
[impulse of each row in N s] [integral of each event function: so the rate of a state holds all that
the event functions need]. Source: Hairer and Wanner, Solving Ordinary Differential Equations II,
VII.2.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.rigid.bodies.body import RigidBody, lies_on
from contact_sim_pkg.rigid.bodies.body_state import fill_rates, places_of
from contact_sim_pkg.rigid.forces.constraint_forces import (
    DEEP,
    FIRST,
    FORCE,
    FREE,
    GAP,
    NEAR,
    NEWTONS,
    PLACE,
    SECOND,
    SLIDES,
    SLIGHT_SLIP,
    SPARE,
    SPEED,
    STICKS,
    VELOCITY,
    ConstrainedBody,
    fill_forces,
    update_contacts,
)
from contact_sim_pkg.rigid.problem import PLANE

GOING, ENDED = 0, 1  # the last of the modes: whether every mode still lasts
EVENTS_PER_CONTACT = 2
# of the speed: so far back slip may go, as its start and its end are known to rounding alone
SLACK = 1.0e-10
# of a gap, so that its integral stays small and regula falsi finds where it closes
LARGEST_EVENT_VALUE = 1.0e3


def constrained_states(body: RigidBody, contacts: int) -> int:
    """Number of state variables."""
    return places_of(body.width) + len(body.load) + 2 + contacts * (body.width + EVENTS_PER_CONTACT)


@borrowing_kernel
def first_of_time(rig):
    """Place of the time in the state; the work of friction follows it, then the impulses."""
    return (3 if rig.body.width == PLANE else 7) + rig.body.load.shape[0]


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    for i in range(out.shape[0]):
        out[i] = 0.0
    # a mode has ended: the state stays, the event functions grow so that none is found again
    if mode[mode.shape[0] - 1] == ENDED:
        for event in range(out.shape[0] - EVENTS_PER_CONTACT * (mode.shape[0] - 1), out.shape[0]):
            out[event] = 1.0
        return
    # forces that keep the modes, and the rates of the body under them
    update_contacts(rig, state)
    fill_forces(rig, mode)
    place, body, force, push = first_of_time(rig), rig.body, rig.rows[FORCE], rig.push[1]
    for k in range(push.shape[0]):
        push[k] = body.load[k]
        for row in range(force.shape[0]):
            push[k] += rig.J[row, k] * force[row]
    fill_rates(body, rig.motion.rotation, push, state, out)
    # time, work of friction and impulses
    out[place] = 1.0
    for row in range(force.shape[0]):
        out[place + 2 + row] = force[row]
        if row % body.width != 0:
            out[place + 1] += force[row] * rig.rows[VELOCITY, row]
    _fill_event_functions(rig, mode, out)


@borrowing_kernel
def _fill_event_functions(rig, mode, out):
    """The event functions at the state looked at, into the last entries of ``out``."""
    contacts, width, force, u = mode.shape[0] - 1, rig.body.width, rig.rows[FORCE], rig.rows[VELOCITY]
    place = out.shape[0] - EVENTS_PER_CONTACT * contacts
    for i in range(contacts):
        row, end, extent = i * width, place + i, place + contacts + i
        gap = rig.contacts[GAP, i] - rig.contacts[DEEP, i]
        out[end] = max(min(gap / rig.unit[NEAR], LARGEST_EVENT_VALUE), -LARGEST_EVENT_VALUE) + 1.0
        out[extent] = 1.0
        if mode[i] == FREE:
            continue
        out[end] = -1.0
        if lies_on(rig.body, rig.ground, rig.motion, i) != rig.contacts[PLACE, i]:
            # beyond the end of a face the axes of the contact are others: neither its force nor its
            # slip counts
            continue
        out[end] = force[row] / rig.unit[NEWTONS]
        if mode[i] == STICKS:
            out[extent] = rig.contacts[SPARE, i] / rig.unit[NEWTONS]
        else:
            along = u[row + 1] * rig.contacts[FIRST, i]
            along += u[row + 2] * rig.contacts[SECOND, i] if width != PLANE else 0.0
            out[extent] = along / rig.unit[SPEED] + SLACK


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    place = derivative.shape[0] - out.shape[0]
    for event in range(out.shape[0]):
        out[event] = derivative[place + event]


@borrowing_kernel
def _slip_goes_on(rig, i):
    """Whether the slip of contact ``i`` has come at right angles to where it went and goes on; it
    then counts from there.
    """
    if rig.body.width == PLANE:
        return False
    u, row = rig.rows[VELOCITY], i * rig.body.width
    length = math.hypot(u[row + 1], u[row + 2])
    if length <= SLIGHT_SLIP * rig.unit[SPEED]:
        return False
    rig.contacts[FIRST, i], rig.contacts[SECOND, i] = u[row + 1] / length, u[row + 2] / length
    return True


@borrowing_kernel
def _start_slip(rig, i):
    """Slip of contact ``i`` begins against its friction."""
    force, row = rig.rows[FORCE], i * rig.body.width
    first, second = force[row + 1], force[row + 2] if rig.body.width != PLANE else 0.0
    push = math.hypot(first, second)
    if push > 0.0:
        rig.contacts[FIRST, i], rig.contacts[SECOND, i] = -first / push, -second / push


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    contacts = mode.shape[0] - 1
    i = event - contacts if event >= contacts else event
    if event >= contacts and mode[i] == SLIDES:
        if _slip_goes_on(rig, i):
            return 1.0
        mode[i] = STICKS
    elif event >= contacts:
        _start_slip(rig, i)
        mode[i] = SLIDES
    else:
        mode[i] = FREE
    mode[contacts] = ENDED
    return 1.0


@borrowing_kernel
def _need_rate(rig, mode):
    return True


register_rig(ConstrainedBody, _rate, _event_functions, _mode_transition, _need_rate)
