"""Columns with a kind, and their errors over the scales of the contract; expected values by hand."""

import numpy
import pytest
from tests.compare.runs import axle, force, motion, patch

from contact_sim_pkg.compare.columns import Key, columns_of, judged_topics, not_judged, paired
from contact_sim_pkg.compare.judgement import Scale, cell_of, judged, larger_scales, largest_by_kind, scales_of
from contact_sim_pkg.records.rig import Standing, TouchedBody

NOTHING = Standing({}, {})


def judgements(run, finer, standing=NOTHING, factor=1.0):
    columns = columns_of(run)
    return judged(columns, columns_of(finer), scales_of(columns, standing, cell_of(run)), factor)


def test_only_columns_with_a_kind_are_taken_each_at_its_instants():
    columns = columns_of([force([1.0, 2.0]), force([3.0], stamp=2_000_000), patch(5.0, 0.1)])
    assert [*columns] == [
        Key("tire/force", "normal"), Key("tire/force", "tangential"), Key("tire/patch", "peak"), Key("tire/patch", "area"),
    ]  # fmt: skip
    normal = columns[Key("tire/force", "normal")]
    assert normal.instants.tolist() == [0, 1_000_000, 2_000_000]
    assert normal.values.tolist() == [1.0, 2.0, 3.0]


def test_only_the_same_instants_are_compared():
    first, second = (
        columns_of([output])[Key("tire/force", "normal")]
        for output in (force([1.0, 2.0]), force([9.0, 8.0], stamp=1_000_000))
    )
    instants, values, others = paired(first, second)
    assert (instants.tolist(), values.tolist(), others.tolist()) == ([1_000_000], [2.0], [9.0])


def test_the_error_of_a_force_is_over_the_largest_vector():
    """Vector (300, 400) N is 500 N; the finer run is 5 N off."""
    run = [force([300.0, 300.0], [400.0, 0.0])]
    [found] = judgements(run, [force([305.0, 300.0], [400.0, 0.0])])
    assert (found.place, found.kind, found.column, found.time) == ("tire", "force", "normal", 0.0)
    assert found.error == pytest.approx(0.01, rel=1e-12)


def test_the_difference_is_stretched_by_the_share_of_the_finer_run():
    [found] = judgements([force([500.0])], [force([497.0])], factor=4.0 / 3.0)
    assert found.error == pytest.approx(0.008, rel=1e-12)


def test_a_component_that_errs_by_more_than_a_tenth_of_its_own_is_not_resolved():
    """42 N of 80 N, 0.9 % of 4900 N."""
    run = [axle(numpy.array([80.0, 0.0]), numpy.array([0.0, 4900.0]))]
    [found] = judgements(run, [axle(numpy.array([38.0, 0.0]), numpy.array([0.0, 4900.0]))])
    assert found.error == pytest.approx(42.0 / 4900.0, rel=1e-12)
    [lost] = found.unresolved
    assert (lost.column, lost.share) == ("axle longitudinal", pytest.approx(0.525, rel=1e-12))


def test_a_component_that_is_zero_by_symmetry_is_not_judged_by_noise():
    [found] = judgements([force([5000.0], [1e-9])], [force([5000.0], [-1e-9])])
    assert found.unresolved == ()


def test_the_standing_load_is_the_floor_of_a_force():
    run = [force([0.0, 2.0])]
    [found] = judgements(run, [force([0.0, 1.0])], Standing({"tire": 100.0}, {}))
    assert found.error == pytest.approx(0.01, rel=1e-12)


def test_an_acceleration_is_over_force_by_mass_where_a_contact_acts_on_the_body():
    """4000 N on 40 kg: 100 m/s^2."""
    run = [force([4000.0, 4000.0]), motion([0.0, 1.0], [0.0, 10.0], [0.0, 20.0])]
    finer = [force([4000.0, 4000.0]), motion([0.0, 1.0], [0.0, 10.0], [1.0, 20.0])]
    errors = {
        standing.bodies != {}: {each.place: each.error for each in judgements(run, finer, standing)}["wheel_z"]
        for standing in (NOTHING, Standing({}, {"wheel_z": TouchedBody("tire", 40.0)}))
    }
    assert errors == {False: pytest.approx(0.05, rel=1e-12), True: pytest.approx(0.01, rel=1e-12)}


def test_a_body_at_rest_has_the_floors_of_a_sample_of_free_fall():
    """At 1 kHz: 4.9 um, 9.8 mm/s, 9.8 m/s^2."""
    scales = scales_of(columns_of([motion([1.0, 1.0], [0.0, 0.0], [0.0, 0.0])]), NOTHING)
    values = {key.field: scale.scale for key, scale in scales.items()}
    assert values == {
        "position": pytest.approx(4.9e-6, rel=1e-2),
        "velocity": pytest.approx(9.81e-3, rel=1e-3),
        "acceleration": pytest.approx(9.81, rel=1e-3),
    }


def test_a_position_is_over_its_excursion():
    [found] = judgements([motion([10.0, 12.0], [0.0, 0.0], [0.0, 0.0])], [motion([10.0, 12.5], [0.0, 0.0], [0.0, 0.0])])
    assert (found.column, found.error) == ("position", pytest.approx(0.25, rel=1e-12))


def test_peak_and_area_are_over_their_largest_and_an_area_has_a_cell_for_its_floor():
    """A cell is 1 cm by 2 cm."""
    run, finer = [patch(100.0, 1e-4), patch(200.0, 0.0, 10)], [patch(90.0, 0.0), patch(200.0, 0.0, 10)]
    errors = {each.kind: each.error for each in judgements(run, finer)}
    assert errors == {"peak": pytest.approx(0.05, rel=1e-12), "area": pytest.approx(0.5, rel=1e-12)}


def test_what_is_zero_in_both_runs_is_left_out():
    assert judgements([force([0.0])], [force([0.0])]) == []


def test_the_largest_of_each_kind_and_the_larger_scales():
    found = judgements(
        [force([100.0]), force([10.0], topic="seat/force")], [force([101.0]), force([10.5], topic="seat/force")]
    )
    assert largest_by_kind(found) == {"force": pytest.approx(0.05, rel=1e-12)}
    key, other = Key("tire/force", "normal"), Key("seat/force", "normal")
    assert larger_scales({key: Scale(1.0, 5.0)}, {key: Scale(2.0, 3.0), other: Scale(7.0, 7.0)}) == {
        key: Scale(2.0, 5.0),
        other: Scale(7.0, 7.0),
    }


def test_what_is_not_judged_is_listed_by_topic():
    topics = ["tire/force", "tire/patch", "bench/energy"]
    assert judged_topics(topics) == ["tire/force", "tire/patch"]
    listed = not_judged(topics)
    assert listed[0] == "tire/force approach, effective_height"
    assert listed[-1] == "bench/energy"
    assert "pressure" in listed[1]
