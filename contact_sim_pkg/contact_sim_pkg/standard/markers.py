"""The rig as markers: road ahead, tire, seat, occupant, and an arrow a force.

The messages are made once and changed: new ones would cost four times as much.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy
from rosbags.typesys.stores.ros2_jazzy import builtin_interfaces__msg__Duration as Duration
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Point as Point
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Pose as Pose
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Quaternion as Quaternion
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__CompressedImage as CompressedImage
from rosbags.typesys.stores.ros2_jazzy import std_msgs__msg__ColorRGBA as ColorRGBA
from rosbags.typesys.stores.ros2_jazzy import visualization_msgs__msg__Marker as Marker
from rosbags.typesys.stores.ros2_jazzy import visualization_msgs__msg__MarkerArray as MarkerArray
from rosbags.typesys.stores.ros2_jazzy import visualization_msgs__msg__MeshFile as MeshFile

from contact_sim_pkg.bag.messages import BENCH_FRAME
from contact_sim_pkg.records.messages import RoadPatch, WrenchStamped
from contact_sim_pkg.standard.messages import header, rotation, vector
from contact_sim_pkg.standard.places import Places

ROAD_POINTS = 40  # of the line at most
METRE_FORCE = 5000.0  # [N] that an arrow of 1 m stands for
GREY, DARK, BLUE, SKIN, RED = (
    (0.5, 0.5, 0.5), (0.15, 0.15, 0.15), (0.2, 0.35, 0.7), (0.85, 0.65, 0.5), (0.8, 0.1, 0.1),
)  # fmt: skip
SEAT_SIZE, OCCUPANT_SIZE = (0.45, 0.45, 0.08), (0.24, 0.36, 0.22)  # [m] as drawn


class Markers:
    """The markers of one run; `message` holds what was given last."""

    def __init__(self, places: Places, bodies: Iterable[str], contacts: Iterable[str]) -> None:
        """Make the markers of the bodies and contacts that the run has."""
        self._made: list[Marker] = []
        self._arrows = {
            contact: self._add("force", f"{contact}_contact", Marker.ARROW, (0.02, 0.05, 0.06), RED)
            for contact in contacts
        }
        for arrow in self._arrows.values():
            arrow.points = [Point(x=0.0, y=0.0, z=0.0), Point(x=0.0, y=0.0, z=0.0)]
        for body in bodies:
            self._add_body(body, places)
        self._road: Marker | None = None
        self._message = MarkerArray(markers=self._made)  # type: ignore[arg-type]  # rosbags names the Marker of Dashing

    def take_force(self, contact: str, wrench: WrenchStamped) -> None:
        """The arrow of a contact: its force on the upper body, from the centre of pressure of the wrench.

        With the force in the plane z = 0 that is (-T_y / F_z, T_x / F_z) of the torque T.
        """
        force, torque = wrench.wrench.force, wrench.wrench.torque
        tail, tip = self._arrows[contact].points
        tail.x, tail.y = (-torque.y / force.z, torque.x / force.z) if force.z else (0.0, 0.0)
        tip.x, tip.y, tip.z = (
            tail.x + force.x / METRE_FORCE, tail.y + force.y / METRE_FORCE, force.z / METRE_FORCE,
        )  # fmt: skip

    def take_road(self, patch: RoadPatch) -> None:
        """The line of the road: heights in the middle of the track, the highest of each section so that no bump is missed."""
        if self._road is None:  # not before: a line without points is an error in RViz
            self._road = self._add("road", BENCH_FRAME, Marker.LINE_STRIP, (0.02, 0.0, 0.0), GREY)
        heights = patch.height[:, patch.height.shape[1] // 2]
        edges = numpy.linspace(0, len(heights), min(ROAD_POINTS, len(heights)) + 1).astype(int)
        self._road.points = [
            Point(x=float((patch.first_row + place) * patch.cell_x), y=0.0, z=float(heights[place]))
            for first, last in pairwise(edges)
            for place in [first + int(heights[first:last].argmax())]
        ]

    def message(self, stamp: int) -> MarkerArray:
        """The markers at a stamp [ns]; the same objects in every call."""
        for marker in self._made:
            marker.header.stamp = header(stamp, "").stamp
        return self._message

    def _add_body(self, body: str, places: Places) -> None:
        if body == "wheel" and places.radius:
            size = (2.0 * places.radius, 2.0 * places.radius, places.width)
            tire = self._add("tire", body, Marker.CYLINDER, size, DARK)
            tire.pose.orientation = rotation(numpy.array([0.5 * numpy.pi, 0.0, 0.0]))  # the axis of a cylinder is z
        elif body == "seat_frame":
            self._add("seat", body, Marker.CUBE, SEAT_SIZE, BLUE)
        elif body == "seat_back":
            x, y, z = SEAT_SIZE
            self._add("seat", body, Marker.CUBE, (z, y, x), BLUE)
        elif body.startswith("occupant"):
            self._add("occupant", body, Marker.SPHERE, OCCUPANT_SIZE, SKIN)

    def _add(
        self, group: str, frame: str, kind: int, size: tuple[float, float, float], colour: tuple[float, float, float]
    ) -> Marker:
        red, green, blue = colour
        marker = Marker(
            header=header(0, frame), ns=group, id=len(self._made), type=kind, action=Marker.ADD,
            pose=Pose(position=Point(x=0.0, y=0.0, z=0.0), orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)),
            scale=vector(*size), color=ColorRGBA(r=red, g=green, b=blue, a=0.9), lifetime=Duration(sec=0, nanosec=0),
            frame_locked=False, points=[], colors=[], texture_resource="",
            texture=CompressedImage(header=header(0, ""), format="", data=numpy.zeros(0, numpy.uint8)), uv_coordinates=[],
            text="", mesh_resource="", mesh_file=MeshFile(filename="", data=numpy.zeros(0, numpy.uint8)),
            mesh_use_embedded_materials=False,
        )  # fmt: skip
        self._made.append(marker)
        return marker
