"""Accelerations of active contacts on their paths, against differences of the contact velocities
``J(q) v`` at constant v.
"""

import math

import numpy
import pytest
from scipy.spatial.transform import Rotation

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigid.bodies.active_contacts import path_acceleration
from contact_sim_pkg.rigid.bodies.body import (
    RigidBody,
    box,
    contact_count,
    contact_kinematics,
    fitted_ground,
    height_field,
    placed,
    regular_block,
    slope,
    sphere,
)
from contact_sim_pkg.rigid.problem import PLANE, SPACE

ROOF = [0.0, 1.0, 0.0]  # faces of 45 degrees about a peak at x = 0
TIME = 1e-5  # [s], of the central differences


@entry
def accelerations(body, ground, motion, J, out):
    """Of all contacts."""
    for i in range(out.shape[0]):
        normal, first, second = path_acceleration(body, ground, motion, J, i)
        out[i, 0], out[i, 1], out[i, 2] = normal, first, second


def ball(radius):
    """A ball in the plane."""
    load = numpy.array([0.0, -9.81, 0.0])
    return RigidBody(PLANE, 1.0, numpy.array([0.4 * radius**2]), numpy.zeros((1, 2)), radius, 0.3, 0.0, load)


def moved(body, motion, time):
    """The motion after ``time`` at its velocities, which stay what they are."""
    width = body.width
    v, position = motion.velocity, motion.position + time * motion.velocity[:width]
    if width == PLANE:
        return placed(body, position, v, angle=motion.angle[0] + time * v[2])
    return placed(body, position, v, rotation=Rotation.from_rotvec(time * v[3:]).as_matrix() @ motion.rotation)


def speeds(body, ground, motion):
    """Gaps, rows, and velocities [contacts, width] of the contacts."""
    contacts = contact_count(body, ground)
    gap, rows = numpy.zeros(contacts), numpy.zeros((contacts * body.width, len(body.load)))
    contact_kinematics(body, ground, motion, gap, rows)
    return gap, rows, (rows @ motion.velocity).reshape(contacts, body.width)


def differences(body, ground, motion):
    """Rates of the contact velocities, and of the gaps twice."""
    (gap_0, _rows, before), (gap, _r, _s), (gap_1, _rows, after) = (
        speeds(body, ground, moved(body, motion, t)) for t in (-TIME, 0.0, TIME)
    )
    return (after - before) / (2.0 * TIME), (gap_1 - 2.0 * gap + gap_0) / TIME**2


PLANE_RATE, SPACE_RATE = [0.3, -0.2, 1.7], [0.3, 0.5, -0.2, 1.1, -0.7, 2.3]
TURNED = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
CASES = [
    pytest.param(regular_block(0.2, 1.0, 0.3, 0.0), slope(PLANE, 0.2), [0.1, 0.4], PLANE_RATE, id="block over a plane"),
    pytest.param(
        box((0.1, 0.2, 0.3), 1.0, 0.3, 0.0), slope(SPACE, 0.2), [0.0, 0.1, 0.5], SPACE_RATE, id="box over a plane"
    ),
    pytest.param(
        regular_block(0.4, 1.0, 0.3, 0.0), height_field(PLANE, ROOF, -1.0, 1.0), [0.05, 1.25], PLANE_RATE, id="peak"
    ),
    pytest.param(ball(0.1), height_field(PLANE, ROOF, -1.0, 1.0), [0.04, 1.1], PLANE_RATE, id="ball over a peak"),
    pytest.param(
        sphere(0.1, 1.0, 0.3, 0.0), height_field(SPACE, ROOF, -1.0, 1.0), [0.04, 0.0, 1.1], SPACE_RATE, id="sphere"
    ),
]


@pytest.mark.parametrize(("body", "ground", "place", "rate"), CASES)
def test_the_normal_acceleration_of_a_path_is_the_second_rate_of_the_gap(body, ground, place, rate):
    """At constant velocities; of a contact whose gap turns with the feature that it is near to."""
    ground = fitted_ground(body, ground)
    motion = placed(body, place, rate, angle=0.3, rotation=TURNED)
    gap, rows, _speeds = speeds(body, ground, motion)
    found = numpy.zeros((len(gap), 3))
    accelerations(body, ground, motion, rows, found)
    slopes, bends = differences(body, ground, motion)
    near = gap < 0.6
    assert near.any()
    assert found[near, 0] == pytest.approx(bends[near], abs=1e-4)
    assert found[near, 0] == pytest.approx(slopes[near, 0], abs=1e-7)
    assert numpy.abs(found[near, 0]).max() > 1e-3


@pytest.mark.parametrize(("body", "ground", "place", "rate"), CASES)
def test_the_tangential_acceleration_of_an_active_path_is_the_rate_of_the_slip(body, ground, place, rate):
    """Of the contact nearest to the ground, at a velocity that keeps its gap."""
    ground = fitted_ground(body, ground)
    motion = placed(body, place, rate, angle=0.3, rotation=TURNED)
    if (
        body.radius > 0.0
    ):  # the normal of a sphere over a peak turns with its distance: on the ground that is its radius
        motion.position[[0, -1]] = [0.3 * body.radius, 1.0 + math.sqrt(0.91) * body.radius]
    gap, rows, speed = speeds(body, ground, motion)
    nearest = int(numpy.argmin(gap))
    motion.velocity[: body.width] -= speed[nearest, 0] * rows[nearest * body.width, : body.width]
    found = numpy.zeros((len(gap), 3))
    accelerations(body, ground, motion, rows, found)
    slopes, _bends = differences(body, ground, motion)
    assert found[nearest, 1 : body.width] == pytest.approx(slopes[nearest, 1:], abs=1e-7)
