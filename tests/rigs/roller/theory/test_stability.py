"""Linear stability of the roller."""

import math

import numpy
import pytest
from tests.rigs.roller.bench import BENDING, CURVATURES, MODULUS, ROLLER

from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.stability import (
    RollerError,
    critical_damping,
    critical_load,
    linearise,
    stability,
)

LOAD = 300.0  # [N]


@pytest.mark.parametrize("friction", [0.01, -0.01])
def test_spin_and_friction_flutter(friction):
    """Sheet of the paper: +0.4557 1/s at 304 Hz for f_r > 0, at 216 Hz for f_r < 0."""
    found = stability(ROLLER._replace(rolling_friction=friction), CURVATURES, None, MODULUS, LOAD)
    assert found.growth_rate == pytest.approx(0.4557, abs=5e-5)
    assert found.frequency == pytest.approx(304.0 if friction > 0.0 else 216.0, abs=0.5)


def test_the_roots_are_those_of_the_characteristic_polynomial():
    roller = ROLLER._replace(inertia_product=4e-6, inertia_yaw=3e-5)
    gyro, arm = roller.inertia_spin * roller.spin, LOAD * roller.radius
    k1, k2, c = 60.0 - arm, 50.0, 0.01 * arm
    middle = 2e-5 * k2 + 3e-5 * k1 + gyro**2 + c * 4e-6
    expected = numpy.roots([2e-5 * 3e-5 - 4e-6**2, 0.0, middle, c * gyro, k1 * k2])
    found = stability(roller, CURVATURES, None, MODULUS, LOAD).roots
    assert sorted(found, key=lambda r: r.imag) == pytest.approx(sorted(expected, key=lambda r: r.imag), rel=1e-7)


def test_without_friction_the_roots_come_in_pairs_and_nothing_grows():
    found = stability(ROLLER._replace(rolling_friction=0.0), CURVATURES, None, MODULUS, LOAD)
    assert abs(found.growth_rate) < 1e-9
    assert sorted(found.roots.imag) == pytest.approx(sorted(-found.roots.imag))


@pytest.mark.parametrize("speed", [0.0, 1.0, 50.0, 5000.0])
def test_an_undamped_motion_without_friction_is_neutral_and_needs_no_damping(speed):
    """Roots on the imaginary axis: what rounding puts beside it is none."""
    roller = ROLLER._replace(rolling_friction=0.0, spin=2.0 * math.pi * speed)
    assert stability(roller, CURVATURES, None, MODULUS, LOAD).growth_rate == 0.0
    assert critical_damping(roller, CURVATURES, None, MODULUS, LOAD) == 0.0
    assert critical_load(roller, CURVATURES, None, MODULUS, 10000.0) == pytest.approx(3000.0, rel=1e-6)


@pytest.mark.parametrize(("friction", "damping", "load"), [(0.01, 1.562e-5, 380.0), (-0.01, 2.188e-5, 275.0)])
def test_damping_sets_the_threshold(friction, damping, load):
    """Sheet of the paper; the load is that which damping of 2e-5 N m s bears."""
    roller = ROLLER._replace(rolling_friction=friction)
    assert critical_damping(roller, CURVATURES, None, MODULUS, LOAD) == pytest.approx(damping, rel=5e-4)
    damped = roller._replace(damping_tilt=2e-5, damping_yaw=2e-5)
    assert critical_load(damped, CURVATURES, None, MODULUS, 5000.0) == pytest.approx(load, rel=2e-3)


def test_divergence_without_spin_where_the_moment_of_the_pressure_reaches_the_stiffness():
    """F R = k_psi."""
    still = ROLLER._replace(spin=0.0, rolling_friction=0.0)
    assert critical_load(still, CURVATURES, None, MODULUS, 10000.0) == pytest.approx(3000.0, rel=1e-6)
    assert stability(still, CURVATURES, None, MODULUS, 3100.0).frequency == 0.0


@pytest.mark.parametrize(("share", "stable"), [(1.02, True), (0.98, False)])
def test_the_gyroscope_stabilises_two_negative_stiffnesses(share, stable):
    """From G^2 = 2 sqrt(I_y I_z k1 k2) - I_y k2 - I_z k1 on, with I_yz = 0."""
    k1, k2 = -2.0, -5.0
    least = math.sqrt(2.0 * 2e-5 * math.sqrt(k1 * k2) - 2e-5 * k2 - 2e-5 * k1)
    roller = ROLLER._replace(
        stiffness_tilt=LOAD * ROLLER.radius + k1, stiffness_yaw=k2, rolling_friction=0.0, spin=share * least / 3.5e-5
    )
    assert (stability(roller, CURVATURES, None, MODULUS, LOAD).growth_rate < 1e-6) is stable


def test_the_static_angles_of_a_bent_shaft():
    linear = linearise(ROLLER, CURVATURES, BENDING, MODULUS, 100.0)
    moment = moments(ROLLER, CURVATURES, BENDING, MODULUS, 100.0, linear.tilt, linear.yaw)
    assert linear.tilt != 0.0
    assert moment.tilt == pytest.approx(60.0 * linear.tilt, rel=1e-10)
    assert moment.yaw == pytest.approx(50.0 * linear.yaw, rel=1e-8)


def test_the_slope_of_the_bending_moment():
    """k1 = k_psi - F R + T R^2 and k2 = k_theta - (T/4) (a^2 - b^2) dphi/dtheta about zero, here with A = l."""
    bending = BENDING._replace(load_distance=BENDING.contact_distance)
    linear = linearise(ROLLER, CURVATURES, bending, MODULUS, 100.0)
    a, b, h = 2.14706568e-4, 1.16828444e-4, 0.005 - 4.01105618e-6  # of Hertz, tested elsewhere
    pull = 0.1 * 225.0 * math.pi * a * b * h / bending.second_moment
    assert linear.tilt == 0.0
    assert linear.stiffness[0, 0] == pytest.approx(60.0 - 100.0 * 0.02 + pull * 0.02**2, rel=1e-9)
    assert 50.0 - linear.stiffness[1, 1] == pytest.approx(-pull / 12.0 * (a * a - b * b), rel=1e-3, abs=1e-13)


def test_inertias_that_are_none_are_refused():
    with pytest.raises(RollerError, match=r"I_yz = 2e-05 .* must be below"):
        stability(ROLLER._replace(inertia_product=2e-5), CURVATURES, None, MODULUS, LOAD)


def test_a_divergence_is_not_damped():
    still = ROLLER._replace(spin=0.0, rolling_friction=0.0)
    with pytest.raises(RollerError, match="no damping stops the motion under 3100 N"):
        critical_damping(still, CURVATURES, None, MODULUS, 3100.0)
