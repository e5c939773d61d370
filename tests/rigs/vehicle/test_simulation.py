"""The simulation by blocks: balance at rest, the field as the contact, energy, refusals."""

import numpy
import pytest
import scipy.signal
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger, SeatResponse
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_sources

GRAVITY = 9.81


def messages_of(scene, blocks=None):
    """All messages of a run as {topic: [bytes]}."""
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    found = {}
    for block in range(simulation.blocks if blocks is None else blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        for topic, _stamp, data in result.messages:
            found.setdefault(topic, []).append(data)
    return found


@pytest.fixture(scope="module")
def car():
    """A second of the full bench, both fields on."""
    return messages_of(resolved("car_full_bench", "duration=1.0"))


@pytest.mark.parametrize("contact", ["tire", "seat"])
def test_the_force_that_drives_the_bodies_is_the_integral_of_the_published_pressure(car, contact):
    for force_data, patch_data in zip(car[f"{contact}/force"], car[f"{contact}/patch"], strict=True):
        force, patch = decode(ContactForce, force_data), decode(ContactPatch, patch_data)
        integral = patch.pressure.astype(float).sum() * patch.cell_x * patch.cell_y
        assert integral == pytest.approx(force.normal[0], rel=1e-6)
        assert patch.pressure.min() >= 0.0


@pytest.mark.parametrize("contact", ["tire", "seat"])
def test_the_approaches_of_force_and_field_differ_by_the_effective_height(car, contact):
    for force_data, patch_data in zip(car[f"{contact}/force"], car[f"{contact}/patch"], strict=True):
        force, patch = decode(ContactForce, force_data), decode(ContactPatch, patch_data)
        assert patch.approach == pytest.approx(force.approach[0] - force.effective_height[0], abs=1e-15)


def test_the_wheel_accelerates_by_the_published_forces_alone(car):
    """Newton's second law on the wheel from published numbers: m a = F_tire - m g - F_suspension."""
    for force_data, motion_data in zip(car["tire/force"], car["bench/motion"], strict=True):
        force, motion = decode(ContactForce, force_data), decode(BodyMotion, motion_data)
        wheel, body = motion.bodies.index("wheel_z"), motion.bodies.index("body_z")
        spring = 20000.0 * (motion.position[wheel] - motion.position[body])
        damper = 1500.0 * (motion.velocity[wheel] - motion.velocity[body])
        expected = (force.normal - spring - damper) / 40.0 - GRAVITY
        assert motion.acceleration[wheel] == pytest.approx(expected, abs=1e-8)


def test_the_response_of_the_seat_in_a_car_is_over_its_body(car):
    """Against scipy, by the published accelerations: segments of 0.222 s in a second."""
    motions = [decode(BodyMotion, data) for data in car["bench/motion"]]
    acceleration = dict(zip(motions[0].bodies, numpy.hstack([each.acceleration for each in motions]), strict=True))
    last = decode(SeatResponse, car["seat/response"][-1])
    given = {"fs": 1000.0, "nperseg": 222}
    _, cross = scipy.signal.csd(acceleration["body_z"], acceleration["seat_frame_z"], **given)
    _, power = scipy.signal.welch(acceleration["body_z"], **given)
    assert (len(car["seat/response"]), last.segments) == (7, 8)
    found = last.transmissibility * numpy.exp(1j * last.transmissibility_phase)
    numpy.testing.assert_allclose(found, (cross / power)[1 : 1 + len(last.frequency)], rtol=1e-9)


def test_energy_supplied_is_found_again(car):
    last = decode(EnergyLedger, car["bench/energy"][-1])
    dissipated = [decode(EnergyLedger, data).dissipated for data in car["bench/energy"]]
    assert abs(last.residual) <= 1e-5 * last.dissipated
    assert numpy.all(numpy.diff(dissipated) >= 0.0)


def test_a_car_on_a_flat_road_stands_still_under_its_weight():
    scene = resolved("car_full_bench", "duration=0.2", "road={kind: flat}", "vibration.amplitude=0.0")
    found = messages_of(scene)
    weight = (40.0 + 300.0 + 6.7 + 33.4 + 10.7) * GRAVITY
    for data in found["tire/force"]:
        assert decode(ContactForce, data).normal == pytest.approx(numpy.full(10, weight), rel=1e-2)
    for data in found["bench/motion"]:
        assert numpy.abs(decode(BodyMotion, data).velocity).max() < 5e-3


def test_the_same_scene_gives_the_same_bytes_twice():
    scene = resolved("car_full_bench", "duration=0.3")
    first, second = messages_of(scene), messages_of(scene)
    for topic, data in first.items():
        if topic != "bench/cost":
            assert data == second[topic], topic


def test_a_seat_scene_asks_for_no_road():
    assert Simulation(resolved("seat_ride")).inputs == ("platform/vibration",)


def test_a_block_out_of_turn_is_named():
    scene = resolved("seat_ride", "duration=0.1")
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    with pytest.raises(RunError, match="block 1 came, block 0 was due"):
        simulation.advance(1, {topic: source.block(1) for topic, source in sources.items()})


def test_a_missing_input_is_named():
    simulation = Simulation(resolved("seat_ride", "duration=0.1"))
    simulation.prepare()
    with pytest.raises(RunError, match="platform/vibration: block 0 with 11 samples was due, none came"):
        simulation.advance(0, {})


def test_a_height_that_is_no_number_is_named_by_its_cell():
    simulation, sources = Simulation(scene := resolved("tire_bump", "duration=0.1")), make_sources(scene)
    simulation.prepare()
    patch = sources["road/patch"].block(0)
    height = patch.height.copy()
    height[5, 7] = numpy.nan
    with pytest.raises(RunError, match="road/patch: block 0 has the height nan at row 5, column 7"):
        simulation.advance(0, {"road/patch": patch._replace(height=height)})


def test_contact_beyond_both_grids_ends_the_run_with_its_cause():
    short = ("effects.tire.contact_field.length=0.05", "road={kind: pothole, position: 10, depth: 0.03, length: 0.6}")
    outcome = run_offline(resolved("tire_half_space", "duration=1.1", *short), None)
    assert 0 < outcome.blocks < 110
    assert "the contact reaches the edge of the grid" in outcome.failure
    assert "see effects.tire.contact_field" in outcome.failure


def test_an_effect_that_is_off_leaves_every_bit_of_the_others():
    """Friction acts along x; the vertical motion of a scene without it must not know."""
    without = messages_of(resolved("seat_ride", "duration=0.5"))
    with_friction = messages_of(resolved("seat_ride", "duration=0.5", "effects.seat.friction={}"))
    for bare, rubbed in zip(without["seat/force"], with_friction["seat/force"], strict=True):
        assert numpy.array_equal(decode(ContactForce, bare).normal, decode(ContactForce, rubbed).normal)
