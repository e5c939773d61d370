"""Goals of the vehicle rigs: speed with point contacts, and solves of the tire's pressure field."""

from __future__ import annotations

from functools import partial

from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_lab.rigs.vehicle.accuracy_field import bench_solves
from contact_sim_lab.rigs.vehicle.scene_drive import drive_of, fast_run
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["GOALS", "point_contacts", "tire_field"]

SCENES = ("seat_ride", "tire_bump", "car_full_bench")


def point_contacts() -> list[Measured]:
    """Speed of the rigs of three scenes with point contacts."""
    found = []
    for name in SCENES:
        drive = drive_of(load_resolved(name), 2.0)
        simulated = (len(drive.height) - 1) * drive.segment
        seconds = median_time(partial(fast_run, drive, drive.model.scale))
        found.append(Measured(f"rig of {name}, point contacts", simulated / seconds, "× real time"))
    return found


def tire_field() -> list[Measured]:
    """Solves of the tire's field on a rough road, from nothing and from the field 10 ms before."""
    scene = load_resolved("tire_rough_road")
    found = []
    for cells in ((48, 64), (96, 128)):
        for tolerance in (1e-2, 1e-3):
            cold, warm, error = bench_solves(scene, cells, tolerance)
            name, note = f"tire field {cells[0]}x{cells[1]}, tolerance {tolerance:g}", f"error {error:.1e} (L2)"
            found += [
                Measured(f"{name}, cold", cold, "ms", note=note),
                Measured(f"{name}, warm", warm, "ms", note=note),
            ]
    return found


GOALS = (GoalPart("rigs with point contacts", point_contacts), GoalPart("tire field", tire_field))
