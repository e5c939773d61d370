"""A tire that rolls over an obstacle with its axle held in height (mount `held`)."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.scene_outputs import outputs_with, records_of
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["CLEAT", "OverCleat", "duration_of", "held_over", "over_cleat"]

SCENE = "tire_cleat"
CLEAT = 1.0  # [m] where the cleat begins
BEHIND = 5.0  # [m] rolled behind it, at least
Samples = NDArray[numpy.float64]


class OverCleat(NamedTuple):
    """Forces on the axle over the place of the wheel centre."""

    time: Samples  # [s]
    place: Samples  # [m]
    longitudinal: Samples  # [N] forward
    vertical: Samples  # [N] up
    moment: Samples  # [N m] on the rim
    spin: Samples  # [rad/s]


def over_cleat(load: float, speed: float, *values: str) -> OverCleat:
    """Roll ``tire_cleat`` with ``values`` set at a ``speed`` [m/s] over a cleat of 10 by 50 mm with
    edges of 5 mm, its axle at the height where it stands under the ``load`` [N].
    """
    scene = load_resolved(
        SCENE, f"duration={duration_of(speed)}", f"travel={{speed: {speed}}}", "outputs.force_rate=2000",
        f"road={{kind: cleat, position: {CLEAT}, height: 0.01, length: 0.05, edge: 0.005}}", "block_length=0.1",
        f"tire.mount={{kind: held, load: {load}}}", *values,
    )  # fmt: skip
    return held_over(scene)


def duration_of(speed: float) -> float:
    """Duration [s] of a run over the cleat at a ``speed`` [m/s]."""
    return round((CLEAT + BEHIND) / speed + 0.15, 1) + 0.1


def held_over(scene: ResolvedScene) -> OverCleat:
    """The run of a scene whose axle is held, with a wheel that spins, at one speed."""
    outputs = outputs_with(scene, Simulation(scene))
    records = records_of(outputs, "tire/axle")
    time = numpy.arange(sum(len(record.vertical) for record in records)) * records[0].sample_period

    def joined(name: str) -> Samples:
        return numpy.concatenate([getattr(record, name) for record in records])

    place = float(scene.data["travel"]["speed"]) * time
    return OverCleat(
        time, place, joined("longitudinal"), joined("vertical"), joined("moment_y"), joined("spin")
    )  # fmt: skip
