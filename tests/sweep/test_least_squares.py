"""Least squares whose residual costs a run, and the ends of intervals, against closed forms and scipy."""

import math

import numpy
import pytest
from scipy import optimize

from contact_sim_pkg.sweep.intervals import intervals, unidentified
from contact_sim_pkg.sweep.least_squares import Minimum, minimum, slopes

TIMES = numpy.linspace(0.0, 1.0, 40)


class Counted:
    """A residual of places in [0, 1], and how many it was taken at."""

    def __init__(self, residual):
        self._residual, self._known = residual, {}

    def __call__(self, places):
        for place in places:
            self._known.setdefault(tuple(place), self._residual(place))
        return [self._known[tuple(place)] for place in places]

    @property
    def count(self):
        return len(self._known)


def decay(place):
    """``a exp(-b t) + c`` with noise, of three keys."""
    noise = numpy.random.default_rng(2).normal(0.0, 0.02, TIMES.size)
    a, b, c = 1.0 + 4.0 * place[0], 10.0 * place[1], place[2]
    return (a * numpy.exp(-b * TIMES) + c - (2.0 * numpy.exp(-4.0 * TIMES) + 0.3 + noise)) / 0.02


def test_the_place_is_that_of_scipy_for_fewer_runs():
    at = Counted(decay)
    found = minimum(at, numpy.full(3, 0.5))
    exact = optimize.least_squares(decay, numpy.full(3, 0.5), bounds=(0.0, 1.0), xtol=1e-12)
    deviation = numpy.sqrt(numpy.diag(numpy.linalg.inv(exact.jac.T @ exact.jac)))
    # To where the next step gains a twentieth of a standard deviation
    assert (abs(found.place - exact.x) < 0.1 * deviation).all()
    differences = optimize.least_squares(decay, numpy.full(3, 0.5), bounds=(0.0, 1.0), xtol=1e-4)
    assert at.count < differences.nfev + 3 * differences.njev


def test_a_minimum_beyond_a_bound_lies_on_it():
    found = minimum(Counted(lambda place: numpy.array([place[0] - 1.5, place[1] - 0.25, 0.1])), numpy.full(2, 0.5))
    assert found.place == pytest.approx([1.0, 0.25], abs=1e-4)


@pytest.mark.parametrize(("steepness", "noise"), [(0.5, 0.1), (6.0, 16.0)])
def test_a_profile_ends_where_the_closed_form_does(steepness, noise):
    """Mean of n values by ``exp(k p)``: it ends where that is the mean ± t s / sqrt(n), with k = 6 a third nearer above than
    below.
    """
    values = numpy.random.default_rng(4).normal(0.0, noise, 12)
    values += math.exp(0.5 * steepness) - values.mean()
    at = Counted(lambda place: math.exp(steepness * float(place[0])) - values)
    found = minimum(at, numpy.array([0.4]), 1e-4)
    scatter = math.sqrt(found.square / found.freedom)
    ((low, high),), _ = intervals(at, found, scatter, 1.8)
    half = 1.8 * scatter / math.sqrt(values.size)
    exact = [math.log(values.mean() + side * half) / steepness for side in (-1.0, 1.0)]
    assert [low, high] == pytest.approx(exact, abs=0.05 * (exact[1] - exact[0]))


def test_a_profile_over_two_parameters_is_that_of_their_covariance():
    """A straight line: both intervals are linear, however the parameters hang together."""
    rng = numpy.random.default_rng(3)
    lines = numpy.array([numpy.ones(50), numpy.linspace(0.5, 1.0, 50)]).T
    values = lines @ [0.4, 0.6] + rng.normal(0.0, 0.02, 50)
    at = Counted(lambda place: lines @ place - values)
    found = minimum(at, numpy.full(2, 0.5), 1e-4)
    ends, _ = intervals(at, found, 0.02, 1.7)
    half = 1.7 * 0.02 * numpy.sqrt(numpy.diag(numpy.linalg.inv(lines.T @ lines)))
    exact, *_ = numpy.linalg.lstsq(lines, values, rcond=None)
    for (low, high), middle, width in zip(ends, exact, half, strict=True):
        assert [low, high] == pytest.approx([middle - width, middle + width], abs=0.03 * width)


def test_a_better_place_on_a_profile_is_handed_back():
    at, begun = Counted(lambda place: numpy.array([10.0 * place[0] - 6.0, 0.05])), numpy.array([0.5])
    found = Minimum(begun, at([begun])[0], slopes(at, begun))
    _, best = intervals(at, found, 0.3, 1.7)
    assert float(numpy.sum(at([best])[0] ** 2)) < found.square


def test_a_sum_leaves_no_key_identified():
    at = Counted(lambda place: numpy.array([place[0] + place[1] - 1.0, place[2] - 0.5, 2.0 * (place[0] + place[1])]))
    found = minimum(at, numpy.array([0.3, 0.3, 0.4]))
    assert unidentified(at, found, 0.01).tolist() == [True, True, False]
