"""ISO 2631-5:2018 against its own worked case and the figures recomputed from its definition."""

import numpy as np
import pytest

from contact_sim_pkg.report.signal.spine import Career, daily, dose, risk, spine_acceleration, spine_response, stress

TABLE = {
    1: 1.012,
    2: 1.056,
    3: 1.164,
    4: 1.417,
    5: 1.543,
    6: 1.143,
    8: 0.873,
    10: 0.822,
    16: 0.756,
    20: 0.705,
    40: 0.328,
    80: 0.0056,
}


def test_the_response_is_that_of_the_table_and_peaks_at_4_7_hertz():
    assert abs(spine_response(np.array([*TABLE], dtype=float))) == pytest.approx([*TABLE.values()], abs=6e-4)
    frequency = np.linspace(4.0, 6.0, 20001)
    magnitude = abs(spine_response(frequency))
    assert magnitude.max() == pytest.approx(1.586, abs=0.002)
    assert frequency[magnitude.argmax()] == pytest.approx(4.70, abs=0.02)
    assert spine_response(np.zeros(1)) == pytest.approx(1.0)


def test_the_worked_case():
    assert stress(55.97) == pytest.approx(1.62, abs=0.005)
    found = risk(stress(55.97), Career(20, 20, 120))
    assert found == pytest.approx(1.22, abs=0.005)
    assert 1.0 - np.exp(-((found / 1.613) ** 2.799)) == pytest.approx(0.37, abs=0.005)


def test_the_dose_counts_one_peak_between_two_crossings():
    spine = np.array([0.0, 1.0, 3.0, 2.0, 3.5, -1.0, 2.0, -4.0, 0.0])
    assert dose(spine) == pytest.approx(1.07 * (3.5**6 + 2.0**6) ** (1 / 6))
    assert dose(-np.abs(spine)) == 0.0


def test_the_dose_of_a_sine_grows_with_the_sixth_root_of_its_cycles():
    rate, seconds = 1000.0, 60.0
    sine = np.sin(2.0 * np.pi * 4.0 * np.arange(0.0, seconds, 1.0 / rate))
    found = dose(spine_acceleration(sine, rate))
    assert found == pytest.approx(1.07 * 1.417 * (4.0 * seconds) ** (1 / 6), rel=5e-3)
    assert daily(found, 60.0) == pytest.approx(found * 480.0 ** (1 / 6))
