"""Who must be there before block 0 may be sent, and who must not."""

from __future__ import annotations

import time

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from contact_sim_pkg.nodes.protocol.endpoints import refuse_strangers

NAME_SECONDS = 3.0  # for the graph to learn a stranger's name before it is refused without one


class Peers:
    """The simulator's view of the other nodes of its run."""

    def __init__(
        self,
        node: Node,
        inputs: dict[str, Subscription],
        outputs: dict[str, Publisher],
        progress: Publisher,
        recorded: Subscription | None,
        *,
        supervised: bool,
    ) -> None:
        """Look from `node` at its own subscriptions and publishers; `recorded` is None where
        nothing is recorded.

        A supervisor (`supervised`) must hear of the progress too, or it would take a short run for
        a silent one.
        """
        self._node, self._inputs, self._outputs = node, inputs, outputs
        self._progress, self._recorded = progress, recorded
        self._began: float | None = None
        self._followers = len(inputs) + (recorded is not None) + supervised

    def missing(self) -> list[str]:
        """What is not matched yet, one text each; empty when everybody is there.

        Raises NodeError (refused) for a second publisher on an input or an output, a second bench,
        or another message definition.
        """
        self._began = time.monotonic() if self._began is None else self._began
        checked = [
            *self._inputs,
            *self._outputs,
            "bench/progress",
            *([] if self._recorded is None else ["bench/recorded"]),
        ]
        unnamed = time.monotonic() - self._began > NAME_SECONDS
        absent = [
            f"the names of {t}'s publishers" for t in checked if not refuse_strangers(self._node, t, unnamed=unnamed)
        ]
        absent += [
            f"a publisher of {topic}" for topic, entry in self._inputs.items() if _publishers(self._node, entry) < 1
        ]
        if self._progress.get_subscription_count() < self._followers:
            absent.append(f"{self._followers} subscribers of bench/progress")
        if self._recorded is not None:
            absent += [] if _publishers(self._node, self._recorded) else ["a publisher of bench/recorded (bag_logger)"]
            absent += [
                f"a recorder of {topic}" for topic, entry in self._outputs.items() if entry.get_subscription_count() < 1
            ]
        return absent


def _publishers(node: Node, subscription: Subscription) -> int:
    return int(node.count_publishers(subscription.topic_name))
