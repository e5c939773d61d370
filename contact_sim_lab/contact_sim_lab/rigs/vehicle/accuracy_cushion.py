"""Accuracy and cost of a cushion: its cells, and the spacing of its table.

*cells*: sink, stiffness, peak pressure and area under the load at rest with the cells of each level,
against cells of half the finest side. *table*: force and map between the nodes of tables of several spacings, against the
layer itself. Errors are relative; of a map that of its L2 norm. The cost is that of the maps at the
field rate; the table is made once.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_force
from contact_sim_pkg.pressure.cushion import REACH
from contact_sim_pkg.pressure.cushion.force_table import Carrier, make_table
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.seat.cushion import pan_layer
from contact_sim_pkg.rigs.vehicle.seat.mass import occupant_mass
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion, SeatSection
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import LEVELS

__all__ = ["cushion_rows"]

COARSEST, FINEST = 0.02, 0.0025  # [m] of a cell, beside those of the levels
SPACINGS = (4e-3, 2e-3, 1e-3, 5e-4)  # [m]
COARSE = 2e-3  # [m] of the table from which the load at rest is sought
SENSITIVITY = 500.0  # [Pa] above which a cell counts as loaded
REPEATS = 20


def cushion_rows(scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of cells and table; none for a scene without a cushion."""
    keys = scene.effect("seat", SeatCushion)
    if keys is None:
        return []
    load = occupant_mass(scene.section(SeatSection).occupant) * GRAVITY
    notify("seat cushion: reference cells")
    exact = _figures(pan_layer(keys.model_copy(update={"cell": FINEST})), load)
    rows = []
    levels = [("", COARSEST), *zip((level.name for level in LEVELS), keys.cells, strict=True)]
    for level, cell in levels:
        notify(f"seat cushion: cells of {1e3 * cell:g} mm")
        layer = pan_layer(keys.model_copy(update={"cell": cell}))
        found = _figures(layer, load)
        head = {
            **_head(layer, 0.0, _map_cost(layer, load), scene, f"own code, cells of {1e3 * FINEST:g} mm"),
            "level": level,
        }
        rows += [
            {**head, "quantity": f"seat cushion {name}", "error": abs(value / exact[name] - 1.0)}
            for name, value in found.items()
        ]
    layer = pan_layer(keys)
    for spacing in SPACINGS:
        notify(f"seat cushion: table of {1e3 * spacing:g} mm")
        head = _head(layer, spacing, _map_cost(layer, load), scene, "own code, the layer between the nodes")
        rows += [
            {**head, "quantity": f"seat cushion {name}", "error": error}
            for name, error in _between(layer, spacing).items()
        ]
    return rows


def _head(layer: Carrier, spacing: float, cost: float, scene: ResolvedScene, reference: str) -> dict[str, Any]:
    return {
        "part": "cushion cells" if spacing == 0.0 else "cushion table", "level": "",
        "grid": f"{layer.grid.rows}x{layer.grid.cols}", "tolerance": spacing or layer.grid.cell_x, "reference": reference,
        "ms_per_simulated_s": 1e3 * cost * scene.outputs.field_rate,
    }  # fmt: skip


def _figures(layer: Carrier, load: float) -> dict[str, float]:
    """Sink [m], stiffness [N/m], peak [Pa] and area [m^2] under a load [N]."""
    found = layer.solve(float(approach_of_force(make_table(layer, COARSE).law(), load)))
    for _ in range(6):
        found = layer.solve(found.approach + (load - found.force) / layer.tangent(found), found)
    loaded = found.pressure > SENSITIVITY
    return {
        "sink": found.approach, "stiffness": layer.tangent(found), "peak pressure": float(found.pressure.max()),
        "contact area": float(loaded.sum()) * layer.grid.cell_area,
    }  # fmt: skip


def _between(layer: Carrier, spacing: float) -> dict[str, float]:
    """Largest error of force and map in the middle between nodes, from 0.12 to 0.82 of the
    table's reach.
    """
    table = make_table(layer, spacing)
    law, errors = table.law(), {"force": 0.0, "pressure (L2)": 0.0}
    for part in numpy.linspace(0.1, 0.7, 13):
        approach = (int(part * layer.farthest / REACH / spacing) + 0.5) * spacing
        found = layer.solve(approach)
        missed = table.map_at(approach, found.force) - found.pressure
        errors["force"] = max(errors["force"], abs(elastic_force(law, approach) / found.force - 1.0))
        norms = (float(numpy.linalg.norm(each)) for each in (missed, found.pressure))
        errors["pressure (L2)"] = max(errors["pressure (L2)"], next(norms) / next(norms))
    return errors


def _map_cost(layer: Carrier, load: float) -> float:
    """Time [s] of one map from a table."""
    table = make_table(layer, COARSE)
    approach = float(approach_of_force(table.law(), load))
    began = time.perf_counter()
    for _ in range(REPEATS):
        table.map_at(approach, load)
    return (time.perf_counter() - began) / REPEATS
