"""Films of runs at the instants that all of them recorded."""

from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.report.comparison.films import films_of_runs
from contact_sim_pkg.report.comparison.instants import at_common_instants, common_instants
from contact_sim_pkg.report.field_series import FieldReader
from contact_sim_pkg.report.reading import PATCH
from contact_sim_pkg.report.series import Recording

PERIOD = 10_000_000  # [ns] between two fields
CELLS = 80  # along each side: 46 frames a film


def field(pressure):
    """One loaded cell."""
    grid = np.zeros((CELLS, CELLS))
    grid[40, 40] = pressure
    return SimpleNamespace(
        rows=CELLS, cols=CELLS, cell_x=0.01, cell_y=0.01, origin_x=0.0, origin_y=0.0, load=pressure, peak=pressure, mean=1.0,
        area=1.0, lame_a=0.0, lame_b=0.0, lame_n=2.0, centre_x=0.0, centre_y=0.0, pressure=grid.ravel(),
    )  # fmt: skip


class Run:
    """A bag of one pressure a field, and what the report reads of it."""

    def __init__(self, pressures, begin=0, period=PERIOD):
        self.topics = {"/seat/patch": SimpleNamespace(type=PATCH, relative_name="seat/patch")}
        self.fields = {begin + number * period: field(each) for number, each in enumerate(pressures)}

    def messages(self, topic):
        assert topic == "/seat/patch"
        yield from (SimpleNamespace(log_time=time, data=each) for time, each in self.fields.items())

    def decode(self, message):
        return message.data

    def recording(self):
        reader = FieldReader()
        for time, each in self.fields.items():
            reader.add(time * 1e-9, each)
        blank = dict.fromkeys(Recording._fields)
        return Recording(**{**blank, "name": "run", "fields": {"seat": reader.finish()}})


def films_at(*runs):
    return at_common_instants(runs, [run.recording() for run in runs])


def test_the_difference_is_of_two_fields_of_the_peak_instant():
    """A has its peak at an odd place, and B there a dip that no straight line between its neighbours has."""
    one, two = np.full(400, 1000.0), np.full(400, 2000.0)
    one[201], two[201], two[200], two[202], two[303] = 5100.0, 0.0, 4000.0, 4000.0, 5100.0
    bags = Run(one), Run(two)
    runs = films_at(*bags)
    first, second = (each.fields["seat"].film for each in runs)
    assert common_instants(first.time, second.time) == pytest.approx(first.time)
    assert first.time.size <= bags[0].recording().fields["seat"].film.time.size + 2
    found = films_of_runs("AB", runs)
    assert found.views[2].text == "2.010 s · -5.1 to 0 kPa"
    assert found.notes == []


def test_before_they_were_brought_together_the_peaks_are_of_one_run_each():
    """What the page showed: B between two of its fields."""
    one, two = np.full(400, 1000.0), np.full(400, 2000.0)
    one[201], two[201], two[303] = 5100.0, 0.0, 5100.0
    apart = films_of_runs("AB", [Run(each).recording() for each in (one, two)])
    assert apart.views[2].text != "2.010 s · -5.1 to 0 kPa"


def test_a_run_that_goes_on_keeps_its_fields_behind_the_end_of_the_other():
    runs = films_at(Run(np.full(50, 1000.0)), Run(np.linspace(1000.0, 5000.0, 400)))
    first, second = (each.fields["seat"].film for each in runs)
    assert first.time[-1] == pytest.approx(0.49, abs=0.02)
    assert second.time[-1] == pytest.approx(3.99)
    assert np.diff(second.time).max() < 0.25  # of its own film: 0.16
    assert films_of_runs("AB", runs).notes == []


def test_runs_of_other_instants_keep_their_films_and_a_note_says_so():
    runs = [Run(np.full(50, 1000.0)), Run(np.full(50, 2000.0), begin=3_000_000)]
    before = [run.recording() for run in runs]
    after = at_common_instants(runs, before)
    for one, other in zip(after, before, strict=True):
        assert (one.fields["seat"].film.time == other.fields["seat"].film.time).all()
    assert films_of_runs("AB", after).notes == [
        "The fields of the seat in A and B are of different instants: linear between two."
    ]


def test_a_third_run_of_other_instants_does_not_take_those_of_the_first_two():
    runs = films_at(Run(np.full(50, 1000.0)), Run(np.full(50, 2000.0)), Run(np.full(50, 2000.0), begin=3_000_000))
    assert films_of_runs("ABC", runs).notes == [
        "The fields of the seat in A and C are of different instants: linear between two."
    ]


def test_of_half_the_rate_every_second_field_is_compared():
    runs = films_at(Run(np.full(40, 1000.0)), Run(np.full(20, 2000.0), period=2 * PERIOD))
    first, second = (each.fields["seat"].film for each in runs)
    assert common_instants(first.time, second.time) == pytest.approx(0.02 * np.arange(20))
    assert films_of_runs("AB", runs).notes == []
