"""Seat rig, tire rig and car: road -> tire -> suspension -> floor -> seat -> occupant, with any
part absent.

Vertical motion (z up), and the occupant's sliding on the cushion (x forward) where the scene calls
for friction.

* wheel  ``m_w z_w'' = F_tire - m_w g - F_susp``, ``F_susp = k (z_w - z_b) + c (z_w' - z_b')``; with
  a rigid ring the force of its sidewalls takes the place of F_tire
* belt   ``m_r z_r'' = F_tire - m_r g - F_side``, ``F_side = k (z_r - z_w) + c (z_r' - z_w')``
* body   ``m_b z_b'' = F_susp - m_b g - F_seat + m_b a_z(t)`` (a_z: what the drive line gives to the
  free body)
* occupant: ``motion/seated.py``

Each force is that of an element (``motion/elements.py``). Approach of the tire ``h(t) - z_w`` (belt: ``h(t) - z_r``), h the
effective road height. State: [z_w, v_w, z_b, v_b] [z_r, v_r] [masses and own states of effects] [z_0 .. z_n, v_0 .. v_n]
[x, v_x, s] [z] [q] [z_b] [supplied, dissipated]; z and z_b are the hysteresis variables of foam in cushion and seat back
(``laws/foam_hysteresis.py``), q the mean square of softening links, the last two are the works in [J] that the energy
ledger needs.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.rigs.vehicle.motion import seated  # noqa: F401 - registers the occupant
from contact_sim_pkg.rigs.vehicle.motion.elements import act, events, events_of, finish, need_rate, transition
from contact_sim_pkg.rigs.vehicle.motion.ground import ground_at
from contact_sim_pkg.rigs.vehicle.motion.masses import accelerate
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle


def event_count(rig: Vehicle) -> int:
    """Number of event functions."""
    return events_of(rig.elements)


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    ground = ground_at(drive, time, rig.gravity)
    out[:] = 0.0
    # Forces first, then the accelerations of the table's masses, then those of others and what follows from them
    lost, brought, _stored, _kept = act(rig.elements, ground, mode, state, out)
    accelerate(rig.masses, -rig.gravity, state, out)
    brought += finish(rig.elements, ground, state, out)
    last = state.shape[0]
    out[last - 2] = brought
    out[last - 1] = lost


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    events(rig.elements, ground_at(drive, time, rig.gravity), mode, state, derivative, 0, out)


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    return transition(rig.elements, ground_at(drive, time, rig.gravity), mode, state, event, direction)


@borrowing_kernel
def _need_rate(rig, mode):
    return need_rate(rig.elements, mode)


register_rig(Vehicle, _rate, _event_functions, _mode_transition, _need_rate)
