"""Numbered blocks of excitation: what one message of road and of vibration carries, and how it is
cut out.

A block depends on its number alone, so it is the same whatever the order of requests.
"""

from math import ceil, floor
from typing import Any, NamedTuple, Protocol

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock

# Nodes of one block; 16 MB as float32, far above the widest tire at the highest speed
LARGEST_PATCH = 4_000_000


class RoadLattice(NamedTuple):
    """Lattice of the road under a tire, and how much of it a field instant may need."""

    rows: int  # of the usual grid, along the road
    cols: int
    cell_x: float  # [m]
    cell_y: float  # [m]
    road_rows: int  # of the wide grid, or the tire's diameter where that is more
    road_cols: int


class Surface(Protocol):
    """A road: heights as a pure function of position."""

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights in [m], [len(x), len(y)], at x along the road and y to the left, both in [m]."""

    def describe(self) -> dict[str, Any]:
        """What was found and what was done, for the report: plain values, units in the names,
        sentences in `notes`.
        """


class Signal(Protocol):
    """A vibration: acceleration as a pure function of time."""

    def acceleration(self, t: NDArray[numpy.float64]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """Acceleration forward (x) and up (z) in [m/s^2] at times t in [s]."""

    def describe(self) -> dict[str, Any]:
        """What was found and what was done, for the report: plain values, units in the names,
        sentences in `notes`.
        """


AHEAD = 0.2
"""[s] of the travel that block 0 shows at least: the mean slope over it decides how fast a rig begins to rise
(decision 0034).
"""


class RoadBlocks:
    """The strips of a surface that a rig passes, one a block.

    A strip covers the travel of its block, half_length before and after it, and at least one node
    more on each side; that of block 0 the travel of `AHEAD`, where the road is there.
    """

    def __init__(
        self,
        surface: Surface,
        travel: Travel,
        block_length: float,
        cell_x: float,
        cell_y: float,
        half_length: float,
        cols: int,
    ) -> None:
        """Lay the lattice over the road.

        Args:
            surface: the road.
            travel: travel of the wheel centre over time.
            block_length: simulated time of a block, [s], > 0.
            cell_x: lattice spacing along the road, [m], > 0.
            cell_y: lattice spacing across the track, [m], > 0.
            half_length: reach of the strip before and behind the wheel centre, [m], >= 0.
            cols: lattice nodes across the track, >= 1.

        Raises:
            ExcitationError: a value out of range, a strip of more than 4 million nodes at the
            programme's highest
                speed, or a surface that has no height in block 0.
        """
        for name, value in (("block_length", block_length), ("cell_x", cell_x), ("cell_y", cell_y)):
            if not 0.0 < value < float("inf"):
                raise ExcitationError(f"{name} of the road blocks is {value}; it must be above 0 and finite")
        if not 0.0 <= half_length < float("inf") or cols < 1:
            raise ExcitationError(
                f"the road strip has half_length {half_length} m and {cols} cols; allowed: from 0 m, from 1 col"
            )
        longest = 2.0 * half_length + block_length * max(abs(speed) for speed in travel.speeds)
        nodes = (longest / cell_x + 4.0) * cols
        if nodes > LARGEST_PATCH:
            raise ExcitationError(
                f"a road strip would have {nodes:.3g} nodes ({longest:.3g} m in cells of {cell_x} m, {cols} cols), "
                f"limit {LARGEST_PATCH}; use larger cells or shorter blocks"
            )
        self.surface, self.travel, self.block_length = surface, travel, block_length
        self.cell_x, self.cell_y, self.half_length, self.cols = cell_x, cell_y, half_length, cols
        self._y = numpy.asarray((numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y, dtype=numpy.float64)
        self._first_held = 0
        self._held: NDArray[numpy.float32] = numpy.empty((0, cols), dtype=numpy.float32)
        # Surfaces make their tables for this track now, and a track that they refuse is refused
        # here
        self.block(0)

    def block(self, block: int) -> RoadPatch:
        """The strip of block number `block`, from 0; ExcitationError where the surface has no
        height there.
        """
        start, end = block * self.block_length, (block + 1) * self.block_length
        first_row, last_row = self.rows(start, end)
        strip = self._strip_ahead if block == 0 and end < AHEAD else self._strip
        height = strip(first_row, last_row)
        if not numpy.isfinite(height).all():
            row, col = numpy.argwhere(~numpy.isfinite(height))[0]
            raise ExcitationError(
                f"block {block}: the road has no finite height between x = {first_row * self.cell_x:.6g} m and "
                f"{last_row * self.cell_x:.6g} m: it is {height[row, col]} at x = {(first_row + row) * self.cell_x:.6g} m, "
                f"y = {(col - 0.5 * (height.shape[1] - 1)) * self.cell_y:.6g} m"
            )
        return RoadPatch(
            block=block, travel_start=self.travel.position(start), travel_end=self.travel.position(end),
            first_row=first_row, cell_x=self.cell_x, cell_y=self.cell_y, height=height,
        )  # fmt: skip

    def rows(self, start: float, end: float) -> tuple[int, int]:
        """First and last row under the travel between two times in [s]."""
        lowest, highest = self.travel.extent(start, end)
        return floor((lowest - self.half_length) / self.cell_x) - 1, ceil(
            (highest + self.half_length) / self.cell_x
        ) + 1

    def _strip_ahead(self, first_row: int, last_row: int) -> NDArray[numpy.float32]:
        """The strip of block 0 with the travel of `AHEAD`; without it where the road ends before, or does not
        fit into a block.
        """
        further = self.rows(0.0, AHEAD)[1]
        if (further + 1 - first_row) * len(self._y) <= LARGEST_PATCH:
            try:
                height = self._strip(first_row, further)
                if numpy.isfinite(height).all():
                    return height
            except ExcitationError:
                pass
        return self._strip(first_row, last_row)

    def _strip(self, first_row: int, last_row: int) -> NDArray[numpy.float32]:
        """Heights of these rows; a strip moves on by few rows, so that they are made for several at
        once.
        """
        rows, offset = last_row + 1 - first_row, first_row - self._first_held
        if not 0 <= offset <= len(self._held) - rows:
            kept = self._held[offset:] if offset >= 0 else self._held[:0]
            fresh = self._heights(first_row + len(kept), last_row + 1, rows)
            self._first_held, self._held, offset = first_row, numpy.concatenate((kept, fresh)), 0
        return self._held[offset : offset + rows]

    def _heights(self, first_row: int, end_row: int, more: int) -> NDArray[numpy.float32]:
        """Heights of these rows and of `more` behind them, where the surface reaches as far."""
        x = numpy.arange(first_row, end_row + more, dtype=numpy.float64) * self.cell_x
        try:
            return self.surface.heights(x, self._y).astype(numpy.float32)
        except ExcitationError:
            return self.surface.heights(x[: end_row - first_row], self._y).astype(numpy.float32)

    def refuse_short_road(self, duration: float) -> None:
        """Raise ExcitationError where the surface has no height somewhere under a run of so long, [s]."""
        first, last = self.rows(0.0, duration)
        self.surface.heights(numpy.array([first, last]) * self.cell_x, self._y)

    def describe(self) -> dict[str, Any]:
        """What the surface says about itself."""
        return self.surface.describe()


class VibrationBlocks:
    """The samples of a signal, one row a block; sample i of block k lies at (k n + i) /
    sample_rate, n samples a block."""

    def __init__(self, signal: Signal, block_length: float, sample_rate: float) -> None:
        """Lay the sample times over the blocks.

        Args:
            signal: the vibration. block_length: simulated time of a block, [s], > 0. sample_rate:
            samples a second, [Hz]; block_length * sample_rate must be a whole number of samples.

        Raises:
            ExcitationError: a value out of range, or a block that is not a whole number of samples.
        """
        samples = block_length * sample_rate
        if not 0.5 < samples < LARGEST_PATCH or abs(samples - round(samples)) > 1e-9 * samples:
            raise ExcitationError(
                f"a block of {block_length} s holds {samples:.9g} samples at {sample_rate} Hz; choose a sample rate "
                f"that is a whole multiple of {1.0 / block_length if block_length else 0.0:.9g} Hz"
            )
        self.signal, self.sample_rate = signal, sample_rate
        self.samples = round(samples)

    def block(self, block: int) -> VibrationBlock:
        """The samples of block number `block`, from 0; ExcitationError where the signal has no
        finite value there.
        """
        times = numpy.arange(block * self.samples, (block + 1) * self.samples + 1) / self.sample_rate
        acceleration_x, acceleration_z = self.signal.acceleration(times)
        if not (numpy.isfinite(acceleration_x).all() and numpy.isfinite(acceleration_z).all()):
            raise ExcitationError(
                f"block {block}: the vibration is not finite between {times[0]:.6g} s and {times[-1]:.6g} s"
            )
        return VibrationBlock(
            block=block,
            sample_period=1.0 / self.sample_rate,
            acceleration_x=acceleration_x,
            acceleration_z=acceleration_z,
        )

    def describe(self) -> dict[str, Any]:
        """What the signal says about itself."""
        return self.signal.describe()
