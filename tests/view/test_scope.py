"""Frames of the live page: the newest field alone, and every peak of the series, however seldom a reader comes."""

import numpy
import pytest
from tests.standard.records import COLS, PEAK, ROWS, motion_of
from tests.view.frames import force_of, patch_of_block, read

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.view.scope import INTERVAL, SPAN, Scope

MS = 1_000_000  # [ns]


def test_a_reader_that_comes_seldom_gets_the_newest_field_and_all_samples_since():
    scope = Scope()
    scope.take("seat/force", 0, force_of(0))
    scope.take("seat/patch", 0, patch_of_block(0))
    number, first = scope.frame(0)
    about, *_ = read(first)
    assert about["anew"] is True
    assert about["maps"][0]["load"] == 600.0
    for block in range(1, 101):
        scope.take("seat/force", 10 * block * MS, force_of(block))
        scope.take("seat/patch", 10 * block * MS, patch_of_block(block))
    about, series, _ = read(scope.frame(number)[1])
    assert (about["anew"], about["load"], about["time"]) == (False, 700.0, pytest.approx(1.009))
    assert [each["load"] for each in about["maps"]] == [700.0]
    assert set(series["seat/force"][1]) == {600.0 + block for block in range(1, 101)}
    assert numpy.all(numpy.diff(series["seat/force"][0]) > 0.0)
    assert series["seat/force"][0][0] == pytest.approx(0.01)


def test_bytes_of_a_field_are_its_pressure_over_the_largest_so_far():
    scope = Scope()
    record = patch_of_block(0)
    scope.take("seat/patch", 0, record)
    scope.take("seat/patch", MS, record._replace(peak=0.5 * PEAK, pressure=0.5 * record.pressure))
    _, _, fields = read(scope.frame(0)[1])
    found = fields["seat/patch"] / 255.0
    assert found.shape == (ROWS, COLS)
    expected = 0.5 * record.pressure.reshape(ROWS, COLS) / PEAK
    assert numpy.abs(found - expected).max() <= 1.0 / 255.0 + 1e-6
    assert numpy.array_equal(found == 0.0, expected == 0.0), "blank where there is no pressure, and only there"


def test_no_peak_of_a_dense_series_is_lost():
    """2 kHz and more are thinned to the smallest and largest value of 5 ms."""
    values = numpy.zeros(1000)
    values[437], values[712] = 9000.0, -1.0
    record = force_of(0)._replace(
        sample_period=1e-4, normal=values, tangential=values, approach=values, effective_height=values
    )
    scope = Scope()
    scope.take("tire/force", 0, record)
    _, series, _ = read(scope.frame(0)[1])
    time, normal, _ = series["tire/force"]
    assert normal.size == 2 * 20
    assert (normal.min(), normal.max()) == (-1.0, 9000.0)
    assert abs(time[normal.argmax()] - 0.0437) <= 0.005


def test_only_the_last_seconds_are_kept_and_an_earlier_time_begins_anew():
    scope = Scope()
    for block in range(1500):
        scope.take("seat/force", 10 * block * MS, force_of(block))
    number, frame = scope.frame(0)
    time = read(frame)[1]["seat/force"][0]
    assert SPAN <= time[-1] - time[0] <= SPAN + 0.02
    scope.take("seat/force", 0, force_of(0))
    about, series, _ = read(scope.frame(number)[1])
    assert about["anew"] is True
    assert series["seat/force"][0][-1] == pytest.approx(0.009, abs=INTERVAL)


def test_each_body_has_its_row():
    scope = Scope()
    scope.take("bench/motion", 0, motion_of(("floor_z", "seat_frame_z"), acceleration=numpy.array([1.0, 2.0])))
    about, series, _ = read(scope.frame(0)[1])
    assert about["plots"][0]["names"] == ["floor z", "seat frame z"]
    assert set(series["bench/motion"][1]) == {1.0}
    assert set(series["bench/motion"][2]) == {2.0}


@pytest.mark.parametrize(
    "change", [{"sample_period": float("nan")}, {"normal": numpy.zeros(0), "tangential": numpy.zeros(0)}]
)
def test_a_message_whose_values_do_not_fit_is_refused(change):
    with pytest.raises(MessageError):
        Scope().take("seat/force", 0, force_of(0)._replace(**change))
