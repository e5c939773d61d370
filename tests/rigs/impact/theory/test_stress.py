"""Stress and velocities over the contact area: they carry the force, end at the border, and stay finite at first touch."""

import math

import numpy
import pytest
from scipy.integrate import quad

from contact_sim_pkg.rigs.impact.theory import stress
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.micro_front import front_time
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact
from contact_sim_pkg.rigs.impact.theory.surface_wave import shear_speed

IMPACT = solve_impact(Sphere(0.02, 0.01), Material(8e6, 0.2), 2.0)
FRONT = front_time(IMPACT, shear_speed(8e6 / 3, 1100.0))
DEPTH, SPEED = 5e-4, 1.2


@pytest.mark.parametrize(("shape", "carried"), [("parabola", 1.0), ("hertz", 1.0), ("printed", 0.75)])
def test_the_stress_integrates_to_the_force_but_for_the_printed_shape(shape, carried):
    found = stress.centre_stress(IMPACT, DEPTH, SPEED, FRONT.depth, shape)
    radius = IMPACT.shape * math.sqrt(0.01 * DEPTH)
    force = IMPACT.elastic * DEPTH**1.5 + IMPACT.viscous * DEPTH**0.5 * SPEED

    def ring(rho):
        return 2 * math.pi * radius**2 * rho * float(stress.distribution(found.total, numpy.array([rho]), shape)[0])

    assert quad(ring, 0.0, 1.0, epsrel=1e-10)[0] == pytest.approx(carried * force, rel=1e-8)
    assert not found.limited


def test_the_hertz_shape_gives_equation_87_in_the_centre():
    found = stress.centre_stress(IMPACT, DEPTH, 0.0, FRONT.depth, "hertz")
    assert found.elastic == pytest.approx(
        2 * 8e6 * math.sqrt(DEPTH) / (math.pi * math.sqrt(2.0) * math.sqrt(0.01)), rel=1e-13
    )
    assert found.viscous == 0.0


def test_the_sum_is_the_stress_and_the_root_of_squares_the_amplitude():
    found = stress.centre_stress(IMPACT, DEPTH, -SPEED, FRONT.depth)
    assert found.total == found.elastic + found.viscous
    assert found.total < found.elastic
    assert found.amplitude == pytest.approx(math.sqrt(found.elastic**2 + found.viscous**2), rel=1e-15)


def test_the_viscous_stress_is_finite_and_flagged_towards_first_touch():
    at_limit = stress.centre_stress(IMPACT, FRONT.depth, 2.0, FRONT.depth)
    assert not at_limit.limited
    for depth in (0.999 * FRONT.depth, 1e-9, 1e-300):
        found = stress.centre_stress(IMPACT, depth, 2.0, FRONT.depth)
        assert found.limited
        assert found.viscous == pytest.approx(at_limit.viscous, rel=1e-12)
        assert 0.0 <= found.elastic <= at_limit.elastic
    nothing = stress.centre_stress(IMPACT, 0.0, 2.0, FRONT.depth)
    assert (nothing.elastic, nothing.viscous, nothing.limited) == (0.0, 0.0, True)
    assert stress.centre_stress(IMPACT, -1e-3, 0.0, FRONT.depth).total == 0.0
    with pytest.raises(ImpactError, match="limiting depth"):
        stress.centre_stress(IMPACT, DEPTH, SPEED, 0.0)


def test_velocities_end_where_the_border_and_the_centre_hold_them():
    places = numpy.array([0.0, 0.5, 1.0, 1.5])
    assert stress.normal_velocity(2.0, places).tolist() == [2.0, 1.5, 0.0, 0.0]
    assert stress.radial_velocity(3.0, places).tolist() == [0.0, 0.75, 3.0, 0.0]
    assert stress.distribution(4.0, places).tolist() == [4.0, 3.0, 0.0, 0.0]
    assert stress.distribution(4.0, places, "hertz") == pytest.approx([4.0, 4.0 * math.sqrt(0.75), 0.0, 0.0])


def test_the_retarded_speed_is_the_derivative_of_the_retarded_motion():
    for part in (0.1, 0.5, 0.9):
        time, step = part * IMPACT.duration, 1e-6 * IMPACT.duration
        _depth, speed, defined = stress.retarded_motion(IMPACT, time)
        before, after = (stress.retarded_motion(IMPACT, time + sign * step)[0] for sign in (-1.0, 1.0))
        assert defined
        assert speed == pytest.approx((after - before) / (2 * step), rel=1e-7, abs=1e-8)
        assert stress.retarded_motion(IMPACT, time, "printed")[1] != pytest.approx(speed, rel=1e-3)


def test_the_retarded_stress_has_a_value_or_a_flag_everywhere():
    for time in (-1.0, 0.0, IMPACT.duration * 1.0001, 5.0):
        assert stress.retarded_motion(IMPACT, time) == (0.0, 0.0, False)
        assert stress.retarded_viscous_stress(IMPACT, time, FRONT.depth) == (0.0, False)
    early, whole = stress.retarded_viscous_stress(IMPACT, 1e-12, FRONT.depth)
    assert math.isfinite(early)
    assert not whole
    time = 0.3 * IMPACT.duration
    depth, speed, _ = stress.retarded_motion(IMPACT, time)
    expected = 1.5 * 4 * 8e6 * 0.2 * speed / (math.pi * IMPACT.frequency * math.sqrt(2.0) * 0.1 * math.sqrt(depth))
    assert stress.retarded_viscous_stress(IMPACT, time, FRONT.depth, "hertz")[0] == pytest.approx(expected, rel=1e-12)
    heavy = solve_impact(Sphere(0.02, 0.01), Material(8e6, 3.2), 2.0)
    assert stress.retarded_motion(heavy, 0.5 * heavy.duration) == (0.0, 0.0, False)


def test_another_shape_is_refused_by_its_name():
    with pytest.raises(ValueError, match="shape 'flat'"):
        stress.distribution(1.0, numpy.zeros(1), "flat")


def test_the_course_of_the_centre_stress_is_finite_over_the_whole_impact():
    run = course(IMPACT, numpy.linspace(0.0, IMPACT.duration, 200))
    found = [stress.centre_stress(IMPACT, x, v, FRONT.depth) for x, v in zip(run.depth, run.speed, strict=True)]
    assert all(math.isfinite(value.total) for value in found)
    assert max(value.total for value in found) > 0.0
