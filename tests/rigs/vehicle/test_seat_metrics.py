"""Metrics of a seat: from a recording in which no two quantities are equal, and of a sine and a shock in closed form."""

import numpy as np
import pytest
from tests.report import uneven_bag as known
from tests.report.signal.test_metrics import SHOCK_CASES

from contact_sim_pkg.pressure.cushion import VALID_STRAIN
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.seat.report.metrics import seat_metrics, shock_metrics, vibration_metrics
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals

FORCE, FIELD = known.FORCES["seat"], known.FIELDS["seat"]


def by_key(metrics):
    return {each.key.partition(".")[2]: each for each in metrics}


@pytest.fixture(scope="module")
def recording(uneven):
    return read_recording(uneven)


@pytest.fixture(scope="module")
def metrics(recording):
    return by_key(seat_metrics(recording))


def test_time_without_load_is_the_share_of_samples_at_zero(metrics):
    assert metrics["lift_off"].value == pytest.approx(100.0 * 5 / 28)
    assert metrics["lift_off"].verdict == "outside"
    assert metrics["lift_off"].window == pytest.approx((known.START, known.TIMES[-1] + known.PERIOD))


def test_pressures_and_area_are_means_over_the_fields_that_carry(metrics):
    carries = np.arange(known.BLOCKS) != known.EMPTY["seat"]
    for key, column, scale in (("mean_pressure", "mean", 1e-3), ("peak_pressure", "peak", 1e-3), ("area", "area", 1e4)):
        assert metrics[key].value == pytest.approx(scale * FIELD[column][carries].mean(), rel=1e-12)
    assert metrics["area"].size == known.BLOCKS - 1


def test_a_seat_without_a_map_says_how_deep_it_sinks_within_the_range_of_its_foam(recording):
    found = by_key(seat_metrics(recording._replace(fields={})))["sink"]
    assert found.value == pytest.approx(1e3 * FORCE["approach"].max(), rel=1e-12)
    assert found.band.high == pytest.approx(1e3 * VALID_STRAIN * 0.09)


def test_the_h_point_sinks_with_the_sitter_while_he_sits(metrics):
    sinks = FORCE["approach"][FORCE["normal"] > 0.0].mean()
    assert metrics["h_point"].value == pytest.approx(1e3 * (0.098 - sinks), rel=1e-12)


@pytest.mark.parametrize(("width", "_peak", "weighted", "crest", "dose", "running"), SHOCK_CASES)
def test_a_shock_on_the_seat_over_a_sine_of_the_floor(width, _peak, weighted, crest, dose, running):
    """8 s: half-sine of 10 m/s^2 downward, and 0.8 m/s^2 rms at a tabulated frequency, |Wk| = 0.9648."""
    rate = 8000.0
    time = np.arange(0.0, 8.0, 1.0 / rate)
    inside = (time >= 1.0) & (time <= 1.0 + width)
    shock = np.where(inside, -10.0 * np.sin(np.pi * (time - 1.0) / width), 0.0)
    sine = 0.8 * np.sqrt(2.0) * np.sin(2.0 * np.pi * 3.981 * time)
    found = by_key(vibration_metrics(RideSignals(3.0 + time, rate, sine, shock)))
    floor = 0.8 * 0.9648
    assert found["factor"].value == pytest.approx(100.0 * weighted / floor, rel=0.01)
    assert found["factor_dose"].value == pytest.approx(100.0 * dose / (1.10668 * floor * 8.0**0.25), rel=0.01)
    assert found["a_w"].value == found["a_8"].value == pytest.approx(weighted, rel=5e-3)
    assert found["dose"].value == pytest.approx(dose * (8.0 * 3600.0 / 8.0) ** 0.25, rel=5e-3)
    assert found["mtvv"].value == pytest.approx(running, rel=5e-3)
    assert found["crest"].value == pytest.approx(crest, rel=5e-3)
    assert found["factor"].window == (3.0, 11.0)


@pytest.mark.parametrize(("width", "_peak", "_weighted", "_crest", "dose", "running"), SHOCK_CASES)
def test_a_shock_says_the_same_however_long_the_run_goes_on(width, _peak, _weighted, _crest, dose, running):
    """Half-sine of 10 m/s^2 on the seat, of 20 m/s^2 on the floor, in 8 and in 16 s."""
    rate = 8000.0
    for length in (8.0, 16.0):
        time = np.arange(0.0, length, 1.0 / rate)
        inside = (time >= 1.0) & (time <= 1.0 + width)
        shock = np.where(inside, -10.0 * np.sin(np.pi * (time - 1.0) / width), 0.0)
        found = by_key(shock_metrics(RideSignals(time, rate, 2.0 * shock, shock), 1e-3))
        assert found["floor_peak"].value == pytest.approx(20.0, rel=1e-3)
        assert (found["seat_peak"].value, found["seat_peak"].error) == pytest.approx((10.0, 0.02), rel=1e-3)
        assert found["shock_ratio"].value == pytest.approx(0.5)
        assert found["mtvv"].value == pytest.approx(running, rel=5e-3)
        assert found["dose_of_shock"].value == pytest.approx(dose, rel=5e-3)
        assert {each.basis for each in found.values()} == {"event"}


def test_a_scene_of_one_shock_shows_no_figure_of_a_ride(recording):
    """Neither SEAT nor exposure; the same recording under a sine shows them."""
    shaken = {"kind": "half_sine", "amplitude": 10.0, "duration": 0.1}
    keys = by_key(seat_metrics(recording._replace(scene={"vibration": shaken})))
    assert "off_the_seat" in keys
    assert not {"factor", "a_w", "a_8", "dose", "lift_off", "spine_risk"} & set(keys)
    assert keys["off_the_seat"].value == pytest.approx(1e3 * 5 * known.PERIOD)
    ride = by_key(seat_metrics(recording._replace(scene={"vibration": {"kind": "sine", "frequency": 4.0}})))
    assert "lift_off" in ride
    assert "off_the_seat" not in ride


def test_a_record_that_is_repeated_makes_no_number_more_certain():
    rate, once = 200.0, 20.0
    random = np.random.default_rng(5)
    floor = random.normal(size=round(once * rate))
    seat = np.convolve(floor, [0.2, 0.5, 0.2], "same") + 0.3 * random.normal(size=floor.size)
    single, thrice = (
        by_key(vibration_metrics(
            RideSignals(np.arange(times * floor.size) / rate, rate, np.tile(floor, times), np.tile(seat, times)), distinct=once
        ))
        for times in (1, 3)
    )  # fmt: skip
    for key in ("factor", "a_w"):
        # three times as long would be 1.7 times as certain; the filter of the weighting begins at rest once
        assert thrice[key].spread == pytest.approx(single[key].spread, rel=1e-3)
        assert "too short: 20 s repeated, 34 s needed" in thrice[key].broken
        assert "too short: 20 s, 34 s needed" in single[key].broken
