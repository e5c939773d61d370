"""Ring, circular wave and micro-impact front: volumes, published relations, the end of the supersonic phase."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_pkg.rigs.impact.theory import micro_front, surface_wave
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact

SHEAR, DENSITY = 8e6 / 3.0, 1100.0
IMPACT = solve_impact(Sphere(0.02, 0.01), Material(8e6, 0.2), 2.0)
V_S = surface_wave.shear_speed(SHEAR, DENSITY)
WAVE = surface_wave.surface_wave(IMPACT, SHEAR, DENSITY, 0.5)


@pytest.mark.parametrize("pressure", [0.0, 1e5, 4e8])
def test_the_ring_holds_the_area_that_continuity_asks_for(pressure):
    found = surface_wave.ring(1e-3, pressure, 1e9)
    assert found.ratio == pytest.approx((1e9 + pressure) / (1e9 - pressure), rel=1e-15)
    lifted = math.pi * (1e-3 + 2.0 * found.width) ** 2 - math.pi * 1e-6
    assert lifted == pytest.approx(found.ratio * math.pi * 1e-6, rel=1e-12)
    assert found.front_radius == found.contact_radius + found.width


def test_an_incompressible_ring_is_equation_52():
    found = surface_wave.ring(2e-3, 5e6, math.inf)
    assert found.front_radius == pytest.approx(1e-3 * (1.0 + math.sqrt(2.0)), rel=1e-15)


@pytest.mark.parametrize("pressure", [1e9, 2e9])
def test_a_pressure_of_the_bulk_modulus_has_no_ring(pressure):
    with pytest.raises(ImpactError, match="less than the bulk modulus"):
        surface_wave.ring(1e-3, pressure, 1e9)


def test_length_and_speed_of_the_wave_are_equations_73_and_74():
    radius = math.sqrt(2.0) * math.sqrt(IMPACT.depth * 0.01)
    assert WAVE.length == pytest.approx(2.0 * radius * (math.sqrt(2.0) - 1.0), rel=1e-14)
    assert WAVE.speed == pytest.approx(IMPACT.frequency / math.pi * radius * (math.sqrt(2.0) - 1.0), rel=1e-14)
    assert WAVE.relative_speed == pytest.approx(WAVE.speed / (0.95531 * V_S), rel=1e-5)


@pytest.mark.parametrize(("poisson", "ratio"), [(0.5, 0.955313), (0.25, 0.919402), (0.0, 0.874032)])
def test_the_rayleigh_speed_is_that_of_the_tables(poisson, ratio):
    assert surface_wave.rayleigh_speed(SHEAR, DENSITY, poisson) / V_S == pytest.approx(ratio, abs=2e-6)


def test_the_wave_starts_with_the_depth_and_moves_with_its_phase_speed():
    times = IMPACT.compression_time + numpy.array([-1e-6, 0.0, 2e-4])
    radii = numpy.array([0.0, 1e-3])
    height = surface_wave.wave_height(WAVE, radii, times)
    assert (height[0] == 0.0).all()
    assert height[1, 0] == pytest.approx(IMPACT.depth, rel=1e-15)
    step = 1e-4
    late = IMPACT.compression_time + 4e-4
    first = surface_wave.wave_height(WAVE, radii[:1], numpy.array([late]))[0, 0]
    moved = surface_wave.wave_height(WAVE, radii[:1] + WAVE.speed * step, numpy.array([late + step]))[0, 0]
    assert moved == pytest.approx(first * math.exp(-WAVE.damping * step), rel=1e-10)
    printed = surface_wave.wave_height(WAVE, radii, times, form="printed")
    assert printed[1, 0] == pytest.approx(IMPACT.depth * math.exp(-WAVE.damping * IMPACT.compression_time), rel=1e-14)


def test_nothing_moves_ahead_of_the_front_and_spreading_thins_the_wave():
    late = numpy.array([IMPACT.compression_time + 3e-4])
    front = WAVE.start_radius + WAVE.speed * 3e-4
    radii = numpy.array([0.5 * WAVE.start_radius, 0.999 * front, 1.001 * front, 1.0])
    plane = surface_wave.wave_height(WAVE, radii, late)[0]
    thin = surface_wave.wave_height(WAVE, radii, late, spread="cylindrical")[0]
    assert (plane[2:] == 0.0).all()
    assert thin[0] == plane[0]
    assert thin[1] / plane[1] == pytest.approx(math.sqrt(WAVE.start_radius / radii[1]), rel=1e-12)


def test_another_spread_is_refused_by_its_name():
    with pytest.raises(ValueError, match="spread 'round'"):
        surface_wave.wave_height(WAVE, numpy.zeros(1), numpy.zeros(1), spread="round")


def test_the_ring_of_an_instant_takes_the_mean_pressure_of_the_whole_force():
    found = surface_wave.contact_ring(IMPACT, 5e-4, 100.0, 1e9)
    area = math.pi * (2 * 0.01 * 5e-4 - 25e-8)
    assert found.ratio == pytest.approx((1e9 + 100.0 / area) / (1e9 - 100.0 / area), rel=1e-12)


@pytest.mark.parametrize("speed", [0.05, 0.5, 2.0])
@pytest.mark.parametrize("loss_tangent", [0.0, 0.2, 0.4])
def test_the_front_comes_down_to_the_shear_speed_where_a_slow_integration_says(speed, loss_tangent):
    impact = solve_impact(Sphere(0.02, 0.01), Material(8e6, loss_tangent), speed)
    found = micro_front.front_time(impact, V_S)

    def rate(_t, y):
        root = math.sqrt(max(y[0], 0.0))
        force = impact.elastic * root * y[0] + impact.viscous * root * y[1]
        return [y[1], -force / 0.02, impact.viscous * root * y[1] ** 2]

    def down(_t, y):
        front = (1 + math.sqrt(2.0)) / 4 * math.sqrt(2.0) * 0.1 * y[1] / math.sqrt(max(y[0], 1e-30))
        return front - V_S

    down.terminal = True
    run = solve_ivp(
        rate, (0.0, impact.duration), [0.0, speed, 0.0], method="DOP853", rtol=1e-12, atol=1e-18, events=down,
        first_step=found.time * 1e-3,
    )  # fmt: skip
    assert found.time == pytest.approx(run.t[-1], rel=1e-7)
    assert found.depth == pytest.approx(run.y[0, -1], rel=1e-7)
    assert found.heat == pytest.approx(run.y[2, -1], rel=1e-6, abs=1e-18)
    front, supersonic = micro_front.front_speed(impact, found.depth * 0.99, found.speed, V_S)
    assert (front, supersonic) == (V_S, True)


@pytest.mark.parametrize("speed", [1e-3, 1e-2, 0.1])
def test_for_slow_impacts_the_formula_of_small_times_is_approached(speed):
    impact = solve_impact(Sphere(0.02, 0.01), Material(8e6, 0.2), speed)
    exact, small = micro_front.front_time(impact, V_S), micro_front.front_of_small_times(impact, V_S)
    sine = micro_front.front_of_damped_sine(impact, V_S)
    part = exact.time / impact.compression_time
    assert small.time == pytest.approx(exact.time, rel=10.0 * part**1.5 + 1e-9)
    assert sine == pytest.approx(exact.time, rel=10.0 * part + 1e-9)
    assert small.heat == pytest.approx(exact.heat, rel=10.0 * part + 1e-9)
    assert part < 0.05


def test_at_first_touch_the_border_is_at_the_shear_speed_and_flagged():
    assert micro_front.border_speed(IMPACT, 0.0, 2.0, V_S) == (V_S, True)
    assert micro_front.front_speed(IMPACT, 1e-15, 2.0, V_S) == (V_S, True)
    slow, flagged = micro_front.border_speed(IMPACT, IMPACT.depth, 0.1, V_S)
    assert slow == pytest.approx(0.5 * math.sqrt(2.0) * math.sqrt(0.01 / IMPACT.depth) * 0.1, rel=1e-14)
    assert not flagged


def test_the_border_speed_is_the_derivative_of_the_contact_radius():
    run = course(IMPACT, numpy.array([0.3 - 1e-6, 0.3, 0.3 + 1e-6]) * IMPACT.duration)
    radius = IMPACT.shape * numpy.sqrt(0.01 * run.depth)
    slope = (radius[2] - radius[0]) / (2e-6 * IMPACT.duration)
    found = micro_front.border_speed(IMPACT, float(run.depth[1]), float(run.speed[1]), 1e9)[0]
    assert found == pytest.approx(slope, rel=1e-6)


def test_a_shear_speed_of_zero_is_refused():
    with pytest.raises(ImpactError, match="shear wave speed"):
        micro_front.front_time(IMPACT, 0.0)
