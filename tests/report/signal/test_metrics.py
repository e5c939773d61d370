"""Ride metrics against exact values for sines and half-sine shocks."""

import math

import numpy as np
import pytest

from contact_sim_pkg.report.metrics.exposure import Exposed, exposure_metrics
from contact_sim_pkg.report.metrics.maker import Maker
from contact_sim_pkg.report.signal.metrics import ride_metrics, root_mean_square, seat_factor, weighted_rms
from contact_sim_pkg.report.signal.spectrum import power_density
from contact_sim_pkg.report.signal.weighting import WD, WEIGHTINGS, response

# |Wk| at the true third-octave centres, from the table of ISO 8041-1.
SINE_CASES = [(1.995, 0.5308), (3.981, 0.9648), (10.0, 0.9884), (31.62, 0.4031)]
# Half-sine shocks of 10 m/s^2 starting at 1 s in a record of 8 s: width [s], peak, a_w, crest factor, VDV, MTVV.
SHOCK_CASES = [
    (0.020, 5.805, 0.2531, 22.9, 1.791, 0.716),
    (0.050, 7.698, 0.4807, 16.0, 2.841, 1.359),
    (0.100, 7.305, 0.6371, 11.5, 3.186, 1.801),
]


@pytest.mark.parametrize(("frequency", "gain"), SINE_CASES)
def test_a_sine_of_unit_rms_is_weighted_by_the_gain_at_its_frequency(frequency, gain):
    rate, duration = 1000.0, 300.0
    time = np.arange(0.0, duration, 1.0 / rate)

    metrics = ride_metrics(math.sqrt(2.0) * np.sin(2.0 * np.pi * frequency * time), rate)

    assert metrics.rms == pytest.approx(1.0, rel=1e-4)
    assert metrics.weighted_rms == pytest.approx(gain, rel=2e-3)
    assert metrics.vibration_dose == pytest.approx(1.10668 * gain * duration**0.25, rel=2e-3)


@pytest.mark.parametrize(("frequency", "gain"), SINE_CASES)
def test_the_weighted_rms_of_a_sine_follows_from_its_density(frequency, gain):
    rate = 1000.0
    sine = math.sqrt(2.0) * np.sin(2.0 * np.pi * frequency * np.arange(0.0, 300.0, 1.0 / rate))

    assert weighted_rms(power_density(sine, rate)) == pytest.approx(gain, rel=1e-2)  # Wk over bins of 0.25 Hz


@pytest.mark.parametrize(("width", "peak", "weighted", "crest", "dose", "running"), SHOCK_CASES)
def test_half_sine_shocks_give_the_exact_values(width, peak, weighted, crest, dose, running):
    rate = 8000.0
    time = np.arange(0.0, 8.0, 1.0 / rate)
    inside = (time >= 1.0) & (time <= 1.0 + width)
    shock = np.where(inside, 10.0 * np.sin(np.pi * (time - 1.0) / width), 0.0)

    metrics = ride_metrics(shock, rate)

    assert metrics.crest_factor * metrics.weighted_rms == pytest.approx(peak, rel=5e-3)
    assert metrics.weighted_rms == pytest.approx(weighted, rel=5e-3)
    assert metrics.crest_factor == pytest.approx(crest, rel=5e-3)
    assert metrics.vibration_dose == pytest.approx(dose, rel=5e-3)
    assert metrics.largest_running_rms == pytest.approx(running, rel=5e-3)


def test_a_shock_downward_has_the_crest_factor_of_one_upward():
    time = np.arange(0.0, 8.0, 1e-3)
    shock = np.where((time >= 1.0) & (time <= 1.05), 10.0 * np.sin(np.pi * (time - 1.0) / 0.05), 0.0)
    assert ride_metrics(-shock, 1000.0).crest_factor == pytest.approx(
        ride_metrics(shock, 1000.0).crest_factor, rel=1e-9
    )


def test_gravity_in_the_signal_changes_nothing():
    signal = np.random.default_rng(1).normal(size=5000)

    bare, with_gravity = ride_metrics(signal, 1000.0), ride_metrics(signal + 9.81, 1000.0)

    assert with_gravity[:5] == pytest.approx(bare[:5], rel=1e-9)


def test_the_horizontal_weighting_takes_more_off_a_sine_at_8_hertz():
    sine = np.sin(2.0 * np.pi * 7.943 * np.arange(0.0, 60.0, 1e-3))

    ratio = ride_metrics(sine, 1000.0, WD).weighted_rms / ride_metrics(sine, 1000.0).weighted_rms

    assert ratio == pytest.approx(0.2550 / 1.037, rel=5e-3)


def test_seat_factor_is_in_per_cent_and_undefined_for_a_floor_at_rest():
    assert seat_factor(0.6, 0.8) == pytest.approx(75.0)
    assert math.isnan(seat_factor(0.6, 0.0))
    assert math.isnan(seat_factor(2e-14, 1e-14))


def test_a_signal_of_zeros_has_no_crest_factor():
    metrics = ride_metrics(np.zeros(100), 100.0)

    assert metrics.weighted_rms == 0.0
    assert math.isnan(metrics.crest_factor)


def test_root_mean_square_of_three_four_is_the_textbook_value():
    assert root_mean_square(np.array([3.0, 4.0])) == pytest.approx(math.sqrt(12.5))


def test_hours_and_doses_of_a_sine_in_closed_form():
    """1 m/s^2 rms at a tabulated frequency, |Wk| = 0.9648: eVDV 1.4 a T^(1/4), VDV (3/8 A^4 T)^(1/4), 8 h (0.5/a)^2."""

    rate = 1000.0
    time = np.arange(0.0, 64.0, 1.0 / rate)
    sine = np.sqrt(2.0) * np.sin(2.0 * np.pi * 3.981 * time)
    make = Maker("seat", "bench/motion", (0.0, 64.0)).make
    found = {each.key: each for each in exposure_metrics(make, ride_metrics(sine, rate), sine, rate, ())}
    a_w = 0.9648
    assert found["seat.hours_to_action"].value == pytest.approx(8.0 * (0.5 / a_w) ** 2, rel=0.01)
    assert found["seat.dose_estimated"].value == pytest.approx(1.4 * a_w * 28800.0**0.25, rel=5e-3)
    assert found["seat.dose"].value == pytest.approx((1.5 * 28800.0) ** 0.25 * a_w, rel=5e-3)
    slow = np.sqrt(2.0) * np.sin(2.0 * np.pi * 0.2 * time)
    sick = {each.key: each for each in exposure_metrics(
        make, ride_metrics(slow, rate, WEIGHTINGS["Wf"]), slow, rate, (), Exposed("Wf", vertical=False, decides=False)
    )}  # fmt: skip
    factor = abs(response(WEIGHTINGS["Wf"], np.array([0.2]))[0])
    assert sick["seat.sickness"].value == pytest.approx(60.0 * factor, rel=0.03)
    assert not {"seat.a_8", "seat.dose"} & set(sick)
