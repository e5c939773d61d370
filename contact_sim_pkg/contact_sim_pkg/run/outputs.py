"""Outputs that every rig has: stamps, wrenches, energy ledger, cost."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import ContactForce, EnergyLedger, SolverCost, Vector3, Wrench, WrenchStamped
from contact_sim_pkg.scene.timing import Timing

NANOSECONDS = 1_000_000_000


class BlockStamps(NamedTuple):
    """The stamps of one block [ns]: its samples lie evenly in it, the first at its start."""

    block: int
    timing: Timing

    @property
    def start(self) -> int:
        """Of the block."""
        return self.block * round(self.timing.block_length * NANOSECONDS)

    @property
    def period(self) -> float:
        """From one sample to the next [s]."""
        return self.timing.block_length / self.timing.samples

    def at(self, sample: int) -> int:
        """Of a sample, from 0."""
        return self.start + sample * round(self.timing.block_length * NANOSECONDS) // self.timing.samples

    def displayed(self) -> Iterator[int]:
        """The samples at which a wrench is shown."""
        for display in range(self.timing.displays):
            yield display * self.timing.samples // self.timing.displays


def wrench_of(force: Sequence[float], torque: Sequence[float]) -> WrenchStamped:
    """Wrench of a force [N] and a torque [N m] about the origin, along x (forward), y (left), z
    (up).
    """
    fx, fy, fz = force
    tx, ty, tz = torque
    return WrenchStamped(wrench=Wrench(force=Vector3(x=fx, y=fy, z=fz), torque=Vector3(x=tx, y=ty, z=tz)))


def contact_outputs(
    name: str, stamps: BlockStamps, force: ContactForce, lateral: NDArray[numpy.float64] | None = None
) -> Iterator[Output]:
    """Resultant of a contact at the full rate, and its wrench at the display rate.

    ``lateral`` [samples, 2]: force along y [N] and moment about z [N m] on the upper body; 0 where
    it is not given.
    """
    yield Output(f"{name}/force", stamps.start, force)
    vertical = force.normal + force.impulses if len(force.impulses) else force.normal
    for sample in stamps.displayed():
        force_y, moment_z = (0.0, 0.0) if lateral is None else (float(part) for part in lateral[sample])
        along = (float(force.tangential[sample]), force_y, float(vertical[sample]))
        yield Output(f"{name}/wrench", stamps.at(sample), wrench_of(along, (0.0, 0.0, moment_z)))


def energy_ledger(
    block: int, *, kinetic: float, potential: float, stored: float, dissipated: float, supplied: float
) -> EnergyLedger:
    """Energy ledger [J] at the start of a block.

    The residual is supplied - kinetic - potential - stored - dissipated.
    """
    return EnergyLedger(
        block=block, kinetic=kinetic, potential=potential, stored=stored, dissipated=dissipated, supplied=supplied,
        residual=supplied - kinetic - potential - stored - dissipated,
    )  # fmt: skip


def solver_cost(stamps: BlockStamps, wall_time: float, **counted: Any) -> SolverCost:
    """Cost of a block that took ``wall_time`` [s]; columns that are not given are 0."""
    factor = stamps.timing.block_length / wall_time
    return SolverCost(block=stamps.block, wall_time=wall_time, real_time_factor=factor, **counted)


def largest(outputs: Iterable[Output], part: str, column: str) -> float:
    """Largest value of a column, such as ``normal`` [N], of all topics that end in ``part``
    (``force``); 0 without any.
    """
    chosen = (getattr(each.record, column) for each in outputs if each.topic.endswith(f"/{part}"))
    return max((float(value.max() if hasattr(value, "max") else value) for value in chosen), default=0.0)
