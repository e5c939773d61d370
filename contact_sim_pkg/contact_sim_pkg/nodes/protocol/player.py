"""Due times of the messages of a bag: rate, begin, pause, loop, and how many were sent. Without
ROS.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from typing import NamedTuple

from contact_sim_pkg.bag.encoding import CDR_HEADER
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag, BagMessage

SHORTEST_PASS_NS = 100_000_000  # of a loop: a bag of one instant is not sent without end in no time


class ReplayProgress(NamedTuple):
    """Progress of a replay."""

    simulated: float  # [s] since the begin of the recording
    end: float  # [s] of the recording, since its begin
    sent: int  # messages in this pass
    messages: int  # of this pass
    passes: int  # done before
    paused: bool

    def describe(self) -> str:
        """For a person."""
        number = f"pass {self.passes + 1}, " if self.passes else ""
        paused = ", paused" if self.paused else ""
        return f"{number}{self.simulated:.2f} of {self.end:g} s, {self.sent} of {self.messages} messages{paused}"


class Player:
    """Messages of some topics of a bag, each when it is due. Paused until `resume`."""

    def __init__(
        self, bag: Bag, topics: Collection[str], latched: Collection[str], *,
        start: float = 0.0, start_message: int = 0, rate: float = 1.0, loop: bool = False,
    ) -> None:  # fmt: skip
        """Find the begin, and look at every message before the first one is sent.

        Args:
            bag: the bag; its log times may count from any instant.
            topics: names in the bag of the topics to replay.
            latched: those of them whose messages before the begin are sent too, at once.
            start: recorded time to begin at, since the first message of the bag, [s].
            start_message: number of the message to begin at, among those of the topics, from 0.
            rate: recorded seconds per second.
            loop: begin again after the end.

        Raises:
            BagError: the begin lies after the end, a message is too short to be one, or the bag is
                damaged.
        """
        # the begin is the later of the offset and the time of the first message
        self._bag, self._topics, self._latched = bag, set(topics), set(latched)
        self._total = sum(bag.count(name) for name in self._topics)
        self._first, self._rate, self._loop = start_message, rate, loop
        self._start = max(bag.begin + round(start * 1e9), self._time_of(start_message))
        if self._start > bag.end:
            raise BagError(
                f"start_offset is {start:g} s, {bag.path} lasts {self._seconds(bag.end):g} s; begin before its end"
            )
        self.passes = 0
        self._base, self._resumed_at = self._start, math.inf
        self._rewind()

    def _time_of(self, number: int) -> int:
        """Recorded time of the message with this number, [ns]; for number 0 the begin of the bag."""
        if number >= max(1, self._total):
            raise BagError(
                f"start_message is {number}, {self._bag.path} holds {self._total} messages to replay, from 0"
            )
        found = self._bag.begin
        chosen = (message for message in self._bag.messages() if message.topic in self._topics)
        for index, message in enumerate(chosen):
            if len(message.data) < len(CDR_HEADER):
                raise BagError(
                    f"{self._bag.path}: the message of {message.topic} at {self._seconds(message.log_time):g} s has "
                    f"{len(message.data)} bytes, and the head of a message alone has {len(CDR_HEADER)}; "
                    "leave its topic out: give the others with --topics"
                )
            if index == number > 0:
                found = message.log_time
        return found

    def _seconds(self, time: int) -> float:
        """A recorded time in [ns] as time since the begin, [s]."""
        return (time - self._bag.begin) * 1e-9

    def _rewind(self) -> None:
        self.sent, self._skipped = 0, 0
        self._messages: Iterator[BagMessage] = self._bag.messages()
        self._next = self._advance()

    def _advance(self) -> BagMessage | None:
        """The next message to send; those before the begin are skipped unless they are latched."""
        for message in self._messages:
            if message.topic not in self._topics:
                continue
            early = message.log_time < self._start or self.sent + self._skipped < self._first
            if not early or message.topic in self._latched:
                return message
            self._skipped += 1
        return None

    @property
    def paused(self) -> bool:
        """Whether the recorded time is stopped."""
        return math.isinf(self._resumed_at)

    @property
    def done(self) -> bool:
        """Whether nothing is left to send."""
        return self._next is None and not self._loop

    @property
    def messages(self) -> int:
        """Messages of a pass; those skipped before the begin do not count."""
        return self._total - self._skipped

    def position(self, now: float) -> int:
        """Recorded time, [ns], at this instant of the steady clock, [s]."""
        return self._base if self.paused else self._base + round((now - self._resumed_at) * self._rate * 1e9)

    def pause(self, now: float) -> None:
        """Stop the recorded time."""
        self._base, self._resumed_at = self.position(now), math.inf

    def resume(self, now: float) -> None:
        """Let the recorded time go on."""
        if self.paused:
            self._resumed_at = now

    def next_due(self, now: float) -> BagMessage | None:
        """The next message, if it is due at `now`, [s]; a loop begins again once the last one is
        sent.
        """
        if self.paused:
            return None
        if self._next is None and self._loop and self.position(now) - self._start >= self._pass_length():
            self.passes += 1
            self._base, self._resumed_at = self._start, now
            self._rewind()
        message = self._next
        if message is None or message.log_time > self.position(now):
            return None
        self.sent += 1
        self._next = self._advance()
        return message

    def wait(self, now: float) -> float:
        """Seconds until something is due; infinity where nothing will be."""
        if self.paused or self.done:
            return math.inf
        due = self._start + self._pass_length() if self._next is None else self._next.log_time
        return max(0.0, (due - self.position(now)) * 1e-9 / self._rate)

    def _pass_length(self) -> int:
        return max(SHORTEST_PASS_NS, self._bag.end - self._start)

    def progress(self, now: float) -> ReplayProgress:
        """Progress at `now` of the steady clock, [s]."""
        simulated, end = self._seconds(min(self.position(now), self._bag.end)), self._seconds(self._bag.end)
        return ReplayProgress(simulated, end, self.sent, self.messages, self.passes, self.paused)


def chosen_topics(bag: Bag, chosen: str) -> list[str]:
    """Full names of the topics with these names, separated by commas; empty: all with messages.

    Raises BagError for a topic that the bag does not have.
    """
    if not chosen:
        return [name for name in bag.topics if bag.count(name)]
    return [bag.topic(name.strip()).name for name in chosen.split(",")]
