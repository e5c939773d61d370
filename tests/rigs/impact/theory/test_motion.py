"""An impact in SI units: scalings, closed elastic limit, the rig's integrator on the same law, geometry of large depths."""

import math

import numpy
import pytest

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.twins import impact as hunt_crossley
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere, hertz_modulus, pair, shares
from contact_sim_pkg.rigs.impact.theory.errors import FoldError, ImpactError
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact

SPHERE = Sphere(0.02, 0.01)
RUBBER = Material(8.0e6, 0.2)


def test_the_sample_of_the_paper_lasts_as_long_and_goes_as_deep_as_published():
    small = solve_impact(SPHERE, RUBBER, 2.0)
    iterated = solve_impact(SPHERE, RUBBER, 2.0, shape="iterate")
    assert small.depth / SPHERE.radius == pytest.approx(0.10799, abs=5e-6)
    assert small.duration == pytest.approx(1.7981e-3, abs=5e-8)
    assert iterated.shape == pytest.approx(1.37506, abs=5e-6)
    assert iterated.depth / SPHERE.radius == pytest.approx(0.10921, abs=5e-6)
    assert iterated.duration == pytest.approx(1.8184e-3, abs=5e-8)
    assert iterated.shape == pytest.approx(math.sqrt(2.0 - iterated.depth / SPHERE.radius), rel=1e-15)


@pytest.mark.parametrize("loss_tangent", [0.0, 0.05, 0.3, 1.0])
def test_restitution_depth_and_time_scale_with_speed_and_modulus(loss_tangent):
    base = solve_impact(SPHERE, Material(8e6, loss_tangent), 1.0)
    for ratio in (1e-3, 0.3, 7.0):
        other = solve_impact(SPHERE, Material(8e6, loss_tangent), ratio)
        assert other.restitution == pytest.approx(base.restitution, rel=1e-12)
        assert other.depth == pytest.approx(base.depth * ratio**0.8, rel=1e-12)
        assert other.duration == pytest.approx(base.duration * ratio**-0.2, rel=1e-12)
    doubled = solve_impact(SPHERE, Material(16e6, loss_tangent), 1.0)
    assert doubled.duration == pytest.approx(base.duration * 2**-0.4, rel=1e-12)
    assert doubled.restitution == pytest.approx(base.restitution, rel=1e-12)


def test_a_steel_ball_without_loss_is_hertz_in_closed_form():
    radius, speed = 0.01, 1.0
    mass = 7800.0 * 4.0 / 3.0 * math.pi * radius**3
    coefficient = hunt_crossley.sphere_coefficient(radius, 210e9, 0.3)
    duration, depth, force = hunt_crossley.elastic_impact(mass, speed, coefficient, 1.5)
    modulus = hertz_modulus(210e9 / (2.0 * (1.0 - 0.3**2)), math.sqrt(2.0))
    found = solve_impact(Sphere(mass, radius), Material(modulus, 0.0), speed)
    assert found.duration == pytest.approx(duration, rel=1e-14)
    assert found.depth == pytest.approx(depth, rel=1e-14)
    assert found.peak_force == pytest.approx(force, rel=1e-14)


@pytest.mark.parametrize(
    ("loss_tangent", "end"), [(0.05, "force"), (0.2, "force"), (1.0, "force"), (0.2, "gap"), (0.4, "gap")]
)
def test_the_rigs_own_integrator_finds_the_same_rebound_and_time(loss_tangent, end):
    found = solve_impact(SPHERE, Material(8e6, loss_tangent), 2.0, end)
    rig = PointContact(SPHERE.mass, 0.0, 0.0, 0.0, *found.normal_law)
    scale = numpy.array([found.depth, 2.0]) * 1e-12
    height, speed = integrate(rig, numpy.array([0.0, -2.0]), scale, numpy.array([0.0, 20e-3])).states[-1]
    assert speed / 2.0 == pytest.approx(found.restitution, abs=1e-9)
    free = (height + (0.0 if end == "gap" else _left_depth(found))) / speed
    assert 20e-3 - free == pytest.approx(found.duration, rel=1e-8)


def _left_depth(found):
    return float(course(found, numpy.array([found.duration])).depth[0])


def test_the_frequency_in_the_viscous_force_is_that_of_the_contact_time():
    found = solve_impact(SPHERE, RUBBER, 2.0)
    expected = 4.0 * math.sqrt(2.0) * math.sqrt(0.01) * 8e6 * 0.2 / (math.pi / found.duration)
    assert found.viscous == pytest.approx(expected, rel=1e-14)
    assert found.elastic == pytest.approx(4.0 / 3.0 * math.sqrt(2.0) * 8e6 * 0.1, rel=1e-14)


@pytest.mark.parametrize("end", ["force", "gap"])
def test_the_course_starts_and_ends_by_the_end_rule(end):
    found = solve_impact(SPHERE, RUBBER, 2.0, end)
    run = course(found, numpy.linspace(0.0, found.duration, 501))
    assert run.force.max() == pytest.approx(found.peak_force, rel=1e-4)
    assert run.depth.max() == pytest.approx(found.depth, rel=1e-4)
    assert run.speed[-1] == pytest.approx(-found.restitution * 2.0, rel=1e-9)
    assert run.force[0] == 0.0
    assert abs(run.force[-1]) < 1e-6 * found.peak_force
    if end == "force":
        assert run.force.min() > -1e-9 * found.peak_force
        assert run.depth[-1] > 0.0
    else:
        assert run.force.min() < -0.01 * found.peak_force
    impulse = numpy.sum(0.5 * (run.force[1:] + run.force[:-1]) * numpy.diff(run.time))
    assert impulse == pytest.approx(0.02 * 2.0 * (1.0 + found.restitution), rel=1e-3)


def test_two_lossy_bodies_stand_in_series():
    both = pair(Material(8e6, 0.2), Material(8e6, 0.2))
    assert both.storage_modulus == pytest.approx(4e6, rel=1e-15)
    assert both.loss_tangent == pytest.approx(0.2, rel=1e-14)
    stiff = pair(Material(8e6, 0.2), Material(8e12, 0.0))
    assert stiff.storage_modulus == pytest.approx(8e6, rel=2e-6)
    assert pair(Material(8e6, 0.2), None) == Material(8e6, 0.2)
    one = shares(8e6, math.inf)
    assert one == (1.0, 0.0)
    assert shares(2e6, 8e6) == pytest.approx((0.8, 0.2))


def test_depths_are_noted_above_a_third_and_refused_above_the_radius():
    assert solve_impact(SPHERE, RUBBER, 2.0).note is None
    assert "0.3" in str(solve_impact(SPHERE, RUBBER, 8.0).note)
    with pytest.raises(ImpactError, match="depth over radius"):
        solve_impact(SPHERE, RUBBER, 80.0)
    with pytest.raises(ImpactError, match="depth over radius"):
        solve_impact(SPHERE, RUBBER, 80.0, shape="iterate")


@pytest.mark.parametrize(
    ("sphere", "material", "speed", "name"),
    [
        (Sphere(0.0, 0.01), RUBBER, 1.0, "mass"),
        (Sphere(0.02, -1.0), RUBBER, 1.0, "radius"),
        (SPHERE, Material(math.nan, 0.2), 1.0, "storage modulus"),
        (SPHERE, Material(8e6, -0.1), 1.0, "loss tangent"),
        (SPHERE, RUBBER, 0.0, "impact speed"),
        (SPHERE, RUBBER, math.inf, "impact speed"),
    ],
)
def test_a_number_outside_its_range_is_refused_by_its_name(sphere, material, speed, name):
    with pytest.raises(ImpactError, match=name):
        solve_impact(sphere, material, speed)


def test_the_fold_is_refused_by_its_own_error():
    with pytest.raises(FoldError, match="end rule gap"):
        solve_impact(SPHERE, Material(8e6, 0.41), 1.0, "gap")
