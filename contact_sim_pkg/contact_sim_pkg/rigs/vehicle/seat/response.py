"""Responses of seat and occupant while a run goes on: transmissibility, apparent mass, seat to head,
SEAT.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion, SeatResponse
from contact_sim_pkg.records.state import State
from contact_sim_pkg.report.signal.metrics import seat_factor, weighted_rms
from contact_sim_pkg.report.signal.spectrum import Transmissibility, Welch, band
from contact_sim_pkg.run.outputs import BlockStamps

__all__ = ["FLOOR_BODIES", "SEAT_BODY", "RunningResponse"]

SEAT_BODY = "seat_frame_z"
"""The mass that rests on the cushion moves as the seat surface does."""
FLOOR_BODIES = ("floor_z", "body_z")
"""The seat stands on the platform, or on the body of the car."""
FLOOR, SEAT, FORCE, HEAD = range(4)
"""Signals: three vertical accelerations and the force of the cushion."""


class RunningResponse:
    """Estimate of the responses over all segments since the start of a run, from what `seat/force`
    and `bench/motion` carry. Parts of the run change nothing: blocks may have any length.
    """

    STATE = State(("_welch",))

    def __init__(self, segment_length: float, sample_rate: float, head: int | None) -> None:
        """Begin a run.

        Args:
            segment_length: [s] of a segment, a sample or more.
            sample_rate: [Hz] of force and motion.
            head: number of the mass that is the head; None without one.
        """
        samples = round(segment_length * sample_rate)
        self._segment_length, self._head = samples / sample_rate, head
        self._welch = Welch(HEAD if head is None else HEAD + 1, samples, sample_rate)

    def outputs(self, stamps: BlockStamps, others: Iterable[Output]) -> list[Output]:
        """Messages of the next block, whose ``others`` are given: one for each segment that ends in
        it, but for the first of the run, whose coherence would always be 1.
        """
        records = {each.topic: each.record for each in others}
        motion: BodyMotion = records["bench/motion"]
        floor = next(name for name in FLOOR_BODIES if name in motion.bodies)
        names = [floor, SEAT_BODY, *([] if self._head is None else [f"occupant{self._head}_z"])]
        signals = [motion.acceleration[motion.bodies.index(name)] for name in names]
        signals.insert(FORCE, records["seat/force"].normal)
        return [
            Output("seat/response", stamps.at(sample), self._response(stamps.block))
            for sample in self._welch.advance(numpy.array(signals))
            if self._welch.segments > 1
        ]

    def _response(self, block: int) -> SeatResponse:
        """Message of the segments so far."""
        mean = self._welch.mean()
        inside = band(mean.frequency)
        floor, seat = mean.power(FLOOR), mean.power(SEAT)
        ratios = {"transmissibility": mean.response(FLOOR, SEAT), "apparent_mass": mean.response(SEAT, FORCE)}
        if self._head is not None:
            ratios["seat_to_head"] = mean.response(SEAT, HEAD)
        columns = {
            name + part: values[inside] for name, ratio in ratios.items() for part, values in _parts(ratio).items()
        }
        on_floor, on_seat = weighted_rms(floor), weighted_rms(seat)
        return SeatResponse(
            block=block, segments=mean.segments, segment_length=self._segment_length, floor_weighted_rms=on_floor,
            seat_weighted_rms=on_seat, seat_factor=seat_factor(on_seat, on_floor), frequency=mean.frequency[inside],
            floor_density=floor.density[inside], seat_density=seat.density[inside], **columns,
        )  # fmt: skip


def _parts(ratio: Transmissibility) -> dict[str, NDArray[numpy.float64]]:
    """Columns of a response by the ends of their names."""
    return {"": ratio.magnitude, "_phase": ratio.phase, "_coherence": ratio.coherence}
