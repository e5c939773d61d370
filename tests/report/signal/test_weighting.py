"""Weightings against the tables of ISO 8041-1 and closed forms."""

import numpy as np
import pytest
from scipy.signal import freqs

from contact_sim_pkg.report.signal.weighting import WD, WEIGHTINGS, WK, apply_weighting, response

# Weighting factors x 1000 at the true third-octave centres 10^(n/10) Hz, n = -10 .. 26 (ISO 8041-1).
WK_TABLE = """31.21 49.31 77.56 120.7 183.2 264.4 350.4 418.8 458.8 476.7 482.5 484.6 493.5 530.8 633.5 807.1 964.8 1039
1054 1037 988.4 898.9 774.3 637.3 510.3 403.1 316 245.1 185.7 133.9 88.73 53.11 29.22 15.28 7.795 3.935 1.978"""
WD_TABLE = """62.42 98.67 155.3 242 368.2 533 709.7 854 944.3 991.4 1011 1007 970.7 891.3 773.3 639.8 514.3 408.1
322.6 255 201.7 159.7 126.6 100.4 79.58 62.99 49.65 38.72 29.46 21.3 14.14 8.478 4.668 2.442 1.246 0.6293 0.3164"""
WC_TABLE = """62.38 98.58 155.1 241.5 366.9 530.2 704.2 844.2 929.2 971.6 991 1000 1006 1012 1017 1023 1024 1013 973.9 894.1
776.2 642.5 516.6 409.8 323.6 254.9 200.2 155.7 118.2 85.38 56.65 33.94 18.68 9.772 4.987 2.518 1.266"""
WE_TABLE = """62.52 98.93 156 243.5 371.5 539.4 719.8 863.5 938.9 942.3 879.8 768.3 637.2 512.7 407 321.8 254.3 201.2 159.4
126.3 100.2 79.54 63.14 50.11 39.75 31.47 24.81 19.35 14.73 10.65 7.071 4.239 2.334 1.221 0.6232 0.3147 0.1582"""
WJ_TABLE = """30.99 48.97 77.03 119.9 182.1 263 348.9 417.6 458.5 477.6 484.4 485.1 483.2 481.9 488.9 524.6 625.1 794.8 947
1016 1030 1026 1019 1012 1006 1000 991.1 972 930.4 846.5 707.5 533.8 370 243.7 156.5 99.51 62.97"""
WF_TABLE = """695.1 900 1004 992.8 850.1 614.9 388.4 222.5 115.7 54.34 23.52 9.705 3.916 1.566 0.624 0.2484 0.09886 0.03934
0.01566 0.006233 0.002481 0.0009877 0.0003932 0.0001565 6.231e-05 2.481e-05 9.876e-06 3.932e-06 1.565e-06
6.231e-07 2.481e-07 9.876e-08 3.932e-08 1.565e-08 6.231e-09 2.481e-09 9.876e-10"""
WB_TABLE = """24.94 39.41 61.98 96.45 146.4 211.3 280 334.7 366.6 380.8 385.3 386.4 391.6 416.8 496 665.3 885 1026 1054 1026
974.5 904.2 814.4 708.8 597.3 490.6 395 311.8 238.9 173.4 115.4 69.29 38.18 19.99 10.2 5.154 2.591"""


@pytest.mark.parametrize(
    ("weighting", "table"),
    [(WK, WK_TABLE), (WD, WD_TABLE)]
    + [
        (WEIGHTINGS[name], table)
        for name, table in (("Wc", WC_TABLE), ("We", WE_TABLE), ("Wj", WJ_TABLE), ("Wf", WF_TABLE), ("Wb", WB_TABLE))
    ],
)
def test_gain_equals_the_table_at_every_third_octave(weighting, table):
    expected = np.array([float(factor) for factor in table.split()]) / 1000.0
    centres = 10.0 ** (np.arange(-10, 27) / 10.0)

    np.testing.assert_allclose(np.abs(response(weighting, centres)), expected, rtol=1e-3)


@pytest.mark.parametrize("weighting", [WK, WD], ids=["Wk", "Wd"])
def test_phase_is_that_of_the_transfer_function_of_the_standard_as_one_quotient_of_polynomials(weighting):
    """ISO 2631-1 annex A: H_h H_l H_t H_s of the corner frequencies and qualities, multiplied out by numpy, taken by scipy."""
    f_1, f_2, f_3, f_4, q_4 = (0.4, 100.0, 12.5, 12.5, 0.63) if weighting is WK else (0.4, 100.0, 2.0, 2.0, 0.63)
    w_1, w_2, w_3, w_4 = (2.0 * np.pi * f for f in (f_1, f_2, f_3, f_4))
    above = np.polymul([1.0, 0.0, 0.0], [w_2**2])
    below = np.polymul([1.0, np.sqrt(2.0) * w_1, w_1**2], [1.0, np.sqrt(2.0) * w_2, w_2**2])
    above = np.polymul(above, [1.0 / w_3, 1.0])
    below = np.polymul(below, [1.0 / w_4**2, 1.0 / (q_4 * w_4), 1.0])
    if weighting is WK:
        w_5, w_6, q = 2.0 * np.pi * 2.37, 2.0 * np.pi * 3.35, 0.91
        above = np.polymul(above, [1.0 / w_5**2, 1.0 / (q * w_5), 1.0]) * (w_5 / w_6) ** 2
        below = np.polymul(below, [1.0 / w_6**2, 1.0 / (q * w_6), 1.0])
    frequency = np.geomspace(0.1, 400.0, 50)
    _, expected = freqs(above, below, 2.0 * np.pi * frequency)
    np.testing.assert_allclose(response(weighting, frequency), expected, rtol=1e-9)


@pytest.mark.parametrize(("weighting", "gain"), [(WK, 0.7718), (WD, 0.1261)], ids=["Wk", "Wd"])
def test_gain_at_the_reference_frequency_of_100_radians_a_second(weighting, gain):
    assert abs(response(weighting, np.array([100.0 / (2.0 * np.pi)]))[0]) == pytest.approx(gain, abs=5e-5)


@pytest.mark.parametrize(("weighting", "gain", "at"), [(WK, 1.0545, 6.17), (WD, 1.0126, 1.09)], ids=["Wk", "Wd"])
def test_largest_gain_and_its_frequency(weighting, gain, at):
    frequency = np.linspace(0.5, 20.0, 195001)
    magnitude = np.abs(response(weighting, frequency))

    assert magnitude.max() == pytest.approx(gain, abs=1e-4)
    assert frequency[magnitude.argmax()] == pytest.approx(at, abs=0.01)


def test_nothing_passes_at_zero_frequency():
    assert response(WK, np.zeros(1))[0] == 0.0


def test_a_sine_keeps_its_frequency_and_takes_gain_and_phase_of_the_response():
    rate, frequency = 1000.0, 8.0
    time = np.arange(0.0, 20.0, 1.0 / rate)
    factor = response(WK, np.array([frequency]))[0]

    weighted = apply_weighting(WK, np.sin(2.0 * np.pi * frequency * time), rate)

    settled = slice(10_000, 19_000)
    expected = np.imag(factor * np.exp(2j * np.pi * frequency * time))
    np.testing.assert_allclose(weighted[settled], expected[settled], atol=2e-4)


def test_the_end_of_a_record_does_not_leak_into_its_start():
    pulse_at_the_end = np.zeros(4000)
    pulse_at_the_end[-20:] = 10.0

    weighted = apply_weighting(WK, pulse_at_the_end, 1000.0)

    # A record that wraps around gives 7.8 here.
    assert np.abs(weighted[:3000]).max() < 1e-3


@pytest.mark.parametrize("rate", [0.0, -476.0, np.nan, np.inf])
def test_an_unknown_rate_is_refused(rate):
    with pytest.raises(ValueError, match="known rate above 0"):
        apply_weighting(WK, np.zeros(10), rate)


def test_several_signals_at_once_are_refused():
    with pytest.raises(ValueError, match="2 dimensions"):
        apply_weighting(WK, np.zeros((2, 10)), 100.0)
