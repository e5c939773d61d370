"""Bags as other people's tools write them, by rosbags."""

import numpy
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation

STORE = get_typestore(Stores.ROS2_JAZZY)
ODOMETRY = "nav_msgs/msg/Odometry"
ORIGIN = 1_760_000_000 * 10**9  # [ns]


def _type(name):
    return STORE.types[name]


def _header(time, frame):
    stamp = ORIGIN + round(time * 1e9)
    return _type("std_msgs/msg/Header")(_type("builtin_interfaces/msg/Time")(*divmod(stamp, 10**9)), frame)


def _pose(position, rotation):
    point, quaternion = _type("geometry_msgs/msg/Point"), _type("geometry_msgs/msg/Quaternion")
    return _type("geometry_msgs/msg/Pose")(point(*position), quaternion(*Rotation.from_matrix(rotation).as_quat()))


def _twist(velocity, spin):
    vector = _type("geometry_msgs/msg/Vector3")
    return _type("geometry_msgs/msg/Twist")(vector(*velocity), vector(*spin))


def write_odometry(path, states, topic="/odom", storage=StoragePlugin.MCAP, child="base_link"):
    """Poses in `map`; the twist in the axes of the child, as the definition of Odometry says."""
    with Writer(path, version=9, storage_plugin=storage) as writer:
        row = writer.add_connection(topic, ODOMETRY, typestore=STORE)
        for _, time, data in odometry_rows(states, topic, child):
            writer.write(row, time, data)


def odometry_rows(states, topic="/odom", child="base_link"):
    """Topic, time [ns] and CDR of each message."""
    for time, position, rotation, velocity, spin in zip(*states, strict=True):
        pose = _type("geometry_msgs/msg/PoseWithCovariance")(_pose(position, rotation), numpy.zeros(36))
        axes = numpy.eye(3) if child == "map" else rotation.T
        twist = _type("geometry_msgs/msg/TwistWithCovariance")(_twist(axes @ velocity, axes @ spin), numpy.zeros(36))
        message = _type(ODOMETRY)(_header(time, "map"), child, pose, twist)
        yield topic, ORIGIN + round(time * 1e9), bytes(STORE.serialize_cdr(message, ODOMETRY))


def write_pose_and_twist(path, states, twist_frame="map", late=0.0, every=1, pushes=(), push_frame="map"):
    """PoseStamped in `map` and TwistStamped in world or body axes, the twist's stamps `late` [s].

    Only every such pose has a twist. `pushes`: time [s], force [3] and torque [3] of WrenchStamped in `push_frame`, if any.
    """
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        kinds = {"/pose": "geometry_msgs/msg/PoseStamped", "/twist": "geometry_msgs/msg/TwistStamped"}
        if len(pushes):
            kinds["/push"] = "geometry_msgs/msg/WrenchStamped"
        rows = {topic: writer.add_connection(topic, kind, typestore=STORE) for topic, kind in kinds.items()}
        vector = _type("geometry_msgs/msg/Vector3")

        def write(topic, time, *fields):
            data = STORE.serialize_cdr(_type(kinds[topic])(*fields), kinds[topic])
            writer.write(rows[topic], ORIGIN + round(time * 1e9), data)

        for number, (time, position, rotation, velocity, spin) in enumerate(zip(*states, strict=True)):
            axes = numpy.eye(3) if twist_frame == "map" else rotation.T
            write("/pose", time, _header(time, "map"), _pose(position, rotation))
            if number % every == 0:
                write("/twist", time, _header(time + late, twist_frame), _twist(axes @ velocity, axes @ spin))
        for time, force, torque in pushes:
            wrench = _type("geometry_msgs/msg/Wrench")(vector(*force), vector(*torque))
            write("/push", time, _header(time, push_frame), wrench)
