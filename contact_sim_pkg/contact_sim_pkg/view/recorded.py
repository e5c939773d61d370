"""A bag as the source of the live page, with a clock of its own."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.messages import record_of, stamp_of
from contact_sim_pkg.bag.reader import Bag, BagMessage
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.standard.convert import record_type
from contact_sim_pkg.view.scope import SHOWN, SPAN, Scope

__all__ = ["CAN", "RecordedSource"]

CAN = ("pause", "step", "seek")
BLOCK = 0.01
"""[s] of a step where the bag holds no scene"""
BATCH = 500
"""Messages between two looks at what the page asks for"""


class RecordedSource:
    """Plays a bag at pace 1 into a scope; stops at the end until somebody seeks or goes on."""

    def __init__(self, bag: Bag, scope: Scope) -> None:
        """Begin at the first message.

        Raises BagError where the bag has no topic that the page shows.
        """
        self._topics = {bag.topic(name).name: name for name in SHOWN if bag.count(name)}
        if not self._topics:
            raise BagError(f"{bag.path} has nothing to show; the page is made from {', '.join(SHOWN)}")
        self._bag, self._scope = bag, scope
        scene = scene_of_text(bag.scene, "the scene of the bag") if bag.scene else {}
        self._block = float(scene.get("block_length") or BLOCK)
        self._length = (bag.end - bag.begin) * 1e-9
        scope.say(can=list(CAN), scene=str(scene.get("name") or bag.path.name), end=self._length, time=0.0)
        self._at, self._resumed = 0.0, math.inf
        self._rewind()

    def _rewind(self) -> None:
        self._messages: Iterator[BagMessage] = (each for each in self._bag.messages() if each.topic in self._topics)
        self._next: BagMessage | None = next(self._messages, None)

    def position(self, now: float) -> float:
        """Recorded time [s] since the first message at ``now`` [s] of the steady clock."""
        return self._at if math.isinf(self._resumed) else min(self._at + now - self._resumed, self._length)

    def go(self, now: float) -> None:
        """Let the recorded time go on; from the beginning where it has reached the end."""
        if self.position(now) >= self._length:
            self._seek(0.0, now)
        self._at, self._resumed = self.position(now), now
        self._scope.say(paused=False)

    def pause(self, now: float) -> None:
        """Stop the recorded time."""
        self._at, self._resumed = self.position(now), math.inf
        self._scope.say(paused=True)

    def steer(self, wish: Mapping[str, Any], now: float) -> None:
        """What a page asks for: `do` is pause, go, step (a block) or seek, to `at` [s]."""
        match wish.get("do"):
            case "pause":
                self.pause(now)
            case "go":
                self.go(now)
            case "step":
                self.pause(now)
                self._at = min(self._at + self._block, self._length)
            case "seek" if isinstance(wish.get("at"), int | float):
                self._seek(float(wish["at"]), now)

    def _seek(self, at: float, now: float) -> None:
        """Go to a recorded time [s]; the page then shows what leads up to it."""
        self._at = min(max(at, 0.0), self._length) if math.isfinite(at) else 0.0
        self._resumed = self._resumed if math.isinf(self._resumed) else now
        self._scope.clear()
        self._rewind()

    def advance(self, now: float) -> bool:
        """Hand on what is due; False where more than a batch is, so that somebody else is looked after first."""
        position = self.position(now)
        due = self._bag.begin + round(position * 1e9)
        for _ in range(BATCH):
            message = self._next
            if message is None or message.log_time > due:
                break
            if message.log_time >= due - round(SPAN * 1e9):
                self._show(message)
            self._next = next(self._messages, None)
        else:
            return False
        self._scope.say(at=round(position, 3))
        if position >= self._length and math.isfinite(self._resumed):
            self.pause(now)
        return True

    def _show(self, message: BagMessage) -> None:
        try:
            record = record_of(record_type(self._topics[message.topic]), self._bag.decode(message))
            self._scope.take(self._topics[message.topic], stamp_of(message.data), record)
        except (MessageError, AttributeError, TypeError, ValueError) as error:
            raise BagError(f"{self._bag.path}: the message of {message.topic} cannot be shown: {error}") from None
