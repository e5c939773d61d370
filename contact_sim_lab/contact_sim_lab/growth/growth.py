"""How processor time grows with what a scene asks for: `bench growth`.

Every axis changes one thing in one scene; the run is offline, compiled before. Time is that of the
process over a simulated second. The slope is that of a straight line through the logarithms of the
last three points: 1 doubles the time with the value. The counted floor is the least that the method
needs: of a pressure field two transforms an iteration on the padded grid, timed alone; of a
recording the bytes of the bag, copied once.
"""

from __future__ import annotations

import math
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.records.table import Section
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.scene_outputs import outputs_with, records_of
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["page", "sections", "study"]

SLOPE_POINTS = 3
REPEATS = 3  # of which the fastest counts
FEW = 100  # transforms timed together
SQUARE = 0.27  # [m] side of the tire's grid
ROUGH = "road={kind: iso8608, roughness_class: C, length: 60, shortest_wavelength: 0.1, longest_wavelength: 20}"


class Axis(NamedTuple):
    """One thing that a scene may ask for more of."""

    name: str
    unit: str
    scene: str
    duration: float  # [s]
    values: tuple[float, ...]
    settings: Callable[[float], tuple[str, ...]]
    recorded: bool = False


def _cells(side: float) -> tuple[str, ...]:
    n = round(side)
    return (ROUGH, f"effects.tire.contact_field={{rows: {n}, cols: {n}, length: {SQUARE}, width: {SQUARE}}}")


def _load(newton: float) -> tuple[str, ...]:
    return (ROUGH, f"tire.body_mass={newton / 9.80665 - 40.0}")


AXES = (
    Axis("cells of the tire's field, n x n", "n", "tire_rough_road", 0.2, (16, 32, 64, 128, 256, 512), _cells),
    Axis("load of the tire (contact area)", "N", "tire_rough_road", 1.0, (1500, 3000, 6000), _load),
    Axis("speed on a rough road", "m/s", "tire_rough_road", 1.0, (2.5, 5, 10, 20, 40),
         lambda speed: (ROUGH, f"travel={{speed: {speed}}}")),
    Axis("contacts with a field: tire, tire and seat", "contacts", "car_full_bench", 1.0, (1, 2),
         lambda count: () if count > 1.0 else ("effects.seat.contact_field=null",)),
    Axis("publishing rate of the fields", "Hz", "car_full_bench", 1.0, (10, 20, 50, 100, 200, 500),
         lambda rate: (f"outputs.field_rate={rate}", "block_length=0.1")),
    Axis("recording rate of the forces, fields at 10 Hz", "Hz", "car_full_bench", 1.0, (500, 1000, 2000, 5000),
         lambda rate: (f"outputs.force_rate={rate}", "outputs.field_rate=10", "block_length=0.1"), recorded=True),
)  # fmt: skip


def study(notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows: axis, unit, value, seconds a simulated second, floor, slope of the axis, note."""
    rows = []
    for axis in AXES:
        found = []
        for value in axis.values:
            notify(f"{axis.name}: {value:g} {axis.unit}")
            found.append(_row(axis, value))
        last = found[-SLOPE_POINTS:]
        values, times = ([math.log(row[name]) for row in last] for name in ("value", "seconds"))
        slope = statistics.linear_regression(values, times).slope
        rows += [{**row, "slope": slope} for row in found]
    return rows


def _row(axis: Axis, value: float) -> dict[str, Any]:
    scene = load_resolved(axis.scene, f"duration={axis.duration}", *axis.settings(value))
    simulated = scene.duration
    if axis.recorded:
        with tempfile.TemporaryDirectory() as folder:
            bags = [Path(folder) / str(number) for number in range(REPEATS)]
            seconds = min(_time(partial(run_offline, scene, bag)) for bag in bags)
            size = sum(file.stat().st_size for file in bags[0].rglob("*") if file.is_file())
        content = bytes(size)
        floor, note = min(_time(lambda: bytearray(content)) for _ in range(REPEATS)), f"{1e-6 * size:.1f} MB"
    else:
        seconds = min(_time(lambda: run_offline(scene, None)) for _ in range(REPEATS))
        iterations = _iterations(scene)
        floor = iterations * _transforms(scene)
        note = f"{iterations / simulated:.0f} iterations/s"
    return {
        "axis": axis.name, "unit": axis.unit, "value": float(value), "seconds": seconds / simulated,
        "floor": floor / simulated, "note": note,
    }  # fmt: skip


def _time(call: Callable[[], Any]) -> float:
    """Processor time [s] of this process."""
    began = time.process_time()
    call()
    return time.process_time() - began


def _iterations(scene: ResolvedScene) -> int:
    """Iterations of all fields."""
    costs = records_of(outputs_with(scene, make_simulation(scene), cost=True), "bench/cost")
    return sum(int(cost.field_iterations) for cost in costs)


def _transforms(scene: ResolvedScene) -> float:
    """[s] of one transform there and back on twice the cells of the standing contact, the least that
    holds it; 0 without a field.
    """
    model = build(scene)
    if model.tire_field is None or model.tire_geometry is None:
        return 0.0
    cells, geometry = model.tire_field.usual.settings, model.tire_geometry
    rows = math.ceil(geometry.footprint_length / cells.cell_x)
    cols = math.ceil(2.0 * geometry.half_width / cells.cell_y)
    half_space = make_half_space(rows, cols, cells.cell_x, cells.cell_y, cells.modulus)
    buffers, pressure, result = make_buffers(half_space), numpy.ones((rows, cols)), numpy.empty((rows, cols))

    def there_and_back() -> None:
        for _ in range(FEW):
            displacement(half_space, buffers, pressure, result)

    there_and_back()
    return min(_time(there_and_back) for _ in range(REPEATS)) / FEW


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """A table an axis."""
    return [
        Section(f"{name}: slope {own[0]['slope']:.2f}", [
            {own[0]["unit"]: f"{row['value']:g}", "s a simulated second": f"{row['seconds']:.3g}",
             "× real time": f"{1.0 / row['seconds']:.3g}", "counted floor, s": f"{row['floor']:.2g}", "": row["note"]}
            for row in own
        ])
        for name, own in _by_axis(rows)
    ]  # fmt: skip


def _by_axis(rows: list[dict[str, Any]]) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    for name in dict.fromkeys(row["axis"] for row in rows):
        yield name, [row for row in rows if row["axis"] == name]


def page(rows: list[dict[str, Any]], picture: str | None) -> str:
    """The page docs/performance.md, with a ``picture`` beside it."""
    lines = [
        "# How cost grows", "",
        "Made by `bench growth --page docs/performance.md --plot docs/images/growth.png --overwrite`.", "",
        "Processor time of an offline run for a simulated second, on one core; the fastest of three. *Slope*:",
        "of the last three points on logarithmic axes. *Counted floor*: of a field the transforms of its",
        "iterations on its own grid, not on the coarser ones that it starts from, there and back on twice the",
        "cells of the contact, timed alone; of a recording its bytes, copied once.",
        "Speed of whole runs: `bench goals`.", "",
    ]  # fmt: skip
    if picture is not None:
        lines += [f'<img src="{picture}" width="800" alt="Time of a simulated second over each axis">', ""]
    for section in sections(rows):
        names = list(section.rows[0])
        lines += [f"## {section.title[:1].upper()}{section.title[1:]}", ""]
        lines += ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
        lines += ["| " + " | ".join(str(row[name]) for name in names) + " |" for row in section.rows]
        lines.append("")
    return "\n".join(lines)
