"""Between published fields a tire stands on half as many cells each way and the offset of the fine field.

References are the fine field itself, solved at each of the places, and spread means of the offsets.
"""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.rigs.vehicle.tire import coarse_level
from contact_sim_pkg.rigs.vehicle.tire.coarse_level import CoarseLevel, LevelSolution, halved
from contact_sim_pkg.rigs.vehicle.tire.footprint import tire_gap
from contact_sim_pkg.rigs.vehicle.tire.road_field import RoadField
from contact_sim_pkg.run.sources import make_sources

ALLOWED = 150e-6  # [m] of a request of 1e-2


def rolled(*sets, scene="tire_rough_road"):
    """All outputs of 0.2 s of a scene."""
    made = resolved(scene, "duration=0.2", *sets)
    simulation, sources = Simulation(made), make_sources(made)
    simulation.prepare()
    outputs = []
    for block in range(simulation.blocks):
        outputs += simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()}).outputs
    return outputs


def fields_on_a_rough_road():
    """The field of a tire with its level, and a block of rough road of 0.2 m."""
    scene = resolved("tire_rough_road", "duration=0.1", "travel={speed: 20}")
    model = Simulation(scene).model
    field = RoadField(model.tire_field, model.tire_contact, model.tire_geometry, None)
    field.use_level(ALLOWED)
    return field, model, make_sources(scene)["road/patch"].block(0)


def force_at(height, model):
    """Force [N] of the tire's table at a height [m], straight between its points."""
    law = model.tire_contact.elastic
    depths = numpy.linspace(0.0, 0.04, 4001)
    return float(numpy.interp(height, depths, [elastic_force(law, depth) for depth in depths]))


def test_the_coarse_force_and_its_offset_are_the_fine_force():
    """From place to place a half-grid with the offset so far errs by less than 2e-3 of the force: 4 to 6 N of 3.4 kN."""
    field, model, road = fields_on_a_rough_road()
    law, depth, errors, slopes = model.tire_contact.elastic, 0.017, [], []
    for number, travel in enumerate(numpy.linspace(0.0, 0.19, 30)):
        field.place(road, float(travel))
        row = round(travel / road.cell_x) - road.first_row
        approach = depth - float(road.height[row - 12 : row + 13].mean())
        coarse = field.level.at(road, float(travel), approach, law)
        fine = LevelSolution(approach + field.solve(approach, approach, 0), field.effective_slope())
        if number > 4:
            found = field.level.with_offset(coarse)
            errors.append(force_at(found.height, model) - force_at(fine.height, model))
            slopes.append(found.slope - fine.slope)
        field.level.renew(fine, coarse)
    load = force_at(depth, model)
    assert numpy.abs(errors).max() < 2e-3 * load
    assert numpy.std(errors) < 6e-4 * load
    assert numpy.abs(slopes).max() < 1e-3
    assert field.level.is_quiet


def test_the_coarse_cells_have_the_heights_of_every_second_node():
    _field, model, road = fields_on_a_rough_road()
    settings = model.tire_field.usual.settings
    coarse = halved(settings)
    fine, half = numpy.empty((settings.rows, settings.cols)), numpy.empty((coarse.rows, coarse.cols))
    for times, out in ((1, fine), (2, half)):
        place = (road.height, road.first_row, settings.cell_x, settings.cell_y, model.tire_geometry.form, -20, 0.05)
        assert tire_gap(*place, times, out)
    assert numpy.array_equal(half, fine[::2, ::2])
    assert (coarse.rows * coarse.cell_x, coarse.cols * coarse.cell_y) == pytest.approx(
        (settings.rows * settings.cell_x, settings.cols * settings.cell_y)
    )
    assert (coarse.modulus, coarse.belt) == (settings.modulus, settings.belt)


def level():
    """A level without solutions."""
    model = Simulation(resolved("tire_rough_road", "duration=0.1")).model
    return CoarseLevel(model.tire_field.usual.settings, "tire", model.tire_geometry, ALLOWED)


def test_an_offset_that_misses_too_much_is_refused_until_it_is_quiet_again():
    """The largest of a run counts as three times the root mean square, of which the newest has an eighth."""
    made, coarse = level(), LevelSolution(0.017, 0.0)
    assert not made.is_quiet
    assert made.renew(LevelSolution(0.0171, 0.0), coarse) == 0.0
    assert not made.is_quiet  # one offset says nothing of the next
    for _ in range(3):
        made.renew(LevelSolution(0.0171, 0.0), coarse)
    assert made.is_quiet
    leap = coarse_level.SHARE * ALLOWED
    assert made.renew(LevelSolution(0.0171 + leap, 0.0), coarse) == pytest.approx(leap)
    assert not made.is_quiet
    for _ in range(40):
        made.renew(LevelSolution(0.0171 + leap, 0.0), coarse)
    assert made.is_quiet
    assert made.with_offset(coarse).height == pytest.approx(0.0171 + leap, abs=1e-8)


def test_the_offset_is_a_mean_of_those_of_published_fields():
    made, coarse = level(), LevelSolution(0.017, 0.01)
    offsets = 1e-6 * numpy.array([3.0, -2.0, 5.0, 1.0])
    for offset in offsets:
        made.renew(LevelSolution(coarse.height + offset, coarse.slope + 10.0 * offset), coarse)
    new = coarse_level.NEWEST_OFFSET
    weights = [(1 - new) ** 3, new * (1 - new) ** 2, new * (1 - new), new]
    found = made.with_offset(coarse)
    assert found.height - coarse.height == pytest.approx(weights @ offsets, rel=1e-6)
    assert found.slope - coarse.slope == pytest.approx(10.0 * (weights @ offsets), rel=1e-6)


def test_a_level_is_left_out_where_nothing_lies_between_published_fields():
    """One solution between two published fields does not pay for the coarse one beside each; two do."""
    made = level()
    made.renew(LevelSolution(0.0171, 0.0), LevelSolution(0.017, 0.0))
    made.renew(LevelSolution(0.0171, 0.0), LevelSolution(0.017, 0.0))
    for between, worth in ((2, True), (1, False), (2, True)):
        for _ in range(20):
            for _ in range(between):
                made.count(is_published=False)
            made.count(is_published=True)
        assert made.is_worth == made.is_quiet == worth


def test_a_level_on_level_road_is_the_law():
    exact = LevelSolution(0.0172, 0.003, 0.01695)
    made = level()
    made.renew(LevelSolution(0.0171, 0.0), LevelSolution(0.017, 0.0))
    assert made.with_offset(exact) == LevelSolution(0.01695, 0.0)


def test_published_fields_are_fine_and_their_sum_is_the_force(monkeypatch):
    solved = []
    at = CoarseLevel.at
    monkeypatch.setattr(CoarseLevel, "at", lambda self, *given: solved.append(1) or at(self, *given))
    outputs = rolled("travel={speed: 20}")
    forces = {each.stamp: each.record.normal[0] for each in outputs if each.topic == "tire/force"}
    patches = [each for each in outputs if each.topic == "tire/patch"]
    steps = sum(each.record.coupling_steps for each in outputs if each.topic == "bench/cost")
    assert len(solved) > steps > 2 * len(patches)  # the level stood between them
    for patch in patches:
        record = patch.record
        assert record.pressure.shape in ((72, 48), (144, 96))
        if patch.stamp in forces:
            total = record.pressure.sum() * record.cell_x * record.cell_y
            assert total == pytest.approx(forces[patch.stamp], rel=5e-3)


def test_two_runs_have_the_same_bits():
    first, second = rolled("travel={speed: 20}"), rolled("travel={speed: 20}")
    for one, other in zip(first, second, strict=True):
        assert one.topic == other.topic
        if one.topic in ("tire/force", "bench/motion"):
            name = "normal" if one.topic == "tire/force" else "acceleration"
            assert numpy.array_equal(getattr(one.record, name), getattr(other.record, name))
