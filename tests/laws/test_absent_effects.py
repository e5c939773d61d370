"""An absent effect changes nothing, to the last bit; and friction that is there stands in the energy ledger."""

import numpy
import pytest

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import Contact, Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.motion import columns, entries
from contact_sim_pkg.rigs.vehicle.motion.parameters import Seat, Seated, Vehicle
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count
from contact_sim_pkg.studies.effects.effect_cost import HandWritten, bounce, rigs

FRICTION = Friction(2.0e4, 200.0, 0.4, 0.35)


def _shaken_seat(friction, fore_aft=0.0, count=1500):
    """States and forces of an occupant who is shaken until he leaves the cushion."""
    seat = Seat(0, numpy.array([6.7, 33.4]), numpy.array([[0, 1]]), numpy.array([[35776.0], [761.0]]))
    contact = Contact(NormalElastic(2.73e5, 1.5), NormalDissipative(1.0), friction)
    rig = Vehicle(9.81, (), (Seated(seat, contact),))
    states = 4 + (3 if friction else 0) + 2
    times = numpy.arange(count + 1) * 1e-3
    zeros, a_z, a_x = numpy.zeros(count + 1), 15.0 * numpy.sin(24.0 * times), fore_aft * numpy.sin(19.0 * times)
    state = numpy.zeros(states)
    state[0] = -((40.1 * 9.81 / 2.73e5) ** (2.0 / 3.0))
    state[1] = state[0] - 33.4 * 9.81 / 35776.0
    scale = numpy.array([1e-2, 1e-2, 0.5, 0.5, *([1e-2, 0.5, 1e-2] if friction else []), 1e6, 1e6]) * 1e-6
    scale[-2:] = numpy.inf
    work, mode = make_workspace(states, event_count(rig)), numpy.zeros(1, dtype=numpy.int64)
    samples = (numpy.zeros((count, states)), numpy.zeros((count, states)), numpy.zeros((count, columns.FORCES)))
    straight = (None, None)
    entries.start(rig, mode, state, work, 1e-3, zeros[:2], zeros[:2], a_x[:2], a_z[:2], None, straight)
    assert (
        entries.advance(
            rig, mode, state, scale, work, 0.0, 1e-3, zeros, zeros, a_x, a_z, None, (None, None), 1, 0, *samples
        )
        == 0
    )
    return samples[0], samples[2]


@pytest.mark.fault("D11")
def test_friction_without_fore_aft_input_leaves_the_vertical_motion_bit_identical():
    (with_friction, forces), (without, others) = _shaken_seat(FRICTION), _shaken_seat(None)
    force, other = forces[:, columns.SEAT_NORMAL], others[:, columns.SEAT_NORMAL]
    assert (force == 0.0).any(), "the case does not reach lift-off"
    assert with_friction[:, :4].tobytes() == without[:, :4].tobytes()
    assert force.tobytes() == other.tobytes()


def test_what_an_occupant_who_slips_is_given_and_loses_is_the_change_of_his_energy():
    states, forces = _shaken_seat(FRICTION, fore_aft=12.0)
    z_0, z_1, v_0, v_1, _x, v_x, _s, supplied, lost = states.T
    kinetic = 0.5 * (6.7 * v_0**2 + 33.4 * v_1**2 + 40.1 * v_x**2)
    stored = 0.5 * 35776.0 * (z_1 - z_0) ** 2 + 2.73e5 * numpy.maximum(-z_0, 0.0) ** 2.5 / 2.5
    energy = kinetic + 9.81 * (6.7 * z_0 + 33.4 * z_1) + stored  # lost counts the work on the friction's spring too
    normal, friction = forces[:, columns.SEAT_NORMAL], forces[:, columns.SEAT_TANGENTIAL]
    slips = numpy.abs(friction[normal > 0.0]) == 0.35 * normal[normal > 0.0]
    assert 0.2 < slips.mean() < 0.8, "the case does not stick and slip"
    assert supplied - lost == pytest.approx(energy - energy[0], abs=1e-7 * lost[-1])


def test_an_absent_loss_gives_the_bits_of_a_rig_written_by_hand_without_it():
    _with_loss, absent, by_hand = rigs()
    assert isinstance(by_hand, HandWritten)
    assert bounce(absent)[0].tobytes() == bounce(by_hand)[0].tobytes()


def test_a_loss_that_is_there_changes_the_motion():
    with_loss, absent, _by_hand = rigs()
    assert bounce(with_loss)[0].tobytes() != bounce(absent)[0].tobytes()


def test_a_loss_of_strength_zero_gives_the_motion_without_loss():
    law = NormalElastic(1.0e5, 1.5)
    times, scale, start = numpy.linspace(0.0, 2.0, 21), numpy.array([1e-3, 1.0]) * 1e-9, numpy.array([0.02, 0.0])
    absent = integrate(PointContact(1.0, 9.81, 0.0, 0.0, law, None), start, scale, times)
    zero = integrate(PointContact(1.0, 9.81, 0.0, 0.0, law, NormalDissipative(0.0)), start, scale, times)
    assert absent.states.tobytes() == zero.states.tobytes()
