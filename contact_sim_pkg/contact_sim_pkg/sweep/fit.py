"""Keys of a scene fitted to what was measured, with intervals, and whether the scene can follow it at all.

Least squares (`sweep/least_squares.py`) over residuals (`sweep/residuals.py`) of the runs of a scene (`sweep/scene_runs.py`),
their keys in [0, 1] between their bounds, by the logarithm where a range says so. A series is fitted to its beginning first,
then to longer parts: over many impacts at once the square has minima by the hundred. Then the accuracy that the runs request
is tightened until a finer one moves what is left by less than chance lets it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence, Set
from contextlib import ExitStack, suppress
from pathlib import Path

import numpy
from numpy.typing import NDArray
from scipy import stats

from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.sweep.case import scene_of
from contact_sim_pkg.sweep.fit_result import LEAST_PROBABILITY, Compared, Fit, Fitted
from contact_sim_pkg.sweep.intervals import LEVEL, Interval, intervals, unidentified
from contact_sim_pkg.sweep.least_squares import ROUGH, At, Minimum, minimum
from contact_sim_pkg.sweep.measured import Measured, MeasuredResponse, Points, Series
from contact_sim_pkg.sweep.pool import Workers
from contact_sim_pkg.sweep.recorded import NO_ERROR, OwnError, own_error
from contact_sim_pkg.sweep.residuals import (
    EXACT,
    DensityResidual,
    PointsResidual,
    Residual,
    ResponseResidual,
    SeriesResidual,
)
from contact_sim_pkg.sweep.scene_runs import Runs, SceneRuns
from contact_sim_pkg.sweep.sensor import check_sensor, is_of_sensor
from contact_sim_pkg.sweep.starts import as_good, far_starts, followed, starts
from contact_sim_pkg.sweep.sweep import CASES, Notify, check_folder, processors, texts_of
from contact_sim_pkg.sweep.variation import SweepError, Values, Variation

__all__ = ["Compared", "Fit", "Fitted", "fit"]

Field = NDArray[numpy.float64]

EFFECT_KEY = re.compile(r"(effects\.\w+\.\w+)\.\w+")
PARTS = 0.125, 0.35, 1.0
"""Of a recording's square, that are fitted one after the other."""
MOST_ROUNDS = 4
"""Of fitting and whitening."""
WHITE, SAME_SPREAD = 0.02, 0.1
"""By which the filters, and of themselves the spreads of lines of two rounds may differ."""
FINER = 0.1
"""Times the accuracy, of the run beside which one is looked at."""
FAR = 10.0
"""Times what chance lets a square grow by, that slopes may err by."""
STILL, FAINT = 0.3, 0.1
"""Standard deviations of its own by which a parameter, and of chance by which what is left may move under a finer accuracy."""


def _within_request(found: Fit, scene: str) -> float:
    """Accuracy that the runs request if what is left is no more than it allows, else 0."""
    (compared,) = found.compared
    accuracy = requested(scene_of(scene, texts_of(found.values)).data["accuracy"])
    left = float(abs(compared.fitted - compared.measured).max())
    return accuracy if left <= accuracy * float(abs(compared.measured).max()) else 0.0


def fit(
    scene: str,
    to: Measured,
    free: Sequence[Variation],
    folder: Path,
    *,
    fixed: Values | None = None,
    jobs: int | None = None,
    most_shift: float = 0.02,
    by_spectrum: bool = False,
    workers: Workers | None = None,
    notify: Notify = lambda _text, _done: None,
) -> Fit:
    """Fit keys of a scene; the fitted scene is written to ``fitted.yaml`` in the folder.

    Args:
        scene: a name or path.
        to: what was measured.
        free: keys with their ranges.
        folder: new, empty, or of this fit: cases that it holds do not run again.
        fixed: what is set in every case; an ``accuracy`` there is held, else the runs request a finer one where they must.
        jobs: processes; None: as many as there are processors.
        most_shift: [s] by which a recording may be late or early; 0 holds it.
        by_spectrum: whether the densities of a series are compared in place of its samples.
        workers: processes that have begun already, in place of ``jobs``.
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
    check_sensor(keys, fixed or {}, to)
    sensor = {key: value for key, value in (fixed or {}).items() if is_of_sensor(key)}
    of_scene = {key: value for key, value in (fixed or {}).items() if key not in sensor}
    cases: list[Values] = [{**of_scene, **each} for each in (to.values if isinstance(to, Points) else [{}])]
    inner = [each for each in free if not is_of_sensor(each.key)]
    middle = scene_of(scene, texts_of({**cases[0], **{each.key: each.at(0.5) for each in inner}}))
    for each in inner:
        for end in each.ends:
            scene_of(scene, texts_of({**cases[0], **{other.key: other.at(0.5) for other in inner}, each.key: end}))
    if isinstance(to, MeasuredResponse) and middle.data.get("seat") is None:
        raise SweepError(f"{scene} has no seat, so no transmissibility from its floor: fit a series or metrics of it")
    (folder / CASES).mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        if workers is None:
            workers = stack.enter_context(Workers(jobs or processors()))
        runs = SceneRuns(scene, to, cases, free, folder, workers, notify, sensor)
        runs.accuracy = requested(middle.data["accuracy"])
        runs.is_held = any("accuracy" in each for each in cases)
        if isinstance(to, Points):
            found = _fitted_points(runs, to)
        elif isinstance(to, MeasuredResponse):
            found = _fitted_response(runs, to)
        else:
            found = _fitted_spectrum(runs, to) if by_spectrum else _fitted_series(runs, to, most_shift)
    if found.probability < LEAST_PROBABILITY and isinstance(to, Series) and not by_spectrum and runs.is_held:
        found = found._replace(coarse=_within_request(found, scene))
    (folder / "fitted.yaml").write_text(_text_of(scene, found), encoding="utf-8")
    return found


class _Concluded:
    """A least square that was found, its intervals, what is left, and others that are as good."""

    def __init__(
        self,
        runs: Runs,
        residual: Residual,
        found: Minimum,
        to: Measured,
        others: Sequence[Minimum] = (),
        fewer: int = 0,
    ) -> None:
        """Of a residual with ``fewer`` degrees of freedom than its keys leave; ``others`` are what further starts led to."""
        at, count = _at(runs, residual), found.place.size
        own = own_error(runs, residual, to, found.place)
        found, *others = _sorted([found, *(minimum(at, each.place, least=own.scatter) for each in others)])
        self.others: list[Minimum] = []
        for _ in range(2):
            freedom = found.freedom - fewer
            self.scatter = _scatter(residual, found.square, freedom, own)
            blind = unidentified(at, found, self.scatter)
            ends = [Interval(math.nan, math.nan)] * count
            if blind.any() or not self.scatter > 0.0:
                break
            quantile = stats.t.ppf(0.5 + 0.5 * LEVEL, freedom if math.isnan(residual.scatter) else math.inf)
            self.others = as_good(others, found, self.scatter, quantile)
            ends, best = intervals(at, found, self.scatter, quantile)
            # A profile may come upon a place that is better than where it began
            if float(numpy.sum(at([best])[0] ** 2)) > found.square - 0.1 * self.scatter**2:
                break
            found = minimum(at, best, least=own.scatter)
        needless = set() if blind.any() or not self.scatter > 0.0 else _needless(runs, residual, found, self.scatter)
        self.found, self.own, self.given = found, own, runs([found.place])[0]
        self.probability = residual.probability(found.left, found.slope, self.given)
        ends = [Interval(low - way, high + way) for (low, high), way in zip(ends, own.ways(found.slope), strict=True)]
        self.parameters = _parameters(runs, found.place, ends, blind, needless)

    def as_fit(self, runs: Runs, misfit: float, unit: str, compared: list[Compared], shift: float = 0.0) -> Fit:
        """The result."""
        is_own = self.probability < LEAST_PROBABILITY and self.own.is_all(self.found.left)
        return Fit(
            self.parameters, misfit, unit, self.probability, shift, runs.count, runs.values_at(self.found.place), compared,
            self.own.request if is_own else 0.0, runs.accuracy, self.own.request,
            [[_value(each, float(part)) for each, part in zip(runs.free, other.place, strict=True)] for other in self.others],
        )  # fmt: skip


def _sorted(found: Sequence[Minimum]) -> list[Minimum]:
    return sorted(found, key=lambda each: each.square)


def _scatter(residual: Residual, square: float, freedom: int, own: OwnError) -> float:
    """Standard deviation of a residual by chance, and by the recording's own error where that is more; nan: not known."""
    usual = residual.scatter
    if math.isnan(usual) and freedom > 0:
        usual = math.sqrt(square / freedom)
    return float(numpy.fmax(usual, own.scatter)) if own.moved is not None else usual


def _needless(runs: Runs, residual: Residual, found: Minimum, scatter: float) -> set[str]:
    """Effects with a free key without which the least square over the other keys is no larger than chance lets it (F test)."""
    needless = set()
    for effect in dict.fromkeys(match[1] for each in runs.free if (match := EFFECT_KEY.fullmatch(each.key))):
        others = [i for i, each in enumerate(runs.free) if not each.key.startswith(f"{effect}.")]
        without, count = runs.without(effect), len(runs.free) - len(others)
        if without is None:
            continue
        freedom = max(found.freedom, 1) if math.isnan(residual.scatter) else math.inf
        most = count * float(stats.f.ppf(LEVEL, count, freedom)) * scatter**2
        with suppress(SweepError):  # a run that fails without it, or does not give what was measured
            if _least_without(_at(without, residual), found, others, FAR * most) - found.square <= most:
                needless.add(effect)
        runs.count += without.count
    return needless


def _least_without(at: At, found: Minimum, others: list[int], far: float) -> float:
    """The least square over the ``others`` of the keys; as the slopes predict it where that is more by ``far``: one run then."""
    place, slope = found.place[others], found.slope[:, others]
    (left,) = at([place])
    step, *_ = numpy.linalg.lstsq(slope, -left, rcond=None)
    predicted = float(numpy.sum((left + slope @ step) ** 2))
    if predicted - found.square > far or not others:
        return predicted
    return minimum(at, place).square


def _at(runs: Runs, residual: Residual) -> At:
    return lambda places: [residual.of(given) for given in runs(places)]


def _minima(runs: Runs, at: At) -> tuple[Minimum, list[Minimum]]:
    """The least square, and what further starts led to."""
    places = starts(at, len(runs.free))
    found = minimum(at, places[0])
    found, *others = _sorted([found, *followed(at, far_starts(at, places, found), found)])
    return found, others


def _fitted_points(runs: Runs, to: Points) -> Fit:
    residual = PointsResidual(to)
    _require_enough(int(residual.known.sum()), runs)
    found, others = _minima(runs, _at(runs, residual))
    concluded = _Concluded(runs, residual, _settled(runs, residual, found), to, others)
    number, given = numpy.arange(1.0, 1.0 + len(to.values)), concluded.given
    compared = [
        Compared(_titled(each, to.units.get(each, "")), number, to.measured[:, i], given[:, i], "row of the table")
        for i, each in enumerate(to.metrics)
    ]
    unit = "of its scatter" if to.scatter is not None else "of the mean size"
    return concluded.as_fit(runs, math.sqrt(concluded.found.square / concluded.found.left.size), unit, compared)


def _fitted_spectrum(runs: Runs, to: Series) -> Fit:
    residual = DensityResidual(to)
    _require_enough(int(residual.lines.sum()), runs)
    found, others = _minima(runs, _at(runs, residual))
    own = own_error(runs, residual, to, found.place)
    concluded = _Concluded(runs, residual, _settled(runs, residual, found, own), to, others)
    lines, given = residual.lines, concluded.given
    both = numpy.exp(residual.measured.values[lines]), numpy.exp(residual.density(given)[lines])
    compared = [Compared(f"density of {to.name}", residual.measured.frequency[lines], *both, "frequency, Hz")]
    left = concluded.found.left
    return concluded.as_fit(runs, math.sqrt(float(left @ left) / left.size), "of the scatter of its lines", compared)


def _fitted_response(runs: Runs, to: MeasuredResponse) -> Fit:
    """A transmissibility, its lines weighed anew by the spread of the run that is best, round by round."""
    residual = ResponseResidual(to)
    at = _at(runs, residual)
    residual.weigh(runs([numpy.full(len(runs.free), 0.5)])[0])
    places = starts(at, len(runs.free))
    best, led = places[0], None
    for _ in range(MOST_ROUNDS):
        changed = residual.weigh(runs([best])[0])
        _require_enough(residual.lines.size, runs)
        own = own_error(runs, residual, to, best)
        found = minimum(at, best, least=own.scatter)
        if led is None:  # before a finer request makes the starts new runs
            led = far_starts(at, places, found)
        best = (found := _settled(runs, residual, found, own)).place
        if changed < SAME_SPREAD:
            break
    others = followed(at, led or [], found, own.scatter)
    concluded = _Concluded(runs, residual, found, to, others)
    fitted, left = residual.fitted(concluded.given), concluded.found.left
    compared = [Compared("seat.transmissibility", residual.frequency, residual.measured, fitted, "frequency, Hz")]
    unit = "of the magnitude" if to.spread is None else "of the spread of its lines"
    return concluded.as_fit(runs, math.sqrt(float(left @ left) / left.size), unit, compared)


def _fitted_series(runs: Runs, to: Series, most_shift: float) -> Fit:
    """A series, in parts that grow, then whitened anew round by round."""
    _require_enough(SeriesResidual(to, most_shift).time.size, runs)
    least, led = EXACT * float(to.values.std()), None
    for part in PARTS:
        residual = SeriesResidual(to, most_shift, part)
        at = _at(runs, residual)
        runs.end = residual.end if part < 1.0 else None
        if led is None:
            places = starts(at, len(runs.free))
            found = minimum(at, places[0], ROUGH, least)
            led = far_starts(at, places, found)
        else:
            found = minimum(at, found.place, ROUGH, least)
        found, *others = _sorted([found, *followed(at, led, found, least)])
        led = [each.place for each in others]
    for _ in range(MOST_ROUNDS):
        given = runs([found.place])[0]
        # What a recording of the bench leaves of its own error has no colour to be taken off
        is_done = to.request > 0.0 and residual.is_exact(given)
        changed = 0.0 if is_done else residual.whiten(given)
        own = own_error(runs, residual, to, found.place)
        found = _settled(runs, residual, minimum(at, found.place, least=own.scatter), own)
        if changed < WHITE:
            break
    concluded = _Concluded(runs, residual, found, to, others, fewer=1)
    given = concluded.given
    fitted = residual.fitted(given)
    compared = [Compared(to.name, residual.time, residual.measured, fitted, "time, s")]
    misfit = float(numpy.std(fitted - residual.measured))
    return concluded.as_fit(runs, misfit, "", compared, residual.shift(given))


def _settled(runs: Runs, residual: Residual, found: Minimum, own: OwnError = NO_ERROR) -> Minimum:
    """The least square of runs that request enough, and no more than a recording of the bench can show."""
    at = _at(runs, residual)
    while not runs.is_held and runs.accuracy > own.finest:
        usual = runs.accuracy
        scatter = _scatter(residual, found.square, max(found.freedom, 1), own)
        runs.accuracy = max(FINER * usual, own.finest)
        moved = at([found.place])[0] - found.left
        basis, _ = numpy.linalg.qr(found.slope)
        is_still = float(numpy.linalg.norm(basis.T @ moved)) <= STILL * scatter
        if is_still and float(numpy.std(moved)) <= FAINT * scatter:
            runs.accuracy = usual
            break
        found = minimum(at, found.place, least=own.scatter)
    return found


def _titled(name: str, unit: str) -> str:
    return f"{name}, {unit}" if unit else name


def _parameters(
    runs: Runs, place: Field, ends: Sequence[Interval], blind: NDArray[numpy.bool_], needless: Set[str]
) -> list[Fitted]:
    """Values with their intervals, and what is not identifiable."""
    unseen = [each.key for each, is_blind in zip(runs.free, blind, strict=True) if is_blind]
    found = []
    for each, part, (low, high), is_blind in zip(runs.free, place, ends, blind, strict=True):
        remark = ""
        if is_blind:
            beside = [other for other in unseen if other != each.key]
            remark = f"not identifiable beside {', '.join(beside)}" if beside else "moves nothing that was measured"
        elif part < 1e-6 or part > 1.0 - 1e-6:
            remark = "at the end of its range"
        elif low < 0.0 or high > 1.0:
            remark = "interval beyond its range"
        if any(each.key.startswith(f"{effect}.") for effect in needless):
            remark = f"{remark}; not needed".removeprefix("; ")
        found.append(Fitted(each.key, _value(each, float(part)), _value(each, low), _value(each, high), remark))
    return found


def _value(free: Variation, part: float) -> float:
    """At a part of a range, beyond its ends too."""
    if free.is_logarithmic:
        return float(free.low * (free.high / free.low) ** part)
    return free.low + part * (free.high - free.low)


def _require_enough(count: int, runs: Runs) -> None:
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
