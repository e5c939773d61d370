"""Standard messages as rosbags defines them for Jazzy: headers, numbers that recur, and their bytes.

The bytes are those of `bag/encoding.py`: little-endian CDR, filled up with zeros to a multiple of 4.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore
from rosbags.typesys.stores.ros2_jazzy import builtin_interfaces__msg__Time as Time
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Quaternion as Quaternion
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Vector3 as Vector3
from rosbags.typesys.stores.ros2_jazzy import std_msgs__msg__Header as Header

from contact_sim_pkg.bag.encoding import LAST_STAMP, SECOND
from contact_sim_pkg.bag.errors import MessageError

__all__ = [
    "Header",
    "Quaternion",
    "Time",
    "Vector3",
    "definition",
    "encoded",
    "header",
    "rotation",
    "type_hash",
    "vector",
]

BASE = "base_link"
"""Frame that moves with the rig along the road, at road height 0 (REP 105)."""


@cache
def store() -> Typestore:
    """All types of Jazzy; making them takes 0.2 s."""
    return get_typestore(Stores.ROS2_JAZZY)


def encoded(message: Any) -> bytes:
    """CDR bytes of a message."""
    data = bytes(store().serialize_cdr(message, message.__msgtype__))
    return data + bytes(-len(data) % 4)


def definition(type_name: str) -> str:
    """The `ros2msg` text of a type with its dependencies."""
    return store().generate_msgdef(type_name, ros_version=2)[0]


def type_hash(type_name: str) -> str:
    """The hash `RIHS01_…` of a type, equal to the one that a running graph reports."""
    return store().hash_rihs01(type_name)


def header(stamp: int, frame: str) -> Header:
    """A header with a stamp [ns]; MessageError outside of 0 to 2^31 s."""
    if not 0 <= stamp <= LAST_STAMP:
        raise MessageError(f"a stamp of {stamp} ns cannot be sent; allowed: 0 to {LAST_STAMP} ns")
    return Header(stamp=Time(sec=stamp // SECOND, nanosec=stamp % SECOND), frame_id=frame)


def vector(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Vector3:
    """A vector along x (forward), y (left), z (up)."""
    return Vector3(x=float(x), y=float(y), z=float(z))


def rotation(turn: NDArray[numpy.float64]) -> Quaternion:
    """Quaternion of a rotation vector, [3] in [rad]: (u sin(a/2), cos(a/2)) for an angle a about u."""
    angle = float(numpy.linalg.norm(turn))
    # sin(a/2)/a, 1/2 at rest
    x, y, z = (float(part) for part in 0.5 * numpy.sinc(0.5 * angle / numpy.pi) * turn)
    return Quaternion(x=x, y=y, z=z, w=float(numpy.cos(0.5 * angle)))
