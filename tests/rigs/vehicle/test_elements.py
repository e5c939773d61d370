"""Masses and elements: the energies of each element are those of its forces, and closed forms of two masses on one."""

import numpy
import pytest

from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.effects.suspension_kernel import DryFriction, ShakenMass, Strut
from contact_sim_pkg.rigs.vehicle.effects.travel_stops_kernel import TravelStops
from contact_sim_pkg.rigs.vehicle.motion import elements, entries
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES
from contact_sim_pkg.rigs.vehicle.motion.ground import Ground
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass, accelerate, clear
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle
from contact_sim_pkg.rigs.vehicle.motion.road import AsperityPush, RoadContact
from contact_sim_pkg.rigs.vehicle.motion.spring import DriveLine, Spring
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
}
MODE = numpy.zeros(1, dtype=numpy.int64)
STATE = numpy.array([-0.012, 0.3, -0.17, -0.4, 1.5e-4])  # the wheel 12 mm in the road, a friction that holds
GROUND = Ground(0.001, 0.2, 0.0, 0.0, 0.0, 3.0, 150.0)


def test_each_element_has_a_case():
    assert {type(each) for each in CASES.values()} == set(elements._KERNELS)


@pytest.mark.parametrize("name", CASES)
def test_what_an_element_brings_in_less_what_it_loses_and_stores_is_the_power_of_its_forces(name):
    acting, rate = (CASES[name],), numpy.zeros(5)
    clear(MASSES, rate)
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


def test_two_masses_on_a_spring_in_free_fall_follow_the_closed_form():
    """The centre falls freely, the distance is a damped oscillation of the reduced mass."""
    spring, gravity, length, count = Spring(0, 2, 2e4, 300.0), 9.81, 1e-3, 400
    rig = Vehicle(gravity, MASSES, (spring,), None, None)
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
