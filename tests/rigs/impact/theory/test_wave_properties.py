"""Every public function of the impact's front, stresses and surface wave: checks over its domain, refusals outside."""

from __future__ import annotations

import math
import pkgutil

import numpy
import pytest
import scipy.integrate
from hypothesis import strategies as st
from tests.properties import Table, positive, rows
from tests.rigs.impact.theory import test_material_properties as material
from tests.rigs.impact.theory import test_motion_properties as moving
from tests.rigs.impact.theory import test_viscoelasticity_properties as viscoelastic
from tests.rigs.impact.theory.solved_impacts import IMPACT

from contact_sim_pkg.rigs.impact import theory as package
from contact_sim_pkg.rigs.impact.theory import micro_front, motion, stress, surface_wave
from contact_sim_pkg.rigs.impact.theory.closed_form import scalings as closed_forms

MODULES = ("micro_front", "stress", "surface_wave")
TABLE = Table()
PREFIX = f"{package.__name__}."
holds = TABLE.holds
close = pytest.approx
NOT_PHYSICS = {"checks", "errors"}  # thin names of `compiled/guards.py`, which has tests of its own


# Micro-impact front

SHEAR = positive(10.0, 1e3)
DEPTH, RATE = st.just(0.0) | positive(1e-8, 0.01), st.floats(-3.0, 3.0)


def border(impact, depth, speed):
    """d/dt of k_p sqrt(R x)."""
    if depth == 0.0:
        return math.inf if speed > 0.0 else 0.0
    step = 1e-6 * depth
    radii = [impact.shape * math.sqrt(impact.sphere.radius * x) for x in (depth - step, depth + step)]
    return (radii[1] - radii[0]) / (2.0 * step) * speed


def check_speed(found, expected, shear_speed):
    if abs(expected / shear_speed - 1.0) > 1e-6:
        assert found[1] == (expected > shear_speed)
        assert found[0] == close(min(expected, shear_speed), rel=1e-6)


@holds(micro_front.border_speed, impact=IMPACT, depth=DEPTH, speed=RATE, shear_speed=SHEAR)
def _(found, impact, depth, speed, shear_speed):
    check_speed(found, border(impact, depth, speed), shear_speed)


@holds(micro_front.front_speed, impact=IMPACT, depth=DEPTH, speed=RATE, shear_speed=SHEAR)
def _(found, impact, depth, speed, shear_speed):
    check_speed(found, 0.5 * (1.0 + math.sqrt(2.0)) * border(impact, depth, speed), shear_speed)


@holds(micro_front.front_time, impact=IMPACT, shear_speed=SHEAR, examples=10)
def _(found, impact, shear_speed):
    assert 0.5 * (1.0 + math.sqrt(2.0)) * border(impact, found.depth, found.speed) == close(shear_speed, rel=1e-6)
    now = motion.course(impact, [found.time])
    assert (now.depth[0], now.speed[0]) == close((found.depth, found.speed), rel=1e-9)
    times = found.time * numpy.linspace(0.0, 1.0, 401) ** 2
    run = motion.course(impact, times)
    assert found.heat == close(scipy.integrate.simpson(run.viscous_force * run.speed, x=times), rel=1e-4, abs=1e-300)


@holds(micro_front.front_of_small_times, impact=IMPACT, shear_speed=SHEAR)
def _(found, impact, shear_speed):
    assert found.depth == close(impact.speed * found.time)
    assert 0.5 * (1.0 + math.sqrt(2.0)) * border(impact, found.depth, impact.speed) == close(shear_speed, rel=1e-6)
    heat = scipy.integrate.quad(lambda x: impact.viscous * math.sqrt(x) * impact.speed, 0.0, found.depth, epsabs=0.0)[0]
    assert found.heat == close(heat, rel=1e-6, abs=1e-300)


@holds(micro_front.front_of_damped_sine, impact=IMPACT, shear_speed=SHEAR)
def _(found, impact, shear_speed):
    sine = closed_forms.damped_sine(impact.sphere, impact.material, impact.speed, "corrected", impact.shape)
    decay = complex(-sine.damping, sine.frequency)
    motion_there = impact.speed / sine.frequency * numpy.exp(decay * found)
    depth, speed = motion_there.imag, (motion_there * decay).imag
    assert 0.5 * (1.0 + math.sqrt(2.0)) * border(impact, depth, speed) == close(shear_speed, rel=1e-5)


# Stress

CARRIED = {"parabola": 1.0, "hertz": 1.0, "printed": 0.75}
PLACES = rows(st.floats(0.0, 1.5))


@holds(stress.centre_stress, impact=IMPACT, depth=positive(1e-6, 1e-2), speed=RATE, limiting_depth=positive(1e-9, 1e-4),
       shape=st.sampled_from(list(CARRIED)), outside=({"limiting_depth": 0.0},))  # fmt: skip
def _(found, impact, depth, speed, limiting_depth, shape):
    """Over the area the stress carries the force."""
    mean = 2.0 * scipy.integrate.quad(lambda r: r * float(stress.distribution(1.0, [r], shape)[0]), 0.0, 1.0)[0]
    area = math.pi * impact.shape**2 * impact.sphere.radius * depth
    assert found.elastic * mean * area == close(CARRIED[shape] * impact.elastic * depth**1.5, rel=1e-9)
    assert found.limited == (depth < limiting_depth)
    if not found.limited:
        force = impact.viscous * math.sqrt(depth) * speed
        assert found.viscous * mean * area == close(CARRIED[shape] * force, rel=1e-9, abs=1e-300)
    assert found.total == found.elastic + found.viscous


@holds(stress.distribution, centre=st.floats(-1e6, 1e6), places=PLACES, shape=st.sampled_from(list(CARRIED)))
def _(found, centre, places, shape):
    power = 0.5 if shape == "hertz" else 1.0
    expected = [centre * (1.0 - min(r, 1.0) ** 2) ** power for r in places]
    assert found == close(numpy.array(expected), rel=1e-12, abs=1e-9)


@holds(stress.normal_velocity, speed=RATE, places=PLACES)
def _(found, speed, places):
    assert found == close(numpy.array([speed * (1.0 - min(r, 1.0) ** 2) for r in places]), abs=1e-14)


@holds(stress.radial_velocity, border_speed=RATE, places=PLACES, outside=({"places": [-0.1]},))
def _(found, border_speed, places):
    assert found == close(numpy.array([border_speed * r * r if r <= 1.0 else 0.0 for r in places]), abs=1e-14)


@holds(stress.retarded_motion, impact=IMPACT, time=positive(1e-6, 0.1), form=st.sampled_from(["corrected", "printed"]))
def _(found, impact, time, form):
    depth, speed, defined = found
    assert defined == (0.0 < time <= impact.duration)
    if not defined:
        assert (depth, speed) == (0.0, 0.0)
        return
    slower = 1.0 - impact.material.loss_tangent / math.pi
    omega, delta = math.pi / impact.duration, -math.log(impact.restitution) / impact.duration

    def place(t):
        return impact.speed / omega * math.exp(-delta * t) * math.sin(omega * slower * t)

    step = 1e-6 * time
    rate = (place(time + step) - place(time - step)) / (2.0 * step)
    if form == "printed":
        rate += (1.0 - slower) * impact.speed * math.exp(-delta * time) * math.cos(omega * slower * time)
    assert (depth, speed) == close((place(time), rate), rel=1e-6, abs=1e-6 * impact.speed)


@holds(stress.retarded_viscous_stress, impact=IMPACT, time=positive(1e-6, 0.1), limiting_depth=positive(1e-9, 1e-6),
       shape=st.sampled_from(list(CARRIED)), form=st.sampled_from(["corrected", "printed"]),
       outside=({"limiting_depth": 0.0},))  # fmt: skip
def _(found, impact, time, limiting_depth, shape, form):
    """Eq 89."""
    depth, speed, defined = stress.retarded_motion(impact, time, form)
    if not defined:
        assert found == (0.0, False)
    elif depth > limiting_depth:
        centre = {"parabola": 2.0, "hertz": 1.5, "printed": 1.5}[shape]
        expected = centre * 4.0 * impact.material.loss_modulus * speed
        expected /= math.pi * impact.frequency * impact.shape * math.sqrt(impact.sphere.radius * depth)
        assert found == (close(expected, rel=1e-9, abs=1e-300), True)


# Surface wave


@holds(surface_wave.ring, radius=positive(1e-4, 0.1), mean_pressure=st.just(0.0) | positive(1.0, 9e5),
       bulk_modulus=st.just(math.inf) | positive(1e6, 1e9), outside=({"mean_pressure": 1e6, "bulk_modulus": 1e6},))  # fmt: skip
def _(found, radius, mean_pressure, bulk_modulus):
    """Half of the width of a ring whose area is a_k times that of the contact."""
    part = mean_pressure / bulk_modulus
    outer = radius + 2.0 * found.width
    assert (outer**2 - radius**2) * (1.0 - part) == close((1.0 + part) * radius**2, rel=1e-9)
    assert (found.contact_radius, found.front_radius) == close((radius, radius + found.width))


GROUND = {"shear_modulus": positive(1e5, 1e9), "density": positive(500.0, 5000.0)}


@holds(surface_wave.shear_speed, **GROUND)
def _(found, shear_modulus, density):
    assert density * found**2 == close(shear_modulus, rel=1e-12)


@holds(surface_wave.rayleigh_speed, **GROUND, poisson_ratio=st.floats(-0.99, 0.5), outside=({"poisson_ratio": -1.0},))
def _(found, shear_modulus, density, poisson_ratio):
    """Rayleigh's function is zero there: (2 - s)^2 = 4 sqrt(1 - s) sqrt(1 - s b), s = (c/V_s)^2, b = (V_s/V_p)^2."""
    s = found**2 * density / shear_modulus
    b = 0.5 * (1.0 - 2.0 * poisson_ratio) / (1.0 - poisson_ratio)
    assert 0.0 < s < 1.0
    assert (2.0 - s) ** 2 == close(4.0 * math.sqrt(1.0 - s) * math.sqrt(1.0 - s * b), rel=1e-9)


@holds(surface_wave.surface_wave, impact=IMPACT, **GROUND, poisson_ratio=st.floats(0.0, 0.5))
def _(found, impact, shear_modulus, density, poisson_ratio):
    radius = impact.shape * math.sqrt(impact.depth * impact.sphere.radius)
    assert found.length == close(2.0 * (math.sqrt(2.0) - 1.0) * radius)
    assert found.number * found.length == close(2.0 * math.pi)
    assert found.speed == close(found.length * impact.frequency / (2.0 * math.pi))
    assert found.start_radius == close(radius + 0.5 * found.length / 2.0)  # r_w = r/2 (sqrt 2 - 1), a quarter wave
    assert found.relative_speed == close(
        found.speed / surface_wave.rayleigh_speed(shear_modulus, density, poisson_ratio)
    )
    assert (found.amplitude, found.start_time) == (impact.depth, impact.compression_time)
    assert math.exp(-found.damping * impact.duration) == close(impact.restitution)


@holds(surface_wave.wave_height,
       wave=st.builds(surface_wave.surface_wave, IMPACT, st.just(1e6), st.just(1e3), st.just(0.4)),
       radii=rows(st.floats(0.0, 1.0)), times=rows(st.floats(0.0, 0.01)), spread=st.sampled_from(["none", "cylindrical"]),
       form=st.sampled_from(["corrected", "printed"]), outside=({"radii": [-1.0]}, {"times": [[0.0]]}))  # fmt: skip
def _(found, wave, radii, times, spread, form):
    assert found.shape == (len(times), len(radii))
    for t, line in zip(times, found, strict=True):
        for r, height in zip(radii, line, strict=True):
            since = t - wave.start_time
            if since < 0.0 or r > wave.start_radius + wave.speed * since:
                assert height == 0.0
                continue
            decay = math.exp(-wave.damping * (t if form == "printed" else since))
            fall = math.sqrt(min(1.0, wave.start_radius / max(r, 1e-300))) if spread == "cylindrical" else 1.0
            phase = wave.frequency * since - wave.number * r
            assert height == close(wave.amplitude * decay * fall * math.cos(phase), abs=1e-9 * wave.amplitude)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg.rigs.impact.theory", MODULES, (motion.FreeImpact, surface_wave.Wave))
)


def test_each_module_of_the_package_is_in_a_table():
    tables = {name for module in (material, moving, viscoelastic) for name in module.MODULES}
    assert {
        found.name.removeprefix(PREFIX) for found in pkgutil.walk_packages(package.__path__, PREFIX) if not found.ispkg
    } == {*tables, *MODULES, *NOT_PHYSICS}
