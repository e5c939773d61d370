"""The motion of the bodies at one sample as joint states, accelerometers, and a tree of frames.

A coordinate of `bench/motion` is called BODY_AXIS: `wheel_z` moves the frame `wheel` along z,
`block_pitch` turns the frame `block` about y. A body is one frame, however many coordinates it has.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Quaternion as Quaternion
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Transform as Transform
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__TransformStamped as TransformStamped
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__Imu as Imu
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__JointState as JointState
from rosbags.typesys.stores.ros2_jazzy import tf2_msgs__msg__TFMessage as TFMessage

from contact_sim_pkg.bag.messages import BENCH_FRAME
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.messages import BodyMotion
from contact_sim_pkg.standard.messages import BASE, header, rotation, vector
from contact_sim_pkg.standard.places import FLOOR, Places

Array = NDArray[numpy.float64]

COORDINATE = re.compile(r"(?P<body>\w+?)_(?:rotation_)?(?P<axis>x|y|z|roll|pitch|tilt|yaw)$")
AXES = ("x", "y", "z", "roll", "pitch", "yaw")
TILT = {"tilt": "pitch"}
"""The roller's word for a rotation about y."""

IMU_BODIES = {"floor": FLOOR, "seat": ("seat_frame",), "axle": ("wheel",)}
"""Where an accelerometer sits: the first of these bodies that moves in the run."""
NOT_GIVEN = -1.0
"""First element of a covariance whose quantity the message does not give (REP 145)."""


class Body(NamedTuple):
    """Six components of a body along x, y, z and about them."""

    along: Array  # [3]
    about: Array  # [3], a rotation vector where they are angles


def bodies_of(names: Iterable[str], values: Array) -> dict[str, Body]:
    """The components of each body: `values` [coordinates] at one sample, in the order of the names.

    Coordinates that name no axis are left out; axes without a coordinate are 0.
    """
    found: dict[str, Body] = {}
    for name, value in zip(names, values, strict=True):
        match = COORDINATE.match(name)
        if match is None:
            continue
        body = found.setdefault(match["body"], Body(numpy.zeros(3), numpy.zeros(3)))
        place = AXES.index(TILT.get(match["axis"], match["axis"]))
        turns = place > 2 or "_rotation_" in name
        (body.about if turns else body.along)[place % 3] = value
    return found


def joints_of(motion: BodyMotion, sample: int, stamp: int) -> JointState:
    """Position and velocity of every coordinate at a sample, whose stamp is given in [ns]."""
    return JointState(
        header=header(stamp, BENCH_FRAME), name=list(motion.bodies), position=motion.position[:, sample].copy(),
        velocity=motion.velocity[:, sample].copy(), effort=numpy.zeros(0),
    )  # fmt: skip


def imu_of(motion: BodyMotion, place: str, sample: int, stamp: int) -> Imu | None:
    """What an accelerometer on `place` of `IMU_BODIES` measures at a sample; None where no such body moves.

    The specific force a + g e_z: the acceleration in the fixed frame and what carries the body
    against gravity, so +9.81 m/s^2 up at rest. The bodies do not turn: the angular velocity is 0,
    the orientation is not given (REP 145).
    """
    accelerations = bodies_of(motion.bodies, motion.acceleration[:, sample])
    body = next((each for each in IMU_BODIES[place] if each in accelerations), None)
    if body is None:
        return None
    x, y, z = accelerations[body].along
    not_given = numpy.zeros(9)
    not_given[0] = NOT_GIVEN
    return Imu(
        header=header(stamp, body),
        orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0), orientation_covariance=not_given,
        angular_velocity=vector(), angular_velocity_covariance=numpy.zeros(9),
        linear_acceleration=vector(x, y, z + GRAVITY), linear_acceleration_covariance=numpy.zeros(9),
    )  # fmt: skip


def frames_of(motion: BodyMotion, sample: int, stamp: int, places: Places, contacts: Iterable[str]) -> TFMessage:
    """The tree of frames at a sample: `bench`, `base_link` in it, in that the bodies and contacts."""
    bodies = bodies_of(motion.bodies, motion.position[:, sample])
    at: dict[str, tuple[float, float, float]] = {}
    tree = [_transform(stamp, BENCH_FRAME, BASE, (places.travelled(stamp), 0.0, 0.0), rotation(numpy.zeros(3)))]
    for name, body in bodies.items():
        x, y, z = (float(part) for part in numpy.add(places.of_body(name), body.along))
        at[name] = (x, y, z)
        tree.append(_transform(stamp, BASE, name, at[name], rotation(body.about)))
    for contact in contacts:
        parent, place, (qx, qy, qz, qw) = places.of_contact(contact, at)
        tree.append(_transform(stamp, parent, f"{contact}_contact", place, Quaternion(x=qx, y=qy, z=qz, w=qw)))
    return TFMessage(transforms=tree)


def _transform(
    stamp: int, parent: str, child: str, place: tuple[float, float, float], turn: Quaternion
) -> TransformStamped:
    moved = Transform(translation=vector(*place), rotation=turn)
    return TransformStamped(header=header(stamp, parent), child_frame_id=child, transform=moved)


def moved_bodies(names: Iterable[str]) -> Mapping[str, None]:
    """The bodies that have a coordinate, in order."""
    return dict.fromkeys(match["body"] for match in map(COORDINATE.match, names) if match)
