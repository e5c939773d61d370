"""Which directions count as told: inertia beside a mass that is known many orders better."""

import numpy
import pytest
from tests.identify import motions

from contact_sim_pkg.identify.contact.balance import split
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench

FORCE, TORQUE = (0.0, 2.0, 3.0), (0.02, -0.03, 0.05)


def regressor(inertia, mass, seed=0):
    """Rows that tell two numbers of inertia by `inertia` and the mass by `mass`."""
    rows = numpy.random.default_rng(seed).normal(size=(40, 3))
    return rows * [*inertia, mass]


@pytest.mark.parametrize("mass", [10.0, 1e6, 1e13, 1e18])
def test_how_well_the_mass_is_known_takes_nothing_from_the_inertia(mass):
    """The covariance of the two numbers does not depend on the size of the third column: normal equations of columns of size 1."""
    found = split(regressor((1e4, 3e3), mass), with_mass=True)
    assert found.rank == 3
    covariance = (found.identified.T / found.values**2) @ found.identified
    unit = regressor((1.0, 1.0), 1.0)
    expected = numpy.linalg.inv(unit.T @ unit)[:2, :2] / numpy.outer((1e4, 3e3), (1e4, 3e3))
    assert covariance[:2, :2] == pytest.approx(expected, rel=1e-6 if mass < 1e12 else 1e-1)


def test_a_mass_that_noise_hides_is_missing():
    found = split(regressor((1e4, 3e3), 1e-3), with_mass=True)
    assert found.rank == 2
    assert abs(found.missing) == pytest.approx(numpy.array([[0.0, 0.0, 1.0]]), abs=1e-6)


@pytest.mark.parametrize("mass", [10.0, 1e6, 1e13])
def test_a_direction_in_inertia_that_rounding_alone_tells_is_missing(mass):
    rows = regressor((1e4, 1e4), mass)
    rows[:, 1] = 2.0 * rows[:, 0] * (1.0 + 1e-15)
    found = split(rows, with_mass=True)
    assert found.rank == 2
    assert abs(found.missing) == pytest.approx(numpy.array([[2.0, 1.0, 0.0]]) / numpy.sqrt(5.0), abs=1e-7)


def test_mass_and_inertia_that_move_together_are_one_direction():
    """As of a torque alone: the last column is that of the first, 1e3 times."""
    rows = regressor((1e4, 1e4), 1.0)
    rows[:, 2] = 1e3 * rows[:, 0]
    found = split(rows, with_mass=True)
    assert found.rank == 2
    assert abs(found.missing) == pytest.approx(numpy.array([[1e3, 0.0, 1.0]]) / numpy.sqrt(1e6 + 1.0), abs=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_rough_rotations_beside_exact_positions_tell_mass_and_inertia(seed):
    """Velocities to 1e-13 m/s, rotations to 0.1 mrad: the mass is told 1e9 times better than the inertia, and both are."""
    exact = motions.states_of(motions.spatial(0.5, FORCE, TORQUE))
    states = motions.noisy(exact, seed, 0.0, 1e-4, 0.0, 1e-3)
    found = identify(states, Setup(geometry.box(motions.LENGTHS), wrench=wrench.constant(FORCE, TORQUE)))
    truth = [*numpy.diag(motions.SPATIAL_INERTIA), 0.0, 0.0, 0.0, 1.0 / motions.MASS]
    assert found.rank == 7
    for parameter, expected in zip(found.parameters, truth, strict=True):
        assert parameter.identified
        assert abs(parameter.value - expected) < 4.5 * parameter.deviation
