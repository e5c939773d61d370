"""The companion of a scene: the same scene with each dial one level finer.

Orders that are assumed when the error follows from the difference of the two:

* time integration: the error is proportional to the tolerance, which is a hundredth: at a tenth a
  run whose steps end with its samples has the same bits,
* coupling: second order in the step between two solutions of a field, which is half as long,
* samples of force: a coupling step is a whole number of segments, which are no longer than a
  sample, so four times as many let it be shorter,
* grid: second order in the cell, which is two thirds as long.

The error of the companion is then a share of that of the scene, and the delivered error is the
difference over (1 - share). Where fields are coupled to bodies, the share of force and motion is
that of the coupling, which rules their error; peak pressure and area have that of the grid.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import read_explicit
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.pressure_field import MOST_CELLS_A_SIDE

__all__ = ["Companion", "cells_of", "companion_of", "dials_of", "factor_of", "finer_than", "halved", "with_values"]

INTEGRATION, COUPLING, LENGTH, CELLS, SOLVER = 0.01, 0.25, 0.5, 1.5, 0.1
SAMPLES = 4.0
"""Factors on tolerance of the integration, tolerance and length of the coupling, cells a side,
tolerance of the field, and rate of the samples of force.
"""
INTEGRATOR = "relative_tolerance"
LEAST = {INTEGRATOR: 1e-13, "coupling_tolerance": 1e-8, "tolerance": 1e-12, "cell": 0.005}
"""Bounds of the schema."""
FEWEST_CELLS, LARGEST_CELL = 4, 0.02
"""a side of a field, and of a cushion [m]: bounds of the schema too"""
COUNTS = ("rows", "cols", "cells_x", "cells_y", "cells_z", "table_rows")
"""Keys of cells along a side, and of rows of a table, in a rig's section and its effects. Those round a track that is
rough by itself are none: other cells are another track.
"""


class Companion(NamedTuple):
    """A finer scene, and which dials were turned."""

    scene: ResolvedScene
    dials: tuple[str, ...]  # keys that are finer
    grid: bool  # whether grids are finer


def companion_of(scene: ResolvedScene, *, grid: bool = True) -> Companion:
    """The scene with each dial one level finer; without the ``grid`` fields keep their cells.

    Raises SceneError where the scene does not take finer grids: their memory, for one.
    """
    values = dict(_dials(scene.data, grid=grid))
    cells = any(key.endswith((".rows", ".cell")) for key in values)
    return Companion(with_values(scene, values), tuple(values), cells)


def halved(scene: ResolvedScene) -> ResolvedScene:
    """The scene with half as many cells along each side of its fields, cushions, mats and boxes under a contact, and half
    the rows of its tables, all other dials as they are.
    """
    values: dict[str, Any] = {}
    for contact in rigs()[scene.rig].contacts:
        effects = scene.data["effects"].get(contact.name) or {}
        values |= _coarser(f"effects.{contact.name}", effects)
        if not any(keys and "cell" in keys for keys in effects.values()):  # a cushion has the cells of its map itself
            values |= _coarser(contact.name, scene.data.get(contact.name) or {})
    return with_values(scene, values)


def _coarser(where: str, keys: Mapping[str, Any]) -> dict[str, Any]:
    """Dotted keys of cells below ``where``, with half as many along each side."""
    found: dict[str, Any] = {}
    for key, value in keys.items():
        if isinstance(value, Mapping):
            found |= _coarser(f"{where}.{key}", value)
        elif key in COUNTS and isinstance(value, int):
            found[f"{where}.{key}"] = min(value, max(FEWEST_CELLS, 2 * round(0.25 * value)))
        elif key == "cell" and value is not None:
            found[f"{where}.{key}"] = min(LARGEST_CELL, 2.0 * value)
    return found


def finer_than(scene: ResolvedScene, other: ResolvedScene) -> ResolvedScene:
    """A scene at a finer request than another, with those dials one level finer still that have the
    same value in both, and the time integration.

    Raises SceneError as `companion_of`.
    """
    shared = dials_of(other.data)
    values = {
        key: value
        for key, value in _dials(scene.data, grid=True)
        if key == f"integrator.{INTEGRATOR}" or shared.get(key) == _value(scene.data, key)
    }
    return with_values(scene, values)


def cells_of(scene: ResolvedScene) -> dict[str, Any]:
    """Cells of the fields and cushions of a scene, by dotted key."""
    return {
        f"{where}.{side}": keys[side]
        for where, keys in _effects(scene.data)
        for side in ("rows", "cols", "cell")
        if keys.get(side) is not None and (side == "cell" or _is_field(keys))
    }


def with_values(scene: ResolvedScene, values: Mapping[str, Any]) -> ResolvedScene:
    """A resolved scene with other values, by dotted key; checked again."""
    overrides = [set_value(f"{key}={value}") for key, value in values.items()]
    return ResolvedScene(read_explicit(scene.to_yaml(), f"{scene.name}, finer", overrides), scene.files)


def dials_of(data: dict[str, Any]) -> dict[str, Any]:
    """Values of the dials in the plain data of a resolved scene, by dotted key."""
    return {key: _value(data, key) for key, _ in _dials(data, grid=True)}


def _value(data: Any, key: str) -> Any:
    for part in key.split("."):
        data = data[part]
    return data


def factor_of(kind: str, companion: Companion) -> float:
    """Delivered error over the difference of the two runs: 1 / (1 - share)."""
    coupled = any("coupling" in dial for dial in companion.dials)
    if coupled and kind in ("force", "motion"):
        share = LENGTH**2
    elif companion.grid:
        share = CELLS**-2
    else:
        share = LENGTH**2 if coupled else INTEGRATION
    return 1.0 / (1.0 - share)


def _dials(data: dict[str, Any], *, grid: bool) -> Iterator[tuple[str, Any]]:
    """Dotted keys of the dials that the scene has, with their finer values."""
    integrator = data["integrator"]
    for key, factor in (
        (INTEGRATOR, INTEGRATION), ("coupling_tolerance", COUPLING), ("coupling_length", LENGTH),
    ):  # fmt: skip
        if integrator.get(key) is not None:
            finer = max(LEAST.get(key, 0.0), factor * integrator[key])
            if finer < integrator[key]:
                yield f"integrator.{key}", finer
    if integrator.get("coupling_tolerance") is not None:
        yield "outputs.force_rate", SAMPLES * data["outputs"]["force_rate"]
    for where, keys in _effects(data):
        yield from _grid_dials(where, keys, grid=grid)


def _effects(data: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Dotted key and keys of each effect of a resolved scene."""
    for contact in rigs()[data["rig"]].contacts:
        for effect, keys in (data["effects"].get(contact.name) or {}).items():
            if keys is not None:
                yield f"effects.{contact.name}.{effect}", keys


def _is_field(keys: Mapping[str, Any]) -> bool:
    return "rows" in keys and "corrector_passes" in keys


def _grid_dials(where: str, keys: dict[str, Any], *, grid: bool) -> Iterator[tuple[str, Any]]:
    """Dials of an effect that is a pressure field or a cushion with a map."""
    is_field = _is_field(keys)
    if is_field and keys["tolerance"] > LEAST["tolerance"]:
        yield f"{where}.tolerance", max(LEAST["tolerance"], SOLVER * keys["tolerance"])
    if grid and is_field:
        for side in ("rows", "cols"):
            yield f"{where}.{side}", min(MOST_CELLS_A_SIDE, 2 * round(0.5 * CELLS * keys[side]))
    if grid and keys.get("cell") is not None and keys["cell"] > LEAST["cell"]:
        yield f"{where}.cell", max(LEAST["cell"], round(keys["cell"] / CELLS, 6))
