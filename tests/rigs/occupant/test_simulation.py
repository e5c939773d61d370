"""An occupant on a pan and against a seat back: one trunk, its weight shared by both, and the maps of both."""

import math

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger
from contact_sim_pkg.rigs.occupant.model import back_cushion, build_occupant
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import matrices
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.run.sources import make_sources

FORWARD = ("vibration={kind: sine, axis: x, frequency: 5.25, amplitude: 25}", "duration=0.6")
DROP = ("vibration={kind: half_sine, axis: z, amplitude: -40, duration: 0.1, start: 0.05}", "duration=0.6")
STILL = "vibration={kind: sine, frequency: 4, amplitude: 0}"


def messages_of(scene):
    """Every message by topic."""
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    found = {topic: [] for topic in result_topics(scene)}
    for block in range(simulation.blocks):
        given = {topic: source.block(block) for topic, source in sources.items()}
        for topic, _stamp, data in simulation.advance(block, given).messages:
            found[topic].append(data)
    return found


@pytest.fixture(scope="module")
def shaken():
    return messages_of(resolved("seat_ride_full", *FORWARD))


@pytest.fixture(scope="module")
def dropped():
    return messages_of(resolved("seat_ride_full", *DROP))


def forces(found, contact):
    return numpy.concatenate([decode(ContactForce, data).normal for data in found[f"{contact}/force"]])


@pytest.mark.parametrize("contact", ["seat", "backrest"])
def test_a_map_is_one_sided_and_its_integral_is_the_force(shaken, dropped, contact):
    for found in (shaken, dropped):
        force = forces(found, contact)
        fields = [decode(ContactPatch, data) for data in found[f"{contact}/patch"]]
        every = len(force) // len(fields)
        for number, field in enumerate(fields):
            pressure = field.pressure.astype(float)
            assert (pressure >= 0.0).all()
            expected = pytest.approx(force[number * every], rel=1e-6)
            assert pressure.sum() * field.cell_x * field.cell_y == expected
            assert field.load == expected


def at_rest(tilt, angle, *values):
    """Forces [N] of pan and seat back on 57 kg at rest, at the first and the last sample of 0.1 s."""
    degrees = (f"seat.pan_tilt={math.radians(tilt)}", f"backrest.angle={math.radians(angle)}")
    found = outputs_of("seat_ride_full", 0.1, "seat.occupant.mass=57", *degrees, STILL, *values)
    return [
        [record.normal[place] for place, record in ((0, records[0]), (-1, records[-1]))]
        for records in (records_of(found, "seat/force"), records_of(found, "backrest/force"))
    ]


@pytest.mark.parametrize(("tilt", "angle", "pan", "back"), [(10, 22, 530, 99), (12, 22, 526, 118), (16, 25, 513, 156)])
@pytest.mark.parametrize("model", ["wei_griffin_2", "boileau_rakheja", "inert_75"])
def test_pan_and_seat_back_share_the_weight_of_one_trunk(tilt, angle, pan, back, model):
    on_pan, on_back = at_rest(tilt, angle, f"seat.occupant.model={model}")
    assert on_pan == pytest.approx([pan, pan], abs=0.6)
    assert on_back == pytest.approx([back, back], abs=0.6)
    for normal, leaning in zip(on_pan, on_back, strict=True):
        upward = normal * math.cos(math.radians(tilt)) + leaning * math.sin(math.radians(angle))
        assert upward == pytest.approx(57.0 * GRAVITY, rel=1e-9)


def test_on_a_level_pan_an_upright_seat_back_carries_the_push_of_the_feet_and_no_weight():
    on_pan, on_back = at_rest(0.0, 0.0, "backrest.preload=80")
    assert on_pan == pytest.approx([57.0 * GRAVITY] * 2, rel=1e-9)
    assert on_back == pytest.approx([80.0] * 2, rel=1e-9)


LINEAR = (
    "effects={seat: {normal_elastic: {coefficient: 5e4, exponent: 1}, "
    "general_dissipative: {coefficient: 500, approach_exponent: 0}}, "
    "backrest: {normal_elastic: {coefficient: 2e4, exponent: 1}, "
    "general_dissipative: {coefficient: 300, approach_exponent: 0}}}"
)


def closed_motion(model, trunk, frequency, tilt, angle, axis):
    """Phasors of (z_0 .. z_n, x) relative to the floor per unit acceleration of it along ``axis``, by one mass, damping
    and stiffness matrix of the whole.
    """
    own = matrices(model)
    count = len(model.masses)
    mass, damping, stiffness = (numpy.zeros((count + 1, count + 1)) for _ in range(3))
    mass[:count, :count], mass[count, count] = own.mass, model.mass
    damping[:count, :count], stiffness[:count, :count] = own.damping, own.stiffness
    pan, back = numpy.zeros(count + 1), numpy.zeros(count + 1)
    pan[0], pan[count] = math.cos(tilt), -math.sin(tilt)
    back[trunk] += math.sin(angle)
    back[count] = math.cos(angle)
    for direction, k, c in ((pan, 5e4, 500.0), (back, 2e4, 300.0)):
        stiffness += k * numpy.outer(direction, direction)
        damping += c * numpy.outer(direction, direction)
    w = 2.0 * math.pi * frequency
    floor = numpy.ones(count + 1)
    floor[:count], floor[count] = (1.0, 0.0) if axis == "z" else (0.0, 1.0)
    return numpy.linalg.solve(stiffness + 1j * w * damping - w**2 * mass, -mass @ floor)


@pytest.mark.parametrize("axis", ["x", "z"])
@pytest.mark.parametrize(("name", "trunk"), [("wei_griffin_2", 1), ("boileau_rakheja", 3), ("iso_5982", 3)])
def test_linear_pan_and_seat_back_move_the_occupant_as_one_mass_matrix_says(name, trunk, axis):
    frequency, tilt, angle = 4.0, 0.21, 0.384
    shake = f"vibration={{kind: sine, axis: {axis}, frequency: {frequency}, amplitude: 0.5}}"
    found = outputs_of("seat_ride_full", 8.0, f"seat.occupant.model={name}", shake, LINEAR)
    motions = records_of(found, "bench/motion")
    position = numpy.hstack([record.position for record in motions])
    bodies, period = list(motions[0].bodies), motions[0].sample_period
    first = position.shape[1] - round(2.0 / period)
    turning = numpy.exp(-2j * math.pi * frequency * numpy.arange(first, position.shape[1]) * period)
    phasors = 2j * (position[:, first:] * turning).mean(axis=1) / 0.5
    rows = [number for number, body in enumerate(bodies) if body not in ("floor_z", "seat_back_x")]
    expected = closed_motion(OCCUPANTS[name], trunk, frequency, tilt, angle, axis)
    assert abs(phasors[rows] - expected).max() <= 2e-3 * abs(expected).max()


def test_the_occupant_of_a_dropped_seat_leaves_pan_and_back_and_comes_down(dropped):
    assert (forces(dropped, "seat") == 0.0).any()
    assert (forces(dropped, "backrest") == 0.0).any()
    assert forces(dropped, "seat")[-1] > 100.0
    assert min(forces(dropped, "seat").min(), forces(dropped, "backrest").min()) == 0.0


def test_the_back_leaves_a_seat_shaken_forward(shaken):
    assert (forces(shaken, "backrest") == 0.0).any()
    assert forces(shaken, "backrest").max() > 500.0


@pytest.mark.parametrize(
    ("values", "allowed"),
    [
        ((), 1e-6),
        (("seat.occupant.model=wan_schimmels",), 1e-6),
        (("effects.seat.friction={}",), 1e-6),
        (("effects.seat.softening={least: 0.01, most: 100}",), 1e-6),
        # its usual limits are corners of the stiffness, which no event locates
        (("effects.seat.softening={}",), 1e-5),
    ],
)
@pytest.mark.parametrize("drive", [FORWARD, DROP])
def test_energy_is_kept_by_pan_back_and_occupant_together(values, allowed, drive):
    found = messages_of(resolved("seat_ride_full", *drive, *values, "integrator.relative_tolerance=1e-7"))
    motion = decode(BodyMotion, found["bench/motion"][0])
    assert (motion.bodies[0], *motion.bodies[-2:]) == ("floor_z", "seat_back_x", "occupant_x")
    ledgers = [decode(EnergyLedger, data) for data in found["bench/energy"]]
    supplied = max(abs(each.supplied) for each in ledgers)
    assert supplied > 10.0
    assert max(abs(each.residual) for each in ledgers) <= allowed * supplied


@pytest.mark.parametrize(("name", "trunk"), [("wei_griffin_2", 1), ("iso_5982", 3), ("inert_75", 0)])
def test_the_heaviest_mass_leans(name, trunk):
    scene = resolved("seat_ride_full", f"seat.occupant.model={name}")
    assert build_occupant(scene, back_cushion(scene)).rig.back.trunk == trunk


def test_densification_stops_an_occupant_who_falls_back():
    with_it = messages_of(resolved("seat_drop", "duration=0.8"))
    without = messages_of(resolved("seat_drop", "duration=0.8", "effects.seat.cushion.densification=0"))
    depths = [
        max(decode(ContactForce, data).approach.max() for data in found["seat/force"]) for found in (with_it, without)
    ]
    assert (forces(with_it, "seat") == 0.0).any()
    assert 0.6 * 0.1 < depths[0] < min(0.75 * 0.1, depths[1] - 0.002)
