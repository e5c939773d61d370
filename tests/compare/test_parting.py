"""Runs that part for good: a pair whose difference grows tenfold in a known time."""

import numpy
import pytest
from tests.compare.runs import force

from contact_sim_pkg.compare.columns import Key, columns_of
from contact_sim_pkg.compare.judgement import scales_of
from contact_sim_pkg.compare.parting import parting_of, until
from contact_sim_pkg.records.rig import Standing

TIME = numpy.arange(4000) * 1e-3  # [s]
NORMAL = Key("tire/force", "normal")


def parting(difference, request=1e-3):
    normal = 1000.0 + 500.0 * numpy.sin(50.0 * TIME)
    run, finer = columns_of([force(normal)]), columns_of([force(normal + difference)])
    return parting_of(run, finer, scales_of(run, Standing({}, {})), request)


def test_runs_that_part_agree_until_the_difference_passes_the_request():
    """A difference of 1e-6 of 1500 N that grows tenfold every half second passes 1e-3 at 1.5 s."""
    found = parting(1500.0 * numpy.minimum(1e-6 * 10.0 ** (TIME / 0.5), 0.5))
    assert found.time == pytest.approx(1.5, abs=2e-3)
    assert [each.column for each in found.statistics] == ["normal", "tangential"]


def test_beyond_it_the_mean_differs_by_the_mean_of_the_difference():
    found = parting(numpy.where(TIME < 1.0, 0.0, 750.0))
    normal = found.statistics[0]
    assert found.time == pytest.approx(1.0, abs=1e-9)
    assert normal.mean == pytest.approx(0.5, rel=1e-3)
    assert normal.quantiles == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize(
    "difference",
    [
        numpy.zeros(4000),
        numpy.full(4000, 15.0),  # an error from the start on, above the request
        numpy.where((TIME > 1.0) & (TIME < 2.0), 700.0, 0.0),  # comes back
        numpy.where(TIME > 2.0, 3.0, 0.0),  # passes the request by little
    ],
)
def test_runs_that_do_not_part(difference):
    assert parting(difference) is None


def test_a_short_run_is_not_looked_at():
    run, finer = columns_of([force([1.0, 1.0])]), columns_of([force([1.0, 9.0])])
    assert parting_of(run, finer, scales_of(run, Standing({}, {})), 1e-3) is None


def test_columns_up_to_an_instant():
    columns = until(columns_of([force([1.0, 2.0, 3.0])]), 2e-3)
    assert columns[NORMAL].values.tolist() == [1.0, 2.0]
