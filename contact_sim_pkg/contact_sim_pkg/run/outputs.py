"""Outputs that every rig has: stamps, wrenches, energy ledger, cost."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import (
    ContactForce,
    ContactPatch,
    EnergyLedger,
    SolverCost,
    Vector3,
    Wrench,
    WrenchStamped,
)
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


class Centre(NamedTuple):
    """Centre of pressure of a contact from a sample on, in the contact's frame."""

    sample: int
    x: float  # [m]
    y: float  # [m]


def contact_outputs(
    name: str,
    stamps: BlockStamps,
    force: ContactForce,
    patches: Sequence[tuple[int, ContactPatch]] = (),
    *,
    centres: Sequence[Centre] | None = None,
    lateral: NDArray[numpy.float64] | None = None,
) -> Iterator[Output]:
    """Resultant of a contact at the full rate, its wrench at the display rate, its pressure fields.

    The wrench is about the origin of the contact's frame, with every force in the plane z = 0: the
    normal force F_z at the centre of pressure (x_c, y_c) gives the torque (y_c F_z, -x_c F_z).
    Between two centres the earlier one holds; without any the force acts at the origin.

    Args:
        name: name of the contact, in front of its topics.
        stamps: stamps of the block.
        force: the resultant at all samples.
        patches: sample and pressure field, in order.
        centres: centres of pressure, in order; None: those of ``patches``.
        lateral: [samples, 2], force along y [N] and moment about z [N m] on the upper body; None: 0.
    """
    yield Output(f"{name}/force", stamps.start, force)
    if centres is None:
        centres = [Centre(sample, patch.centre_x, patch.centre_y) for sample, patch in patches]
    vertical = force.normal + force.impulses if len(force.impulses) else force.normal
    for sample in stamps.displayed():
        force_y, moment_z = (0.0, 0.0) if lateral is None else (float(part) for part in lateral[sample])
        normal, at = float(vertical[sample]), _centre_at(centres, sample)
        torque = (at.y * normal, -at.x * normal, moment_z)
        yield Output(
            f"{name}/wrench", stamps.at(sample), wrench_of((float(force.tangential[sample]), force_y, normal), torque)
        )
    for sample, patch in patches:
        yield Output(f"{name}/patch", stamps.at(sample), patch)


def _centre_at(centres: Sequence[Centre], sample: int) -> Centre:
    """The last centre that is not later than a sample."""
    return next((each for each in reversed(centres) if each.sample <= sample), Centre(0, 0.0, 0.0))


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


def open_energy(energies: Sequence[float] | NDArray[numpy.float64]) -> float:
    """What kinetic, potential and stored energy, work supplied and dissipated [J] leave open: supplied less the rest."""
    kinetic, potential, stored, supplied, dissipated = (float(each) for each in energies)
    return supplied - kinetic - potential - stored - dissipated


class Estimate(NamedTuple):
    """Estimated numerical error of a column, in a block or over a run."""

    column: str  # topic and column, as of `largest_of`
    error: float  # in the unit of the column
    largest: float  # largest magnitude of the column there


def solver_cost(
    stamps: BlockStamps, wall_time: float, estimates: Sequence[Estimate] = (), **counted: Any
) -> SolverCost:
    """Cost of a block that took ``wall_time`` [s], with estimated errors of its outputs; columns that
    are not given are 0.
    """
    factor = stamps.timing.block_length / wall_time
    return SolverCost(
        block=stamps.block, wall_time=wall_time, real_time_factor=factor,
        estimated=tuple(each.column for each in estimates), estimated_error=numpy.array([each.error for each in estimates]),
        estimated_of=numpy.array([each.largest for each in estimates]), **counted,
    )  # fmt: skip


def largest_of(outputs: Iterable[Output], column: str) -> float:
    """Largest magnitude of a column in some outputs, as ``tire/force.normal``, or of one body as
    ``bench/motion.velocity of wheel_z``; 0 without any.
    """
    topic, _dot, field = column.partition(".")
    name, _of, body = field.partition(" of ")
    found = 0.0
    for each in outputs:
        if each.topic == topic:
            values = getattr(each.record, name)
            chosen = values[each.record.bodies.index(body)] if body else values
            found = max(found, abs(chosen) if isinstance(chosen, float) else float(numpy.abs(chosen).max(initial=0.0)))
    return found


def largest(outputs: Iterable[Output], part: str, column: str) -> float:
    """Largest value of a column, such as ``normal`` [N], of all topics that end in ``part``
    (``force``); 0 without any.
    """
    chosen = (getattr(each.record, column) for each in outputs if each.topic.endswith(f"/{part}"))
    return max((float(value.max() if hasattr(value, "max") else value) for value in chosen), default=0.0)
