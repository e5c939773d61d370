"""The node of the replay: publishes what a bag holds, with the recorded spacing, bytes and quality of service."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from rclpy.duration import Duration
from rclpy.publisher import Publisher

from contact_sim_pkg.bag.messages import encode_clock
from contact_sim_pkg.bag.reader import Bag, BagMessage, open_bag

from .bench_node import LifecycleBenchNode
from .endpoints import message_type, publisher, refuse_strangers
from .parameters import declare
from .process import run
from .protocol import DONE, REFUSED, NodeError
from .recorded_qos import profile_of_recorded

CLOCK_RATE = 40.0  # [Hz] of the steady clock
BATCH = 200  # messages between two looks at signals
SETTLE_SECONDS = 1.0


class BagReplayNode(LifecycleBenchNode):
    """Publishes the topics of a bag; their names count from the node's namespace."""

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("bag_replay")
        self._bag_name = declare(self, "bag", "", "Directory of the bag.")
        self._rate = declare(self, "rate", 1.0, "Recorded seconds per second.", (0.001, 1000.0))
        self._offset = declare(self, "start_offset", 0.0, "Recorded time to begin at, in s.", (0.0, 1e9))
        self._delay = declare(
            self, "delay", 0.5, "Time before the first message, in s, for others to match.", (0.0, 3600.0)
        )
        self._chosen = declare(self, "topics", "", "Names of the topics to replay, separated by commas. Empty: all.")
        self._with_clock = declare(self, "clock", False, "Publish the recorded time on /clock, 40 times a second.")
        self._publishers_by_topic: dict[str, Publisher] = {}
        self._clock_publisher: Publisher | None = None
        self._began: float | None = None
        self._clock_due = 0.0
        self._checked = False

    def configure(self) -> None:
        """Open the bag and create a publisher for each topic that has messages."""
        if not self._bag_name:
            raise NodeError("parameter bag is empty; give the directory of a bag", REFUSED)
        bag = open_bag(Path(self._bag_name))
        self._start = round(self._offset * 1e9)
        if self._start > bag.end:
            raise NodeError(
                f"start_offset is {self._offset:g} s, {self._bag_name} ends at {bag.end * 1e-9:g} s; begin before its end",
                REFUSED,
            )
        for note in bag.notes:
            self.get_logger().warning(note)
        for name in _chosen_topics(bag, self._chosen):
            row = bag.topics[name]
            profile = profile_of_recorded(row.offered_qos)
            self._publishers_by_topic[name] = self.create_publisher(message_type(row.type), name.lstrip("/"), profile)
            self._refuse_other_definition(name, row.type_hash)
        self._clock_publisher = publisher(self, "/clock") if self._with_clock else None
        self._messages: Iterator[BagMessage] = bag.messages()
        self._latched = {n for n in self._publishers_by_topic if "transient_local" in bag.topics[n].offered_qos}
        self._next = self._advance()

    def _refuse_other_definition(self, name: str, recorded: str) -> None:
        for info in self.get_publishers_info_by_topic(name.lstrip("/")):
            installed = str(info.topic_type_hash)
            if info.node_name == self.get_name() and recorded and installed != recorded:
                raise NodeError(
                    f"{name} was recorded with another definition of {info.topic_type} than the installed one "
                    f"({recorded}, {installed}); replay it with the package that it was recorded with",
                    REFUSED,
                )

    def _advance(self) -> BagMessage | None:
        """The next message to publish; what lies before the start is passed over unless it is latched."""
        for message in self._messages:
            late = message.log_time < self._start and message.topic not in self._latched
            if message.topic in self._publishers_by_topic and not late:
                return message
        return None

    def tick(self, now: float) -> float:
        """Publish what is due."""
        if not self.active:
            return 1.0
        if self._began is None:
            self._began = now + self._delay
        if now < self._began:
            return self._began - now
        self._refuse_others()
        simulated = self._start + round((now - self._began) * self._rate * 1e9)
        for _ in range(BATCH):
            if self._next is None or self._next.log_time > simulated:
                break
            self._publishers_by_topic[self._next.topic].publish(self._next.data)
            self._next = self._advance()
        if self._clock_publisher is not None and now >= self._clock_due:
            self._clock_due = now + 1.0 / CLOCK_RATE
            self._clock_publisher.publish(encode_clock(simulated))
        if self._next is None:
            self._settle()
            return 0.0
        return max(0.0, (self._next.log_time - simulated) * 1e-9 / self._rate)

    def _refuse_others(self) -> None:
        """Once, before the first message: nobody else may publish on these topics."""
        if self._checked:
            return
        self._checked = True
        names = [name.lstrip("/") for name in self._publishers_by_topic]
        for name in [*names, "/clock"] if self._clock_publisher is not None else names:
            refuse_strangers(self, name)

    def _settle(self) -> None:
        for entry in self._publishers_by_topic.values():
            entry.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))
        self.exit_status = DONE

    def stop(self) -> None:
        """End at once."""
        self.exit_status = DONE


def _chosen_topics(bag: Bag, chosen: str) -> list[str]:
    if not chosen:
        return [name for name in bag.topics if bag.count(name)]
    return [bag.topic(name.strip()).name for name in chosen.split(",")]


def main(args: Sequence[str] | None = None) -> int:
    """Run the node; returns the exit status."""
    return run(BagReplayNode, args)


if __name__ == "__main__":
    sys.exit(main())
