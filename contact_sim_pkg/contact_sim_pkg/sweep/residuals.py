"""What a fit makes small: the difference between what a run gives and what was measured, in standard deviations of chance as
far as these are known.

Sources: Seber and Wild, Nonlinear Regression (1989), section 6.4; Ljung and Box, Biometrika 65 (1978) 297; Ljung, System
Identification (1999); Akima, J. ACM 17 (1970) 589; Bendat and Piersol, Random Data (2010), section 9.2.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy
from numpy.typing import NDArray
from scipy import interpolate, optimize, signal, stats

from contact_sim_pkg.sweep.measured import MeasuredResponse, Points, Series
from contact_sim_pkg.sweep.spectrum import APART, FEWEST_LINES, OVERLAP, log_density, loud
from contact_sim_pkg.sweep.variation import SweepError

__all__ = ["DensityResidual", "PointsResidual", "Residual", "ResponseResidual", "SeriesResidual"]

Field = NDArray[numpy.float64]

ORDER = 4
"""Of the autoregression that whitens a series."""
LAGS, LAGS_OF_LINES = 20, 4
AROUND = 4
"""Samples on either side, that what is left may hang on."""
EXACT = 2e-3
"""Of a recording's own standard deviation: what is left below it is numerical, chance has no part in it."""
LEFT_OUT = 0.02
"""Of a series' time at either end, beyond the shift: the run began from another state."""
LEAST_SPREAD = 1e-3
"""Of a magnitude: a coherence is not printed, nor leakage small enough, for less."""
TRIED_SHIFTS = 17
"""Over the allowed ones, before the best is refined."""


class Residual(Protocol):
    """What a fit makes small."""

    @property
    def scatter(self) -> float:
        """Standard deviation of an element by chance; nan: to be estimated from what is left."""

    def of(self, given: Field) -> Field:
        """Of what a run gives. Raises SweepError where it cannot be compared."""

    def probability(self, left: Field, slope: Field, given: Field) -> float:
        """Of what is ``left`` of a run if the scene is right, ``slope`` [residuals, keys] by its free keys; nan where nothing
        says it.
        """


class PointsResidual:
    """Points, weighed by their scatter where it is known, else by the mean size of each metric."""

    def __init__(self, to: Points) -> None:
        self._measured, self.known = to.measured, numpy.isfinite(to.measured)
        size = numpy.nanmean(abs(to.measured), axis=0)
        usual = numpy.broadcast_to(numpy.where(size > 0.0, size, 1.0), self.known.shape)
        self._scale = usual if to.scatter is None else to.scatter
        self.scatter = math.nan if to.scatter is None else 1.0

    def of(self, given: Field) -> Field:
        """Of metrics [cases, metrics]."""
        found = (given - self._measured)[self.known] / self._scale[self.known]
        if not numpy.isfinite(found).all():
            raise SweepError("a metric has no value in a case where it was measured; narrow the ranges of --free")
        return numpy.asarray(found)

    def probability(self, left: Field, slope: Field, given: Field) -> float:
        """By chi-squared."""
        freedom = left.size - slope.shape[1]
        return math.nan if math.isnan(self.scatter) or freedom == 0 else float(stats.chi2.sf(left @ left, freedom))


class DensityResidual:
    """The logarithm of a series' density, both estimates with the scatter of chance; a run may go another way in time."""

    scatter = 1.0

    def __init__(self, to: Series) -> None:
        self._to, self.measured = to, log_density(to.time, to.values)
        self.lines = loud(self.measured)

    def density(self, given: Field) -> Field:
        """ln of the density of a run."""
        time, values = given
        if time[0] > self._to.time[0] or time[-1] < self._to.time[-1]:
            raise too_short(given, self._to)
        return log_density(self._to.time, numpy.interp(self._to.time, time, values)).values

    def of(self, given: Field) -> Field:
        """Of times and values [2, samples]."""
        found = (self.density(given) - self.measured.values)[self.lines] / (math.sqrt(2.0) * self.measured.scatter)
        if not numpy.isfinite(found).all():
            raise SweepError(
                f"{self._to.name} of a run stands still where the recording moves; narrow the ranges of --free"
            )
        return numpy.asarray(found)

    def probability(self, left: Field, slope: Field, given: Field) -> float:
        """By chi-squared."""
        return float(stats.chi2.sf(left @ left, left.size - slope.shape[1]))


class ResponseResidual:
    """The logarithm of a transmissibility, over the spread by chance of both estimates as if their floors were two.

    Nothing is whitened: windows of Hann make independent what lies two lines apart (`spectrum.APART`), so that of the
    measured points those are compared, where the run can be trusted too. The spreads are weights: floors that are one have
    most of it in common, so that what is left says how large chance is.
    """

    scatter = math.nan

    def __init__(self, to: MeasuredResponse) -> None:
        self._to = to
        self.lines = numpy.arange(to.frequency.size)
        self.spread: Field = numpy.ones(to.frequency.size)

    @property
    def frequency(self) -> Field:
        """[Hz] of the points that are compared."""
        return self._to.frequency[self.lines]

    @property
    def measured(self) -> Field:
        """Magnitudes there."""
        return self._to.magnitude[self.lines]

    def fitted(self, given: Field) -> Field:
        """Magnitudes of a run there, its line ``given`` as frequency, magnitude and spread [3, lines]."""
        known = given[:, numpy.isfinite(given[1])]
        if not known.size:
            raise SweepError("the seat of a run follows its floor nowhere; narrow the ranges of --free")
        return numpy.asarray(numpy.exp(numpy.interp(self.frequency, known[0], numpy.log(known[1]))))

    def of(self, given: Field) -> Field:
        """Of frequency, magnitude and spread [3, lines]."""
        return numpy.asarray(numpy.log(self.fitted(given) / self.measured) / self.spread)

    def weigh(self, given: Field) -> float:
        """Take the points and their spreads of a run; by how much the spreads changed, of the largest, 1 where points did.

        Raises SweepError where the run can be trusted at too few of them.
        """
        to, known = self._to, given[:, numpy.isfinite(given[1])]
        width = float(given[0, 1] - given[0, 0])
        near = _between(known[0], to.frequency, 1.5 * width)
        if to.spread is not None and to.frequency.size > 1:
            width = max(width, float(numpy.median(numpy.diff(to.frequency))))
        lines: list[int] = []
        for place in numpy.flatnonzero(near):
            if not lines or to.frequency[place] - to.frequency[lines[-1]] > (APART - 1e-6) * width:
                lines.append(int(place))
        if len(lines) < FEWEST_LINES:
            run = f"from {known[0, 0]:.3g} to {known[0, -1]:.3g} Hz" if known.size else "nowhere"
            raise SweepError(
                f"a run can be trusted {run}, T(f) was measured from {to.frequency[0]:.3g} to {to.frequency[-1]:.3g} Hz: "
                f"{len(lines)} independent lines in common, {FEWEST_LINES} are needed; set a longer duration, or measure more"
            )
        before, self.lines = (self.lines, self.spread), numpy.array(lines)
        self.spread = numpy.ones(len(lines))
        if to.spread is not None:
            of_run = numpy.interp(self.frequency, known[0], known[2])
            both = OVERLAP * (to.spread[self.lines] ** 2 + of_run**2)
            self.spread = numpy.sqrt(numpy.maximum(both, LEAST_SPREAD**2))
        if not numpy.array_equal(before[0], self.lines):
            return 1.0
        return float((abs(self.spread - before[1]) / self.spread).max())

    def probability(self, left: Field, slope: Field, given: Field) -> float:
        """Twice the least of two: of so large a sum of squares where the spreads are known (chi-squared), and of the
        autocorrelations of what is left from line to line (Ljung and Box), for what another model leaves is smooth.
        """
        if float(numpy.std(numpy.log(self.fitted(given) / self.measured))) < EXACT:
            return math.nan
        white = _of_whiteness(left, min(LAGS_OF_LINES, left.size // 4), 0)
        freedom = left.size - slope.shape[1]
        if self._to.spread is None or freedom < 1:
            return white
        return min(1.0, 2.0 * min(white, float(stats.chi2.sf(left @ left, freedom))))


class SeriesResidual:
    """A series, whitened by an autoregression of order `ORDER` of what is left, the time between recording and run free
    within ``most_shift`` [s]: the best one is taken beside each run, so that differences of residuals hold what it takes.
    """

    scatter = math.nan

    def __init__(self, to: Series, most_shift: float, part: float = 1.0) -> None:
        """Of the beginning of a recording that holds a ``part`` of its square about the median."""
        margin = most_shift + LEFT_OUT * float(to.time[-1] - to.time[0])
        inside = (to.time >= to.time[0] + margin) & (to.time <= to.time[-1] - margin)
        square = numpy.cumsum((to.values - numpy.median(to.values)) ** 2)
        self._window = int(numpy.searchsorted(square[inside], part * square[inside][-1])) + 1 if inside.any() else 0
        self.time, self.measured = to.time[inside][: self._window], to.values[inside][: self._window]
        self._to, self._most = to, most_shift
        self.filter: Field = numpy.array([1.0])
        self._late = math.nan

    @property
    def end(self) -> float:
        """[s] to which a run is needed."""
        return float(self.time[-1]) + self._most

    def shift(self, given: Field) -> float:
        """[s] by which the recording is late."""
        return self._best(self._path(given))

    def fitted(self, given: Field) -> Field:
        """What a run gives at the times of the recording, as late as that is."""
        path = self._path(given)
        return numpy.asarray(path(self.time - self._best(path)))

    def of(self, given: Field) -> Field:
        """Of times and values [2, samples]."""
        path = self._path(given)
        return self._left(path, self._best(path))

    def whiten(self, given: Field) -> float:
        """Take the filter ``1 - sum a_k z^-k`` of what a run leaves, a_k by least squares; by how much it changed."""
        left = self.fitted(given) - self.measured
        columns = numpy.array([left[ORDER - lag : len(left) - lag] for lag in range(1, ORDER + 1)]).T
        found, *_ = numpy.linalg.lstsq(columns, left[ORDER:], rcond=None)
        before = numpy.zeros(1 + ORDER)
        before[: self.filter.size] = self.filter
        self.filter = numpy.concatenate(([1.0], -found))
        return float(abs(self.filter - before).max())

    def is_exact(self, given: Field) -> bool:
        """Whether what a run leaves is too small for chance."""
        return float(numpy.std(self.fitted(given) - self.measured)) < EXACT * float(self.measured.std())

    def probability(self, left: Field, slope: Field, given: Field) -> float:
        """Twice the least of two: of the autocorrelations of what is left if it is white (Ljung and Box), and of what follows the
        run's own values in it (Ljung, section 16.6). An autoregression can whiten what another model leaves; but that stays
        a function of the run, and chance is none.
        """
        if self.is_exact(given):
            return math.nan
        return min(1.0, 2.0 * min(_of_whiteness(left), self._of_independence(left, slope, given)))

    def _of_independence(self, left: Field, slope: Field, given: Field) -> float:
        """By an F test of the values of the run, `AROUND` samples before and behind, and of their square, beside the free keys:
        what these have made up for, such as a delay that is held, is seen only in what they cannot.
        """
        values = self.fitted(given)
        values = (values - values.mean()) / max(float(values.std()), 1e-300)
        inner = values.size - 2 * AROUND
        columns = [values[i : i + inner] for i in range(2 * AROUND + 1)]
        columns += [columns[AROUND] ** 2, columns[AROUND] ** 3, numpy.ones(inner)]
        whitened = numpy.array([signal.lfilter(self.filter, [1.0], each)[self.filter.size - 1 :] for each in columns]).T
        inside = slice(AROUND, AROUND + whitened.shape[0])
        own, by_keys = left[inside], slope[inside] / numpy.maximum(numpy.linalg.norm(slope, axis=0), 1e-300)
        by_keys = by_keys * float(numpy.linalg.norm(whitened, axis=0).max())
        of_keys, _, keys, _ = numpy.linalg.lstsq(by_keys, own, rcond=1e-7)
        both = numpy.hstack([whitened, by_keys])
        followed, _, rank, _ = numpy.linalg.lstsq(both, own, rcond=1e-7)
        rest = float(numpy.sum((own - both @ followed) ** 2))
        gain = float(numpy.sum((own - by_keys @ of_keys) ** 2)) - rest
        more, freedom = int(rank) - int(keys), own.size - int(rank)
        return (
            float(stats.f.sf(gain / more / (rest / freedom), more, freedom))
            if rest > 0.0 and min(more, freedom) > 0
            else 1.0
        )

    def _path(self, given: Field) -> interpolate.Akima1DInterpolator:
        """What a run gives over time: straight lines would damp what is fast wherever the shift is no whole step."""
        if given[0, 0] > self.time[0] - self._most or given[0, -1] < self.end:
            raise too_short(given, self._to)
        needed = slice(None, int(numpy.searchsorted(given[0], self.end)) + 3)
        if not numpy.isfinite(given[1, needed]).all():
            raise SweepError(f"{self._to.name} of a run has values that are no numbers; narrow the ranges of --free")
        return interpolate.Akima1DInterpolator(*given[:, needed], method="makima")

    def _left(self, path: interpolate.Akima1DInterpolator, late: float) -> Field:
        found = path(self.time - late) - self.measured
        return numpy.asarray(signal.lfilter(self.filter, [1.0], found)[self.filter.size - 1 :])

    def _best(self, path: interpolate.Akima1DInterpolator) -> float:
        if self._most == 0.0:
            return 0.0

        def square(late: float) -> float:
            return float(numpy.sum(self._left(path, late) ** 2))

        step = 2.0 * self._most / (TRIED_SHIFTS - 1)
        options = {"xatol": 1e-6 * self._most}
        for _ in range(2):
            if math.isnan(self._late):
                tried = numpy.linspace(-self._most, self._most, TRIED_SHIFTS)
                self._late = float(tried[numpy.argmin([square(float(each)) for each in tried])])
            bounds = max(self._late - step, -self._most), min(self._late + step, self._most)
            found = float(optimize.minimize_scalar(square, bounds=bounds, method="bounded", options=options).x)
            # Beside the last one, unless that leads to an end of where it was sought
            is_inside = min(found - bounds[0], bounds[1] - found) > 1e-3 * step
            self._late = found if is_inside else math.nan
            if is_inside or self._most - abs(found) < 1e-3 * step:
                break
        return found  # of a run that stands still as good as any


def _between(known: Field, places: Field, widest: float) -> NDArray[numpy.bool_]:
    """Mask of ``places`` that lie between two of those ``known``, increasing, that are less than ``widest`` apart."""
    if known.size < 2:
        return numpy.zeros(places.size, dtype=bool)
    behind = numpy.clip(numpy.searchsorted(known, places * (1.0 + 1e-9)), 1, known.size - 1)
    inside = (places >= known[0] * (1.0 - 1e-9)) & (places <= known[-1] * (1.0 + 1e-9))
    return numpy.asarray(inside & (known[behind] - known[behind - 1] < widest))


def _of_whiteness(left: Field, most: int = LAGS, order: int = ORDER) -> float:
    """Probability of the autocorrelations of what is left up to the lag ``most`` if an autoregression of an ``order`` has made
    it white, by Ljung and Box.
    """
    centred = left - left.mean()
    square = float(centred @ centred)
    if square == 0.0:
        return 1.0
    lags = numpy.arange(1, most + 1)
    found = numpy.array([float(centred[lag:] @ centred[:-lag]) / square for lag in lags])
    statistic = left.size * (left.size + 2.0) * float((found**2 / (left.size - lags)).sum())
    return float(stats.chi2.sf(statistic, most - order))


def too_short(given: Field, to: Series) -> SweepError:
    """What to say of a run that ends before the recording."""
    return SweepError(f"the run ends at {given[0, -1]:.6g} s, the recording at {to.time[-1]:.6g} s; set duration")
