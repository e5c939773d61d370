"""The node of the replay: publishes a bag with recorded spacing, bytes and quality of service."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from std_srvs.srv import SetBool

from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.clock import clock_message
from contact_sim_pkg.nodes.parameters import declare
from contact_sim_pkg.nodes.processes.audience import Audience
from contact_sim_pkg.nodes.processes.keys import Keys
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.protocol.endpoints import message_type, publisher, refuse_strangers
from contact_sim_pkg.nodes.protocol.player import Player, ReplayProgress, chosen_topics
from contact_sim_pkg.nodes.protocol.recorded_publisher import recorded_publisher
from contact_sim_pkg.nodes.protocol.states import DONE, LOSS, REFUSED, NodeError

CLOCK_RATE = 40.0  # [Hz] of the steady clock
BATCH = 200  # messages between two looks at signals; what a volatile topic keeps for a subscriber that is behind
SETTLE_SECONDS = 1.0
LOOK_SECONDS = 0.05  # between two looks at the graph, at keys and at a pause
SHOW_SECONDS = 5.0  # between two log lines about the progress
DELAY_TEXT = "Least time before the first message, in s; matched subscribers are waited for in any case."


class BagReplayNode(LifecycleBenchNode):
    """Publishes the topics of a bag below the node's namespace. Offers `~/pause`."""

    def __init__(self, show: Callable[[ReplayProgress], None] | None = None) -> None:
        """Declare the parameters; `show` is called with the progress, in place of the log."""
        super().__init__("bag_replay")
        self._bag_name = declare(self, "bag", "", "Directory of the bag.")
        self._rate = declare(self, "rate", 1.0, "Recorded seconds per second.", (0.001, 1000.0))
        self._offset = declare(
            self, "start_offset", 0.0, "Recorded time to begin at, since the first message, in s.", (0.0, 1e9)
        )
        self._first = declare(
            self, "start_message", 0, "Number of the message to begin at, from 0, among those replayed.", (0, 2**62)
        )
        self._delay = declare(self, "delay", 0.5, DELAY_TEXT, (0.0, 3600.0))
        self._loop = declare(self, "loop", False, "Begin again after the end; the recorded time then jumps back.")
        self._chosen = declare(self, "topics", "", "Names of the topics to replay, separated by commas. Empty: all.")
        self._with_clock = declare(self, "clock", False, "Publish the recorded time on /clock, 40 times a second.")
        self._show = show
        self._player: Player | None = None
        self._began = self._paused = False
        self._clock_due = self._shown_at = 0.0
        self._keys = Keys()
        self._pause = self.create_service(SetBool, "~/pause", self._on_pause)

    def configure(self) -> None:
        """Open the bag and create a publisher for each topic that has messages."""
        if not self._bag_name:
            raise NodeError("parameter bag is empty; give the directory of a bag", REFUSED)
        bag = open_bag(Path(self._bag_name))
        names = self._installed(bag, chosen_topics(bag, self._chosen))
        latched = {name for name in names if "transient_local" in bag.topics[name].offered_qos}
        self._player = Player(
            bag, names, latched,
            start=self._offset, start_message=self._first, rate=self._rate, loop=self._loop,
        )  # fmt: skip
        for note in bag.notes:
            self.get_logger().warning(note)
        self._publishers_by_topic = {name: recorded_publisher(self, bag.topics[name], BATCH) for name in names}
        self._clock_publisher = publisher(self, "/clock") if self._with_clock else None
        self._audience = Audience(self, self._publishers_by_topic, self._delay)

    def _installed(self, bag: Bag, names: list[str]) -> list[str]:
        """Those topics whose type is installed here.

        Others, such as the events of a service, are named and left out, unless they were asked for, or nothing else is
        there.
        """
        found = []
        for number, name in enumerate(names, 1):
            try:
                message_type(bag.topics[name].type)
                found.append(name)
            except NodeError as error:
                if self._chosen or (number == len(names) and not found):
                    raise
                self.get_logger().warning(f"{error}; {name} is left out ({bag.count(name)} messages)")
        self._lacking = len(found) < len(names)
        return found

    def tick(self, now: float) -> float:
        """Wait for the subscribers, then publish what is due."""
        player = self._player
        if player is None or not (self._began or (self.active and self._audience.is_complete(now))):
            return LOOK_SECONDS
        if not self._began:
            self._begin()
        self._pause_or_resume(player, now)
        # a batch at a time, so that signals and the service for a pause are never kept waiting
        for _ in range(BATCH):
            message = player.next_due(now)
            if message is None:
                break
            self._publishers_by_topic[message.topic].publish(message.data)
        if self._clock_publisher is not None and now >= self._clock_due:
            self._clock_due = now + 1.0 / CLOCK_RATE
            self._clock_publisher.publish(clock_message(player.position(now)))
        self._report(player.progress(now), now)
        if player.done:
            for entry in self._publishers_by_topic.values():
                entry.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))
            self.exit_status = LOSS if self._lacking else DONE
        return player.wait(now)

    def _begin(self) -> None:
        """Once, before the first message: nobody else may publish on these topics."""
        names = [name.lstrip("/") for name in self._publishers_by_topic]
        for name in [*names, "/clock"] if self._clock_publisher is not None else names:
            refuse_strangers(self, name)
        self._began = True
        subscriptions, topics = self._audience.count()
        keys = "; space: pause" if self._keys.is_terminal else ""
        self.get_logger().info(
            f"{subscriptions} subscriptions on {topics} of {len(names)} topics{keys}" if names else "nothing to replay"
        )

    def _pause_or_resume(self, player: Player, now: float) -> None:
        if self._keys.pressed().count(" ") % 2:
            self._paused = not self._paused
        if self._paused or not self.active:
            player.pause(now)
        else:
            player.resume(now)

    def _on_pause(self, request: Any, response: Any) -> Any:
        self._paused = bool(request.data)
        response.success, response.message = True, "paused" if self._paused else "going on"
        return response

    def _report(self, progress: ReplayProgress, now: float) -> None:
        if self._show is not None:
            self._show(progress)
        elif now - self._shown_at > SHOW_SECONDS:
            self._shown_at = now
            self.get_logger().info(progress.describe())

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget the bag; a replay that is configured again begins anew."""
        self._player, self._began, self._paused = None, False, False
        return super().on_cleanup(state)

    def destroy_node(self) -> None:
        """Report how many messages were sent, and restore the terminal."""
        self._keys.close()
        if self._player is not None and self._began:
            sent, of, passes = self._player.sent, self._player.messages, self._player.passes
            before = f" in pass {passes + 1}" if passes else ""
            self.get_logger().info(f"{sent} of {of} messages went out{before}")
        super().destroy_node()


def main(args: Sequence[str] | None = None, show: Callable[[ReplayProgress], None] | None = None) -> int:
    """Run the node; returns the exit status. `show` is called with the progress."""
    return run(lambda: BagReplayNode(show), args=args)


if __name__ == "__main__":
    sys.exit(main())
