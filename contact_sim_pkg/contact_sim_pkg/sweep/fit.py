"""Keys of a scene fitted to what was measured, with intervals, and whether the scene can follow it at all.

Least squares over the residual ``r = (model - measured) / scatter``: of points with their own scatter, or one that is
estimated; of the spectrum of a series with the scatter of chance; of a series itself whitened by an autoregression of order
`ORDER` that is fitted to what is left (without that, coloured noise makes intervals half as wide as they are), the time
between recording and run free within a bound. Parameters lie in [0, 1] between their bounds, by their logarithm where asked;
differences are cases over processes.

The interval of a parameter is ``t(0.95) s sqrt((J^T J)^-1)`` in that measure, both ends put back into the unit of the key: a
linear picture, right where a parameter moves little within it. A direction in which the parameters move nothing more than
differences of two steps disagree is named, no interval is given then.

Sources: Seber and Wild, Nonlinear Regression (1989), sections 5.1 and 6.4; Ljung and Box, Biometrika 65 (1978) 297.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy
from numpy.typing import NDArray
from scipy import optimize, signal, stats

from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.sweep.case import FINISHED, Row, Task, scene_of, sources_hash
from contact_sim_pkg.sweep.fit_result import LEAST_PROBABILITY, Compared, Fit, Fitted
from contact_sim_pkg.sweep.measured import Points, Series
from contact_sim_pkg.sweep.pool import Workers
from contact_sim_pkg.sweep.spectrum import log_density, loud
from contact_sim_pkg.sweep.sweep import CASES, Notify, check_folder, processors, texts_of
from contact_sim_pkg.sweep.variation import SweepError, Values, Variation, samples_of

__all__ = ["Compared", "Fit", "Fitted", "fit"]

Field = NDArray[numpy.float64]

ORDER = 4
STEP = 3e-3
"""Of a parameter's range: of the differences; the second ones are twice that."""
STARTS = 4
"""Cases a parameter, drawn over the ranges, of which the best is the start."""
LEVEL = 0.90
LAGS = 20
EXACT = 2e-3
"""Of a recording's own standard deviation: what is left below it is numerical, chance has no part in it."""
MOST_ROUNDS = 4
"""Of fitting and whitening."""
MOST_STEPS = 30
UNSEEN = 3.0
"""Times that by which differences of two steps disagree: what moves the residual less is not seen."""
LEFT_OUT = 0.02
"""Of a series' time at either end, beyond the shift."""


Model = Callable[[Sequence[Field]], list[Field]]
"""Of parameters in [0, 1] what the scene gives."""


def fit(
    scene: str,
    to: Points | Series,
    free: Sequence[Variation],
    folder: Path,
    *,
    fixed: Values | None = None,
    jobs: int | None = None,
    most_shift: float = 0.02,
    by_spectrum: bool = False,
    notify: Notify = lambda _text, _done: None,
) -> Fit:
    """Fit keys of a scene; the fitted scene is written to ``fitted.yaml`` in the folder.

    Args:
        scene: a name or path.
        to: what was measured.
        free: keys with their ranges.
        folder: new, empty, or of this fit: cases that it holds do not run again.
        fixed: what is set in every case.
        jobs: processes; None: as many as there are processors.
        most_shift: [s] by which a recording may be late or early; 0 holds it.
        by_spectrum: whether the densities of a series are compared in place of its samples.
        notify: gets what is being done.

    Raises:
        SweepError: fewer measured values than free keys, a free key without a range, or a case that failed.
        SceneError: a key or an end of a range is refused.
    """
    check_folder(folder)
    listed = [each.key for each in free if each.listed]
    if not free or listed:
        raise SweepError(f"--free {listed[0] if listed else ''}: needs a range, KEY=low:high")
    keys = [each.key for each in free]
    if len(set(keys)) < len(keys):
        raise SweepError(f"--free {keys[0]}: is there twice")
    cases: list[Values] = [{**(fixed or {}), **each} for each in (to.values if isinstance(to, Points) else [{}])]
    for each in free:
        for end in each.ends:
            scene_of(scene, texts_of({**cases[0], **{other.key: other.at(0.5) for other in free}, each.key: end}))
    (folder / CASES).mkdir(parents=True, exist_ok=True)
    with Workers(jobs or processors()) as workers:
        runs = _Runs(scene, to, cases, free, folder, workers, notify)
        if isinstance(to, Points):
            found = _fitted_points(runs, to)
        else:
            found = _fitted_spectrum(runs, to) if by_spectrum else _fitted_series(runs, to, most_shift)
    if found.probability < LEAST_PROBABILITY and isinstance(to, Series) and not by_spectrum:
        found = found._replace(coarse=_within_request(found, scene))
    (folder / "fitted.yaml").write_text(_text_of(scene, found), encoding="utf-8")
    return found


def _within_request(found: Fit, scene: str) -> float:
    """Accuracy that the runs request if what is left is no more than it allows, else 0."""
    (compared,) = found.compared
    accuracy = requested(scene_of(scene, texts_of(found.values)).data["accuracy"])
    left = float(abs(compared.fitted - compared.measured).max())
    return accuracy if left <= accuracy * float(abs(compared.measured).max()) else 0.0


class _Runs:
    """What the scene gives at parameters, by cases."""

    def __init__(
        self, scene: str, to: Points | Series, cases: Sequence[Values], free: Sequence[Variation], folder: Path,
        workers: Workers, notify: Notify,
    ) -> None:  # fmt: skip
        self._scene, self._to, self._cases, self.free = scene, to, cases, free
        self._folder, self._workers, self._notify = folder, workers, notify
        self.count = 0

    def __call__(self, places: Sequence[Field]) -> list[Field]:
        """Of points the metrics [cases, metrics], of a series what the run has at its times, of each place."""
        cases = self._cases
        series = self._to.name if isinstance(self._to, Series) else ""
        tasks = [
            Task(len(cases) * i + j, self._scene, texts_of({**case, **self.values_at(place)}), str(self._folder.absolute()),
                 False, sources_hash(), series)
            for i, place in enumerate(places) for j, case in enumerate(cases)
        ]  # fmt: skip
        rows: dict[int, Row] = {}
        for row in self._workers.run(tasks):
            if row["outcome"] != FINISHED:
                raise SweepError(f"{' '.join(tasks[row['number']].values)} did not finish: {row['sentence']}")
            rows[row["number"]] = row
            self._notify(f"{self.count + len(rows)} runs", 0.0)
        self.count += len(tasks)
        return [self._given([rows[len(cases) * i + j] for j in range(len(cases))]) for i in range(len(places))]

    def values_at(self, place: Field) -> Values:
        """What a place sets."""
        return {each.key: each.at(float(part)) for each, part in zip(self.free, place, strict=True)}

    def _given(self, rows: Sequence[Row]) -> Field:
        if isinstance(self._to, Points):
            return numpy.array(
                [[_metric(row, each, self._to.units.get(each)) for each in self._to.metrics] for row in rows]
            )
        return numpy.array([rows[0]["time"], rows[0]["values"]])


def _metric(row: Row, key: str, unit: str | None) -> float:
    for each in row["metrics"]:
        if each["key"] == key:
            if unit is not None and unit != each["unit"]:
                raise SweepError(f"{key} was measured in {unit}, the metric is in {each['unit'] or '1'}")
            return math.nan if each["value"] is None else float(each["value"])
    raise SweepError(f"the run has no metric {key}; it has {', '.join(each['key'] for each in row['metrics'])}")


def _fitted_points(runs: _Runs, to: Points) -> Fit:
    """Points, weighed by their scatter where it is known, else by the mean size of each metric."""
    known = numpy.isfinite(to.measured)
    _require_enough(int(known.sum()), runs)
    size = numpy.nanmean(abs(to.measured), axis=0)
    scale = (
        to.scatter if to.scatter is not None else numpy.broadcast_to(numpy.where(size > 0.0, size, 1.0), known.shape)
    )

    def residual(given: Field) -> Field:
        found = (given - to.measured)[known] / scale[known]
        if not numpy.isfinite(found).all():
            raise SweepError("a metric has no value in a case where it was measured; narrow the ranges of --free")
        return numpy.asarray(found)

    place, left, slope, disagreement = _minimum(runs, residual)
    freedom = left.size - place.size
    square = float(left @ left)
    probability = math.nan if to.scatter is None or freedom == 0 else float(stats.chi2.sf(square, freedom))
    scatter = 1.0 if to.scatter is not None else math.sqrt(square / freedom) if freedom else math.nan
    parameters = _parameters(runs, place, slope, disagreement, scatter, freedom if to.scatter is None else math.inf)
    unit = "of its scatter" if to.scatter is not None else "of the mean size"
    misfit = math.sqrt(square / left.size)
    given, number = runs([place])[0], numpy.arange(1.0, 1.0 + len(to.values))
    compared = [
        Compared(
            _titled(each, to.units.get(each, "")), number, to.measured[:, column], given[:, column], "row of the table"
        )
        for column, each in enumerate(to.metrics)
    ]
    return Fit(parameters, misfit, unit, probability, 0.0, runs.count, runs.values_at(place), compared)


def _fitted_series(runs: _Runs, to: Series, most_shift: float) -> Fit:
    """A series, whitened anew round by round; the shift is fitted beside each run without another."""
    margin = most_shift + LEFT_OUT * float(to.time[-1] - to.time[0])
    inside = (to.time >= to.time[0] + margin) & (to.time <= to.time[-1] - margin)
    time, measured = to.time[inside], to.values[inside]
    _require_enough(time.size, runs)
    filters = numpy.array([1.0])
    shift = 0.0

    def residual_at(given: Field, late: float) -> Field:
        if given[0, 0] > time[0] - late or given[0, -1] < time[-1] - late:
            raise SweepError(
                f"the run ends at {given[0, -1]:.6g} s, the recording at {to.time[-1]:.6g} s; set duration"
            )
        found = numpy.interp(time - late, given[0], given[1]) - measured
        return numpy.asarray(signal.lfilter(filters, [1.0], found)[len(filters) - 1 :])

    def best_shift(given: Field) -> float:
        if most_shift == 0.0:
            return 0.0
        found = optimize.minimize_scalar(
            lambda late: float(numpy.sum(residual_at(given, late) ** 2)), bounds=(-most_shift, most_shift), method="bounded",
            options={"xatol": 1e-6 * most_shift},
        )  # fmt: skip
        return float(found.x)

    place: Field | None = None
    for number in range(1, MOST_ROUNDS + 1):
        place, left, slope, disagreement = _minimum(runs, lambda given: residual_at(given, best_shift(given)), place)
        given = runs([place])[0]
        shift, used = best_shift(given), filters
        filters = numpy.array([1.0])
        found = _whitener(residual_at(given, shift))
        filters = used
        if number == MOST_ROUNDS or (number > 1 and abs(found - filters).max() < 0.02):
            break
        filters = found
    assert place is not None
    # The shift takes what goes along with it out of every derivative
    if most_shift > 0.0:
        along = (residual_at(given, shift + 1e-5) - residual_at(given, shift - 1e-5)) / 2e-5
        slope = slope - numpy.outer(along, along @ slope) / max(float(along @ along), 1e-300)
    freedom = left.size - place.size - 1
    misfit = float(numpy.std(numpy.interp(time - shift, *given) - measured))
    probability = math.nan if misfit < EXACT * float(measured.std()) else _ljung_box(left)
    scatter = math.sqrt(float(left @ left) / freedom)
    parameters = _parameters(runs, place, slope, disagreement, scatter, freedom)
    compared = [Compared(to.name, time, measured, numpy.interp(time - shift, *given), "time, s")]
    return Fit(parameters, misfit, "", probability, shift, runs.count, runs.values_at(place), compared)


def _fitted_spectrum(runs: _Runs, to: Series) -> Fit:
    """The logarithm of a series' density, both estimates with the scatter of chance; a run may go another way in time."""
    measured = log_density(to.time, to.values)
    lines = loud(measured)
    _require_enough(int(lines.sum()), runs)
    scatter = math.sqrt(2.0) * measured.scatter

    def density(given: Field) -> Field:
        time, values = given
        if time[0] > to.time[0] or time[-1] < to.time[-1]:
            raise SweepError(f"the run ends at {time[-1]:.6g} s, the recording at {to.time[-1]:.6g} s; set duration")
        return log_density(to.time, numpy.interp(to.time, time, values)).values

    def residual(given: Field) -> Field:
        found = (density(given) - measured.values)[lines] / scatter
        if not numpy.isfinite(found).all():
            raise SweepError(f"{to.name} of a run stands still where the recording moves; narrow the ranges of --free")
        return numpy.asarray(found)

    place, left, slope, disagreement = _minimum(runs, residual)
    square = float(left @ left)
    probability = float(stats.chi2.sf(square, left.size - place.size))
    parameters = _parameters(runs, place, slope, disagreement, 1.0, math.inf)
    fitted = density(runs([place])[0])
    both = numpy.exp(measured.values[lines]), numpy.exp(fitted[lines])
    compared = [Compared(f"density of {to.name}", measured.frequency[lines], *both, "frequency, Hz")]
    misfit = math.sqrt(square / left.size)
    return Fit(
        parameters, misfit, "of the scatter of its lines", probability, 0.0, runs.count, runs.values_at(place), compared
    )


def _titled(name: str, unit: str) -> str:
    return f"{name}, {unit}" if unit else name


def _minimum(
    runs: _Runs, residual: Callable[[Field], Field], start: Field | None = None
) -> tuple[Field, Field, Field, Field]:
    """The place of least squares, what is left there, and its slopes by differences of `STEP` [residuals, parameters], with
    how far those of twice the step disagree.

    Without a ``start`` the best of `STARTS` cases a parameter.
    """
    count = len(runs.free)
    known: dict[tuple[float, ...], Field] = {}

    def at(places: Sequence[Field]) -> list[Field]:
        new = [place for place in places if tuple(place) not in known]
        for place, given in zip(new, runs(new) if new else [], strict=True):
            known[tuple(place)] = residual(given)
        return [known[tuple(place)] for place in places]

    def slopes(place: Field, step: float) -> Field:
        ways = [step if part + step <= 1.0 else -step for part in place]
        moved = [place + way * numpy.eye(count)[i] for i, way in enumerate(ways)]
        here, *there = at([place, *moved])
        return numpy.array([(each - here) / way for each, way in zip(there, ways, strict=True)]).T

    if start is None:
        unit = [Variation(str(i), (), 0.0, 1.0) for i in range(count)]
        drawn = samples_of(unit, f"lhs:{STARTS * count}", 0, 1)
        places = [numpy.full(count, 0.5), *(numpy.array([float(each[str(i)]) for i in range(count)]) for each in drawn)]
        squares = [float(each @ each) for each in at(places)]
        start = places[int(numpy.argmin(squares))]
    found = optimize.least_squares(
        lambda place: at([place])[0], start, lambda place: slopes(place, STEP), bounds=(0.0, 1.0), max_nfev=MOST_STEPS,
        xtol=1e-6, ftol=1e-9, gtol=1e-12,
    )  # fmt: skip
    place = numpy.asarray(found.x)
    slope = slopes(place, STEP)
    return place, at([place])[0], slope, slopes(place, 2.0 * STEP) - slope


def _whitener(left: Field) -> Field:
    """Coefficients of the filter ``1 - sum a_k z^-k`` that whitens a series, a_k by least squares."""
    columns = numpy.array([left[ORDER - lag : len(left) - lag] for lag in range(1, ORDER + 1)]).T
    found, *_ = numpy.linalg.lstsq(columns, left[ORDER:], rcond=None)
    return numpy.concatenate(([1.0], -found))


def _ljung_box(left: Field) -> float:
    """Probability of the autocorrelations of a series up to `LAGS` if it is white."""
    centred = left - left.mean()
    square = float(centred @ centred)
    if square == 0.0:
        return 1.0
    lags = numpy.arange(1, LAGS + 1)
    found = numpy.array([float(centred[lag:] @ centred[:-lag]) / square for lag in lags])
    statistic = left.size * (left.size + 2.0) * float((found**2 / (left.size - lags)).sum())
    return float(stats.chi2.sf(statistic, LAGS - ORDER))


def _parameters(
    runs: _Runs, place: Field, slope: Field, disagreement: Field, scatter: float, freedom: float
) -> list[Fitted]:
    """Values with their intervals, and what is not identifiable."""
    blind = _unidentified(slope, disagreement, scatter)
    half = numpy.full(place.size, math.nan)
    if not blind.any() and math.isfinite(scatter):
        half = (
            stats.t.ppf(0.5 + 0.5 * LEVEL, freedom)
            * scatter
            * numpy.sqrt(numpy.diag(numpy.linalg.inv(slope.T @ slope)))
        )
    others = [each.key for each, unseen in zip(runs.free, blind, strict=True) if unseen]
    found = []
    for each, part, width, unseen in zip(runs.free, place, half, blind, strict=True):
        value, low, high = (_value(each, part + side * width) for side in (0.0, -1.0, 1.0)) if math.isfinite(width) else (
            _value(each, part), math.nan, math.nan
        )  # fmt: skip
        remark = ""
        if unseen:
            beside = [other for other in others if other != each.key]
            remark = f"not identifiable beside {', '.join(beside)}" if beside else "moves nothing that was measured"
        elif part < 1e-6 or part > 1.0 - 1e-6:
            remark = "at the end of its range"
        found.append(Fitted(each.key, value, low, high, remark))
    return found


def _unidentified(slope: Field, disagreement: Field, scatter: float) -> NDArray[numpy.bool_]:
    """Of each parameter, whether it lies in a direction in which nothing is seen: differences of two steps disagree by
    as much as they are, or the interval is wider than the range.
    """
    _left, sizes, directions = numpy.linalg.svd(slope, full_matrices=False)
    blind = numpy.zeros(slope.shape[1], dtype=bool)
    for size, direction in zip(sizes, directions, strict=True):
        unsure = UNSEEN * float(numpy.linalg.norm(disagreement @ direction))
        if size <= unsure or (math.isfinite(scatter) and 2.0 * scatter > size):
            blind |= abs(direction) > 0.3
    return blind


def _value(free: Variation, part: float) -> float:
    """At a part of a range, beyond its ends too."""
    if free.is_logarithmic:
        return float(free.low * (free.high / free.low) ** part)
    return free.low + part * (free.high - free.low)


def _require_enough(count: int, runs: _Runs) -> None:
    if count < len(runs.free):
        raise SweepError(f"{count} measured values for {len(runs.free)} free keys: measure more, or free less")


def _text_of(scene: str, found: Fit) -> str:
    """The fitted scene, resolved, with what each value is known to."""
    said = [
        f"# {each.key}: {each.value:.6g}, {100 * LEVEL:.0f} % interval {each.low:.6g} to {each.high:.6g}"
        if math.isfinite(each.low) else f"# {each.key}: {each.value:.6g}, {each.remark or 'no interval'}"
        for each in found.parameters
    ]  # fmt: skip
    return "\n".join([f"# {scene}, fitted", *said, scene_of(scene, texts_of(found.values)).to_yaml()])
