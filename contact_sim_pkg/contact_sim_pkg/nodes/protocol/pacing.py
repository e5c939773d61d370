"""When a block is due, by the steady clock."""

from __future__ import annotations

import math
from collections import deque


def parse_pace(pace: str | float) -> float:
    """Pace as simulated seconds per second [1]: 1 for `realtime`, infinity for `max`, else the
    number.

    Raises ValueError where it is not a number from 0.001 to 1000.
    """
    if pace == "realtime":
        return 1.0
    if pace == "max":
        return math.inf
    try:
        factor = float(pace)
    except ValueError:
        factor = math.nan
    if not 0.001 <= factor <= 1000.0:
        raise ValueError(f"pace {pace!r} is not known; allowed: realtime, max, or a factor from 0.001 to 1000")
    return factor


LATE_IN_A_ROW = 100  # blocks done late, one after the other, before it is reported
GROWTH_BLOCKS = 1000  # within which a delay has to grow by more than a block's time to be called slow


class Pacer:
    """Block k is due k block_length / factor after the start. A late run catches up; simulated time
    is never skipped.
    """

    def __init__(self, factor: float, block_length: float) -> None:
        """Not started: nothing is due.

        Args:
            factor: simulated seconds per second, > 0; infinity: everything is due at once.
            block_length: simulated time of a block, [s].
        """
        self.interval = block_length / factor
        self._start: float | None = None
        self._paused: float | None = None

    def start(self, now: float) -> None:
        """Begin to count at `now` of the steady clock, [s]; a second call changes nothing."""
        self._start = now if self._start is None else self._start

    @property
    def began(self) -> float:
        """When block 0 was due, [s] of the steady clock; infinity before the start."""
        return math.inf if self._start is None else self._start

    def pause(self, now: float) -> None:
        """Nothing is due from `now` of the steady clock, [s], on; a second call changes nothing."""
        self._paused = now if self._paused is None else self._paused

    def resume(self, now: float) -> None:
        """Go on at `now` of the steady clock, [s], where the pause has begun; without a pause nothing happens."""
        if self._start is not None and self._paused is not None:
            self._start += now - self._paused
        self._paused = None

    def step(self) -> None:
        """A block of a step is done, whenever it was due: those behind it follow at the pace from the end of the pause on."""
        if self._start is not None:
            self._start -= self.interval

    def wait(self, block: int, now: float) -> float:
        """Seconds until the block is due: 0 when it is, infinity before the start and in a pause."""
        if self._start is None or self._paused is not None:
            return math.inf
        return max(0.0, self._start + block * self.interval - now)


class Lateness:
    """Counts the blocks that were done later than a block's time after they were due; simulated
    time is never skipped.
    """

    def __init__(self, pacer: Pacer) -> None:
        """No block done."""
        self._pacer = pacer
        self.late = 0
        self._delays = deque[float](maxlen=GROWTH_BLOCKS)  # [s] of the late blocks in a row

    def block_done(self, block: int, now: float, factor: float) -> str:
        """Count a block done at `now` of the steady clock, [s], at `factor` simulated seconds per
        second so far.

        Returns a sentence from the hundredth late block in a row on, which calls a delay that does
        not grow no slowness; empty where the run is in time, or has no pace.
        """
        interval = self._pacer.interval
        behind = now - interval * (block + 2) - self._pacer.began
        if interval <= 0.0 or behind <= 0.0:
            self._delays.clear()
            return ""
        self.late += 1
        self._delays.append(behind)
        if len(self._delays) < LATE_IN_A_ROW:
            return ""
        slow = behind - self._delays[0] > interval
        state = f"slower than its pace: {factor:.2g}x real time" if slow else "held with a constant delay"
        return f"{state}, {behind:.3g} s behind after block {block} ({self.late} blocks late)"


class RateLimit:
    """Lets at most so many messages of each topic a second pass; on average, so what comes a little early is none less."""

    def __init__(self, rate: float, early: float) -> None:
        """`rate` in [Hz]; `early` is how long before it is due a message may pass, [s]."""
        self._period, self._early = 1.0 / rate, early
        self._due: dict[str, float] = {}

    def passes(self, topic: str, now: float) -> bool:
        """Whether a message that comes at `now` of the steady clock, [s], is shown."""
        due = self._due.get(topic, now)
        if now < due - self._early:
            return False
        self._due[topic] = max(due, now - self._period) + self._period  # behind a gap, one period is made up for
        return True
