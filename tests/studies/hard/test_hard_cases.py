"""Every row of `bench hard`, and more ranges of the same cases."""

import json
import math

import numpy
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from contact_sim_lab.hard import hard_cases
from contact_sim_lab.laws import hard_cases_impact
from contact_sim_lab.laws.one_mass.belt_slider import BeltSlider
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.records import guard
from contact_sim_lab.records.guard import Guard
from contact_sim_lab.records.hard_case import HardCase, at_most, close_to
from contact_sim_lab.twins import impact
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import Contact, Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.motion import columns, entries
from contact_sim_pkg.rigs.vehicle.motion.parameters import Seated, Vehicle, rigid_occupant
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count

CASES = hard_cases.all_cases()


@pytest.mark.parametrize("case", CASES, ids=[f"{case.model}: {case.case}" for case in CASES])
def test_each_hard_case_meets_its_expectation(case):
    row = hard_cases.evaluate(case)
    assert row["verdict"] == "pass", (
        f"{row['value']} instead of {row['expectation']}; {case.is_hard.says(row['figure'])}"
    )


def test_every_case_says_what_makes_it_hard_and_none_can_be_made_without():
    for case in CASES:
        assert isinstance(case.is_hard, Guard), case.case
        assert case.is_hard.what
        assert not case.is_hard.met(math.nan)
        # A bound that every figure keeps guards nothing
        assert not all(case.is_hard.met(figure) for figure in (-math.inf, -1.0, 0.0, 1.0, math.inf)), case.case
    with pytest.raises(TypeError):
        HardCase("model", "case", lambda: close_to(1.0, 1.0, 0.1, hard=1.0))
    with pytest.raises(TypeError):
        at_most(0.0, 1.0)


@pytest.mark.parametrize(
    ("is_hard", "hard", "soft"),
    [
        (guard.contact_lost(), 1, 0),
        (guard.touches(3), 3, 2),
        (guard.impacts(3), 4, 2),
        (guard.slip_changes(1), 1, 0),
        (guard.denominator_below_0(), -0.71, 3.69),
        (guard.grid_left(4), 4, 3),
        (guard.rank_lost(1), 1, 0),
        (guard.condition(1e6), 2e6, 9e5),
        (guard.scales("loads", 1e12), 1e12, 1e11),
        (guard.zero("load [N]"), -0.0, 5e-324),
        (guard.above("tilt [rad]", 0.0), 5e-324, 0.0),
        (guard.below("1 - m", 1.0), 0.5, 1.0),
    ],
)
def test_a_case_whose_run_is_not_hard_shows_nothing_and_says_so(is_hard, hard, soft):
    rows = [
        hard_cases.evaluate(HardCase("model", "case", lambda figure=figure: at_most(0.0, 1.0, hard=figure), is_hard))
        for figure in (hard, soft)
    ]
    assert [row["verdict"] for row in rows] == ["pass", "not hard"]
    assert not hard_cases.unjudged(rows[:1])
    assert (hard_cases.failed(rows), hard_cases.unjudged(rows)) == (False, True)
    [section] = hard_cases.sections(rows)
    first, second = (line["hard because"] for line in section.rows)
    assert is_hard.what in first
    assert "not" not in first.removeprefix(is_hard.what)
    assert f"not {is_hard.relation}" in second
    assert json.loads(json.dumps(rows[1]))["figure"] == soft


def test_a_case_that_misses_its_expectation_fails_the_table():
    hard = guard.at_least("figure", 1.0)
    wrong = HardCase("model", "case", lambda: close_to(1.1, 1.0, 0.05, hard=1.0), hard)
    broken = HardCase("model", "case", lambda: at_most(1 / 0, 1.0, hard=1.0), hard)
    not_a_number = HardCase("model", "case", lambda: at_most(math.nan, 1.0, hard=1.0), hard)
    for case in (wrong, broken, not_a_number):
        row = hard_cases.evaluate(case)
        assert row["verdict"] == "fail"
        assert hard_cases.failed([row])


@pytest.mark.parametrize("loss", [0.05, 0.2, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_the_error_of_the_restitution_follows_the_tolerance_in_every_approach_phase(loss, tolerance):
    assert max(hard_cases_impact.phase_errors(loss, tolerance)) <= 3.0 * tolerance


@pytest.mark.parametrize("exponent", [1.0, 1.05, 1.25, 1.75, 2.5, 3.0])
def test_the_error_follows_the_tolerance_for_every_power_of_the_contact_force(exponent):
    law = NormalElastic(1e5, exponent)
    for loss in (0.05, 0.5, 3.0):
        assert max(hard_cases_impact.phase_errors(loss, 1e-7, law)) <= 1e-6


@pytest.mark.parametrize("power", range(4, 12))
def test_the_error_of_the_seat_slap_lies_within_a_factor_10_of_the_tolerance(power):
    assert 0.1 * 10.0**-power <= hard_cases_impact.slap_error(10.0**-power) <= 4.0 * 10.0**-power


def test_the_seat_slap_follows_a_loose_tolerance():
    assert hard_cases_impact.slap_error(1e-3) <= 4e-3


@pytest.mark.parametrize("phase", [0.001, 0.004, 0.011])
def test_the_seat_slap_follows_its_twin_from_other_starts(phase):
    assert hard_cases_impact.slap_error(1e-10, phase) <= 1e-7


@settings(max_examples=40)
@given(st.floats(1e3, 1e16), st.floats(1.0, 3.0), st.floats(1e-4, 5.0), st.floats(1e-3, 10.0))
def test_the_restitution_does_not_depend_on_stiffness_exponent_or_speed(coefficient, exponent, loss, speed):
    rig = PointContact(3.0, 0.0, 0.0, 0.0, NormalElastic(coefficient, exponent), NormalDissipative(loss / speed))
    depth = impact.deepest_approach(3.0, speed, coefficient, exponent, loss / speed)
    lasts = impact.elastic_impact(3.0, speed, coefficient, exponent)[0]
    scale = numpy.array([depth, speed]) * 1e-9
    times = numpy.array([0.0, lasts * (6.0 + 6.0 * loss)])
    end = integrate(rig, numpy.array([0.3 * depth, -speed]), scale, times).states[-1]
    assert end[1] / speed == pytest.approx(impact.restitution(loss), abs=1e-7)


@pytest.mark.fault("D5")
@settings(max_examples=40)
@example(1e3, 0.0, 1.0, 1.0, 0.0, 17.0)  # parts faster than the material recovers, with nothing that moves fore and aft
@example(1e4, 0.0, 0.5, 1.0, 2.0, 17.0)  # the same while it slips
@given(
    st.floats(1e3, 1e6), st.floats(0.0, 1e3), st.floats(0.05, 1.0), st.floats(0.1, 1.0), st.floats(0.0, 12.0),
    st.floats(0.0, 25.0),
)  # fmt: skip
def test_friction_never_chatters_nor_passes_its_limit_while_the_seat_shakes_and_lifts_off(
    stiffness, damping, static, ratio, shake_x, shake_z
):
    contact = Contact(
        NormalElastic(2.73e5, 1.5), NormalDissipative(1.0), Friction(stiffness, damping, static, static * ratio)
    )
    rig = Vehicle(9.81, (), (Seated(rigid_occupant(50.0), contact),))
    count = 1000
    times = numpy.arange(count + 1) * 1e-3
    a_x, a_z = shake_x * numpy.sin(19.0 * times), shake_z * numpy.sin(25.0 * times)
    zeros, state = numpy.zeros(count + 1), numpy.zeros(7)
    state[0] = -((50.0 * 9.81 / 2.73e5) ** (2.0 / 3.0))
    work, mode = make_workspace(7, event_count(rig)), numpy.zeros(1, dtype=numpy.int64)
    samples = (numpy.zeros((count, 7)), numpy.zeros((count, 7)), numpy.zeros((count, columns.FORCES)))
    scale = numpy.array([1e-2, 0.5, 1e-2, 0.5, 1e-2, numpy.inf, numpy.inf]) * 1e-6
    straight = (None, None)
    entries.start(rig, mode, state, work, 1e-3, zeros[:2], zeros[:2], a_x[:2], a_z[:2], None, straight)
    assert (
        entries.advance(
            rig, mode, state, scale, work, 0.0, 1e-3, zeros, zeros, a_x, a_z, None, (None, None), 1, 0, *samples
        )
        == DONE
    )
    normal, tangential = samples[2][:, columns.SEAT_NORMAL], samples[2][:, columns.SEAT_TANGENTIAL]
    assert normal.min() >= 0.0
    assert (numpy.abs(tangential) <= static * normal + 1e-3).all()


@pytest.mark.parametrize("belt_speed", [0.0, 1e-6, 1e-3, 1.0])
@pytest.mark.parametrize("static", [0.3, 0.4])
def test_stick_slip_ends_without_chatter_at_any_belt_speed(belt_speed, static):
    rig = BeltSlider(1.0, 100.0, belt_speed, 9.81, Friction(1.0e5, 300.0, static, 0.3))
    scale = numpy.array([1e-2, 1e-1, 1e-3]) * 1e-8
    course = integrate(rig, numpy.array([0.02, 0.0, 0.0]), scale, numpy.array([0.0, 10.0]), strict=False)
    assert course.status == DONE
    assert course.events < 200
