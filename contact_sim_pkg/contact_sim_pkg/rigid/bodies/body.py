"""A rigid body of points with a radius (block, polygon, box, convex hull, sphere) over a ground:
gaps and Jacobians.

Every shape is the hull of spheres of one radius about its points: radius 0 for polygons and hulls,
one point for a sphere. Against a plane that is exact, and in the plane against heights along x
(`rigid/geometry/profile.py`); in space the points of a hull alone meet heights, so that peaks
narrower than their spacing go unseen. Coordinates: plane (x, y, angle), space (x, y, z and a
rotation matrix); velocities (v, omega) in world axes. Source: Identifiability eqs 10, 11,
40-42.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.geometry.profile import (
    Profile,
    clearance,
    fitted,
    flat,
    make_profile,
    point_on_profile,
    ridge_on_polygon,
    rise_needed,
)
from contact_sim_pkg.rigid.problem import PLANE, SPACE

LEAST_ACCELERATION = 0.1  # [m/s^2]


class RigidBody(NamedTuple):
    """Shape, inertia and surface of a body."""

    width: int  # PLANE or SPACE
    mass: float  # [kg]
    inertia: Vector  # [1] about the centre of mass, or [3] principal, in [kg m^2]
    points: Vector  # [points, width] from the centre of mass, in principal body axes, in [m]
    radius: float  # of the sphere about each point, in [m]
    friction: float
    restitution: float
    # [coordinates], gravity times mass and any known force and torque, in world axes, in [N], [N m]
    load: Vector


class Ground(NamedTuple):
    """A plane ``n x = offset``, or heights along x where its profile has nodes."""

    normal: Vector  # [width], unit
    offset: float  # [m]
    profile: Profile


class Motion(NamedTuple):
    """State of a body; changes in place."""

    position: Vector  # [width] in [m]
    angle: Vector  # [1] in [rad], in the plane
    rotation: Vector  # [width, width], body to world
    velocity: Vector  # [coordinates], v then omega, world axes


def regular_block(side: float, mass: float, friction: float, restitution: float, gravity: float = 9.81) -> RigidBody:
    """The square block of Identifiability: four corners at ``side`` [m], inertia ``m s^2/6`` of
    ``mass`` [kg]; ``gravity`` [m/s^2].
    """
    half = 0.5 * side
    corners = numpy.array([[-half, -half], [half, -half], [half, half], [-half, half]])
    inertia = numpy.array([mass * side**2 / 6.0])
    return RigidBody(
        width=PLANE, mass=mass, inertia=inertia, points=corners, radius=0.0, friction=friction,
        restitution=restitution, load=numpy.array([0.0, -mass * gravity, 0.0]),
    )  # fmt: skip


def box(
    sides: tuple[float, float, float], mass: float, friction: float, restitution: float, gravity: float = 9.81
) -> RigidBody:
    """A homogeneous box of the three ``sides`` in [m] and ``mass`` [kg]; ``gravity`` [m/s^2]."""
    x, y, z = sides
    corners = numpy.array(list(itertools.product((-0.5 * x, 0.5 * x), (-0.5 * y, 0.5 * y), (-0.5 * z, 0.5 * z))))
    inertia = mass / 12.0 * numpy.array([y * y + z * z, x * x + z * z, x * x + y * y])
    load = numpy.array([0.0, 0.0, -mass * gravity, 0.0, 0.0, 0.0])
    return RigidBody(
        width=SPACE, mass=mass, inertia=inertia, points=corners, radius=0.0, friction=friction,
        restitution=restitution, load=load,
    )  # fmt: skip


def sphere(radius: float, mass: float, friction: float, restitution: float, gravity: float = 9.81) -> RigidBody:
    """A homogeneous sphere of ``radius`` [m] and ``mass`` [kg]; ``gravity`` [m/s^2]."""
    inertia = numpy.full(3, 0.4 * mass * radius**2)
    load = numpy.array([0.0, 0.0, -mass * gravity, 0.0, 0.0, 0.0])
    return RigidBody(
        width=SPACE, mass=mass, inertia=inertia, points=numpy.zeros((1, 3)), radius=radius, friction=friction,
        restitution=restitution, load=load,
    )  # fmt: skip


def slope(width: int, angle: float = 0.0) -> Ground:
    """A plane through the origin that rises along x by ``angle`` in [rad]."""
    normal = numpy.zeros(width)
    normal[0], normal[-1] = -math.sin(angle), math.cos(angle)
    return Ground(normal, 0.0, flat())


def height_field(width: int, heights: Vector, origin: float, cell: float) -> Ground:
    """Ground through ``heights`` [nodes] at ``origin``, ``origin + cell``, ... along x in [m]:
    straight between them and beyond.
    """
    return slope(width)._replace(profile=make_profile(heights, origin, cell))


def fitted_ground(body: RigidBody, ground: Ground) -> Ground:
    """The ground, with room for all contacts that ``body`` can have with it."""
    return ground._replace(profile=fitted(ground.profile, body.width, body.points, body.radius))


def contact_count(body: RigidBody, ground: Ground) -> int:
    """Number of contacts of a body with a ground that was fitted to it."""
    return len(body.points) * ground.profile.reach + ground.profile.ridges


def least_gap(body: RigidBody, ground: Ground, motion: Motion) -> float:
    """Least distance in [m] of the body from a ground that was fitted to it; negative below it."""
    corners = body.points @ motion.rotation.T + motion.position
    if len(ground.profile.nodes):
        return clearance(ground.profile, numpy.ascontiguousarray(corners[:, [0, -1]]), body.radius)
    return float((corners @ ground.normal).min()) - ground.offset - body.radius


def rise_to_ground(body: RigidBody, ground: Ground, motion: Motion) -> float:
    """How far in [m] the body has to be raised along z to lie on a ground that was fitted to it;
    negative above it.
    """
    if len(ground.profile.nodes) == 0:
        return -least_gap(body, ground, motion) / float(ground.normal[-1])
    corners = body.points @ motion.rotation.T + motion.position
    return rise_needed(ground.profile, numpy.ascontiguousarray(corners[:, [0, -1]]), body.radius)


def placed(
    body: RigidBody, position: Vector, velocity: Vector, angle: float = 0.0, rotation: Vector | None = None
) -> Motion:
    """Motion of a body at ``position`` [width] in [m] with ``velocity`` [coordinates] in [m/s] and
    [rad/s], turned by ``angle`` [rad] (plane) or ``rotation`` [3, 3] (space).
    """
    turn = numpy.eye(3) if rotation is None else numpy.array(rotation, float)
    if body.width == PLANE:
        turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return Motion(numpy.array(position, float), numpy.array([float(angle)]), turn, numpy.array(velocity, float))


@kernel
def point_arm(body, rotation, i):
    """Point ``i`` from the centre of mass in world axes (x, y, z; the plane's second coordinate is
    z).
    """
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
def _fill_row(J, row, width, axis, arm):
    """Row of the Jacobian of the velocity along an axis a at the arm r [m]: (a, r x a).

    In the plane the moment turns x towards y.
    """
    (a_x, a_y, a_z), (r_x, r_y, r_z) = axis, arm
    if width == PLANE:
        J[row, 0], J[row, 1], J[row, 2] = a_x, a_z, r_x * a_z - r_z * a_x
        return
    J[row, 0], J[row, 1], J[row, 2] = a_x, a_y, a_z
    J[row, 3], J[row, 4], J[row, 5] = r_y * a_z - r_z * a_y, r_z * a_x - r_x * a_z, r_x * a_y - r_y * a_x


@kernel
def is_ridge(body, ground, i):
    """Whether contact ``i`` is one of a peak with the edges of the body."""
    return i >= body.points.shape[0] * ground.profile.reach


@kernel
def _on_plane(body, ground, rotation, x, y, z, i):
    """Contact ``i`` with a plane: gap, normal, arm of the place of contact."""
    r_x, r_y, r_z = point_arm(body, rotation, i)
    n_x, n_z, n_y = ground.normal[0], ground.normal[body.width - 1], ground.normal[1]
    if body.width == PLANE:
        n_y = 0.0
        distance = n_x * (x + r_x) + n_z * (z + r_z) - ground.offset
    else:
        distance = n_x * (x + r_x) + n_y * (y + r_y) + n_z * (z + r_z) - ground.offset
    radius = body.radius
    return distance - radius, n_x, n_y, n_z, r_x - radius * n_x, r_y - radius * n_y, r_z - radius * n_z


@kernel
def on_profile(body, ground, rotation, x, z, i):
    """Contact ``i`` with the heights: gap in [m], normal (x, z), arm (x, y, z), curvature in [1/m],
    and its face or edge.
    """
    profile, radius = ground.profile, body.radius
    if is_ridge(body, ground, i):
        slot, size = i - body.points.shape[0] * profile.reach, 0.0
        for k in range(body.points.shape[0]):
            size = max(size, math.sqrt(body.points[k, 0] ** 2 + body.points[k, 1] ** 2))
        gap, n_x, n_z, r_x, r_z, feature = ridge_on_polygon(profile, slot, body.points, rotation, x, z, size)
        return gap, n_x, n_z, r_x, 0.0, r_z, 0.0, feature
    r_x, r_y, r_z = point_arm(body, rotation, i // profile.reach)
    gap, n_x, n_z, curvature, feature = point_on_profile(profile, i % profile.reach, x + r_x, z + r_z, radius)
    return gap, n_x, n_z, r_x - radius * n_x, r_y, r_z - radius * n_z, curvature, feature


@kernel
def lies_on(body, ground, motion, i):
    """Face or edge that contact ``i`` lies on, -1 on a plane; it changes in valleys and over
    peaks.
    """
    if ground.profile.nodes.shape[0] == 0:
        return -1
    return on_profile(body, ground, motion.rotation, motion.position[0], motion.position[body.width - 1], i)[7]


@kernel
def contact_rows(body, ground, motion, gap, J):
    """Gap of every contact in [m], and its rows: normal, then tangent along x (and the one across
    in space).
    """
    width, position = body.width, motion.position
    x, z = position[0], position[width - 1]
    y = position[1] if width == SPACE else 0.0
    for i in range(gap.shape[0]):
        # gap, normal and arm of the place of contact
        if ground.profile.nodes.shape[0] == 0:
            gap[i], n_x, n_y, n_z, r_x, r_y, r_z = _on_plane(body, ground, motion.rotation, x, y, z, i)
        else:
            gap[i], n_x, n_z, r_x, r_y, r_z, _c, _f = on_profile(body, ground, motion.rotation, x, z, i)
            n_y = 0.0
        row, arm = i * width, (r_x, r_y, r_z)
        # tangents: along x in the ground, then across, both at right angles to the normal
        length = math.sqrt(n_x * n_x + n_z * n_z)
        t_x, t_z = n_z / length, -n_x / length
        _fill_row(J, row, width, (n_x, n_y, n_z), arm)
        _fill_row(J, row + 1, width, (t_x, 0.0, t_z), arm)
        if width == SPACE:
            s_x, s_y, s_z = n_y * t_z, n_z * t_x - n_x * t_z, -n_y * t_x
            _fill_row(J, row + 2, width, (s_x, s_y, s_z), arm)


def load_acceleration(body: RigidBody) -> float:
    """Acceleration in [m/s^2] from which rest speeds and times follow: of the load, and at least
    LEAST_ACCELERATION without weight.
    """
    return max(float(numpy.linalg.norm(body.load[: body.width]) / body.mass), LEAST_ACCELERATION)


@entry
def contact_kinematics(body: RigidBody, ground: Ground, motion: Motion, gap: Vector, jacobian: Vector) -> None:
    """`contact_rows` for callers from Python: ``gap`` [contacts] in [m], ``jacobian`` [rows,
    coordinates].
    """
    contact_rows(body, ground, motion, gap, jacobian)


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
