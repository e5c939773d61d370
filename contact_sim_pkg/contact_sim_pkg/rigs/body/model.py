"""Resolved scene of the block rig -> body, ground, start and timing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigid.bodies.body import (
    Ground,
    Motion,
    RigidBody,
    fitted_ground,
    height_field,
    placed,
    rise_to_ground,
    slope,
)
from contact_sim_pkg.rigid.forces.compliant_body import CompliantLaw
from contact_sim_pkg.rigid.motion.compliant import compliant_contact
from contact_sim_pkg.rigid.parameters import RULE_NAMES
from contact_sim_pkg.rigid.problem import PLANE, SPACE
from contact_sim_pkg.rigs.body import schema
from contact_sim_pkg.rigs.body.hull import homogeneous_hull
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import Timing, make_timing

__all__ = ["BlockModel", "build_block", "rise_at_start"]

BELOW = 1e-9  # of the body's size: a start this far below the ground is rounding
Matrix = NDArray[numpy.float64]


@dataclass(frozen=True)
class BlockModel:
    """Everything that the simulation of one block scene needs."""

    body: RigidBody
    ground: Ground
    start: Motion
    axes: Matrix  # [3, 3] principal axes of the body in the axes of the scene
    timing: Timing
    rule: int
    facets: int
    gravity: float  # [m/s^2]
    force: Vector  # [3] known, in [N]
    torque: Vector  # [3] known, in [N m]
    contact: CompliantLaw | None  # in place of impulses; None: rigid
    # of the integration of a compliant contact, and of a body that turns on active points
    tolerance: float


def build_block(scene: ResolvedScene) -> BlockModel:
    """Parameters of a resolved scene, in SI units."""
    block, law = scene.section(schema.Block), given(scene.effect("block", schema.RigidContact))
    width = PLANE if block.motion == "plane" else SPACE
    points, radius, inertia, axes = _shape(block, width)
    # known forces and gravity act at the centre of mass
    force, torque = numpy.array(block.force, float), numpy.array(block.torque, float)
    weight = numpy.array([0.0, 0.0, -block.mass * block.gravity])
    load = _generalised(force + weight, torque, width)
    body = RigidBody(
        width=width,
        mass=block.mass,
        inertia=inertia,
        points=points,
        radius=radius,
        friction=law.friction,
        restitution=law.restitution,
        load=load,
    )
    # room for all contacts of this body
    ground = fitted_ground(body, _ground(block.ground, width))
    return BlockModel(
        body=body,
        ground=ground,
        start=_start(body, block, axes),
        axes=axes,
        timing=make_timing(scene, True),
        rule=RULE_NAMES[law.rule],
        facets=law.facets,
        gravity=block.gravity,
        force=force,
        torque=torque,
        contact=_compliant(body, scene.effect("block", schema.CompliantContact)),
        tolerance=given(scene.integrator.relative_tolerance),
    )


def _compliant(body: RigidBody, law: schema.CompliantContact | None) -> CompliantLaw | None:
    if law is None:
        return None
    elastic = NormalElastic(law.stiffness, law.exponent)
    return compliant_contact(body, elastic, law.tangential_stiffness, law.tangential_damping)


def _generalised(force: Vector, torque: Vector, width: int) -> Vector:
    """(v, omega) parts: in the plane x, z and the angle from x to z, which is minus the pitch."""
    return numpy.array([force[0], force[2], -torque[1]]) if width == PLANE else numpy.concatenate([force, torque])


def _shape(block: schema.Block, width: int) -> tuple[Matrix, float, Vector, Matrix]:
    """Points and radius in [m], inertia in [kg m^2], principal axes."""
    mass, axes = block.mass, numpy.eye(3)
    if block.shape == "sphere":
        radius = block.radius
        share = 0.4 * mass * radius**2
        return numpy.zeros((1, width)), radius, numpy.full(1 if width == PLANE else 3, share), axes
    if block.points is not None:
        hull = homogeneous_hull(block.points, mass)
        return numpy.ascontiguousarray(hull.corners), 0.0, hull.inertia, axes if width == PLANE else hull.axes
    x, y, z = block.sides
    if width == PLANE:
        corners = 0.5 * numpy.array([[-x, -z], [x, -z], [x, z], [-x, z]])
        return corners, 0.0, numpy.array([mass * (x * x + z * z) / 12.0]), axes
    grid = numpy.array(numpy.meshgrid((-0.5, 0.5), (-0.5, 0.5), (-0.5, 0.5), indexing="ij")).reshape(3, -1).T
    inertia = mass / 12.0 * numpy.array([y * y + z * z, x * x + z * z, x * x + y * y])
    return numpy.ascontiguousarray(grid * numpy.array([x, y, z])), 0.0, inertia, axes


def _ground(ground: schema.BlockGround, width: int) -> Ground:
    if ground.heights is None:
        return slope(width, ground.slope)
    return height_field(width, numpy.array(ground.heights, float), ground.start, ground.distance)


def rotation_of(vector: Vector) -> Matrix:
    """Rotation matrix of a rotation vector in [rad] (Rodrigues)."""
    angle = float(numpy.linalg.norm(vector))
    if angle == 0.0:
        return numpy.eye(3)
    x, y, z = vector / angle
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return numpy.asarray(numpy.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross)


def _start(body: RigidBody, block: schema.Block, axes: Matrix) -> Motion:
    place, velocity, spin, rotation = (
        numpy.array(vector, float)
        for vector in (block.position, block.velocity, block.angular_velocity, block.rotation)
    )
    if body.width == PLANE:
        rates = numpy.array([velocity[0], velocity[2], -spin[1]])
        return placed(body, place[[0, 2]], rates, angle=-float(rotation[1]))
    turned = rotation_of(rotation) @ axes
    return placed(body, place, numpy.concatenate([velocity, spin]), rotation=turned)


def rise_at_start(block: schema.Block) -> float:
    """How far in [m] the z of a body has to rise out of its ground; 0 above or on it.

    The rise covers more than the gap: of a polygon that a peak pierces from below and leaves again,
    no corner lies below the ground.
    """
    width = PLANE if block.motion == "plane" else SPACE
    points, radius, inertia, axes = _shape(block, width)
    # mass, surface and load do not matter here
    body = RigidBody(
        width=width,
        mass=1.0,
        inertia=inertia,
        points=points,
        radius=radius,
        friction=0.0,
        restitution=0.0,
        load=numpy.zeros(3 * (width - 1)),
    )
    start = _start(body, block, axes)
    ground = fitted_ground(body, _ground(block.ground, width))
    # rounding does not count
    rise = rise_to_ground(body, ground, start)
    size = float(numpy.linalg.norm(body.points, axis=1).max()) + body.radius
    return rise if rise > BELOW * size else 0.0
