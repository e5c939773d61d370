"""How often the fields are solved: by the accuracy, the speed and the road, not by the rate of publishing.

The reference of each case solves the fields ten times as often as they are published, by the rate of publishing itself.
"""

from functools import cache
from itertools import pairwise

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import ContactForce, ContactPatch, SolverCost
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.studies.whole_run import whole_run

STANDING = 3335.0  # [N]
ROADS = {
    "kerb": "road={kind: step, position: 3.0, height: -0.1}",
    "pothole": "road={kind: pothole, position: 3.0, depth: 0.05, length: 0.3}",
    "cleat": "road={kind: cleat, position: 3.0, height: 0.01, length: 0.05}",
    "stones": "road={kind: cleat, position: 3.0, height: 0.01, length: 0.02, period: 0.1}",
}


@cache
def run(*sets, scene="tire_bump"):
    """Normal force of the tire at 1 kHz, and costs, of 0.6 s of a scene with other values."""
    scene = resolved(scene, "duration=0.6", *sets)
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    forces, costs = [], []
    for block in range(simulation.blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        for topic, _stamp, data in result.messages:
            if topic == "tire/force":
                forces.append(decode(ContactForce, data).normal)
            elif topic == "bench/cost":
                costs.append(decode(SolverCost, data))
    return numpy.concatenate(forces), costs


@pytest.mark.parametrize("road", ROADS)
def test_the_force_is_that_of_ten_times_as_many_fields(road):
    force, _costs = run(ROADS[road])
    often, _costs = run(ROADS[road], "outputs.field_rate=1000", "integrator.coupling_tolerance=1e-3")
    assert (force - often).std() < 0.01 * STANDING
    assert abs(force.max() / often.max() - 1.0) < 0.015
    assert (force.min() == 0.0) == (often.min() == 0.0)  # lift-off is seen


def test_the_rate_of_publishing_does_not_set_the_force():
    seldom, _costs = run(ROADS["pothole"], "outputs.field_rate=100")
    often, _costs = run(ROADS["pothole"], "outputs.field_rate=500")
    assert (seldom - often).std() < 0.01 * STANDING


SLOW_TREAD = (
    "road={kind: step, position: 3.0, height: 0.04}",
    "effects.tire.tread_viscoelasticity={retardation_time: 0.01, branches: []}",
)


@pytest.mark.parametrize(("force", "field"), [(1000, 100), (4000, 1000), (4000, 2000), (8000, 100)])
def test_the_coupling_steps_of_a_viscoelastic_tread_are_its_own(force, field):
    scene = resolved("tire_bump", *SLOW_TREAD, f"outputs.force_rate={force}", f"outputs.field_rate={field}")
    model = Simulation(scene).model
    assert model.tread.step == pytest.approx(model.coupling.segments * model.timing.segment_length, rel=1e-12)


def test_a_viscoelastic_tread_meets_a_kerb_with_the_same_force_at_every_rate():
    peaks = [run(*SLOW_TREAD, f"outputs.field_rate={rate}")[0].max() for rate in (100, 500, 1000)]
    shorter = run(*SLOW_TREAD, "outputs.field_rate=4000", "outputs.force_rate=4000")[0].max()  # four times as short
    assert peaks == pytest.approx([shorter] * 3, rel=0.06)


def test_a_kerb_is_met_with_the_law_of_a_field_solved_tightly():
    case = ("road={kind: step, position: 3.0, height: 0.08}", "travel={speed: 15}", "duration=0.4")
    tight = ("effects.tire.contact_field.tolerance=1e-5", "integrator.coupling_tolerance=1e-3")
    force, exact = run(*case)[0], run(*case, *tight)[0]
    assert (force - exact).std() < 0.03 * STANDING
    assert force.max() == pytest.approx(exact.max(), rel=0.03)


def test_the_error_follows_the_tolerance():
    exactly = ("effects.tire.contact_field.corrector_passes=6", "effects.tire.contact_field.tolerance=1e-4")
    exact, _costs = run(ROADS["pothole"], "integrator.coupling_tolerance=1e-4", *exactly)
    errors = [
        (run(ROADS["pothole"], f"integrator.coupling_tolerance={tolerance}", *exactly)[0] - exact).std() / STANDING
        for tolerance in (1.0, 1e-1, 1e-2, 1e-3)
    ]
    assert all(later < earlier for earlier, later in pairwise(errors))
    assert errors[1] < 0.1
    assert errors[2] < 0.01


def test_a_flat_road_asks_for_no_more_than_the_footprint_does():
    _force, costs = run("road={kind: flat}")
    assert sum(cost.coupling_steps_repeated for cost in costs) == 0
    assert max(cost.coupling_error for cost in costs) < 5e-3  # what the field solver's tolerance of 1e-2 leaves
    later = costs[10:]  # a run begins with short steps, before any was checked
    assert max(cost.coupling_steps for cost in later) == min(cost.coupling_steps for cost in later) <= 4


def test_a_wheel_that_stands_is_solved_once_a_field():
    _force, costs = run("travel={speed: 0.0}", ROADS["pothole"])
    assert all(cost.coupling_steps == 1 for cost in costs)


def test_coupling_steps_are_shorter_over_an_edge():
    _force, costs = run(ROADS["kerb"])
    assert sum(cost.coupling_steps_repeated for cost in costs) > 0
    assert max(cost.coupling_steps for cost in costs) > min(cost.coupling_steps for cost in costs)


def test_samples_keep_their_instants_where_coupling_steps_end_between_them():
    """At 40 m/s four segments make a sample; with 1000 fields a second each sample starts an interval of its own."""
    fast = "travel={speed: 40.0}"
    force, _costs = run(fast, ROADS["pothole"])
    often, _costs = run(fast, ROADS["pothole"], "outputs.field_rate=1000")
    assert len(force) == len(often) == 600
    assert (force - often).std() < 0.01 * STANDING


@pytest.mark.parametrize("rate", [1000, 4000, 40000])
def test_a_wall_before_the_usual_grid_is_felt_before_it_enters(rate):
    """The far edge of a pothole 0.1 m deep is higher than the tire is at the end of its usual grid (33 mm at 0.14 m)."""
    pothole = ("travel.speed=5", "road={kind: pothole, position: 1.5, depth: 0.1, length: 0.6}")
    usual, costs = run(*pothole, f"outputs.force_rate={rate}")
    large, _costs = run(*pothole, "effects.tire.contact_field.length=0.6", "effects.tire.contact_field.rows=160")
    assert usual.max() == pytest.approx(large.max(), rel=0.02)
    assert usual[:: rate // 1000] == pytest.approx(large, abs=0.1 * large.max())
    assert max(cost.coupling_error for cost in costs) < 0.1


LOSSES = {"default": "{}", "large": "{restitution: 0.5, reference_speed: 1.0}"}


@pytest.mark.parametrize("loss", LOSSES)
def test_the_rate_of_the_forces_does_not_set_their_peak(loss):
    """At 40 kHz a segment is a fraction of a millimetre long: neither nodes of the road nor corrections are felt as speeds."""
    road = "road={kind: pothole, position: 2, depth: 0.05, length: 0.3}"
    effects = (
        f"effects.tire={{normal_elastic: {{young_modulus: 3e6}}, normal_dissipative: {LOSSES[loss]}, "
        "contact_field: {tolerance: 1e-4}}"
    )
    peaks = [
        run("travel.speed=10", road, effects, f"outputs.force_rate={rate}")[0].max() for rate in (1000, 4000, 40000)
    ]
    assert peaks[1] == pytest.approx(peaks[2], rel=0.015)
    assert peaks[0] == pytest.approx(peaks[2], rel=0.035)  # a sample a millisecond need not meet the peak


@pytest.mark.parametrize(("scene", "extent"), [("tire_half_space", r"0\.56"), ("tire_bump", r"0\.54")])
@pytest.mark.parametrize("position", [0.275, 0.29])
def test_a_wall_beyond_both_grids_is_refused_by_name(position, scene, extent):
    """The tire is 0.14 m high or more at 0.29 m: a wall of 0.3 m stands in it."""
    with pytest.raises(
        RunError, match=rf"beyond its pressure grid of {extent} m, .* enlarge effects\.tire\.contact_field\.length"
    ):
        run("travel={speed: 0.0}", f"road={{kind: step, position: {position}, height: 0.3}}", scene=scene)


def test_a_belt_that_yields_beside_the_footprint_keeps_the_usual_grid():
    """The half-space alone would let the fine road touch beyond the grid: the wide one would be solved every time."""
    scene = resolved("tire_texture", "duration=0.05")
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    for block in range(simulation.blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        fields = [decode(ContactPatch, data) for topic, _stamp, data in result.messages if topic == "tire/patch"]
        assert {field.pressure.shape for field in fields} == {(128, 96)}


WALLS = {
    "higher than the axle": ("{kind: step, position: 1.0, height: 0.3}", r"road\.height: 0\.3 m .*; at most 0\.28 m"),
    "steep and higher": ("{kind: step, position: 1.5, height: 0.4, length: 0.1}", "no tire climbs it"),
    "high": ("{kind: step, position: 1.0, height: 0.2}", r"contact_field\.length: .* 0\.31 m are enough"),
    "steep flanks": (
        "{kind: cleat, position: 2.3, height: 0.4, length: 2, edge: 0.3}",
        r"length: .* 0\.33 m are enough",
    ),
    "fast up a ramp": (
        "{kind: cleat, position: 2.3, height: 0.4, length: 2, edge: 0.8}",
        r"length: .* 0\.3 m are enough",
    ),
}


@pytest.mark.parametrize("wall", WALLS)
def test_a_wall_that_cannot_be_climbed_is_refused_before_the_start(wall):
    road, sentence = WALLS[wall]
    with pytest.raises(SceneError, match=sentence):
        Simulation(resolved("tire_bump", f"road={road}"))


def test_an_obstacle_of_a_file_that_the_field_does_not_see_is_refused_before_the_start(tmp_path):
    """A half-round of ten inches: the tire touches it 0.263 m before its axle, where it is 0.141 m high."""
    x, radius = numpy.arange(0.0, 8.0, 0.004), 0.254
    for height in (radius, 0.4 * radius):
        z = numpy.sqrt(numpy.maximum(0.0, height**2 - (x - 5.0) ** 2))
        numpy.savetxt(
            tmp_path / "x_z.csv", numpy.stack((x, z), axis=1), delimiter=",", header="x [m],z [m]", comments=""
        )
        sets = (f"road={{kind: profile, file: {tmp_path / 'x_z.csv'}}}", "travel.speed=6", "duration=1.2")
        if height < radius:
            Simulation(resolved("tire_bump", *sets))
            continue
        with pytest.raises(
            SceneError, match=r"contact_field\.length: 4\.5\d+ m after its start .*; 0\.33 m are enough"
        ):
            Simulation(resolved("tire_bump", *sets))
        Simulation(resolved("tire_bump", *sets, "effects.tire.contact_field.length=0.33"))
        Simulation(resolved("tire_bump", *sets, "duration=0.5"))  # ends before it


@pytest.mark.parametrize(
    "cured",
    [
        ("travel.speed=8", "road={kind: step, position: 1.0, height: 0.28}", "effects.tire.contact_field.length=0.33"),
        ("travel.speed=8", "road={kind: step, position: 1.0, height: 0.2}", "effects.tire.contact_field.length=0.31"),
        ("travel.speed=8", "road={kind: step, position: 1.0, height: 0.12}"),
        ("travel.speed=10", WALLS["steep flanks"][0], "effects.tire.contact_field.length=0.33"),
        ("travel.speed=10", WALLS["fast up a ramp"][0], "effects.tire.contact_field.length=0.3"),
        ("travel.speed=3", WALLS["fast up a ramp"][0]),
    ],
)
def test_what_the_refusals_of_walls_allow_runs_to_its_end(cured):
    force, _costs = run(*(each if "=" in each else f"road={each}" for each in cured), "duration=0.6")
    assert force.max() > 2.0 * STANDING


def test_a_parabola_on_a_half_space_touches_a_wall_beyond_its_radius():
    """0.2 m of a parabola of 0.3 m lie at sqrt(2 R h) = 0.346 m."""
    wall = ("travel.speed=8", "road={kind: step, position: 1.0, height: 0.2}")
    with pytest.raises(SceneError, match=r"as far as 0\.35 m before its axle, .*; 0\.37 m are enough"):
        run(*wall, scene="tire_half_space")
    run(*wall, "effects.tire.contact_field.length=0.37", "duration=0.3", scene="tire_half_space")


def test_a_wall_behind_the_end_of_the_run_is_no_wall():
    assert Simulation(resolved("tire_bump", "road={kind: step, position: 31.0, height: 0.4}", "duration=1.0"))


def test_an_interval_of_an_odd_number_of_segments_is_no_trap():
    """Twice its last part of 7 is not yet all of 15, though twice its first one of 8 is: on texture the steps grow to it."""
    steps = whole_run(resolved("tire_texture", "duration=0.1"), lambda _line: None).recording.cost["coupling_steps"]
    assert steps[0] > 2
    assert (steps[5:] == 2).all()  # fields a block
