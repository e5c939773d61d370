"""A mass on spring, damper, dry friction and stops against closed forms and scipy; rest, and SEAT with a suspension."""

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.friction import STICK
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative, NormalElastic
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.acting import Acting, Joined
from contact_sim_pkg.rigs.vehicle.effects import bump_stop_kernel
from contact_sim_pkg.rigs.vehicle.effects.suspension_kernel import DryFriction, Strut
from contact_sim_pkg.rigs.vehicle.effects.travel_stops_kernel import TravelStops
from contact_sim_pkg.rigs.vehicle.model import build, standing_state
from contact_sim_pkg.rigs.vehicle.motion import entries
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count
from contact_sim_pkg.rigs.vehicle.seat.report.metrics import seat_metrics
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.errors import SceneError

MASS, GRAVITY, STIFFNESS = 75.0, 9.81, 5000.0
WEIGHT, TURNS = MASS * GRAVITY, numpy.sqrt(STIFFNESS / MASS)
STOP = Contact(NormalElastic(2e7, 2.0), NormalDissipative(0.8), None)


def moved(elements, start, seconds, states=3, mode=0):
    """Times [s], states [samples, states], the mode of a friction and the change of the energies [J] of one mass."""
    rig, length, count = Vehicle(GRAVITY, (Mass(0, MASS),), elements), 1e-3, round(1e3 * seconds)
    state, mode = numpy.zeros(states + 2), numpy.array([0, mode], dtype=numpy.int64)
    state[: len(start)] = start
    scale = numpy.array([1e-11, 1e-10, *[1e-11] * (states - 2), numpy.inf, numpy.inf])
    flat, still, work = numpy.zeros(count + 1), (None, None), make_workspace(states + 2, event_count(rig))
    samples = tuple(numpy.zeros((count, width)) for width in (states + 2, states + 2, FORCES))
    before = numpy.array(entries.energies(rig, mode, state, 0.0, 0.0))
    entries.start(rig, mode, state, work, length, flat[:2], flat[:2], flat[:2], flat[:2], None, still)
    status = entries.advance(
        rig, mode, state, scale, work, 0.0, length, flat, flat, flat, flat, None, still, 1, 0, *samples
    )
    assert status == 0
    change = numpy.array(entries.energies(rig, mode, state, 0.0, 0.0)) - before
    return length * numpy.arange(count), samples[0], mode[1], change


@pytest.mark.parametrize("ratio", [0.0, 0.3])
def test_natural_frequency_and_damping_are_those_of_the_closed_form(ratio):
    damping = 2.0 * ratio * numpy.sqrt(STIFFNESS * MASS)
    time, states, _mode, _change = moved((Strut(None, 0, WEIGHT, STIFFNESS, damping),), [0.02], 2.0, states=2)
    fades, turns = ratio * TURNS, TURNS * numpy.sqrt(1.0 - ratio**2)
    expected = 0.02 * numpy.exp(-fades * time) * (numpy.cos(turns * time) + fades / turns * numpy.sin(turns * time))
    assert states[:, 0] == pytest.approx(expected, abs=0.02e-6)


@pytest.mark.parametrize(("share", "holds"), [(0.999, True), (1.001, False)])
def test_friction_locks_below_its_breakaway_force(share, holds):
    """Under a share of what friction and spring hold together, 1 + k/k_t times its force, the mass moves as the spring of
    the friction yields, and no further; beyond, the strut moves it until its spring takes what friction cannot hold.
    """
    force, spring = 40.0, 4e5
    push = share * (1.0 + STIFFNESS / spring) * force
    damping, seconds = (4e4, 2.0) if holds else (9000.0, 25.0)  # so much that nothing swings, and long enough
    strut, friction = Strut(None, 0, WEIGHT + push, STIFFNESS, damping), DryFriction(None, 0, 2, 1, force, spring)
    _time, states, mode, _change = moved((strut, friction), [0.0], seconds)
    if holds:
        assert states[-1, 0] == pytest.approx(push / (STIFFNESS + spring), rel=1e-6)
        assert mode == STICK
    else:
        assert states[-1, 0] == pytest.approx((push - force) / STIFFNESS, rel=1e-5)
        assert states[-1, 0] > 1.0008 * force / spring  # where it would have held


def test_a_slide_ends_where_the_closed_form_does_and_holds_there():
    """Sliding, the mass swings about a place that friction shifts by F / k; where it comes to rest friction holds."""
    force, spring, speed = 40.0, 4e7, 0.3
    elements = (Strut(None, 0, WEIGHT, STIFFNESS, 0.0), DryFriction(None, 0, 2, 1, force, spring))
    shift = force / STIFFNESS
    ends = numpy.arctan(speed / (TURNS * shift)) / TURNS
    time, states, _mode, change = moved(elements, [0.0, speed, force / spring], 0.2, mode=1)
    slides = time < ends
    expected = shift * (numpy.cos(TURNS * time) - 1.0) + speed / TURNS * numpy.sin(TURNS * time)
    assert states[slides, 0] == pytest.approx(expected[slides], abs=1e-9)
    turned = numpy.hypot(shift, speed / TURNS) - shift
    assert turned * STIFFNESS > force  # the spring is stronger: it slides back
    kinetic, potential, stored, supplied, lost = change
    assert kinetic + potential + stored - supplied + lost == pytest.approx(0.0, abs=1e-8)
    assert lost > force * turned


def test_a_mass_that_is_dropped_on_the_end_stops_keeps_the_books_and_moves_as_by_scipy():
    travel = 0.05
    elements = (Strut(None, 0, WEIGHT, STIFFNESS, 300.0), TravelStops(None, 0, -travel, travel, STOP))
    time, states, _mode, change = moved(elements, [0.04, -2.0], 1.0, states=2)

    def rate(_time, state):
        height, speed = state
        force = -STIFFNESS * height - 300.0 * speed
        for deep, closing, way in ((-travel - height, -speed, 1.0), (height - travel, speed, -1.0)):
            force += way * 2e7 * max(deep, 0.0) ** 2 * max(0.0, 1.0 + 0.8 * closing)
        return [speed, force / MASS]

    exact = solve_ivp(
        rate, (0.0, 1.0), [0.04, -2.0], t_eval=time, method="DOP853", rtol=1e-12, atol=1e-12, max_step=1e-4
    )
    assert states[:, 0] == pytest.approx(exact.y[0], abs=1e-8)
    assert exact.y[0].min() < -travel - 5e-3  # it goes well into the lower stop
    kinetic, potential, stored, supplied, lost = change
    assert supplied == 0.0
    assert kinetic + potential + stored + lost == pytest.approx(0.0, abs=1e-8 * lost)
    assert lost > 50.0


BARE = ("vibration={kind: sine, frequency: 2, amplitude: 0}", "duration=0.5", "accuracy=1e-4")


def recorded(tmp_path, name, *values):
    assert run_offline(resolved(name, *values), tmp_path / name).failure == ""
    return read_recording(open_bag(tmp_path / name))


def test_a_seat_that_rests_on_its_lower_stop_stays_there(tmp_path):
    """Its spring carries 300 N of the weight; the stop carries the rest where the forces balance."""
    values = ("effects.seat.suspension={preload: 300, friction: 0}", *BARE)
    motion = recorded(tmp_path, "suspension_seat", *values).motion
    weight = (50.8 + 15.0) * GRAVITY

    def left(height):
        return 300.0 - 4500.0 * height + 2000.0 * (max(0.0, -0.05 - height) / 0.01) ** 2 - weight

    height = motion.position["suspension_z"]
    assert height[0] == pytest.approx(brentq(left, -0.2, 0.0, xtol=1e-15), abs=1e-9)
    assert height[0] < -0.05
    for each in motion.position.values():
        assert abs(each - each[0]).max() < 1e-7


def test_a_run_that_lies_on_its_stop_hits_it_once(tmp_path):
    recording = recorded(tmp_path, "suspension_seat", "effects.seat.suspension={preload: 300, friction: 0}", *BARE)
    found = {metric.key.rpartition(".")[2]: metric for metric in seat_metrics(recording)}
    assert found["stop_hits"].value == 1.0
    assert found["travel_used"].remark.endswith("on a stop for 100 % of the run")


@pytest.mark.parametrize(
    ("brought", "sentence"),
    [
        (
            Acting(((1.0, 2.0),)),
            r"effects.tire.bump_stop: brings an element of the class tuple, which is not registered",
        ),
        (Acting((), (Joined("lump", Mass(0, 1.0), (1.0, 1.0)),)), "named lump, a name that ends in _z is needed"),
        (Acting((), 2 * (Joined("lump_z", Mass(0, 1.0), (1.0, 1.0)),)), "named lump_z, as another effect does"),
    ],
)
def test_what_no_vehicle_can_hold_is_refused_by_the_effect_that_brings_it(monkeypatch, brought, sentence):
    monkeypatch.setattr(bump_stop_kernel, "bump_stop", lambda keys, chassis: brought)
    with pytest.raises(SceneError, match=sentence):
        build(resolved("tire_bump", "effects.tire.bump_stop={}"))


@pytest.mark.parametrize("bump", [0.08, -0.03])
def test_a_car_whose_bump_stop_is_engaged_at_rest_stays_at_rest(tmp_path, bump):
    values = (f"effects.tire.bump_stop={{bump: {bump}}}", "road={kind: flat}", "duration=0.5")
    motion = recorded(tmp_path, "tire_bump", *values).motion
    hangs = motion.position["body_z"][0] - motion.position["wheel_z"][0] + 300.0 * GRAVITY / 20000.0

    def left(height):
        return -20000.0 * height + 6000.0 * (max(0.0, -bump - height) / 0.03) ** 2

    assert hangs == pytest.approx(brentq(left, -1.0, 1.0, xtol=1e-15), abs=1e-8)
    for each in motion.position.values():
        assert abs(each - each[0]).max() < 2e-5
    assert abs(motion.velocity["body_z"]).max() < 2e-4


def test_rest_does_not_depend_on_what_is_not_there():
    """The bits of a car without effects between its masses are those of a chain of springs."""
    plain, with_stops = (build(resolved("car_ride", *values)) for values in ((), ("effects.tire.bump_stop={}",)))
    one, other = (standing_state(model, 0.01) for model in (plain, with_stops))
    assert one == pytest.approx(other, abs=1e-10)


def test_the_suspension_isolates_where_the_cushion_alone_does_not(tmp_path):
    """SEAT over the spectrum EM3 of ISO 7096."""
    factors = []
    for number, more in enumerate(((), ("effects.seat.suspension=null",))):
        (tmp_path / str(number)).mkdir()
        listed = seat_metrics(recorded(tmp_path / str(number), "suspension_seat", "duration=20", *more))
        factors.append({each.key: each.value for each in listed}["seat.factor"])
    assert factors[0] < 85.0
    assert factors[1] > 100.0


def test_a_car_on_both_suspensions_closes_its_books(tmp_path):
    values = (
        "effects.tire.bump_stop={bump: 0.01, rebound: 0.01}",
        "effects.seat.suspension={travel: 0.01}",
        "duration=1",
    )
    ledger = recorded(tmp_path, "car_ride", *values).ledger
    size = max(abs(getattr(ledger, name)).max() for name in ("kinetic", "stored", "dissipated", "supplied"))
    assert abs(ledger.residual).max() < 1e-6 * size


def test_a_suspension_under_a_seat_back_and_stops_without_travel_are_refused():
    with pytest.raises(SceneError, match="stands on the floor"):
        resolved("seat_ride_full", "effects.seat.suspension={}")
    with pytest.raises(SceneError, match="leaves no travel"):
        resolved("tire_bump", "effects.tire.bump_stop={bump: -0.02, rebound: 0.01}")
    with pytest.raises(SceneError, match="is a part of"):
        resolved("car_ride", "effects.seat.suspension={upper_mass: 90}", "tire.body_mass=80")
