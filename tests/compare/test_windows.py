"""Where a run is checked."""

from types import SimpleNamespace

import numpy
from tests.compare.runs import force

from contact_sim_pkg.compare.columns import columns_of
from contact_sim_pkg.compare.span import Span
from contact_sim_pkg.compare.windows import event_block, from_the_start, span_round, windows_of
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolve import load_resolved

SCENE = SimpleNamespace(block_length=0.01)


def test_a_window_has_the_block_in_its_middle_and_a_lead_in():
    assert span_round(SCENE, 50, 100) == Span(30, 40, 60)
    assert span_round(SCENE, 3, 100) == Span(0, 0, 20)
    assert span_round(SCENE, 99, 100) == Span(70, 80, 100)
    assert span_round(SCENE, 3, 5) == Span(0, 0, 5)


def cost(block, error):
    """Cost of a block with an estimated error of the normal force."""
    return SolverCost(
        block=block, wall_time=0.0, real_time_factor=0.0, estimated=("tire/patch.peak", "tire/force.normal"),
        estimated_error=numpy.array([1e6 - block, error]), estimated_of=numpy.array([2e6, 1e3]),
    )  # fmt: skip


def test_windows_lie_round_the_largest_force_and_the_largest_estimated_error():
    normal = numpy.ones(1000)
    normal[755] = 2.0  # block 75
    costs = [cost(block, 3.0 if block == 20 else 1.0) for block in range(100)]
    found = windows_of(SCENE, columns_of([force(normal)]), costs, {}, 100)
    assert [(each.span.shown, each.reasons) for each in found] == [
        (10, ("largest estimated error",)),
        (65, ("largest force",)),
    ]
    [whole] = from_the_start(found)
    assert whole.span == Span(0, 0, 85)


def test_windows_that_overlap_are_one():
    normal = numpy.ones(1000)
    normal[300] = 2.0
    costs = [cost(block, 3.0 if block == 20 else 1.0) for block in range(100)]
    [found] = windows_of(SCENE, columns_of([force(normal)]), costs, {}, 100)
    assert found.span == Span(0, 10, 40)
    assert found.reasons == ("largest estimated error", "largest force")


def test_the_event_of_a_road_is_where_the_wheel_passes_its_steepest_part():
    """A bump is steep within its length."""
    scene = load_resolved("tire_bump")
    road, speed = scene.road, scene.travel.speed
    block = event_block(make_sources(scene), scene.blocks)
    place = speed * (block + 0.5) * scene.block_length
    assert abs(place - road.position) <= 0.5 * (road.length + speed * scene.block_length)


def test_the_event_of_a_vibration_is_its_largest_acceleration():
    scene = load_resolved("seat_drop")
    sources = make_sources(scene)
    block = event_block(sources, scene.blocks)
    largest = max(_largest(sources, each) for each in range(50))
    assert _largest(sources, block) >= largest


def _largest(sources, block):
    return float(numpy.abs(sources["platform/vibration"].block(block).acceleration_z).max())
