"""Dynamic stiffness: closed form at small amplitudes, scipy's integrator at large ones, and that of the seat."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from tests.pressure.cushion.cushions import pan_layer

from contact_sim_pkg.laws.dynamic_stiffness import dynamic_stiffness
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import FoamElastic, NormalElastic
from contact_sim_pkg.pressure.cushion.force_table import make_table

FOAM = FoamElastic(0.12, 0.1, 4.0e4, 3.0e3, 150.0, 3.0)


@pytest.mark.parametrize("law", [FOAM, NormalElastic(2.73e5, 1.5)])
def test_small_amplitudes_have_the_slope_and_that_of_the_hysteresis(law):
    load, share, energy = 498.0, 0.12, 1.0
    found = dynamic_stiffness(law, load, 1e-7, 4.0, damping=0.5, share=share, energy=energy)
    slope = elastic_stiffness(law, approach_of_force(law, load))
    assert found.stiffness == pytest.approx(slope + share * load**2 / energy, rel=1e-3)
    assert found.damping == pytest.approx(0.5 * load, rel=1e-2)


def test_a_linear_spring_with_a_damper_has_its_constants_at_any_amplitude():
    found = dynamic_stiffness(NormalElastic(5e4, 1.0), 500.0, 0.005, 3.0)
    assert found.stiffness == pytest.approx(5e4, rel=1e-12)
    assert found.damping == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("amplitude", [1e-3, 1e-2])
def test_large_amplitudes_are_those_of_an_integrated_hysteresis(amplitude):
    load, frequency, share, energy, damping = 498.0, 4.0, 0.18, 0.7, 0.5
    middle, omega = approach_of_force(FOAM, load), 2 * math.pi * frequency

    def motion(t):
        return middle + amplitude * numpy.sin(omega * t), amplitude * omega * numpy.cos(omega * t)

    def rate(t, z):
        x, v = motion(t)
        power = elastic_force(FOAM, float(x)) * v
        return (power - abs(power) * z) / energy

    cycles = 400 if amplitude < 2e-3 else 30
    run = solve_ivp(
        rate, (0.0, cycles / frequency), [0.0], rtol=1e-8, atol=1e-10, max_step=0.02 / frequency, dense_output=True
    )
    t = (cycles - 1 + (numpy.arange(2000) + 0.5) / 2000) / frequency
    x, v = motion(t)
    force = numpy.array([elastic_force(FOAM, float(each)) for each in x])
    force *= numpy.maximum(0.0, 1.0 + share * run.sol(t)[0] + damping * v)
    found = dynamic_stiffness(FOAM, load, amplitude, frequency, damping=damping, share=share, energy=energy)
    assert found.stiffness == pytest.approx(2 * (force * numpy.sin(omega * t)).mean() / amplitude, rel=1e-3)
    assert found.damping == pytest.approx(2 * (force * numpy.cos(omega * t)).mean() / amplitude / omega, rel=1e-3)


@pytest.fixture(scope="module")
def pan():
    return make_table(pan_layer()).law()


def test_a_seat_is_twice_as_stiff_under_small_vibration_as_under_a_slow_load(pan):
    """About 22 against 50 kN/m under 498 N."""
    slow = elastic_stiffness(pan, approach_of_force(pan, 498.0))
    assert slow == pytest.approx(22.0e3, rel=0.03)
    fast = dynamic_stiffness(pan, 498.0, 5e-5, 4.0, damping=0.5, share=0.12, energy=1.0)
    assert fast.stiffness == pytest.approx(50.0e3, rel=0.06)


@pytest.mark.parametrize(
    ("amplitude", "stiffness", "damping"),
    [(0.05, 51.8, 262), (0.5, 51.1, 371), (1, 49.3, 477), (2, 44.1, 609), (5, 32.2, 616), (10, 26.9, 494)],
)
def test_regression_of_the_seat_by_amplitude(pan, amplitude, stiffness, damping):
    found = dynamic_stiffness(pan, 498.0, 1e-3 * amplitude, 4.0, damping=0.5, share=0.12, energy=1.0)
    assert found.stiffness / 1e3 == pytest.approx(stiffness, rel=0.02)
    assert found.damping == pytest.approx(damping, rel=0.04)


def test_a_slow_loop_loses_what_seat_foams_lose(pan):
    """0 to 705 N and back: 15 to 30 %; in closed form from the stored energy U."""
    stored, share, energy = elastic_energy(pan, approach_of_force(pan, 705.0)), 0.12, 1.0
    rest = 1.0 - math.exp(-stored / energy)
    taken = stored + share * (stored - energy * rest)
    given_back = stored - share * (stored - (1.0 + rest) * energy * rest)
    assert 0.15 < 1.0 - given_back / taken < 0.30
    assert 1.0 - given_back / taken == pytest.approx(0.188, abs=0.003)
