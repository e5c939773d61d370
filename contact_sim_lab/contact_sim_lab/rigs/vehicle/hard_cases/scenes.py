"""Hard cases of whole scenes: the energy ledger, lift-off, determinism."""

from __future__ import annotations

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_pkg.bag.block_encoder import Output, encode_block
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of

TIGHT = "integrator.relative_tolerance=1e-7"


def _of(outputs: list[Output], topic: str, column: str) -> Vector:
    return numpy.concatenate([getattr(record, column) for record in records_of(outputs, topic)])


def _residual(outputs: list[Output]) -> float:
    ledger = records_of(outputs, "bench/energy")[-1]
    return abs(ledger.residual) / max(abs(ledger.supplied), ledger.dissipated)


def seat_ledger() -> Finding:
    """Energy residual over the energy turned over, seat with friction and loss."""
    found = outputs_of("seat_ride", 2.0, "effects.seat.friction={}", TIGHT)
    friction = _of(found, "seat/force", "tangential")
    return at_most(_residual(found), 1e-6, hard=(numpy.diff(numpy.sign(friction)) != 0.0).sum())


def tire_ledger() -> Finding:
    """The same for the tire over a bump, its pressure field driving the wheel."""
    found = outputs_of("tire_bump", 1.3, TIGHT)
    force = _of(found, "tire/force", "normal")
    return at_most(_residual(found), 1e-4, hard=force.max() / force[0])


def car_ledger() -> Finding:
    """The same for the full bench with both fields."""
    found = outputs_of("car_full_bench", 1.3, TIGHT)
    force = _of(found, "tire/force", "normal")
    return at_most(_residual(found), 1e-4, hard=force.max() / force[0])


def lift_off() -> Finding:
    """Samples with a negative force behind a bump of 0.12 m, where the tire leaves the road (also
    counted: no map without load).
    """
    found = outputs_of("tire_bump", 1.5, "road.height=0.12")
    force = _of(found, "tire/force", "normal")
    wrong = int((force < 0.0).sum())
    wrong += 0 if any(patch.load == 0.0 and patch.area == 0.0 for patch in records_of(found, "tire/patch")) else 1
    return exactly(wrong, 0, hard=(force == 0.0).sum())


def determinism() -> Finding:
    """Messages that differ between two runs of the same scene."""
    first, second = (encode_block(outputs_of("car_full_bench", 0.2)) for _ in range(2))
    return exactly(sum(one != other for one, other in zip(first, second, strict=True)), 0, hard=len(first))


CASES = (
    HardCase("general", "energy ledger: seat with friction, residual over turnover", seat_ledger,
        guard.slip_changes(5)),
    HardCase("general", "energy ledger: tire field over a bump", tire_ledger,
        guard.at_least("largest force over the first", 1.2)),
    HardCase("general", "energy ledger: full bench, both fields", car_ledger,
        guard.at_least("largest force over the first", 1.2)),
    HardCase("rough road", "tire flies behind a bump: forces below 0, fields missing", lift_off,
        guard.contact_lost(10)),
    HardCase("general", "two runs of a scene: messages that differ", determinism,
        guard.at_least("messages that are compared", 100)),
)  # fmt: skip
