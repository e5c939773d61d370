"""Coupling steps are as long as what they miss in their middle lets them be, and the run says what is missed.

References have steps of 4 mm at most and fields solved to 1e-6.
"""

import math
from functools import cache
from itertools import pairwise

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.rigs.vehicle.field.coupling_rule import AIM, UNLUCKIER, UNLUCKY, Allowance, MeasuredWay
from contact_sim_pkg.rigs.vehicle.motion.heights import effective_between
from contact_sim_pkg.rigs.vehicle.seat.cushion_field import CushionField
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.outputs import largest_of
from contact_sim_pkg.run.sources import make_sources

EXACTLY = ("accuracy=1e-3", "integrator.coupling_tolerance=1e-5", "effects.tire.contact_field.tolerance=1e-6")


@cache
def run(scene, duration, *sets):
    """All outputs of a run."""
    made = resolved(scene, f"duration={duration}", *sets)
    simulation, sources = Simulation(made), make_sources(made)
    simulation.prepare()
    outputs = []
    for block in range(simulation.blocks):
        outputs += simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()}).outputs
    return outputs


def column(outputs, topic, name):
    return numpy.concatenate([numpy.atleast_1d(getattr(each.record, name)) for each in outputs if each.topic == topic])


def estimated(outputs, name):
    """Largest estimated error of a column."""
    costs = [each.record for each in outputs if each.topic == "bench/cost"]
    return max(
        error
        for cost in costs
        for named, error in zip(cost.estimated, cost.estimated_error, strict=True)
        if named == name
    )


def steps(outputs):
    return int(column(outputs, "bench/cost", "coupling_steps").sum())


def test_the_way_follows_from_the_error_of_a_step():
    """Where a step misses m over a way s, the bound is that way on which an unlucky one misses what is aimed at."""
    way = MeasuredWay(0.1, 1e-3)
    for _ in range(200):
        way.learn(0.5 * way.longest, 5.0 * way.longest)  # 10 a metre
    assert way.longest == pytest.approx(AIM / (UNLUCKY * 10.0), rel=0.01)


def test_a_finer_request_expects_unluckier_steps():
    ways = [MeasuredWay(0.1, 1e-6, tolerance) for tolerance in (1e-1, 1e-2, 1e-3, 1e-4)]
    for way in ways:
        for _ in range(300):
            way.learn(way.longest, 10.0 * way.longest)
    assert ways[0].longest == pytest.approx(ways[1].longest)
    expected = [AIM / (10.0 * (UNLUCKY + more)) for more in (0.0, UNLUCKIER, 2.0 * UNLUCKIER)]
    assert [way.longest for way in ways[1:]] == pytest.approx(expected, rel=0.01)


def test_a_single_step_changes_the_way_by_half_or_twice():
    way = MeasuredWay(0.1, 1e-3)
    way.learn(0.1, 1e6)
    assert way.longest == pytest.approx(0.05)
    way.reset()
    way.learn(0.1, 0.0)
    assert way.longest == pytest.approx(0.2)
    way.learn(0.0, 7.0)  # a wheel that stands says nothing of ways
    assert way.longest == pytest.approx(0.2)


def test_an_error_counts_under_the_load_that_it_acts_at():
    """On a spring: its stiffness times a height; a rate's error is a part of the force there, whatever is at rest."""
    stiffness, tolerance, damping = 1e5, 1e-2, 0.05
    allowed = Allowance(height=3e-4, force=tolerance * 3e3, load=3e3, speed=tolerance / damping)
    assert allowed.missed_force(3e3, stiffness, 1e-4, 0.0) == pytest.approx(10.0)
    assert allowed.missed_force(3e3, stiffness, 0.0, 0.1) == pytest.approx(3e3 * damping * 0.1)
    assert allowed.missed_force(12e3, stiffness, 0.0, 0.1) == pytest.approx(12e3 * damping * 0.1)
    assert allowed.missed_force(0.0, 0.0, 1e-4, 0.0) == pytest.approx(10.0)  # aloft, as at rest


ROADS = {
    "rough": ("tire_rough_road", "travel={speed: 12}", "seed=3"),
    "rougher": ("tire_rough_road", "travel={speed: 12}", "road.roughness_class=D"),
    "bump": ("tire_bump", "road.position=0.7", "road.length=0.3"),
}


@pytest.mark.parametrize("accuracy", ["1e-1", "1e-2", "1e-3"])
@pytest.mark.parametrize("road", ROADS)
def test_the_requested_accuracy_is_delivered_and_its_estimate_is_near(road, accuracy):
    scene, *sets = ROADS[road]
    exact = run(scene, 0.1, *sets, *EXACTLY, "integrator.coupling_length=0.004")
    found = run(scene, 0.1, *sets, f"accuracy={accuracy}")
    forces = (column(each, "tire/force", "normal") for each in (found, exact))
    scale = largest_of(exact, "tire/force.normal")
    error = abs(numpy.subtract(*forces)).max() / scale
    estimate = estimated(found, "tire/force.normal") / scale
    assert error < float(accuracy)
    assert error / 3.0 < estimate < 10.0 * max(error, 0.1 * float(accuracy))


def test_a_road_without_short_waves_is_not_paid_for():
    """A tighter request needs shorter steps where the road has texture, not where it has none."""
    smooth = ("travel={speed: 12}", "road.texture=null", "road.shortest_wavelength=1.0")
    counts = [
        [steps(run("tire_rough_road", 0.2, *sets, f"accuracy={accuracy}")) for accuracy in ("1e-2", "1e-3")]
        for sets in (smooth, ("travel={speed: 12}",))
    ]
    assert counts[1][1] > 4 * counts[1][0]
    assert counts[0][1] < 0.5 * counts[1][1]


def rate_error(steps):
    """Largest error of the rate that the loss sees [1/s] over the steps of a sine of 1 m and 1 Hz, the first left out."""
    count, field, worst = 8, CushionField(None, None, None), 0.0
    length = 1.0 / (steps * count)  # [s] of a segment
    level = numpy.zeros(count + 1)
    height, rate = numpy.empty(count + 1), numpy.empty(count + 1)
    field.begin(0.0)
    for step in range(steps):
        start, end = (math.sin(2.0 * math.pi * (step + k) / steps) for k in (0, 1))
        correction = (start, end, field.turn(end, count, length).bend)
        effective_between(level, level, correction, count * length, height, rate)
        time = (step * count + numpy.arange(count + 1)) * length
        if step:
            worst = max(worst, abs(rate - 2.0 * math.pi * numpy.cos(2.0 * math.pi * time)).max())
        field.accept(end, count, True, 1.0)
    return worst


def test_the_rate_that_the_loss_sees_is_of_second_order_between_fields():
    """Half as long steps leave a quarter of its error, which a straight line would only halve."""
    errors = [rate_error(steps) for steps in (20, 40, 80, 160)]
    assert [before / after for before, after in pairwise(errors)] == pytest.approx([4.0] * 3, rel=0.15)


def test_an_edge_that_no_grid_resolves_has_no_estimate_of_its_peak():
    sharp = run("tire_bump", 0.03, "road={kind: cleat, position: 0.2, height: 0.005, length: 0.05}")
    named = {name for each in sharp if each.topic == "bench/cost" for name in each.record.estimated}
    assert "tire/force.normal" in named
    assert "tire/patch.peak" not in named
    cautions = Simulation(
        resolved("tire_bump", "road={kind: cleat, position: 3, height: 0.005, length: 0.05}")
    ).cautions
    assert any("not determined" in caution for caution in cautions)


CORNERS = {
    "long flanks": (
        "{kind: cleat, position: 3, height: 0.025, length: 0.1, edge: 0.02}",
        "changes there by 1.2 at once",
    ),
    "a slot": ("{kind: cleat, position: 3, height: -0.005, length: 0.05, edge: 0.02}", "changes there by 0.25 at once"),
    "a ramp of 2 %": ("{kind: step, position: 3, height: 0.02, length: 1.0}", "changes there by 0.02 at once"),
    "flanks of a hole": (
        "{kind: pothole, position: 3, depth: 0.02, length: 0.4, edge: 0.05}",
        "changes there by 0.4 at once",
    ),
    "a sharp edge": ("{kind: cleat, position: 3, height: 0.01, length: 0.1}", "the edge is 0 mm long"),
    "a short bar": (
        "{kind: cleat, position: 3, height: 0.02, length: 0.008, edge: 0.004}",
        "the obstacle is 8 mm long, 3 cells of effects.tire.contact_field are 11.2 mm",
    ),
    "a short hole": (
        "{kind: pothole, position: 3, depth: 0.02, length: 0.011}",
        "force and motion may err there by 0.1 and 0.3",
    ),
    "a short bump": (
        "{kind: bump, position: 3, height: 0.02, length: 0.01}",
        "force and motion may err there by 0.1 and 0.3",
    ),
    "a bump of few cells": (
        "{kind: bump, position: 3, height: 0.02, length: 0.029}",
        "8 cells of effects.tire.contact_field are 30 mm; force and motion may err there by 0.06 and 0.2",
    ),
    "a bar of few cells": (
        "{kind: cleat, position: 3, height: 0.02, length: 0.012, edge: 0.002}",
        "the obstacle is 12 mm long, 8 cells of effects.tire.contact_field are 30 mm",
    ),
    "a bump of nine cells": ("{kind: bump, position: 3, height: 0.02, length: 0.034}", ""),
    "a pebble": ("{kind: bump, position: 3, height: 5.0e-5, length: 0.01}", ""),
    "a ramp of 1 %": ("{kind: step, position: 3, height: 0.02, length: 2.0}", ""),
    "a bump": ("{kind: bump, position: 3, height: 0.05, length: 0.5}", ""),
    "class C": ("{kind: iso8608, roughness_class: C}", ""),
}


@pytest.mark.parametrize("road", CORNERS)
def test_corners_at_which_no_grid_determines_the_peak_are_named_before_the_run(road):
    section, words = CORNERS[road]
    cautions = Simulation(resolved("tire_bump", f"road={section}")).cautions
    assert [words in caution and "not determined" in caution for caution in cautions] == [True] * bool(words)


def test_the_peak_at_a_corner_grows_with_every_finer_grid_and_the_force_does_not():
    """Line contact: by E* times the change of the slope times ln 2/(2 pi) at half the cell (Johnson, section 5.2)."""
    slope, modulus = 0.1, 4.0e6  # E* of the tread below
    found = [
        run(
            "tire_bump", 0.08, "travel={speed: 5}", f"road={{kind: step, position: 0.2, height: 0.02, length: {0.02 / slope}}}",
            f"effects.tire.contact_field={{rows: {rows}, cols: {cols}}}", "outputs.field_rate=1000",
            "effects.tire.inflation.tread_modulus=3e6", "effects.tire.inflation.tread_poisson=0.5",
        )
        for rows, cols in ((72, 48), (144, 96))
    ]  # fmt: skip
    peaks = [largest_of(each, "tire/patch.peak") for each in found]
    grown = modulus * slope * math.log(2.0) / (2.0 * math.pi)
    assert 0.7 * grown < peaks[1] - peaks[0] < 2.0 * grown
    forces = [column(each, "tire/force", "normal") for each in found]
    assert forces[0] == pytest.approx(forces[1], rel=4e-3)


def test_a_request_that_no_step_and_no_cell_delivers_is_named_before_the_run():
    """At 10 m/s, 144 x 96 cells and steps of a quarter of a millimetre take minutes of computing a simulated second."""
    [caution] = Simulation(resolved("tire_rough_road", "accuracy=1e-8")).cautions
    assert caution.startswith("tire: an error of 1e-8 is requested, that of its force is not below some 5e-5")
    assert 90.0 < float(caution.partition(" s of computing")[0].rpartition(" ")[2]) < 270.0
    for values in (("tire_rough_road", "accuracy=1e-4"), ("tire_bump", "accuracy=1e-8", "road={kind: flat}")):
        assert not Simulation(resolved(*values)).cautions
