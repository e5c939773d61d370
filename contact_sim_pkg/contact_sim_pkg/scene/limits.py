"""Caps on what a scene may ask of the machine, checked before anything is allocated."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.files import BAG_ENDINGS, FileRefusedError, open_regular_file
from contact_sim_pkg.memory import GIBIBYTE
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.files import InputFile, candidates, find_file, input_files
from contact_sim_pkg.scene.resolved_scene import sha256_of
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection
from contact_sim_pkg.scene.schema.road import Iso8608RoadSection
from contact_sim_pkg.scene.schema.scene import Scene

BYTES_PER_CELL = 256
"""Influence tables, transforms and work arrays of a pressure field, a cell of its grid."""
MOST_CELLS_A_SIDE = 4096
BYTES_PER_ROAD_POINT = 16
ROAD_POINTS_PER_WAVE = 48
"""Height and slope of a random road, so many times on its shortest wave."""
MOST_ROAD_POINTS = 1 << 24
MOST_SAMPLES = 10**9
"""Force samples of a run: 3600 s at 277 kHz."""
LARGEST_ROAD_FILE = 512 << 20
LARGEST_SIGNAL_FILE = 256 << 20


class Need(NamedTuple):
    """Memory that one part of a scene needs."""

    where: str
    what: str
    bytes: int


def limit_breaches(scene: Scene) -> Iterator[Breach]:
    """Scenes that are too large: memory, samples, points of a random road, cells along a side of a
    field.
    """
    yield from _samples(scene)
    yield from _road_points(scene)
    needs = list(memory_needs(scene))
    total, limit = sum(need.bytes for need in needs), scene.limits.memory * GIBIBYTE
    if total > limit:
        yield _too_much(needs, total, scene.limits.memory)
    else:
        yield from _sides(scene)


def memory_needs(scene: Scene) -> Iterator[Need]:
    """Estimated memory of each part of a scene."""
    for where, rows, cols in _grids(scene):
        yield Need(where, f"{rows} × {cols} cells need", rows * cols * BYTES_PER_CELL)
    points = _random_road_points(scene)
    if 0 < points <= MOST_ROAD_POINTS:
        yield Need("road", f"a random road of {points} points needs", points * BYTES_PER_ROAD_POINT)
    for file in input_files(scene):
        path = find_file(file.name, Path(scene.file).parent)
        if path is not None:
            yield Need(file.where, f"{file.name} needs", file_memory(file.where, path))


def file_memory(where: str, path: Path) -> int:
    """Memory in [bytes] that reading an input file takes, as its reader counts it; the reader is
    imported when there is a file.
    """
    from contact_sim_pkg.excitation import table_files
    from contact_sim_pkg.excitation.opencrg import road as opencrg
    from contact_sim_pkg.excitation.profile import formats as profile

    is_grid = where == "road.file" and profile.is_opencrg(path)
    needed = opencrg.memory_needed(path) if is_grid else table_files.memory_needed(path)
    return int(needed)


def file_breaches(scene: Scene) -> Iterator[Breach]:
    """Input files that are missing, unreadable, too large, or have another content than the scene
    states.
    """
    for file in input_files(scene):
        sentence = _file_fault(file, Path(scene.file).parent)
        if sentence:
            yield Breach(file.where, sentence)


def _file_fault(file: InputFile, folder: Path) -> str:
    path = find_file(file.name, folder)
    if path is None:
        looked = " or ".join(str(place) for place in candidates(file.name, folder))
        there = folder / file.name
        kind = "is a folder" if there.is_dir() else "is no regular file" if there.exists() else "is not there"
        if any(each.suffix in BAG_ENDINGS for each in there.glob("*")):
            kind += f" with a bag of several files, `bench recover {file.name} NEW` makes one of them"
        return f"the file {file.name!r} {kind}; looked for {looked}"
    largest = LARGEST_ROAD_FILE if file.where == "road.file" else LARGEST_SIGNAL_FILE
    try:
        # Opened once: size and kind are those of the file that was opened
        with open_regular_file(path) as stream:
            size = os.fstat(stream.fileno()).st_size
    except FileRefusedError as error:
        return f"the file {path} cannot be read: {error.strerror}"
    if size > largest:
        return f"the file {path} has {size} bytes; at most {largest} are allowed"
    if file.sha256 is not None:
        found = sha256_of(path)
        if found != file.sha256:
            return f"the file {path} has another content than the scene states: sha256 {found}, stated {file.sha256}"
    return ""


def _too_much(needs: list[Need], total: int, limit: float) -> Breach:
    largest = max(needs, key=lambda need: need.bytes)
    together = f", all parts together {total / GIBIBYTE:.3g} GiB" if len(needs) > 1 else ""
    sentence = f"{largest.what} {largest.bytes / GIBIBYTE:.3g} GiB{together}, limit {limit:g} GiB (limits.memory)"
    return Breach(largest.where, sentence, ("limits.memory", "accuracy"))


def _grids(scene: Scene) -> Iterator[tuple[str, int, int]]:
    """Key of each pressure field, rows and cols."""
    for contact in rigs()[scene.rig].contacts:
        field = scene.effect(contact.name, PressureFieldSection)
        if field is not None:
            name = next(name for name, effect in scene.effects_at(contact) if effect is field)
            yield f"effects.{contact.name}.{name}", *field.cells(scene)


def _sides(scene: Scene) -> Iterator[Breach]:
    for where, rows, cols in _grids(scene):
        for key, count in (("rows", rows), ("cols", cols)):
            if count > MOST_CELLS_A_SIDE:
                sentence = f"{count} cells are more than the {MOST_CELLS_A_SIDE} that one side of a field can have"
                yield Breach(f"{where}.{key}", sentence)


def _samples(scene: Scene) -> Iterator[Breach]:
    samples = scene.duration * scene.outputs.force_rate
    if samples > MOST_SAMPLES:
        rate = scene.outputs.force_rate
        sentence = f"{scene.duration:g} s at {rate:g} Hz are {samples:.3g} samples, limit {MOST_SAMPLES:.3g}"
        yield Breach("outputs.force_rate", sentence, ("duration",))


def _random_road_points(scene: Scene) -> int:
    road = scene.road
    if not isinstance(road, Iso8608RoadSection):
        return 0
    points = 1024 * -(-ROAD_POINTS_PER_WAVE * road.length / road.shortest_wavelength // 1024)
    return int(points)


def _road_points(scene: Scene) -> Iterator[Breach]:
    road, points = scene.road, _random_road_points(scene)
    if isinstance(road, Iso8608RoadSection) and points > MOST_ROAD_POINTS:
        sentence = (
            f"a road of {road.length:g} m with waves down to {road.shortest_wavelength:g} m needs {points} points, "
            f"limit {MOST_ROAD_POINTS}; shorten it (it repeats) or raise shortest_wavelength"
        )
        yield Breach("road.length", sentence, ("road.shortest_wavelength",))
