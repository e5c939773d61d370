"""The picture of a tire's load by frequency, against signals whose spectrum is known."""

import re

import numpy as np

from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.series import ContactSeries
from contact_sim_pkg.rigs.vehicle.tire.report.figures_spectrum import load_spectrum

RATE = 1000.0


def contact(normal):
    none = np.zeros_like(normal)
    return ContactSeries(np.arange(normal.size) / RATE, 1.0 / RATE, normal, none, none, none, np.empty(0))


def drawn(normal):
    with style():
        return load_spectrum("rolling", "tire", contact(normal))


def test_two_sines_share_the_variance_as_the_squares_of_their_amplitudes():
    time = np.arange(40_000) / RATE
    found = drawn(4000.0 + 300.0 * np.sin(2.0 * np.pi * 1.5 * time) + 400.0 * np.sin(2.0 * np.pi * 12.0 * time))
    shares = [float(each) for each in re.findall(r"([\d.]+) % of the variance", found.caption)]
    np.testing.assert_allclose(shares, [36.0, 64.0], rtol=0.02)
    assert "Largest at 12 Hz" in found.caption


def test_a_constant_load_or_a_short_record_has_no_spectrum():
    assert drawn(np.full(5000, 4000.0)) is None
    assert drawn(4000.0 + 100.0 * np.sin(np.arange(1500) / 20.0)) is None
