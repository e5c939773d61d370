"""The travel of the rig along the road: a speed programme and its exact integral."""

from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from math import isfinite
from typing import TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError

Times = NDArray[numpy.float64]
Time = TypeVar("Time", float, Times)

HIGHEST_SPEED = 150.0  # [m/s] 540 km/h, above every road vehicle


class Travel:
    """Piecewise linear speed over time and the travel that follows from it.

    Between two points (t0, v0), (t1, v1) the speed is v0 + (v1 - v0) (t - t0) / (t1 - t0); before
    the first and after the last point it stays constant. The travel is the exact integral of the
    speed from t = 0, so position(0) = 0.
    """

    def __init__(self, points: Sequence[tuple[float, float]]) -> None:
        """Take the speed programme.

        Args:
            points: (time [s], speed [m/s]) with strictly increasing times; negative speed drives
            backwards.

        Raises:
            ExcitationError: no point, times that do not increase, or a value that is not finite or
            above 150 m/s.
        """
        self.times = [float(time) for time, _ in points]
        self.speeds = [float(speed) for _, speed in points]
        self._check()
        self._positions = [0.0]
        for (t0, v0), (t1, v1) in pairwise(points):
            self._positions.append(self._positions[-1] + 0.5 * (v0 + v1) * (t1 - t0))
        self._origin = 0.0
        self._origin = self.position(0.0)

    def _check(self) -> None:
        if not self.times:
            raise ExcitationError("the speed programme has no point; give at least one (time [s], speed [m/s])")
        for index, (time, speed) in enumerate(zip(self.times, self.speeds, strict=True)):
            if not (isfinite(time) and isfinite(speed)) or abs(speed) > HIGHEST_SPEED:
                raise ExcitationError(
                    f"point {index} of the speed programme is ({time} s, {speed} m/s); both must be finite and the "
                    f"speed within +-{HIGHEST_SPEED:g} m/s"
                )
            if index and time <= self.times[index - 1]:
                raise ExcitationError(
                    f"point {index} of the speed programme is at {time} s, not after the point before at "
                    f"{self.times[index - 1]} s; times must increase"
                )

    def _segment(self, time: float) -> int:
        """Index of the point that the formula at this time starts from; -1 before the first."""
        return bisect_right(self.times, time) - 1

    def _slope(self, index: int) -> float:
        """Acceleration in [m/s^2] of the segment that starts at this point; 0 outside the
        programme.
        """
        if index < 0 or index >= len(self.times) - 1:
            return 0.0
        return (self.speeds[index + 1] - self.speeds[index]) / (self.times[index + 1] - self.times[index])

    def _in_segment(self, index: int, time: Time) -> tuple[Time, Time]:
        """Travel [m] and speed [m/s] at one time or several [s] of a segment."""
        start, slope = max(index, 0), self._slope(index)
        elapsed, speed = time - self.times[start], self.speeds[start]
        path = (speed + 0.5 * slope * elapsed) * elapsed
        return self._positions[start] + path - self._origin, speed + slope * elapsed

    def speed(self, time: float) -> float:
        """Speed in [m/s] at a time in [s]."""
        return self._in_segment(self._segment(time), time)[1]

    def position(self, time: float) -> float:
        """Travel in [m] at a time in [s], counted from t = 0: the exact integral of the speed."""
        return self._in_segment(self._segment(time), time)[0]

    def along(self, times: Times) -> tuple[Times, Times]:
        """Travel [m] and speed [m/s] at times [s] in order, [n] each."""
        cuts = [0, *numpy.searchsorted(times, self.times), len(times)]
        pieces = [times[first:last] for first, last in pairwise(cuts) if first < last]
        places, speeds = zip(*(self._in_segment(self._segment(piece[0]), piece) for piece in pieces), strict=True)
        return numpy.concatenate(places), numpy.concatenate(speeds)

    def extent(self, start: float, end: float) -> tuple[float, float]:
        """Smallest and largest travel in [m] between two times in [s], also where the rig turns
        back in between.
        """
        instants = [start, end, *self._reversals(start, end)]
        positions = [self.position(time) for time in instants]
        return min(positions), max(positions)

    def _reversals(self, start: float, end: float) -> list[float]:
        """Times inside (start, end) at which the speed can change its sign."""
        found = [time for time in self.times if start < time < end]
        for index in range(max(self._segment(start), 0), min(self._segment(end), len(self.times) - 2) + 1):
            slope = self._slope(index)
            if slope != 0.0:
                zero = self.times[index] - self.speeds[index] / slope
                if start < zero < end:
                    found.append(zero)
        return found
