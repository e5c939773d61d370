"""What a series leaves of a run: the time between both, and runs that say nothing of it."""

import numpy
import pytest

from contact_sim_pkg.sweep.measured import Series
from contact_sim_pkg.sweep.residuals import SeriesResidual
from contact_sim_pkg.sweep.variation import SweepError

TIME = numpy.linspace(0.0, 2.0, 2001)
MOST = 0.02


def residual():
    return SeriesResidual(Series("tire/force.normal", TIME, numpy.sin(40.0 * TIME)), MOST)


@pytest.mark.parametrize("late", [-0.019, -0.004, 0.0, 0.0131, 0.02])
def test_a_recording_is_as_late_as_it_was_made(late):
    """The recording is sin 40 t; a run that does the same earlier has to be late."""
    given = numpy.array([TIME, numpy.sin(40.0 * (TIME + late))])
    assert residual().shift(given) == pytest.approx(late, abs=1e-6)


def test_a_run_that_stands_still_is_compared_all_the_same():
    """Any shift is as good as another: the search for it has an end, again and again."""
    left = residual()
    for _ in range(3):
        assert abs(left.shift(numpy.array([TIME, numpy.zeros(TIME.size)]))) <= MOST
    assert left.shift(numpy.array([TIME, numpy.sin(40.0 * (TIME + 0.01))])) == pytest.approx(0.01, abs=1e-6)


def test_a_run_without_numbers_is_refused():
    with pytest.raises(SweepError, match=r"tire/force\.normal of a run has values that are no numbers"):
        residual().of(numpy.array([TIME, numpy.full(TIME.size, numpy.nan)]))
