"""Transmissibilities fitted: a resonator of textbook form on a floor of noise, beside a seat of the bench."""

import math

import numpy
import pytest
from scipy import signal, stats

from contact_sim_pkg import load_scene, run
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.report.curves import curves_of
from contact_sim_pkg.report.metrics.of_bag import recording_of
from contact_sim_pkg.report.signal.spectrum import transmissibility
from contact_sim_pkg.rigs.vehicle.seat.report.response import transmissibility_curve
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals
from contact_sim_pkg.sweep import fit as fits
from contact_sim_pkg.sweep.case import FINISHED, Task, run_case
from contact_sim_pkg.sweep.measured import MeasuredResponse, read_measured, read_response
from contact_sim_pkg.sweep.residuals import ResponseResidual
from contact_sim_pkg.sweep.variation import SweepError, read_variation

RATE = 200.0
TRUTH = {"frequency": 4.0, "damping": 0.25}


def ride(seed, frequency, damping, noise=0.0, second=0.0, seconds=120.0):
    """A mass on spring and damper over a floor of white noise; ``second``: of another resonance at 12 Hz."""
    turn, count = 2.0 * math.pi * frequency, int(seconds * RATE)
    floor = numpy.random.default_rng(seed).normal(size=count)
    system = signal.cont2discrete(([2.0 * damping * turn, turn**2], [1.0, 2.0 * damping * turn, turn**2]), 1.0 / RATE)
    seat = signal.lfilter(system[0].ravel(), system[1], floor)
    seat += second * signal.lfilter(*signal.iirpeak(12.0, 8.0, fs=RATE), floor)
    seat += noise * seat.std() * numpy.random.default_rng(seed + 1000).normal(size=count)
    return RideSignals(numpy.arange(count) / RATE, RATE, floor, seat)


def measured(*arguments, **keys):
    curve = transmissibility_curve(ride(*arguments, **keys))
    known = numpy.isfinite(curve.y)
    return MeasuredResponse(curve.x[known], curve.y[known], curve.spread[known])


class Resonators:
    """In place of runs."""

    accuracy, is_held, end, count = 1e-2, True, None, 0

    def __init__(self, seed):
        self.free = [read_variation(each) for each in ("frequency=2:8:log", "damping=0.1:0.6:log")]
        self.seed = seed

    def values_at(self, place):
        return {each.key: each.at(float(part)) for each, part in zip(self.free, place, strict=True)}

    def __call__(self, places):
        curves = [
            transmissibility_curve(ride(self.seed, *map(float, self.values_at(place).values()))) for place in places
        ]
        return [numpy.array([each.x, each.y, each.spread]) for each in curves]


@pytest.mark.parametrize("has_its_floor", [True, False])
def test_intervals_hold_the_truth_on_the_same_floor_and_on_another(has_its_floor):
    """Of 15 recordings with a fifth of noise, as often as a binomial of 0.9 lets them but once in a thousand; a resonance
    more is refused.
    """
    inside = numpy.zeros(2)
    for number in range(15):
        runs = Resonators(number if has_its_floor else 500)
        found = fits._fitted_response(runs, measured(number, *TRUTH.values(), noise=0.2))
        assert found.follows
        inside += [each.low <= TRUTH[each.key] <= each.high for each in found.parameters]
        if number < 5:
            wrong = measured(number, *TRUTH.values(), noise=0.2, second=0.3)
            assert not fits._fitted_response(runs, wrong).follows
    assert (inside >= stats.binom.ppf(1e-3, 15, 0.9)).all()


def test_a_line_spreads_as_its_coherence_says():
    """Over 60 recordings, of the magnitude of one line each, against scipy's estimates."""
    magnitudes, spreads = [], []
    for number in range(60):
        given = ride(number, *TRUTH.values(), noise=0.5, seconds=40.0)
        found = transmissibility(given.floor, given.seat, RATE)
        # 4 s a segment, half over each other
        kept = {"fs": RATE, "nperseg": 800, "detrend": "constant"}
        across, power = signal.csd(given.floor, given.seat, **kept)[1], signal.welch(given.floor, **kept)[1]
        assert found.magnitude[1:200] == pytest.approx(abs(across / power)[1:200], rel=1e-9)
        magnitudes.append(found.magnitude[10:60:4])
        spreads.append(found.spread[10:60:4])
    ratio = numpy.std(numpy.log(magnitudes), axis=0) / numpy.mean(spreads, axis=0)
    assert ratio.mean() == pytest.approx(1.0, abs=0.1)


def test_points_are_compared_two_lines_apart_where_the_run_is_trusted():
    """A run with lines each 0.25 Hz, none trusted from 2 to 3 Hz, and a curve measured each 0.1 Hz."""
    frequency = numpy.arange(1, 41) * 0.25
    magnitude = numpy.where((frequency > 2.0) & (frequency < 3.0), numpy.nan, 1.0 + frequency)
    given = numpy.array([frequency, magnitude, numpy.full(40, 0.03)])
    points = numpy.arange(5, 120) * 0.1
    residual = ResponseResidual(MeasuredResponse(points, 1.0 + points, numpy.full(115, 0.04)))
    assert residual.weigh(given) == 1.0
    found = residual.frequency
    assert numpy.diff(found).min() == pytest.approx(0.5)
    assert not ((found > 2.0) & (found < 3.0)).any()
    assert (found[0], found[-1]) == (0.5, 10.0)
    # Windows that lie half over each other are worth 1/18 less than separate ones (Welch)
    assert residual.spread == pytest.approx(0.05 * math.sqrt(19.0 / 18.0))
    assert abs(residual.of(given)).max() < 1e-3
    assert residual.weigh(given) == 0.0
    with pytest.raises(SweepError, match="nowhere"):
        residual.weigh(numpy.array([frequency, numpy.full(40, numpy.nan), magnitude]))


def table(tmp_path, text):
    path = tmp_path / "way.csv"
    path.write_text(text)
    return path


def test_a_table_over_frequency(tmp_path):
    text = "frequency [Hz],magnitude,coherence,segments\n1,1.1,0.96,12\n2,1.5,0.92,12\n3,2,0.5,12\n4,0.9,1,12\n"
    found = read_response(table(tmp_path, text))
    assert [*found.frequency] == [1.0, 2.0, 4.0]
    expected = [math.sqrt(0.04 / (24.0 * 0.96)), math.sqrt(0.08 / (24.0 * 0.92)), 0.0]
    assert found.spread == pytest.approx(expected, rel=1e-12)
    assert read_response(table(tmp_path, "magnitude,frequency\n1,1\n2,2\n3,3\n")).spread is None


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("f,magnitude\n1,1\n", "no column frequency"), ("frequency,magnitude,coherence\n1,1,1\n", "segments"),
        ("frequency,magnitude\n1,1\n2,1\n", "3 rows"), ("frequency,magnitude\n1,1\n3,1\n2,1\n", "increases"),
        ("frequency,magnitude\n1,1\n2,0\n3,1\n", "above 0"), ("frequency,magnitude\n1,a\n", "is no number"),
        ("frequency,magnitude,coherence,segments\n1,1,1,1\n2,1,1,1\n3,1,1,1\n", "2 segments"),
    ],
)  # fmt: skip
def test_what_is_no_transmissibility_is_one_sentence(tmp_path, text, word):
    with pytest.raises(SweepError, match=word):
        read_response(table(tmp_path, text))


def test_two_accelerations_of_a_recording(tmp_path):
    """In a table over time, against scipy's densities."""
    given = ride(3, *TRUTH.values(), noise=0.05, seconds=60.0)
    rows = "\n".join(f"{t:.9g},{x:.9g},{y:.9g}" for t, x, y in zip(given.time, given.floor, given.seat, strict=True))
    path = table(tmp_path, f"time [s],under [m/s^2],on [m/s^2]\n{rows}\n")
    found = read_response(path, ["pad.under", "pad.on"])
    kept = {"fs": RATE, "nperseg": 800, "detrend": "constant"}
    frequency, across = signal.csd(given.floor, given.seat, **kept)
    expected = abs(across / signal.welch(given.floor, **kept)[1])
    assert found.frequency.size > 30
    assert found.magnitude == pytest.approx(numpy.interp(found.frequency, frequency, expected), rel=1e-6)
    _, coherence = signal.coherence(given.floor, given.seat, **kept)
    assert numpy.interp(found.frequency, frequency, coherence).min() >= 0.9
    noise = numpy.random.default_rng(1).normal(size=(2, given.time.size))
    rows = "\n".join(f"{t:.9g},{x:.9g},{y:.9g}" for t, x, y in zip(given.time, *noise, strict=True))
    path = table(tmp_path, f"time,under,on\n{rows}\n")
    with pytest.raises(SweepError, match="does not follow"):
        read_response(path, ["under", "on"])


def test_a_run_gives_the_curve_of_its_report(tmp_path):
    keys = "duration=8", "seed=1"
    recorded = run(load_scene("seat_ride", *keys), tmp_path / "bag", progress=False)
    expected = curves_of(recording_of(recorded))["seat.transmissibility"]
    (tmp_path / "cases").mkdir()
    row = run_case(Task(0, "seat_ride", keys, str(tmp_path), False, "", is_response=True))
    assert row["outcome"] == FINISHED
    for name in ("x", "y", "spread"):
        assert row[name] == pytest.approx(getattr(expected, name), rel=1e-9, nan_ok=True)
    again = read_response(recorded.path)
    assert again.magnitude == pytest.approx(expected.y[numpy.isfinite(expected.y)])


def test_a_scene_without_a_seat_is_refused_before_it_runs(tmp_path, capsys):
    path = table(tmp_path, "frequency,magnitude\n1,1\n2,2\n3,3\n")
    given = ["--to", str(path), "--by", "transmissibility", "--free", "tire.suspension_damping=500:4000", "--out"]
    assert main(["fit", "tire_bump", *given, str(tmp_path / "out")]) == 2
    assert "tire_bump has no seat" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_what_does_not_go_together_is_one_sentence(tmp_path):
    path = table(tmp_path, "frequency,magnitude\n1,1\n2,2\n3,3\n")
    for metrics, series, by in (
        ([], ["a.b"], "transmissibility"), (["seat.factor"], [], "transmissibility"), ([], ["a.b", "c.d"], "series"),
        ([], [], "series"), (["seat.factor"], ["a.b"], "spectrum"), ([], ["a.b"], "sound"),
    ):  # fmt: skip
        with pytest.raises(SweepError):
            read_measured(path, metrics, series, by)
