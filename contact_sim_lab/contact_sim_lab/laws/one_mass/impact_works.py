"""A point contact whose force's works are integrated with it: what the coefficient of restitution
is made of.

``W = -integral F x' dt`` (Driver and Seat eq 10, with the closing and the opening phases apart):
``W_c`` collects all closing phases, ``W_r`` all opening ones, and ``e = sqrt(W_r / -W_c)`` (eq 11).
For a free single mass that is the ratio of the speeds. Only the contact force counts, not gravity.
The turning point x' = 0 is a located event, so neither work straddles it. State [z, v, W_c, W_r];
event functions: the approach x, the tension margin, the approach rate.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.normal_force import normal_force
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.point_contact import _event_functions as contact_event_functions
from contact_sim_pkg.laws.one_mass.point_contact import approach_of, free_flight

STATES = 4
EVENT_FUNCTIONS = 3


class ImpactWorks(NamedTuple):
    """A point contact whose force's works are integrated with it. State [z, v, work of closing,
    work of opening] in [m, m/s, J, J].

    Both works are counted from the start of the run: ``W = -integral F x' dt``, the first over all
    closing phases (W_c <= 0), the second over all opening ones (W_r >= 0 where the contact never
    pulls).
    """

    contact: PointContact


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    contact = rig.contact
    approach, approach_rate = approach_of(contact, time, state)
    force = normal_force(contact.elastic, contact.dissipative, approach, approach_rate, 1.0)
    out[0] = state[1]
    out[1] = force / contact.mass - contact.gravity
    power = -force * approach_rate
    out[2] = power if approach_rate > 0.0 else 0.0
    out[3] = power if approach_rate <= 0.0 else 0.0


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    contact_event_functions(rig.contact, drive, mode, time, state, derivative, out)
    _approach, approach_rate = approach_of(rig.contact, time, state)
    out[2] = approach_rate


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    return direction


@borrowing_kernel
def _need_rate(rig, mode):
    return False


@borrowing_kernel
def _free_flight(rig, drive, mode, time, end, state, side):
    return free_flight(rig.contact, drive, mode, time, end, state, side)


register_rig(ImpactWorks, _rate, _event_functions, _mode_transition, _need_rate, _free_flight)
