"""Where a rigid body can touch the ground at its output samples: gap of the lowest contact, arms of
all contacts.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.rigid.bodies.body import Motion, contact_count, contact_kinematics, least_gap
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigs.body.model import BlockModel

Array = NDArray[numpy.float64]


def gaps(model: BlockModel, position: Array, rotation: Array) -> Array:
    """Least distance in [m] of the body from the ground at each of its poses [samples, width],
    [samples, width, width].
    """
    body, ground = model.body, model.ground
    if len(ground.profile.nodes):
        poses = (Motion(place, numpy.zeros(1), turn, body.load) for place, turn in zip(position, rotation, strict=True))
        return numpy.array([least_gap(body, ground, pose) for pose in poses])
    corners = body.points @ rotation.transpose(0, 2, 1) + position[:, None, :]
    return numpy.asarray((corners @ ground.normal).min(axis=1) - ground.offset - body.radius)


def contact_arms(model: BlockModel, position: Array, rotation: Array) -> Array:
    """Places of all contacts from the centre of mass, world axes, [contacts, width] in [m]."""
    body, ground = model.body, model.ground
    if len(ground.profile.nodes) == 0:
        return numpy.asarray(body.points @ rotation.T - body.radius * ground.normal)
    contacts, width = contact_count(body, ground), body.width
    gap, jacobian = numpy.zeros(contacts), numpy.zeros((contacts * width, len(body.load)))
    pose = Motion(position.copy(), numpy.zeros(1), rotation.copy(), numpy.zeros(len(body.load)))
    contact_kinematics(body, ground, pose, gap, jacobian)
    rows = jacobian.reshape(contacts, width, -1)
    if width == PLANE:  # rows (a, r x a): the moments are the arm, in the axes of the contact
        return numpy.asarray(rows[:, 0, 2:] * rows[:, 1, :2] - rows[:, 1, 2:] * rows[:, 0, :2])
    return numpy.asarray(0.5 * numpy.cross(rows[:, :, :3], rows[:, :, 3:]).sum(axis=1))


def in_ground_axes(model: BlockModel, arms: Array) -> Array:
    """Arms [contacts, 3] (x, y, z) in [m] in the axes of a plane ground: along its slope, across,
    along its normal.
    """
    sine, cosine = -float(model.ground.normal[0]), float(model.ground.normal[-1])
    along, up = cosine * arms[:, 0] + sine * arms[:, 2], cosine * arms[:, 2] - sine * arms[:, 0]
    return numpy.column_stack([along, arms[:, 1], up])
