"""A rigid body of points with a radius (block, polygon, box, convex hull, sphere) over a ground: gaps and Jacobians.

Every shape is the hull of spheres of one radius about its points: radius 0 for polygons and hulls, one point for a sphere. Against
a plane that is exact; against a height field the contact lies below each point, so ridges narrower than the spacing of the
points go unseen. Coordinates: plane (x, y, angle), space (x, y, z and a rotation matrix); velocities (v, omega) in world axes.
Source: identifiability paper eqs 10, 11, 40-42; SEEDS 7.2 (M4.7).
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy

from ..jit import kernel
from ..parameters import Vector
from .problem import PLANE, SPACE


class RigidBody(NamedTuple):
    """Shape, inertia and surface of a body."""

    width: int  # PLANE or SPACE
    mass: float  # [kg]
    inertia: Vector  # [1] about the centre of mass, or [3] principal, in [kg m^2]
    points: Vector  # [points, width] from the centre of mass, in principal body axes, in [m]
    radius: float  # of the sphere about each point, in [m]
    friction: float
    restitution: float
    load: Vector  # [coordinates], gravity times mass and any known force and torque, in world axes, in [N], [N m]


class Ground(NamedTuple):
    """A plane ``n x = offset``, or a height field over the first coordinates where it has cells."""

    normal: Vector  # [width], unit
    offset: float  # [m]
    heights: Vector  # [nodes x, nodes y] in [m], 1 column in the plane; (0, 0): the plane alone
    origin_x: float  # [m] of node 0
    origin_y: float
    cell: float  # [m]


class Motion(NamedTuple):
    """State of a body; changes in place."""

    position: Vector  # [width] in [m]
    angle: Vector  # [1] in [rad], in the plane
    rotation: Vector  # [width, width], body to world
    velocity: Vector  # [coordinates], v then omega, world axes


def regular_block(side: float, mass: float, friction: float, restitution: float, gravity: float = 9.81) -> RigidBody:
    """The square block of the identifiability paper: four corners, inertia ``m s^2/6``."""
    half = 0.5 * side
    corners = numpy.array([[-half, -half], [half, -half], [half, half], [-half, half]])
    inertia = numpy.array([mass * side**2 / 6.0])
    return RigidBody(
        PLANE, mass, inertia, corners, 0.0, friction, restitution, numpy.array([0.0, -mass * gravity, 0.0])
    )


def box(
    sides: tuple[float, float, float], mass: float, friction: float, restitution: float, gravity: float = 9.81
) -> RigidBody:
    """A homogeneous box of the three ``sides`` in [m]."""
    x, y, z = sides
    corners = numpy.array(list(itertools.product((-0.5 * x, 0.5 * x), (-0.5 * y, 0.5 * y), (-0.5 * z, 0.5 * z))))
    inertia = mass / 12.0 * numpy.array([y * y + z * z, x * x + z * z, x * x + y * y])
    load = numpy.array([0.0, 0.0, -mass * gravity, 0.0, 0.0, 0.0])
    return RigidBody(SPACE, mass, inertia, corners, 0.0, friction, restitution, load)


def sphere(radius: float, mass: float, friction: float, restitution: float, gravity: float = 9.81) -> RigidBody:
    """A homogeneous sphere."""
    inertia = numpy.full(3, 0.4 * mass * radius**2)
    load = numpy.array([0.0, 0.0, -mass * gravity, 0.0, 0.0, 0.0])
    return RigidBody(SPACE, mass, inertia, numpy.zeros((1, 3)), radius, friction, restitution, load)


def slope(width: int, angle: float = 0.0) -> Ground:
    """A plane through the origin that rises along x by ``angle`` in [rad]."""
    normal = numpy.zeros(width)
    normal[0], normal[-1] = -math.sin(angle), math.cos(angle)
    return Ground(normal, 0.0, numpy.zeros((0, 0)), 0.0, 0.0, 1.0)


def height_field(width: int, heights: Vector, origin_x: float, origin_y: float, cell: float) -> Ground:
    """Bilinear ground over a grid of ``heights`` [nodes x, nodes y]; in the plane [nodes x, 1]."""
    return slope(width)._replace(
        heights=numpy.ascontiguousarray(heights, float), origin_x=origin_x, origin_y=origin_y, cell=cell
    )


def placed(
    body: RigidBody, position: Vector, velocity: Vector, angle: float = 0.0, rotation: Vector | None = None
) -> Motion:
    """Motion of a body at ``position`` with ``velocity``, turned by ``angle`` (plane) or ``rotation`` (space)."""
    turn = numpy.eye(3) if rotation is None else numpy.array(rotation, float)
    if body.width == PLANE:
        turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return Motion(numpy.array(position, float), numpy.array([float(angle)]), turn, numpy.array(velocity, float))


@kernel
def _field_below(ground, width, x, y):
    """Height and slopes of the height field at (x, y), bilinear; beyond its edge the edge goes on."""
    heights = ground.heights
    along = min(max((x - ground.origin_x) / ground.cell, 0.0), heights.shape[0] - 1.0)
    i = min(int(along), heights.shape[0] - 2)
    a = along - i
    if width == PLANE:
        first, second = heights[i, 0], heights[i + 1, 0]
        return first + a * (second - first), (second - first) / ground.cell, 0.0
    across = min(max((y - ground.origin_y) / ground.cell, 0.0), heights.shape[1] - 1.0)
    j = min(int(across), heights.shape[1] - 2)
    b = across - j
    h_00, h_10, h_01, h_11 = heights[i, j], heights[i + 1, j], heights[i, j + 1], heights[i + 1, j + 1]
    height = (1.0 - a) * (1.0 - b) * h_00 + a * (1.0 - b) * h_10 + (1.0 - a) * b * h_01 + a * b * h_11
    slope_x = ((1.0 - b) * (h_10 - h_00) + b * (h_11 - h_01)) / ground.cell
    slope_y = ((1.0 - a) * (h_01 - h_00) + a * (h_11 - h_10)) / ground.cell
    return height, slope_x, slope_y


@kernel
def surface(ground, width, x, y, z):
    """Distance of a point above the ground, and the unit normal there; the second coordinate of the plane is ``z``."""
    if ground.heights.shape[0] == 0:
        if width == PLANE:
            return ground.normal[0] * x + ground.normal[1] * z - ground.offset, ground.normal[0], 0.0, ground.normal[1]
        distance = ground.normal[0] * x + ground.normal[1] * y + ground.normal[2] * z - ground.offset
        return distance, ground.normal[0], ground.normal[1], ground.normal[2]
    height, slope_x, slope_y = _field_below(ground, width, x, y)
    length = math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    return (z - height) / length, -slope_x / length, -slope_y / length, 1.0 / length


@kernel
def point_arm(body, rotation, i):
    """Point ``i`` from the centre of mass in world axes (x, y, z; the plane's second coordinate is z)."""
    points = body.points
    if body.width == PLANE:
        return (
            rotation[0, 0] * points[i, 0] + rotation[0, 1] * points[i, 1],
            0.0,
            rotation[1, 0] * points[i, 0] + rotation[1, 1] * points[i, 1],
        )
    return (
        rotation[0, 0] * points[i, 0] + rotation[0, 1] * points[i, 1] + rotation[0, 2] * points[i, 2],
        rotation[1, 0] * points[i, 0] + rotation[1, 1] * points[i, 1] + rotation[1, 2] * points[i, 2],
        rotation[2, 0] * points[i, 0] + rotation[2, 1] * points[i, 1] + rotation[2, 2] * points[i, 2],
    )


@kernel
def _fill_row(J, row, width, a_x, a_y, a_z, r_x, r_y, r_z):
    """Row of the Jacobian of the velocity along a at the arm r: (a, r x a); in the plane the moment turns x towards y."""
    if width == PLANE:
        J[row, 0], J[row, 1], J[row, 2] = a_x, a_z, r_x * a_z - r_z * a_x
        return
    J[row, 0], J[row, 1], J[row, 2] = a_x, a_y, a_z
    J[row, 3], J[row, 4], J[row, 5] = r_y * a_z - r_z * a_y, r_z * a_x - r_x * a_z, r_x * a_y - r_y * a_x


@kernel
def contact_rows(body, ground, motion, gap, J):
    """Gap of every point in [m], and the rows of its contact: normal, then tangent along x (and the one across in space)."""
    width = body.width
    for i in range(body.points.shape[0]):
        r_x, r_y, r_z = point_arm(body, motion.rotation, i)
        x, z = motion.position[0] + r_x, motion.position[width - 1] + r_z
        y = motion.position[1] + r_y if width == SPACE else 0.0
        distance, n_x, n_y, n_z = surface(ground, width, x, y, z)
        gap[i] = distance - body.radius
        r_x, r_y, r_z = r_x - body.radius * n_x, r_y - body.radius * n_y, r_z - body.radius * n_z
        row = i * width
        length = math.sqrt(n_x * n_x + n_z * n_z)
        t_x, t_z = n_z / length, -n_x / length
        _fill_row(J, row, width, n_x, n_y, n_z, r_x, r_y, r_z)
        _fill_row(J, row + 1, width, t_x, 0.0, t_z, r_x, r_y, r_z)
        if width == SPACE:
            s_x, s_y, s_z = n_y * t_z, n_z * t_x - n_x * t_z, -n_y * t_x
            _fill_row(J, row + 2, width, s_x, s_y, s_z, r_x, r_y, r_z)


@kernel
def fill_inverse_inertia(body, rotation, W):
    """Inverse inertia ``W`` [coordinates, coordinates] in world axes."""
    for i in range(W.shape[0]):
        for j in range(W.shape[0]):
            W[i, j] = 0.0
    for i in range(body.width):
        W[i, i] = 1.0 / body.mass
    if body.width == PLANE:
        W[2, 2] = 1.0 / body.inertia[0]
        return
    for i in range(3):
        for j in range(3):
            total = 0.0
            for k in range(3):
                total += rotation[i, k] * rotation[j, k] / body.inertia[k]
            W[3 + i, 3 + j] = total
