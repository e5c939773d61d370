"""A roller that rides a wavy track."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from contact_sim_pkg.rigs.roller.theory.heave import (
    Path,
    closed_path,
    contact_energy,
    linear_stiffness,
    make_heave,
    natural_frequency,
    ride,
)
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach

K_C, K_B = 4.011056177626691e-06 / 100.0 ** (2.0 / 3.0), 6.985e-7
HEAVE = make_heave(0.175, 0.05, 100.0, K_C, K_B)
REST = K_C * 100.0 ** (2.0 / 3.0) + K_B * 100.0
CELLS, TURN = 256, 1.0 / 200.0


def test_the_frequency_of_the_bench():
    """kappa / 2 pi = 447 Hz; k_lin is the slope of the load by the approach at rest."""
    assert natural_frequency(HEAVE) / (2.0 * math.pi) == pytest.approx(447.0, abs=0.5)

    def approach(f):
        return K_C * f ** (2.0 / 3.0) + K_B * f

    slope = 2e-3 / (approach(100.001) - approach(99.999))
    assert linear_stiffness(HEAVE) == pytest.approx(slope, rel=1e-8)


@pytest.mark.parametrize("waves", [1, 2, 3, 7])
def test_small_waves_give_the_linear_load(waves):
    """F = F_N + k_lin W Re((1 - H) e^(i ...)), H the answer of heave."""
    size = 1e-11
    phase = 2.0 * math.pi * waves * numpy.arange(CELLS) / CELLS
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    ride(HEAVE, closed_path(HEAVE, size * numpy.cos(phase)), TURN / CELLS, 100, state, loads, numpy.zeros((CELLS, 2)))
    ride(HEAVE, closed_path(HEAVE, size * numpy.cos(phase)), TURN / CELLS, 1, state, loads, numpy.zeros((CELLS, 2)))
    kappa, omega = natural_frequency(HEAVE), 2.0 * math.pi * waves / TURN
    answer = 1.0 - kappa**2 / (kappa**2 - omega**2 + 2j * 0.05 * kappa * omega)
    expected = 100.0 + linear_stiffness(HEAVE) * size * (answer * numpy.exp(1j * phase)).real
    swing = linear_stiffness(HEAVE) * size * abs(answer)
    assert loads == pytest.approx(expected, abs=2e-3 * swing)


def test_a_large_wave_separates_the_roller_as_in_scipy():
    """0.1 mm, two waves: separation and impact. Straight lines between the cells in both."""
    track = 1e-4 * numpy.cos(4.0 * math.pi * numpy.arange(CELLS) / CELLS)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    free = ride(HEAVE, closed_path(HEAVE, track), TURN / CELLS, 1, state, loads, numpy.zeros((CELLS, 2)))
    kappa = natural_frequency(HEAVE)

    def force(approach):
        if approach <= 0.0:
            return 0.0
        return brentq(lambda f: K_C * f ** (2.0 / 3.0) + K_B * f - approach, 0.0, 1e5, xtol=1e-12, rtol=1e-14)

    y, dt, closed = numpy.zeros(2), TURN / CELLS, numpy.append(track, track[0])
    for j in range(CELLS):
        w = closed[j : j + 2]
        y = solve_ivp(
            lambda t, y, w=w: [
                y[1], (force(REST + w[0] + (w[1] - w[0]) * t / dt - y[0]) - 100.0) / 0.175 - 2.0 * 0.05 * kappa * y[1]
            ], (0.0, dt), y, method="DOP853", rtol=1e-9, atol=1e-13,
        ).y[:, -1]  # fmt: skip
    assert 0.05 < free < 0.95
    assert loads.min() == 0.0
    assert state == pytest.approx(y, abs=1e-7, rel=1e-3)  # 1e-3 of the wave, after an impact


def test_a_flat_track_leaves_the_roller_at_rest():
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    assert (
        ride(HEAVE, closed_path(HEAVE, numpy.zeros(CELLS)), TURN / CELLS, 10, state, loads, numpy.zeros((CELLS, 2)))
        == 0.0
    )
    assert loads == pytest.approx(100.0, rel=1e-12)


def test_values_that_are_none_are_refused():
    with pytest.raises(ValueError, match=r"heave: mass 0\.0 kg: a finite number above 0 is needed"):
        make_heave(0.0, 0.05, 100.0, K_C, K_B)
    with pytest.raises(ValueError, match=r"heave: zeta -0\.05: a finite number at least 0 is needed"):
        make_heave(0.1, -0.05, 100.0, K_C, K_B)


def test_energy_that_the_track_supplies_is_kept_stored_or_damped():
    """Over waves and over a softness that changes along the way; the ledger closes to the rule's own error."""
    place = 2.0 * math.pi * numpy.arange(CELLS + 1) / CELLS
    path = Path(1e-6 * numpy.cos(2.0 * place), K_C * (1.0 + 0.1 * numpy.sin(3.0 * place)))
    state, loads = numpy.zeros(4), numpy.zeros(CELLS)
    state[0] = 1e-6

    def held():
        approach = REST + path.height[0] - state[0]
        load = load_of_approach(K_C, K_B, approach)
        return contact_energy(K_C, K_B, load) + 100.0 * state[0] + 0.5 * 0.175 * state[1] ** 2

    first = held()
    ride(HEAVE, path, TURN / CELLS, 40, state, loads, numpy.zeros((CELLS, 2)))
    assert state[3] > 1e-7
    assert held() - first + state[3] == pytest.approx(state[2], rel=1e-6)


def test_a_softer_place_carries_less():
    """Standing still on a place of k_c (1 + e): F of `k_c (1 + e) F^(2/3) + k_b F = Delta_0`."""
    soft = numpy.full(CELLS + 1, 1.2 * K_C)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    ride(HEAVE, Path(numpy.zeros(CELLS + 1), soft), 1e-9, 1, state, loads, numpy.zeros((CELLS, 2)))
    expected = brentq(lambda f: 1.2 * K_C * f ** (2.0 / 3.0) + K_B * f - REST, 1.0, 100.0)
    assert loads[0] == pytest.approx(expected, rel=1e-12)
