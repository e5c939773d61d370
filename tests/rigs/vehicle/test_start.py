"""A travel that begins on a slope: the whole rig begins with the slope's vertical speed."""

from types import SimpleNamespace

import numpy
import pytest
from tests.rigs.vehicle.test_coupling import STANDING, run
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.excitation.blocks import AHEAD, RoadBlocks
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.rigs.vehicle.run.drive import rate_at_start
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.sources import make_road, make_sources

SPEED, SLOPE = 10.0, 0.05
RAMP = "road={{kind: step, position: 0.0, height: {}, length: 10.0}}"  # that the wheel stands in the middle of


@pytest.mark.parametrize("height", [0.5, -0.5])
def test_on_a_slope_the_load_is_that_at_rest_from_the_start_on(height):
    force, _costs = run(RAMP.format(height), f"travel={{speed: {SPEED}}}", "duration=0.4")
    assert numpy.abs(force / STANDING - 1.0).max() < 0.01


def test_a_file_that_begins_on_a_slope_does_so_as_well(tmp_path):
    (tmp_path / "x_z.csv").write_text("x [m],z [m]\n0,0\n20,1.0\n")
    force, _costs = run(
        f"road={{kind: profile, file: {tmp_path / 'x_z.csv'}}}", f"travel={{speed: {SPEED}}}", "duration=0.4"
    )
    assert numpy.abs(force / STANDING - 1.0).max() < 0.01


def test_wheel_body_and_occupant_of_a_car_begin_with_the_speed_of_the_slope():
    scene = resolved("car_full_bench", "duration=0.2", RAMP.format(0.5), f"travel.speed={SPEED}", "vibration=null")
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    forces = {"tire/force": [], "seat/force": []}
    for block in range(simulation.blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        for topic, _stamp, data in result.messages:
            if topic in forces:
                forces[topic].append(decode(ContactForce, data).normal)
    for normal in map(numpy.concatenate, forces.values()):
        assert numpy.abs(normal / normal[0] - 1.0).max() < 0.01
    seat = simulation.model.rig.seat
    rates = [1, 3, *range(seat.offset + len(seat.masses), seat.offset + 2 * len(seat.masses))]
    numpy.testing.assert_allclose(simulation._coupling.bodies.state[rates], SLOPE * SPEED, rtol=0.02)


ROADS = {
    "up": (lambda x: SLOPE * x, SLOPE),
    "down": (lambda x: -0.03 * x, -0.03),
    "even before a bump": (
        lambda x: 0.03 * (numpy.abs(x - 1.0) < 0.3) * numpy.cos(numpy.pi * (x - 1.0) / 0.6) ** 2,
        0.0,
    ),
    "a long wave": (lambda x: 0.1 * numpy.sin(2.0 * numpy.pi * x / 60.0), 0.1 * 2.0 * numpy.pi / 60.0),
    "short waves": (lambda x: 2e-3 * numpy.sin(2.0 * numpy.pi * x / 0.25), 0.0),
    "uphill, but down here": (lambda x: SLOPE * x - 0.02 * numpy.sin(2.0 * numpy.pi * x / 0.5), 0.0),
}


@pytest.mark.parametrize("kind", ROADS)
def test_the_speed_is_that_of_the_slope_as_far_as_the_road_goes_on_so(kind):
    """The line through 2 m of the road ahead: short waves leave nothing of their slope, the long one lacks 0.7 %."""
    height, slope = ROADS[kind]
    scene = resolved("tire_bump", "effects.tire.contact_field=null")
    model, given, travel = Simulation(scene).model, make_road(scene), Travel([(0.0, SPEED)])
    surface = SimpleNamespace(heights=lambda x, y: numpy.repeat(height(x)[:, None], len(y), axis=1))
    blocks = RoadBlocks(surface, travel, 0.01, given.cell_x, given.cell_y, given.half_length, given._y.size)
    x = 1e-4
    local = SPEED * float(numpy.diff(height(numpy.array([-x, x])))[0]) / (2.0 * x)
    found = rate_at_start(model, travel, blocks.block(0), local, 0.0)
    assert found == pytest.approx(SPEED * slope, abs=0.01 * SPEED * SLOPE)
    # Without the way ahead, as from another sender, the rig stands.
    assert rate_at_start(model, travel, blocks.block(1), local, 0.01) == 0.0
    assert blocks.block(0).height.shape[0] * given.cell_x > SPEED * AHEAD
