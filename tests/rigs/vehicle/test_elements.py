"""Masses and elements: the energies of each element are those of its forces, and closed forms of two masses on one."""

import math

import numpy
import pytest

from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import Contact, Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.effects.suspension_kernel import DryFriction, Strut
from contact_sim_pkg.rigs.vehicle.effects.travel_stops_kernel import TravelStops
from contact_sim_pkg.rigs.vehicle.motion import elements, entries
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES
from contact_sim_pkg.rigs.vehicle.motion.ends import Pan
from contact_sim_pkg.rigs.vehicle.motion.ground import Ground
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass, accelerate
from contact_sim_pkg.rigs.vehicle.motion.mount import HeldAxle, Slide
from contact_sim_pkg.rigs.vehicle.motion.parameters import Back, Leaning, MasslessNode, Seat, Seated, Softening, Vehicle
from contact_sim_pkg.rigs.vehicle.motion.road import AsperityPush, RoadContact
from contact_sim_pkg.rigs.vehicle.motion.spring import DriveLine, ShakenMass, Spring
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count

MASSES = (Mass(0, 40.0), Mass(2, 300.0))
ON_ROAD = Contact(NormalElastic(4e6, 1.5), NormalDissipative(0.05), None)
STOP = Contact(NormalElastic(2e7, 2.0), NormalDissipative(0.5), None)
CASES = {
    "spring": Spring(0, 2, 2e4, 1500.0),
    "contact": RoadContact(0, ON_ROAD),
    "push": AsperityPush(0),
    "drive line": DriveLine(2, MASSES[1].mass),
    "strut": Strut(0, 2, 600.0, 5e3, 300.0),
    "strut on the floor": Strut(None, 2, 600.0, 5e3, 300.0),
    "lower stop": TravelStops(0, 2, -0.15, 0.2, STOP),
    "upper stop": TravelStops(0, 2, -0.3, -0.17, STOP),
    "friction that holds": DryFriction(0, 2, 4, 0, 40.0, 2e5),
    "shaken mass": ShakenMass(2, MASSES[1].mass),
    "slide": Slide(0, 2000.0),
}
HELD = HeldAxle(0)
MODE = numpy.zeros(1, dtype=numpy.int64)
STATE = numpy.array([-0.012, 0.3, -0.17, -0.4, 1.5e-4])  # the wheel 12 mm in the road, a friction that holds
GROUND = Ground(0.001, 0.2, 0.0, 0.0, 0.0, 3.0, 150.0, 9.81)


def occupant(node=None, softening=None, floor=None):
    """Three masses on two links, the first of them on the cushion."""
    masses = numpy.array([0.0 if node else 6.0, 30.0, 12.0])
    springs = numpy.array([[3.5e4, 5e4], [800.0, 950.0]])
    return Seat(SEATED, masses, numpy.array([[0, 1], [1, 2]]), springs, node, softening, floor)


SEATED = 4  # behind two masses of the table
ON_CUSHION = Contact(NormalElastic(2.7e5, 1.5), NormalDissipative(0.6), None)
RUBS = ON_CUSHION._replace(friction=Friction(2e4, 150.0, 0.4, 0.35))
BEHIND = Contact(NormalElastic(8e4, 1.4), NormalDissipative(0.5), None)
BACK = Back(1, math.sin(0.1), math.cos(0.1), math.sin(0.4), math.cos(0.4), 0.04, 60.0, BEHIND)
SOFTENING = Softening(SEATED + 9, 0.2, 500.0, 0.1, 4.0, numpy.array([-0.012, -0.003]))
SEATS = {
    "in the shaken frame": Seated(occupant(), ON_CUSHION),
    "on the body": Seated(occupant(floor=2), ON_CUSHION),
    "on a pan above the shaken floor": Seated(occupant(floor=Pan(2)), ON_CUSHION),
    "that sticks": Seated(occupant(), RUBS),
    "that softens": Seated(occupant(softening=SOFTENING), ON_CUSHION),
    "with a massless interface": Seated(occupant(node=MasslessNode(800.0)), ON_CUSHION),
    "against a seat back": Leaning(occupant(), RUBS, BACK),
}


def test_each_element_has_a_case():
    cases = (*CASES.values(), *SEATS.values(), HELD)
    assert {type(each) for each in cases} == set(elements._KERNELS)


@pytest.mark.parametrize("name", SEATS)
def test_an_occupant_gains_what_comes_in_less_what_is_lost_and_stored(name):
    """Of masses and weights by hand: kinetic and potential energy of an occupant, and of the body that carries the seat."""
    seated = SEATS[name]
    seat, acting = seated.seat, (seated,)
    ground = GROUND._replace(height=0.0, height_rate=0.0, cushion=0.004, cushion_rate=0.05, acceleration_x=1.7)
    # [wheel, body] [z_0, z_1, z_2, v_0, v_1, v_2] [x, v_x, s] [q]
    state = numpy.array([0.0, 0.0, -0.02, -0.1, -0.045, -0.06, -0.063, 0.2, -0.3, 0.15, 0.01, 0.02, 1e-3, 2.3])
    rate = numpy.zeros_like(state)
    lost, brought, held, kept = elements.act(acting, ground, MODE, state, rate)
    pushed = rate[3]  # by the seat on the body
    brought += elements.finish(acting, ground, state, rate)
    speeds = slice(SEATED + 3, SEATED + 6)
    power = float((seat.masses * state[speeds] * (rate[speeds] + 9.81)).sum()) + pushed * state[3]
    if seated.contact.friction is not None:
        power += seat.masses.sum() * state[SEATED + 7] * rate[SEATED + 7]

    def stored(after):
        moved = rate.copy()
        moved[[2, SEATED, SEATED + 1, SEATED + 2]] = state[[3, SEATED + 3, SEATED + 4, SEATED + 5]]
        moved[speeds], moved[3], moved[SEATED + 7] = 0.0, 0.0, 0.0
        moved = state + after * moved
        there = ground._replace(cushion=ground.cushion + after * ground.cushion_rate)
        _lost, _brought, held, kept = elements.act(acting, there, MODE, moved, numpy.zeros_like(state))
        return held - kept

    storing = (stored(1e-6) - stored(-1e-6)) / 2e-6
    assert power == pytest.approx(brought - lost - storing, rel=1e-6)
    assert abs(power) > 1.0
    assert lost > 0.0
    assert held > kept >= 0.0


def test_energies_of_an_occupant_are_those_of_its_masses():
    seated, state = SEATS["against a seat back"], numpy.arange(14.0)
    kinetic, potential = elements.energies((seated,), 9.81, state)
    assert kinetic == pytest.approx(0.5 * (6.0 * 7.0**2 + 30.0 * 8.0**2 + 12.0 * 9.0**2 + 48.0 * 11.0**2))
    assert potential == pytest.approx(9.81 * (6.0 * 4.0 + 30.0 * 5.0 + 12.0 * 6.0))


@pytest.mark.parametrize("name", CASES)
def test_what_an_element_brings_in_less_what_it_loses_and_stores_is_the_power_of_its_forces(name):
    acting, rate = (CASES[name],), numpy.zeros(5)
    lost, brought, held, kept = elements.act(acting, GROUND, MODE, STATE, rate)
    accelerate(MASSES, 0.0, STATE, rate)
    brought += elements.finish(acting, GROUND, STATE, rate)
    power = sum(mass.mass * STATE[mass.place + 1] * rate[mass.place + 1] for mass in MASSES)

    def stored(after):
        """Energy [J] that is not among the losses, where all moves on with its present velocity for a time [s]."""
        state = STATE + after * numpy.array([STATE[1], 0.0, STATE[3], 0.0, rate[4]])
        ground = GROUND._replace(height=GROUND.height + after * GROUND.height_rate)
        _lost, _brought, held, kept = elements.act(acting, ground, MODE, state, numpy.zeros(5))
        return held - kept

    storing = (stored(1e-6) - stored(-1e-6)) / 2e-6
    assert power == pytest.approx(brought - lost - storing, rel=1e-6)
    assert abs(power) > 10.0
    if "friction" in name:  # its work is counted whole
        assert lost > 0.0 or kept > 0.0
        assert kept == pytest.approx(held)
    else:
        assert lost >= 0.0
        assert kept == 0.0


def test_a_held_axle_stands_whatever_acts_on_it_and_costs_no_energy():
    acting, state, rate = (CASES["spring"], CASES["contact"], HELD), STATE.copy(), numpy.zeros(5)
    state[1] = 0.0  # it begins at rest
    alone = elements.act(acting[:2], GROUND, MODE, state, numpy.zeros(5))
    assert elements.act(acting, GROUND, MODE, state, rate) == alone
    accelerate(MASSES, -9.81, state, rate)
    assert abs(rate[1]) > 1.0
    free = rate[3]
    assert elements.finish(acting, GROUND, state, rate) == 0.0
    assert (rate[0], rate[1], rate[3]) == (0.0, 0.0, free)


def test_two_masses_on_a_spring_in_free_fall_follow_the_closed_form():
    """The centre falls freely, the distance is a damped oscillation of the reduced mass."""
    spring, gravity, length, count = Spring(0, 2, 2e4, 300.0), 9.81, 1e-3, 400
    rig = Vehicle(gravity, MASSES, (spring,))
    state = numpy.array([0.05, 0.0, 0.0, 0.0, 0.0, 0.0])
    scale = numpy.array([1e-11, 1e-10, 1e-11, 1e-10, numpy.inf, numpy.inf])
    flat, still, work = numpy.zeros(count + 1), (None, None), make_workspace(6, event_count(rig))
    samples = numpy.zeros((count, 6)), numpy.zeros((count, 6)), numpy.zeros((count, FORCES))
    before = numpy.array(entries.energies(rig, MODE, state, 0.0, 0.0))
    entries.start(rig, MODE, state, work, length, flat[:2], flat[:2], flat[:2], flat[:2], None, still)
    status = entries.advance(
        rig, MODE, state, scale, work, 0.0, length, flat, flat, flat, flat, None, still, 1, 0, *samples
    )
    assert status == 0
    time, (light, heavy) = length * numpy.arange(count), (each.mass for each in MASSES)
    reduced = light * heavy / (light + heavy)
    fades = spring.damping / (2.0 * reduced)
    turns = numpy.sqrt(spring.stiffness / reduced - fades**2)
    distance = 0.05 * numpy.exp(-fades * time) * (numpy.cos(turns * time) + fades / turns * numpy.sin(turns * time))
    centre = 0.05 * light / (light + heavy) - 0.5 * gravity * time**2
    states = samples[0]
    assert states[:, 0] - states[:, 2] == pytest.approx(distance, abs=1e-9)
    assert (light * states[:, 0] + heavy * states[:, 2]) / (light + heavy) == pytest.approx(centre, abs=1e-9)
    kinetic, potential, stored, supplied, lost = numpy.array(entries.energies(rig, MODE, state, 0.0, 0.0)) - before
    assert supplied == 0.0
    assert kinetic + potential + stored == pytest.approx(-lost, rel=1e-8)
