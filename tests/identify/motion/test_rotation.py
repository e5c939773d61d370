"""Rotations against scipy's."""

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from contact_sim_pkg.identify.motion.rotation import cross_matrix, exponential, from_quaternion, logarithm, mean

COMPONENT = st.floats(-1.8, 1.8)


@given(st.tuples(COMPONENT, COMPONENT, COMPONENT))
def test_the_logarithm_takes_back_the_exponential(vector):
    length = numpy.linalg.norm(vector)
    if length < 3.1:
        assert logarithm(exponential(numpy.array([vector])))[0] == pytest.approx(vector, abs=1e-12)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-6, 0.3, 1.9, 2.1, 3.1])
def test_the_logarithm_agrees_with_scipy_at_small_and_large_angles(angle):
    vector = angle * numpy.array([0.6, 0.0, -0.8])
    matrices = Rotation.from_rotvec([vector, 0.5 * vector]).as_matrix()
    assert logarithm(matrices) == pytest.approx(numpy.array([vector, 0.5 * vector]), rel=1e-10, abs=1e-15)


def test_a_quaternion_is_read_with_its_scalar_first():
    assert from_quaternion(numpy.array([numpy.sqrt(0.5), 0.0, 0.0, numpy.sqrt(0.5)])) @ [1.0, 0, 0] == pytest.approx(
        [0, 1, 0]
    )


def test_the_mean_of_two_rotations_is_half_way():
    first, turn = exponential(numpy.array([0.3, -0.2, 0.9])), numpy.array([0.4, 0.1, -0.2])
    assert mean(first, exponential(turn) @ first) == pytest.approx(exponential(0.5 * turn) @ first, abs=1e-14)


def test_the_cross_matrix_is_the_cross_product():
    first, second = numpy.array([1.0, 2.0, 3.0]), numpy.array([-4.0, 0.5, 2.0])
    assert cross_matrix(first) @ second == pytest.approx(numpy.cross(first, second))
