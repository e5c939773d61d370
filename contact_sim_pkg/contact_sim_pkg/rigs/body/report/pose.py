"""Poses of a rigid body over a run, its outline seen from the side, and the ground below it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from contact_sim_pkg.report.series import MotionSeries
from contact_sim_pkg.rigid.geometry.profile import heights_at
from contact_sim_pkg.rigs.body.model import BlockModel, build_block, rotation_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

FloatArray = NDArray[np.float64]

CIRCLE = np.linspace(0.0, 2.0 * np.pi, 49)
MOST = 16  # outlines of a picture
SEPARATED = 0.4  # of the body's size between two outlines, at least


class BlockPoses(NamedTuple):
    """Centre of mass and orientation at every sample, velocities beside them."""

    model: BlockModel
    time: FloatArray  # [s]
    centre: FloatArray  # [samples, 3] in [m]
    turn: FloatArray  # [samples, 3], rotation vector from the axes of the scene, in [rad]
    velocity: FloatArray  # [samples, 3] in [m/s]
    spin: FloatArray  # [samples, 3] in [rad/s], world axes


def poses_of(scene: dict[str, Any], motion: MotionSeries) -> BlockPoses:
    """Of a run of the rig block; coordinates that it does not have are zero."""
    zero = np.zeros(len(motion.time))

    def columns(values: dict[str, FloatArray], *names: str) -> FloatArray:
        return np.column_stack([values.get(f"block_{name}", zero) for name in names])

    turning = ("rotation_x", "rotation_y", "rotation_z")
    if "block_pitch" in motion.position:
        turning = ("roll", "pitch", "yaw")
    return BlockPoses(
        build_block(ResolvedScene(scene)), motion.time, columns(motion.position, "x", "y", "z"), columns(motion.position, *turning),
        columns(motion.velocity, "x", "y", "z"), columns(motion.velocity, *turning),
    )  # fmt: skip


def outline(poses: BlockPoses, sample: int) -> FloatArray:
    """Closed outline [corners, 2] of the body in x and z, in [m]: the hull of its points, or the
    circle of a sphere.
    """
    body, centre = poses.model.body, poses.centre[sample, [0, 2]]
    if len(body.points) == 1:
        circle = np.column_stack([np.cos(CIRCLE), np.sin(CIRCLE)])
        return np.asarray(centre + body.radius * circle)
    points = points_of(poses, sample)
    corners = points[ConvexHull(points).vertices]
    return np.asarray(centre + np.vstack([corners, corners[:1]]))


def mark(poses: BlockPoses, sample: int) -> FloatArray:
    """A point [2] that is fixed to the body, so that its turning is seen: a corner, or a place on a
    sphere's surface.
    """
    body = poses.model.body
    if len(body.points) > 1:
        return np.asarray(poses.centre[sample, [0, 2]] + points_of(poses, sample)[0])
    top = rotation_of(poses.turn[sample]) @ np.array([0.0, 0.0, body.radius])
    return np.asarray(poses.centre[sample, [0, 2]] + top[[0, 2]])


def points_of(poses: BlockPoses, sample: int) -> FloatArray:
    """Points of the body from its centre, in x and z."""
    turn, body = rotation_of(poses.turn[sample]), poses.model.body
    if body.width == 2:
        spread = np.column_stack([body.points[:, 0], np.zeros(len(body.points)), body.points[:, 1]])
        return np.asarray((spread @ turn.T)[:, [0, 2]])
    return np.asarray((body.points @ (turn @ poses.model.axes).T)[:, [0, 2]])


def chosen(poses: BlockPoses) -> NDArray[np.int64]:
    """Numbers [samples] of samples at even distances along the way, turning counted: the first and
    the last are among them.
    """
    size = float(np.linalg.norm(poses.model.body.points, axis=1).max()) + poses.model.body.radius
    moved = np.linalg.norm(np.diff(poses.centre, axis=0), axis=1)
    turned = size * np.linalg.norm(poses.spin[1:], axis=1) * np.diff(poses.time)
    way = np.concatenate([[0.0], np.cumsum(moved + 0.5 * turned)])
    if way[-1] == 0.0:
        return np.zeros(1, np.int64)
    count = int(np.clip(way[-1] / (SEPARATED * size), 2, MOST))
    found = np.searchsorted(way, np.linspace(0.0, way[-1], count), side="left")
    return np.asarray(np.unique(np.minimum(found, len(way) - 1)), np.int64)


def ground_line(poses: BlockPoses, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Places [nodes] and heights [nodes] of the ground in [m] between two places x in [m]."""
    ground = poses.model.ground
    profile = ground.profile
    if len(profile.nodes) == 0:
        x = np.array([first, last])
        return x, -ground.normal[0] / ground.normal[-1] * x
    nodes = profile.origin + profile.cell * np.arange(len(profile.nodes))
    x = np.union1d(nodes[(nodes > first) & (nodes < last)], [first, last])
    return x, heights_at(profile, x)
