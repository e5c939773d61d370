"""Metrics of a pressure map as of a pressure mat: the mean map of a run, its zones, and the path of the
centre of pressure.
"""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.report.metrics.maker import Maker
from contact_sim_pkg.report.series import FieldSeries, FloatArray, PressureMap

LOADED = 1.0
"""[Pa] above which a cell counts as loaded"""
ZONES = {
    "backrest": (("lower", "upper"), 2),
}
"""By contact: names of the zones along x, and how many there are; each once left, once right."""
PAN = ("rear", "middle", "front"), 3


def mat_metrics(contact: str, field: FieldSeries, duration: float) -> list[Metric]:
    """Of the mean map of a ``contact`` over ``duration`` [s]; none where it carries no load."""
    grid = field.average
    if not (grid.pressure > LOADED).any():
        return []
    make = Maker(contact, f"{contact}/patch", (0.0, duration)).make
    count = field.time.size
    centre_x, centre_y = centre(grid)
    steps = path(field)
    cells = f"cells of {1e3 * grid.cell_x:.4g} by {1e3 * grid.cell_y:.4g} mm, loaded above {LOADED:g} Pa"
    found = [
        make("map_mean", "mean pressure of the mean map", 1e-3 * mean(grid), "kPa", count=count, remark=cells),
        make("map_peak", "peak of the mean map", 1e-3 * float(grid.pressure.max()), "kPa", count=count),
        make("map_gradient", "largest gradient of the mean map", 1e-5 * gradient(grid), "kPa/cm", count=count),
        make("map_spd", "SPD of the mean map", spd(grid.pressure), "%", count=count),
        make("centre_x", "centre of pressure, forward", 1e3 * centre_x, "mm", count=count),
        make("centre_y", "centre of pressure, left", round(1e3 * centre_y, 9), "mm", count=count),
        make("centre_path", "path of the centre of pressure", 1e3 * float(np.hypot(*steps).sum()), "mm", count=count),
    ]
    for name, share in zones(grid, *ZONES.get(contact, PAN)).items():
        found.append(make(f"zone_{name.replace(' ', '_')}", f"load of the zone {name}", share, "%", count=count))
    return found


def mean(grid: PressureMap) -> float:
    """Mean [Pa] over the loaded cells."""
    loaded = grid.pressure[grid.pressure > LOADED]
    return float(loaded.mean()) if loaded.size else 0.0


def spd(pressure: FloatArray) -> float:
    """Distribution index [%] of a map [rows, cols] in [Pa]: 100 sum (p - p_m)^2 / (4 n p_m^2) over the n
    loaded cells; 0 of an even pressure."""
    loaded = pressure[pressure > LOADED]
    middle = float(loaded.mean())
    return 100.0 * float(np.sum((loaded - middle) ** 2)) / (4.0 * loaded.size * middle**2)


def gradient(grid: PressureMap) -> float:
    """Largest slope [Pa/m] between neighbouring cells, along x or along y."""
    slopes = [
        np.abs(np.diff(grid.pressure, axis=axis)).max(initial=0.0) / cell
        for axis, cell in ((0, grid.cell_x), (1, grid.cell_y))
    ]
    return float(max(slopes))


def centre(grid: PressureMap) -> tuple[float, float]:
    """Centre of pressure [m], forward and left."""
    x = grid.origin_x + grid.cell_x * np.arange(grid.pressure.shape[0])
    y = grid.origin_y + grid.cell_y * np.arange(grid.pressure.shape[1])
    total = float(grid.pressure.sum())
    return float(grid.pressure.sum(axis=1) @ x) / total, float(grid.pressure.sum(axis=0) @ y) / total


def path(field: FieldSeries) -> tuple[FloatArray, FloatArray]:
    """Steps [m] of the centre of pressure from field to field, forward and left, while both carry."""
    carries = field.load > 0.0
    both = carries[1:] & carries[:-1]
    return np.diff(field.centre_x)[both], np.diff(field.centre_y)[both]


def zones(grid: PressureMap, names: tuple[str, ...], rows: int) -> dict[str, float]:
    """Share [%] of the load in each zone: equal parts of the loaded length along x, halves of the loaded
    width."""
    loaded = grid.pressure > LOADED
    along, across = (np.flatnonzero(loaded.any(axis=axis)) for axis in (1, 0))
    edges = np.linspace(along[0], along[-1] + 1, rows + 1)
    middle = 0.5 * (across[0] + across[-1] + 1)
    place_x, place_y = np.arange(grid.pressure.shape[0]) + 0.5, np.arange(grid.pressure.shape[1]) + 0.5
    zone = np.clip(np.searchsorted(edges, place_x) - 1, 0, rows - 1)
    total, found = float(grid.pressure.sum()), {}
    for number, name in enumerate(names):
        for side, chosen in (("left", place_y > middle), ("right", place_y <= middle)):
            found[f"{name} {side}"] = 100.0 * float(grid.pressure[zone == number][:, chosen].sum()) / total
    return found
