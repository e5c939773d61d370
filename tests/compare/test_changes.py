"""What an effect changes: of each topic the field that changes most."""

import numpy
import pytest

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compare.changes import Change, changes_of, unit_of
from contact_sim_pkg.records.messages import RollerContact


def contact(**values):
    columns = {name: numpy.ones(4) for name in RollerContact._fields if name not in ("block", "period")}
    columns.update(values)
    return [Output("roller/contact", 0, RollerContact(block=0, period=0.01, **columns))]


def test_the_change_is_that_of_the_field_that_changes_most():
    """rms of (1, -1, 0, 0) over that of (2, 0, 1, 1): sqrt(2 / 6)."""
    with_it = contact(tilt=numpy.array([2.0, 0.0, 1.0, 1.0]), yaw=numpy.full(4, 1.1))
    [found] = changes_of(with_it, contact(), ["roller/contact"])
    assert found.field == "tilt"
    assert found.change == pytest.approx((2.0 / 6.0) ** 0.5, rel=1e-12)


def test_nothing_changes_between_two_equal_runs_and_a_missing_topic_is_reported():
    assert changes_of(contact(), contact(), ["roller/contact", "roller/track"]) == [
        Change("roller/contact", "unchanged", 0.0)
    ]
    assert changes_of(contact(), [], ["roller/contact"])[0] == Change("roller/contact", "only with it", None)
    assert changes_of([], contact(), ["roller/contact"])[0] == Change("roller/contact", "only without it", None)


def test_rounding_in_both_runs_is_no_change():
    tiny = contact(tilt=numpy.full(4, 1e-17))
    assert changes_of(tiny, contact(tilt=numpy.full(4, -2e-17)), ["roller/contact"])[0].field == "unchanged"


def test_a_field_that_is_zero_in_one_run_is_reported_with_its_unit_and_not_as_a_ratio():
    """rms of (3, 4, 0, 0) is 2.5; the ratio of another field stands beside it."""
    rounding = contact(tilt=numpy.full(4, 1e-12))
    large = contact(tilt=numpy.array([3.0, 4.0, 0.0, 0.0]), yaw=numpy.full(4, 1.25))
    for runs in ((rounding, large), (large, rounding)):
        by_ratio, alone = changes_of(*runs, ["roller/contact"])
        assert (by_ratio.field, by_ratio.change) == ("yaw", pytest.approx(0.2, rel=1e-12))
        assert (alone.field, alone.change, alone.unit) == ("tilt", None, "rad")
        assert alone.size == pytest.approx(2.5, rel=1e-12)


@pytest.mark.parametrize(
    ("topic", "field", "unit"),
    [
        ("block/force", "approach", "m"), ("block/wrench", "wrench.torque.y", "N m"), ("block/wrench", "wrench.force.x", "N"),
        ("bench/motion", "velocity of block_pitch", "rad/s"), ("bench/motion", "velocity of block_x", "m/s"),
    ],
)  # fmt: skip
def test_the_unit_of_a_field_is_that_of_its_message(topic, field, unit):
    assert unit_of(topic, field) == unit


def test_another_number_of_values_is_reported():
    """A shell has 320 points in place of one."""
    [found] = changes_of(contact() * 2, contact(), ["roller/contact"])
    assert found.field.startswith("of another length: ")
    assert found.change is None
