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


def mat_metrics(contact: str, field: FieldSeries, duration: float, loaded: float = LOADED) -> list[Metric]:
    """Of the mean map of a ``contact`` over ``duration`` [s]; none where no cell is above ``loaded`` [Pa]."""
    grid = field.average
    if not (grid.pressure > loaded).any():
        return []
    make = Maker(contact, f"{contact}/patch", (0.0, duration)).make
    count = field.time.size
    centre_x, centre_y = centre(grid)
    steps = path(field)
    area = grid.cell_x * grid.cell_y
    cells = f"cells of {1e3 * grid.cell_x:.4g} by {1e3 * grid.cell_y:.4g} mm, loaded above {loaded:g} Pa"
    highest = np.argwhere(grid.pressure == grid.pressure.max()).mean(axis=0)
    found = [
        make("map_load", "load of the mean map", area * float(grid.pressure.sum()), "N", count=count,
             remark=f"{field.load.min():.5g} to {field.load.max():.5g} N"),
        make("map_mean", "mean pressure of the mean map", 1e-3 * mean(grid, loaded), "kPa", count=count, remark=cells),
        make("map_peak", "peak of the mean map", 1e-3 * float(grid.pressure.max()), "kPa", count=count,
             remark=f"row {highest[0]:.4g}, column {highest[1]:.4g} of the map, from 0"),
        make("map_area", "loaded area of the mean map", 1e4 * area * int((grid.pressure > loaded).sum()), "cm²", count=count),
        make("map_gradient", "largest gradient of the mean map", 1e-5 * gradient(grid), "kPa/cm", count=count,
             remark="between these cells; finer ones find a steeper one"),
        make("map_spd", "SPD of the mean map", spd(grid.pressure, loaded), "%", count=count),
        make("centre_x", "centre of pressure, forward", round(1e3 * centre_x, 9) + 0.0, "mm", count=count,
             remark=f"row {(centre_x - grid.origin_x) / grid.cell_x:.4g} of the map, from 0"),
        make("centre_y", "centre of pressure, left", round(1e3 * centre_y, 9) + 0.0, "mm", count=count,
             remark=f"column {(centre_y - grid.origin_y) / grid.cell_y:.4g} of the map, from 0"),
        make("centre_path", "path of the centre of pressure", 1e3 * float(np.hypot(*steps).sum()), "mm", count=count),
    ]  # fmt: skip
    names, rows = ZONES.get(contact, PAN)
    for name, share in zones(grid, names, rows, loaded).items():
        found.append(
            make(
                f"zone_{name.replace(' ', '_')}",
                f"load of the zone {name}",
                share,
                "%",
                count=count,
                remark="of whole cells",
            )
        )
    return found


def mean(grid: PressureMap, loaded: float = LOADED) -> float:
    """Mean [Pa] over the cells above ``loaded`` [Pa]."""
    cells = grid.pressure[grid.pressure > loaded]
    return float(cells.mean()) if cells.size else 0.0


def spd(pressure: FloatArray, loaded: float = LOADED) -> float:
    """Distribution index [%] of a map [rows, cols] in [Pa]: 100 sum (p - p_m)^2 / (4 n p_m^2) over the n
    cells above ``loaded`` [Pa]; 0 of an even pressure."""
    cells = pressure[pressure > loaded]
    middle = float(cells.mean())
    return 100.0 * float(np.sum((cells - middle) ** 2)) / (4.0 * cells.size * middle**2)


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


def zones(grid: PressureMap, names: tuple[str, ...], rows: int, loaded: float = LOADED) -> dict[str, float]:
    """Share [%] of the load in each zone: equal parts of the length along x, halves of the width, of the cells above
    ``loaded`` [Pa]."""
    cells = grid.pressure > loaded
    along, across = (np.flatnonzero(cells.any(axis=axis)) for axis in (1, 0))
    edges = np.linspace(along[0], along[-1] + 1, rows + 1)
    middle = 0.5 * (across[0] + across[-1] + 1)
    place_x, place_y = np.arange(grid.pressure.shape[0]) + 0.5, np.arange(grid.pressure.shape[1]) + 0.5
    zone = np.clip(np.searchsorted(edges, place_x) - 1, 0, rows - 1)
    total, found = float(grid.pressure.sum()), {}
    for number, name in enumerate(names):
        for side, chosen in (("left", place_y > middle), ("right", place_y <= middle)):
            found[f"{name} {side}"] = 100.0 * float(grid.pressure[zone == number][:, chosen].sum()) / total
    return found
