"""Twins of a fit: recordings of the bench's own runs with hidden values and noise, fitted, and the truth counted inside the
90 % intervals.

A twin made and fitted at one request proves nothing: its recording is of runs at a request of 1e-6, a cushion on cells of half
the side, four samples to one of the fit's, late by up to 2 ms. Noise is white, or an autoregression of first order. A truth is
drawn over the inner half of each range.

    python -m contact_sim_lab.twins.fit_twins seat slap --count 20
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy import interpolate, signal

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.sweep.case import FINISHED, Row, Task, sources_hash
from contact_sim_pkg.sweep.fit import Fit, fit
from contact_sim_pkg.sweep.measured import Points, Series
from contact_sim_pkg.sweep.pool import Workers
from contact_sim_pkg.sweep.sensor import FILTER, is_of_sensor
from contact_sim_pkg.sweep.sweep import CASES, texts_of
from contact_sim_pkg.sweep.variation import Values, read_variation

__all__ = [
    "KINDS",
    "PAIRS",
    "REFUSED",
    "Kind",
    "Twin",
    "counted",
    "fitted",
    "is_named",
    "recording",
    "refused",
    "twins",
]

Field = NDArray[numpy.float64]
LATEST = 2e-3
"""[s] that a recording may be late or early."""
RATE = 250.0
"""[Hz] of a recording."""


class Kind(NamedTuple):
    """A scene, and what of it is hidden."""

    scene: str
    fixed: Values
    free: tuple[str, ...]
    series: str = ""
    """of a recording; empty: points"""
    noise: float = 0.01
    """standard deviation, of that of the series; of each point relative"""
    colour: float = 0.0
    """from one sample of the noise to the next"""
    finer: Values = {}  # noqa: RUF012 - a default that nobody changes
    """what the twin's own run has beside a tighter request"""
    points: tuple[Values, ...] = ()
    metrics: tuple[str, ...] = ()


class Twin(NamedTuple):
    """A fit of hidden values."""

    truth: list[float]
    found: Fit
    cpu: float
    """[s] of the fit and its runs"""

    @property
    def inside(self) -> list[bool]:
        """Of each key, whether its interval holds the truth."""
        return [each.low <= truth <= each.high for each, truth in zip(self.found.parameters, self.truth, strict=True)]


KINDS = {
    "seat": Kind(
        "seat_ride", {"duration": "6"},
        ("effects.seat.cushion.plateau=2400:4800:log", "effects.seat.foam_hysteresis.share=0.03:0.4:log"),
        "seat/force.normal", finer={"effects.seat.cushion.cell": "0.005", "outputs.force_rate": "1000"},
    ),
    "slap": Kind(
        "seat_slap", {"duration": "2"},
        ("effects.backrest.normal_elastic.coefficient=1e5:6e5:log",
         "effects.backrest.normal_dissipative.restitution=0.3:0.9"),
        "backrest/force.normal", finer={"outputs.force_rate": "1000"},
    ),
    "tire": Kind(
        "tire_bump", {"duration": "2", "effects.tire.contact_field": "null"},
        ("tire.suspension_damping=700:3500:log", "tire.suspension_stiffness=10e3:40e3:log"),
        "tire/force.normal", finer={"outputs.force_rate": "1000"},
    ),
    "impact": Kind(
        "impact_rubber_drop", {"duration": "0.4"},
        ("impact.sample.storage_modulus=2e6:2e7:log", "impact.sample.loss_tangent=0.05:0.5:log"),
        points=tuple({"impact.speeds": f"[{speed}]"} for speed in (1.0, 3.0)),
        metrics=("impact.duration", "impact.restitution"),
    ),
    "suspension": Kind(
        "suspension_seat", {"duration": "6"},
        ("effects.seat.suspension.stiffness=3000:7000:log", "effects.seat.suspension.damping=120:900:log"),
        "seat/force.normal", colour=0.8,
        finer={"effects.seat.cushion.cell": "0.005", "outputs.force_rate": "1000"},
    ),
}  # fmt: skip
KINDS["sensor"] = KINDS["slap"]._replace(
    free=(*KINDS["slap"].free[:1], "sensor.low_pass=10:60:log"),
)
"""A slap behind the low pass of a sensor, whose frequency is free."""

DURATIONS = KINDS["impact"]._replace(metrics=("impact.duration",))
PAIRS = {
    "damping": (KINDS["slap"]._replace(
        free=("effects.backrest.normal_dissipative.restitution=0.4:0.8",
              "effects.backrest.normal_dissipative.reference_speed=0.25:1:log",
              "effects.backrest.normal_elastic.coefficient=1e5:6e5:log")), 2),
    "foam": (KINDS["seat"]._replace(
        fixed={"duration": "6", "effects.seat.cushion.hardness": "6000", "effects.seat.cushion.densification": "0"},
        free=("effects.seat.cushion.modulus=30e3:60e3:log", "effects.seat.cushion.plateau=2400:4800:log")), 2),
    "masses": (KINDS["tire"]._replace(
        fixed={"duration": "0.8", "effects.tire.contact_field": "null"},
        free=("tire.wheel_mass=30:60", "tire.body_mass=200:400")), 2),
    "ball": (DURATIONS._replace(free=("impact.mass=0.01:0.04:log", "impact.sample.storage_modulus=4e6:2e7:log")), 2),
    "nose": (DURATIONS._replace(free=("impact.radius=0.005:0.02:log", "impact.sample.storage_modulus=4e6:2e7:log")), 2),
}  # fmt: skip
"""Kinds of which the recording holds one number of the first two keys: damping of restitution and its speed, the ratio of
stresses under a hardness, the weight at rest, and m/E and E²R in the time of a contact (Hertz).
"""
REFUSED = {"other-law": "slap", "late": "tire", "late-slap": "slap", "low-passed": "slap"}
"""Recordings that the scene of a kind cannot follow: force over approach with another power, 3 ms late with the shift held, and
behind a low pass.
"""
LOW_PASS = 15.0
"""[Hz] of second order."""


def is_named(count: int, found: Fit) -> bool:
    """Whether the first ``count`` keys are each said not to be identifiable beside the others, and nothing else is."""
    unseen = {each.key for each in found.parameters if each.remark.startswith("not identifiable beside")}
    return unseen == {each.key for each in found.parameters[:count]}


def refused(what: str, workers: Workers, seed: int) -> Fit:
    """The fit to one of the recordings that its scene cannot follow."""
    kind, rng = KINDS[REFUSED[what]], numpy.random.default_rng(seed)
    hidden = {each.key: each.at(0.5) for each in (read_variation(text, "") for text in kind.free)}
    other = {"effects.backrest.normal_elastic.exponent": "1.35"} if what == "other-law" else {}
    with tempfile.TemporaryDirectory(prefix="contact_bench_") as folder:
        model = kind._replace(finer={**kind.finer, **other})
        to = recording(model, hidden, rng, workers, Path(folder) / "twin", 3e-3 if what.startswith("late") else 0.0)
        assert isinstance(to, Series)
        if what == "low-passed":
            passed = signal.lfilter(*signal.butter(2, LOW_PASS, fs=RATE), to.values - to.values[0])
            to = to._replace(values=passed + to.values[0])
        return fitted(kind, to, hidden, workers, Path(folder) / "fit", 0.0 if what.startswith("late") else 0.01).found


def twins(kind: Kind, count: int, workers: Workers, first: int = 0) -> Iterator[Twin]:
    """Fits of ``count`` twins, of seeds from ``first``."""
    for seed in range(first, first + count):
        rng = numpy.random.default_rng(seed)
        free = [read_variation(each, "") for each in kind.free]
        hidden = {each.key: each.at(float(rng.uniform(0.25, 0.75))) for each in free}
        with tempfile.TemporaryDirectory(prefix="contact_bench_") as folder:
            to = recording(kind, hidden, rng, workers, Path(folder) / "twin")
            yield fitted(kind, to, hidden, workers, Path(folder) / "fit")


def fitted(
    kind: Kind, to: Points | Series, hidden: Values, workers: Workers, folder: Path, shift: float = 0.01
) -> Twin:
    """The fit to a recording of hidden values."""
    began = time.process_time()
    free = [read_variation(each, "") for each in kind.free]
    found = fit(kind.scene, to, free, folder, fixed=kind.fixed, workers=workers, most_shift=shift)
    cpu = time.process_time() - began + sum(_cpu(path) for path in (folder / CASES).glob("*.json"))
    return Twin([float(hidden[each.key]) for each in free], found, cpu)


def recording(
    kind: Kind, hidden: Values, rng: numpy.random.Generator, workers: Workers, folder: Path, late: float = math.nan,
) -> Points | Series:  # fmt: skip
    """What was measured of hidden values; ``late`` [s], nan: drawn."""
    of_scene = {key: value for key, value in hidden.items() if not is_of_sensor(key)}
    values = {**kind.fixed, **kind.finer, **of_scene, "accuracy": "1e-6"}
    if not kind.series:
        rows = _rows(kind, [{**values, **each} for each in kind.points], workers, folder)
        exact = numpy.array([[_metric(row, each) for each in kind.metrics] for row in rows])
        measured = exact * (1.0 + kind.noise * rng.normal(size=exact.shape))
        units = {each["key"]: each["unit"] for each in rows[0]["metrics"] if each["key"] in kind.metrics}
        return Points([*kind.points], [*kind.metrics], units, measured, kind.noise * exact)
    (row,) = _rows(kind, [values], workers, folder)
    path = interpolate.CubicSpline(row["time"], row["values"])
    if FILTER in hidden:
        path = _behind_sensor(path, float(hidden[FILTER]))
    late = float(rng.uniform(-LATEST, LATEST)) if math.isnan(late) else late
    at = numpy.arange(row["time"][0] + 0.02, row["time"][-1] - 0.02, 1.0 / RATE)
    exact = path(at - late)
    white = rng.normal(size=at.size + 100) * math.sqrt(1.0 - kind.colour**2)
    noise = signal.lfilter([1.0], [1.0, -kind.colour], white)[100:]
    return Series(kind.series, at, exact + kind.noise * max(float(exact.std()), 1e-2 * float(exact.mean())) * noise)


def _behind_sensor(path: interpolate.CubicSpline, frequency: float) -> interpolate.CubicSpline:
    """Behind a low pass of second order in continuous time, straight between 10 samples a millisecond."""
    time = numpy.arange(path.x[0], path.x[-1], 1e-4)
    above, below = signal.butter(2, 2.0 * math.pi * frequency, analog=True)
    rest = path(time[0])
    _, passed, _ = signal.lsim((above, below), path(time) - rest, time - time[0])
    return interpolate.CubicSpline(time, passed + rest)


def _rows(kind: Kind, cases: list[Values], workers: Workers, folder: Path) -> list[Row]:
    (folder / CASES).mkdir(parents=True)
    tasks = [
        Task(i, kind.scene, texts_of(each), str(folder), False, sources_hash(), kind.series)
        for i, each in enumerate(cases)
    ]
    rows = sorted(workers.run(tasks), key=lambda row: row["number"])
    for row in rows:
        if row["outcome"] != FINISHED:
            raise RuntimeError(row["sentence"])
    return rows


def _metric(row: Row, key: str) -> float:
    return next(float(each["value"]) for each in row["metrics"] if each["key"] == key)


def _cpu(path: Path) -> float:
    return float(json.loads(path.read_text(encoding="utf-8"))["cpu"])


def counted(found: Iterable[Twin]) -> tuple[int, int, NDArray[numpy.int_]]:
    """Twins, those that the scene follows, and truths inside of each key."""
    listed = [*found]
    inside = numpy.array([each.inside for each in listed], dtype=int)
    return len(listed), sum(each.found.follows for each in listed), inside.sum(axis=0)


def _show_pair(name: str, workers: Workers, seed: int) -> None:
    kind, count = PAIRS[name]
    (twin,) = twins(kind, 1, workers, seed)
    remarks = "; ".join(f"{each.key} {each.remark or 'identified'}" for each in twin.found.parameters)
    say(f"{name}: {'named' if is_named(count, twin.found) else 'missed'}: {remarks}; {twin.found.cases} runs")


def _show_refused(name: str, workers: Workers, seed: int) -> None:
    found = refused(name, workers, seed)
    say(f"{name}: {'followed' if found.follows else 'refused'}, probability {found.probability:.2g}")


def _show_kind(name: str, workers: Workers, first: int, count: int) -> None:
    listed = []
    for seed, each in enumerate(twins(KINDS[name], count, workers, first), first):
        listed.append(each)
        values = " ".join(
            f"{truth:.5g} [{key.low:.5g} {key.value:.5g} {key.high:.5g}] {key.remark}".strip()
            for truth, key in zip(each.truth, each.found.parameters, strict=True)
        )
        mark = "".join("+" if ok else "-" for ok in each.inside)
        say(
            f"{name} {seed} {mark} {values} p {each.found.probability:.2g} shift {1e3 * each.found.shift:.2f} ms request "
            f"{each.found.accuracy:.2g} {each.found.cases} runs {each.cpu:.1f} s"
        )
    number, follows, keys = counted(listed)
    say(f"{name}: {number} twins, {follows} followed, inside {' '.join(map(str, keys))}")


def main() -> None:
    """Print a line a twin and a count a kind, a line a pair or recording."""
    parser = argparse.ArgumentParser(description="fits of hidden values, the truth inside their intervals")
    names = [*KINDS, *PAIRS, *REFUSED]
    parser.add_argument("names", nargs="*", default=names, metavar="NAME", help=", ".join(names))
    parser.add_argument("--count", type=int, default=20, help="twins a kind")
    parser.add_argument("--first", type=int, default=0, help="seed")
    given = parser.parse_args()
    with Workers(1) as workers:
        for name in given.names:
            if name in KINDS:
                _show_kind(name, workers, given.first, given.count)
            elif name in PAIRS:
                _show_pair(name, workers, given.first)
            else:
                _show_refused(name, workers, given.first)


if __name__ == "__main__":
    main()
