"""Hard cases of whole scenes: the energy ledger, lift-off, determinism."""

from __future__ import annotations

from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_pkg.bag.block_encoder import encode_block
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of


def _residual(scene_name: str, duration: float, *values: str) -> float:
    ledger = records_of(outputs_of(scene_name, duration, *values), "bench/energy")[-1]
    return abs(ledger.residual) / max(abs(ledger.supplied), ledger.dissipated)


def seat_ledger() -> Finding:
    """Energy residual over the energy turned over, seat with friction and loss."""
    return at_most(_residual("seat_ride", 2.0, "effects.seat.friction={}", "integrator.relative_tolerance=1e-7"), 1e-6)


def tire_ledger() -> Finding:
    """The same for the tire over a bump, its pressure field driving the wheel."""
    return at_most(_residual("tire_bump", 1.3, "integrator.relative_tolerance=1e-7"), 1e-4)


def car_ledger() -> Finding:
    """The same for the full bench with both fields."""
    return at_most(_residual("car_full_bench", 1.0, "integrator.relative_tolerance=1e-7"), 1e-4)


def lift_off() -> Finding:
    """Samples with a negative force behind a bump of 0.12 m, where the tire leaves the road (also
    counted: no flight at all).
    """
    found = outputs_of("tire_bump", 1.5, "road.height=0.12")
    forces = [block.normal for block in records_of(found, "tire/force")]
    flying = sum(int((force == 0.0).sum()) for force in forces)
    wrong = sum(int((force < 0.0).sum()) for force in forces) + (0 if flying > 10 else 1)
    wrong += 0 if any(patch.load == 0.0 and patch.area == 0.0 for patch in records_of(found, "tire/patch")) else 1
    return exactly(wrong, 0)


def determinism() -> Finding:
    """Messages that differ between two runs of the same scene."""
    first, second = (encode_block(outputs_of("car_full_bench", 0.2)) for _ in range(2))
    return exactly(sum(one != other for one, other in zip(first, second, strict=True)), 0)


CASES = (
    HardCase("general", "energy ledger: seat with friction, residual over turnover", seat_ledger),
    HardCase("general", "energy ledger: tire field over a bump", tire_ledger),
    HardCase("general", "energy ledger: full bench, both fields", car_ledger),
    HardCase("rough road", "tire flies behind a bump: forces below 0, fields missing", lift_off),
    HardCase("general", "two runs of a scene: messages that differ", determinism),
)
