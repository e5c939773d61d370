"""Hard cases of the inflated tire: little and much pressure, standstill, lift-off and landing."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.rigs.vehicle.tire.lattice import standing_load
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.scene.resolve import load_resolved

SCENE = "tire_bump"
LEVEL = "road={kind: flat}"
RING = "effects.tire.rigid_ring={}"
STOP_AND_GO = "travel={points: [[0, 5], [0.2, 0], [0.4, 0], [0.6, 5]]}"
ROUGH = "road={kind: iso8608, roughness_class: C, length: 20, shortest_wavelength: 0.1, longest_wavelength: 10}"


def _run(duration: float, *values: str) -> list[Output]:
    return outputs_of(SCENE, duration, *values)


def _forces(outputs: list[Output]) -> NDArray[numpy.float64]:
    return numpy.concatenate([block.normal for block in records_of(outputs, "tire/force")])


def _standing(duration: float, travel: str) -> int:
    """Blocks of 10 ms at whose start and end the wheel does not move."""
    speed = make_travel(load_resolved(SCENE, travel)).speed
    return sum(speed(0.01 * block) == speed(0.01 * (block + 1)) == 0.0 for block in range(round(duration / 0.01)))


def _residual(outputs: list[Output]) -> float:
    """Largest residual of the energy ledger over the energy that passed."""
    ledger = records_of(outputs, "bench/energy")
    passed = max(abs(entry.supplied) + entry.dissipated for entry in ledger)
    return max(abs(entry.residual) for entry in ledger) / passed


def level_road() -> Finding:
    """Relative change of the force on a level road at 100, 120, 300 and 400 kPa, with and without a
    rigid ring, rolling, stopped and off again.
    """
    load, worst = standing_load(TireSection(), None), 0.0
    for inflation in ("1e5", "1.2e5", "3e5", "4e5"):
        for more in ((), (RING,)):
            force = _forces(_run(0.6, LEVEL, STOP_AND_GO, f"effects.tire.inflation.pressure={inflation}", *more))
            worst = max(worst, float(abs(force / load - 1.0).max()))
    return at_most(worst, 1e-6, hard=_standing(0.6, STOP_AND_GO))


def standstill() -> Finding:
    """Relative change of the force where a tire stands on a rough road, at the usual accuracy."""
    force = _forces(_run(0.3, ROUGH, "travel={speed: 0}"))
    return at_most(
        float(abs(force / standing_load(TireSection(), None) - 1.0).max()),
        1e-6,
        hard=_standing(0.3, "travel={speed: 0}"),
    )


def stop_and_go() -> Finding:
    """Residual of the ledger where a wheel stops on a rough road and rolls on."""
    values = ("accuracy=1e-3", "effects.tire.normal_dissipative=null")
    return at_most(_residual(_run(0.6, ROUGH, STOP_AND_GO, *values)), 1e-5, hard=_standing(0.6, STOP_AND_GO))


def landing() -> Finding:
    """Residual of the ledger over a bump of 0.1 m that throws the wheel off the road, at 120 and 300
    kPa.
    """
    values = ("road.height=0.1", "accuracy=1e-3")
    runs = [_run(1.6, *values, f"effects.tire.inflation.pressure={inflation}") for inflation in ("1.2e5", "3e5")]
    return at_most(max(map(_residual, runs)), 1e-5, hard=min(int((_forces(run) == 0.0).sum()) for run in runs))


CASES = (
    HardCase("inflated tire", "level road at 100 to 400 kPa, stopped between: change of the force", level_road,
        guard.at_least("blocks in which the wheel stands", 15)),
    HardCase("inflated tire", "standing on a rough road: change of the force", standstill,
        guard.at_least("blocks in which the wheel stands", 30)),
    HardCase("inflated tire", "stop and go on a rough road: residual of the ledger", stop_and_go,
        guard.at_least("blocks in which the wheel stands", 15)),
    HardCase("inflated tire", "thrown off a bump, landing at 120 and 300 kPa: residual of the ledger", landing,
        guard.contact_lost(10)),
)  # fmt: skip
