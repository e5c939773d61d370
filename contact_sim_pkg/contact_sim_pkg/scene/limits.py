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
from contact_sim_pkg.scene.files import InputFile, candidates, excitations, find_file, input_files
from contact_sim_pkg.scene.resolved_scene import sha256_of
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection
from contact_sim_pkg.scene.schema.scene import Scene

BYTES_PER_CELL = 256
"""Influence tables, transforms and work arrays of a pressure field, a cell of its grid."""
MOST_CELLS_A_SIDE = 4096
MOST_SAMPLES = 10**9
"""Force samples of a run: 3600 s at 277 kHz."""


class Need(NamedTuple):
    """Memory that one part of a scene needs."""

    where: str
    what: str
    bytes: int


def limit_breaches(scene: Scene) -> Iterator[Breach]:
    """Scenes that are too large: memory, samples, cells along a side of a field."""
    yield from _samples(scene)
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
    for section, kind in excitations(scene).items():
        what, needed = kind.memory()
        if needed:
            yield Need(section, what, needed)
    for file in input_files(scene):
        path = find_file(file.name, Path(scene.file).parent)
        if path is not None:
            yield Need(file.where, f"{file.name} needs", file.reader.file_memory(path))


def file_breaches(scene: Scene) -> Iterator[Breach]:
    """Input files that are missing, unreadable, too large, or have another content than the scene
    states.
    """
    for file in input_files(scene):
        sentence = _file_fault(file, Path(scene.file).parent)
        content = getattr(file.reader, "file_fault", None)
        if not sentence and content is not None:  # a part of the scene, so it is read with it
            sentence = content(scene)
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
    try:
        # Opened once: size and kind are those of the file that was opened
        with open_regular_file(path) as stream:
            size = os.fstat(stream.fileno()).st_size
    except FileRefusedError as error:
        return f"the file {path} cannot be read: {error.strerror}"
    if size > file.reader.largest_file:
        return f"the file {path} has {size} bytes; at most {file.reader.largest_file} are allowed"
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
