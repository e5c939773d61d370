"""Messages of the bench to standard messages, those that are wanted."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__Wrench as Wrench
from rosbags.typesys.stores.ros2_jazzy import geometry_msgs__msg__WrenchStamped as StampedWrench
from rosbags.typesys.stores.ros2_jazzy import std_msgs__msg__Float64 as Float64

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records import messages as records
from contact_sim_pkg.records.definitions import PACKAGE
from contact_sim_pkg.records.messages import AxleForce, BodyMotion
from contact_sim_pkg.standard.markers import Markers
from contact_sim_pkg.standard.messages import header, vector
from contact_sim_pkg.standard.motion import frames_of, imu_of, joints_of, moved_bodies
from contact_sim_pkg.standard.patch import cloud_of, image_of
from contact_sim_pkg.standard.places import Places, places_of
from contact_sim_pkg.standard.topics import ROAD, StandardTopic, standard_topics, wrench_topics

__all__ = ["Converter", "Shown", "axle_wrench_of", "has_samples", "record_type", "sample_stamps"]

AXLE_FRAME = "wheel"
SERIES = {f"{PACKAGE}/msg/{name}": field for name, field in (
    ("ContactForce", "normal"), ("AxleForce", "vertical"), ("BodyMotion", "position"),
)}  # fmt: skip
"""Types with all samples of a block, and a field as long as these."""
LONGEST_PERIOD = 1e3  # [s]


class Shown(NamedTuple):
    """A standard message with its topic and its stamp [ns]."""

    topic: str
    stamp: int
    message: Any


class Converter:
    """Makes the standard messages of one run; keeps what several messages of the bench make together."""

    def __init__(self, present: Collection[str], scene: Mapping[str, Any] | None = None) -> None:
        """Take the topics of the bench that the run has, and its resolved scene as plain data, which may follow."""
        self._latest: dict[str, Any] = {}  # by source, what the next markers are made from
        self.offer(present)
        self.take_scene(scene or {})

    def offer(self, present: Collection[str]) -> None:
        """The topics of the bench that the run has, from now on."""
        self.topics = standard_topics(present)
        self._wrenches = {topic: contact for contact, topic in wrench_topics(present).items()}
        self._contacts = tuple(dict.fromkeys(name.partition("/")[0] for name in present if _is_of_contact(name)))
        self._markers: Markers | None = None

    def take_scene(self, scene: Mapping[str, Any]) -> None:
        """The places of a scene, from now on."""
        self._places: Places = places_of(scene)
        self._markers = None

    def convert(
        self, source: str, stamp: int, record: Any, wanted: Collection[str], samples: Collection[int] = (0,)
    ) -> Iterator[Shown]:
        """The wanted standard messages of one message of the bench.

        Args:
            source: its topic.
            stamp: of it, [ns].
            record: its values, of the topic's type.
            wanted: names of standard topics.
            samples: of a message with all samples of a block, those that are shown.

        Yields:
            A message a topic and sample. The markers are the same object each time: encode them at once.
        """
        if source in self._wrenches or source == ROAD:
            self._latest[source] = record
        topics = [self.topics[name] for name in wanted if name in self.topics and self.topics[name].source == source]
        stamps = sample_stamps(record, stamp) if has_samples(source) else [stamp]
        for sample in samples:
            at = stamps[sample]
            for topic in topics:
                message = self._message(topic, record, sample, at)
                if message is not None:
                    yield Shown(topic.name, at, message)

    def _message(self, topic: StandardTopic, record: Any, sample: int, stamp: int) -> Any:
        if topic.field:
            value = getattr(record, topic.field)
            return Float64(data=float(value[sample] if numpy.ndim(value) else value))
        frame = TOPICS[topic.source].frame
        makers: dict[str, Callable[[], Any]] = {
            "Image": partial(image_of, record, stamp, frame),
            "PointCloud2": partial(cloud_of, record, stamp, frame),
            "WrenchStamped": partial(axle_wrench_of, record, sample, stamp),
            "Imu": partial(imu_of, record, topic.name.rpartition("/")[2], sample, stamp),
            "JointState": partial(joints_of, record, sample, stamp),
            "TFMessage": partial(frames_of, record, sample, stamp, self._places, self._contacts),
            "MarkerArray": partial(self._markers_at, record, stamp),
        }
        return makers[topic.type.rpartition("/")[2]]()

    def _markers_at(self, motion: BodyMotion, stamp: int) -> Any:
        if self._markers is None:
            self._markers = Markers(self._places, moved_bodies(motion.bodies), self._wrenches.values())
        while self._latest:  # each is taken once, also where it is malformed and raises
            source, record = self._latest.popitem()
            if source == ROAD:
                self._markers.take_road(record)
            else:
                self._markers.take_force(self._wrenches[source], record)
        return self._markers.message(stamp)


def axle_wrench_of(force: AxleForce, sample: int, stamp: int) -> StampedWrench:
    """Force and moment of the tire on its axle at a sample, about the wheel centre; `stamp` in [ns]."""

    def at(values: Any) -> float:
        return float(values[sample]) if len(values) else 0.0

    return StampedWrench(
        header=header(stamp, AXLE_FRAME),
        wrench=Wrench(
            force=vector(at(force.longitudinal), at(force.lateral), at(force.vertical)),
            torque=vector(0.0, at(force.moment_y), at(force.moment_z)),
        ),
    )


def has_samples(source: str) -> bool:
    """Whether a message of a topic holds all samples of a block that are shown one by one."""
    return TOPICS[source].type in SERIES


def sample_stamps(record: Any, stamp: int) -> range:
    """Stamps [ns] of the samples of a message, the first of which is given; MessageError for samples at no distance."""
    samples = getattr(record, SERIES[f"{PACKAGE}/msg/{type(record).__name__}"]).shape[-1]
    if not 1e-9 <= record.sample_period <= LONGEST_PERIOD:
        raise MessageError(
            f"a {type(record).__name__} has samples {record.sample_period} s apart; allowed are 1e-9 to {LONGEST_PERIOD:g} s"
        )
    period = round(record.sample_period * SECOND)
    return range(stamp, stamp + samples * period, period)


def record_type(source: str) -> Any:
    """The record of a topic of the bench, for `decode`."""
    return getattr(records, TOPICS[source].type.rpartition("/")[2])


def _is_of_contact(name: str) -> bool:
    """Whether the frame of a topic is that of a contact."""
    return name in TOPICS and TOPICS[name].frame.endswith("_contact")
