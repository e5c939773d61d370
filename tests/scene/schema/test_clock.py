"""Blocks, durations and rates fit each other in whole nanoseconds, or the nearest that do are named."""

import operator
from fractions import Fraction
from functools import reduce

import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.schema.clock import divisors
from contact_sim_pkg.scene.timing import make_timing

THOUSAND = {"force_rate": 1000.0, "display_rate": 1000.0, "field_rate": 1000.0}
ADDED_UP = reduce(operator.add, [0.001] * 3599)  # each step rounded; `sum` makes up for that since Python 3.12


@pytest.mark.parametrize(
    ("changes", "where", "nearest"),
    [
        ({"block_length": 0.0100000005}, "block_length", "0.01 and 0.010000001 s"),
        ({"duration": 0.015}, "duration", "0.01 and 0.02 s"),
        ({"duration": 0.004}, "duration", "0.01 s"),
        ({"duration": 3600.0, "block_length": 0.007, "outputs": THOUSAND}, "duration", "3599.995 s"),
        (
            {"duration": 0.7, "block_length": 0.007, "outputs": {**THOUSAND, "field_rate": 100.0}},
            "outputs.field_rate",
            "1000 Hz",
        ),
        ({"duration": 0.300000001}, "duration", "0.3 and 0.31 s"),
        ({"outputs": {"field_rate": 150.0}}, "outputs.field_rate", "100 and 200 Hz"),
        ({"outputs": {"field_rate": 50.0}}, "outputs.field_rate", "100 Hz"),
        ({"outputs": {"display_rate": 300.0}}, "outputs.display_rate", "200 and 500 Hz"),
        ({"outputs": {"force_rate": 1001.0}}, "outputs.force_rate", "1000 and 1600 Hz"),
        ({"outputs": {"field_rate": 400.0}}, "outputs.force_rate", "800 and 1600 Hz"),
        ({"outputs": {"display_rate": 400.0}}, "outputs.force_rate", "800 and 1600 Hz"),
        ({"vibration.sample_rate": 476.0}, "vibration.sample_rate", "400 and 500 Hz"),
    ],
)
def test_a_time_that_does_not_fit_names_the_nearest_that_do(maker, changes, where, nearest):
    faults = maker.faults("seat", changes)
    assert len(faults) == 1
    assert faults[0].startswith(f"{where}: ")
    assert faults[0].endswith(nearest)


@pytest.mark.parametrize(
    "changes",
    [
        {"duration": 0.3},
        {"duration": 3600.0},
        {"block_length": 0.001, "outputs": {"display_rate": 1000.0, "field_rate": 1000.0}},
        {"block_length": 0.1, "outputs": {"field_rate": 10.0, "display_rate": 50.0, "force_rate": 100.0}},
        {"outputs": {"force_rate": 1000000.0}},
        {"vibration.sample_rate": 500.0},
    ],
)
def test_times_that_fit_pass(maker, changes):
    assert maker.faults("seat", changes) == []


@pytest.mark.parametrize("value", [0, -0.01, 1e-10, 0.2])
def test_a_block_length_of_nothing_or_out_of_range_is_refused_with_its_range(maker, value):
    (fault,) = maker.faults("seat", {"block_length": value})
    assert "0.001 to 0.1 s" in fault


@pytest.mark.fault("C6")
def test_the_number_of_blocks_of_an_hour_is_exact(maker):
    scene = maker.load("seat", {"duration": 3599.99, "block_length": 0.01})
    assert make_timing(resolve(scene), with_field=False).blocks == 359999


@pytest.mark.parametrize(
    ("duration", "block_length", "blocks", "meant"),
    [
        (0.47000000000000003, 0.01, 47, 0.47),
        (0.1 + 0.2, 0.01, 30, 0.3),
        (1.1 - 0.4, 0.01, 70, 0.7),
        (ADDED_UP, 0.001, 3599, 3.599),
        (0.3 * (1.0 + 0.9e-9), 0.01, 30, 0.3),
        (0.3 * (1.0 - 0.9e-9), 0.01, 30, 0.3),
    ],
)
def test_a_duration_with_the_rounding_of_a_sum_is_the_whole_number_of_blocks_that_it_is_meant_to_be(
    maker, duration, block_length, blocks, meant
):
    assert duration != meant
    rates = {"outputs": THOUSAND} if block_length == 0.001 else {}
    scene = maker.load("seat", {"duration": duration, "block_length": block_length, **rates})
    resolved = resolve(scene)
    assert make_timing(resolved, with_field=False).blocks == blocks
    assert resolved.data["duration"] == meant


@given(st.integers(1, 10**6))
def test_divisors_are_all_that_divide(number):
    found = divisors(number)
    assert found == sorted(set(found))
    assert all(Fraction(number, n).denominator == 1 for n in found)
    assert len(found) == sum(number % n == 0 for n in range(1, min(number, 2000) + 1)) + sum(n > 2000 for n in found)
