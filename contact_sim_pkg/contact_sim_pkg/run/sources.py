"""The excitation of a scene as sources of numbered blocks: the one place where a scene's road and
vibration are made.

A kind is imported where the scene names it: a node that sends a sine starts without what a
recording needs.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import numpy

from contact_sim_pkg.excitation.blocks import RoadBlocks, RoadLattice, Surface, VibrationBlocks
from contact_sim_pkg.excitation.borders import TurnedBeginning
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import Kind, Setting
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested


class Source(Protocol):
    """Blocks of one input topic by number, and a description of it."""

    def block(self, block: int) -> RoadPatch | VibrationBlock:
        """Block number ``block``, from 0."""

    def describe(self) -> dict[str, Any]:
        """Findings in the excitation and their treatment, for the report."""


def make_travel(scene: ResolvedScene) -> Travel:
    """Speed programme of a resolved scene."""
    assert scene.travel is not None
    points = scene.travel.points or [[0.0, scene.travel.speed or 0.0]]
    return Travel([(time, speed) for time, speed in points])


def make_sources(scene: ResolvedScene) -> dict[str, Source]:
    """Sources of the input topics that a resolved scene calls for. A road without `travel` is no
    topic: the rig reads it itself.

    Raises ExcitationError for a file that cannot be read or an excitation that cannot be made.
    """
    sources: dict[str, Source] = {}
    if scene.road is not None and scene.travel is not None:
        sources["road/patch"] = make_road(scene)
    if scene.vibration is not None:
        sources["platform/vibration"] = make_vibration(scene)
    return sources


def make_road(scene: ResolvedScene) -> RoadBlocks:
    """The road of a resolved scene, on the lattice of its tire."""
    lattice = road_lattice(scene)
    half_length = (lattice.road_rows // 2 + 1) * lattice.cell_x
    surface = make_surface(scene, lattice.cell_x)
    if isinstance(surface, TurnedBeginning):
        half_width = 0.5 * (lattice.road_cols - 1) * lattice.cell_y
        surface.refuse_steep_track(numpy.linspace(-half_width, half_width, lattice.road_cols, dtype=numpy.float64))
    blocks = RoadBlocks(
        surface, make_travel(scene), scene.block_length, lattice.cell_x, lattice.cell_y, half_length, lattice.road_cols
    )
    if isinstance(surface, TurnedBeginning):
        blocks.refuse_short_road(scene.duration)
    return blocks


def road_lattice(scene: ResolvedScene) -> RoadLattice:
    """The strip of road that the rig of a resolved scene needs."""
    lattice: RoadLattice = load(rigs()[scene.rig].road_strip)(scene.data)
    return lattice


def make_surface(scene: ResolvedScene, cell: float) -> Surface:
    """The surface of a resolved scene's road; `cell` [m] is the finest spacing at which it is
    asked. Raises ExcitationError.
    """
    road = scene.road
    assert road is not None
    with _named(road, "road"):
        surface = road.surface(_setting(scene, "road", road, cell))
        if _is_foreign(road):
            _try_surface(surface, cell)
    return surface


def make_vibration(scene: ResolvedScene) -> VibrationBlocks:
    """The vibration of a resolved scene."""
    vibration = scene.vibration
    assert vibration is not None
    with _named(vibration, "vibration"):
        signal = vibration.signal(_setting(scene, "vibration", vibration))
        if _is_foreign(vibration):
            signal.describe()
            forward, up = signal.acceleration(numpy.array([0.0, 1.0 / vibration.sample_rate]))
            if numpy.shape(forward) != (2,) or numpy.shape(up) != (2,):
                raise TypeError("acceleration does not give two arrays of one value a time")
    return VibrationBlocks(signal, scene.block_length, vibration.sample_rate)


def _is_foreign(kind: Kind) -> bool:
    return not type(kind).__module__.startswith("contact_sim_pkg.")


@contextmanager
def _named(kind: Kind, section: str) -> Iterator[None]:
    """What the kind of another package raises, as a sentence that names it; ours raise what they say."""
    try:
        yield
    except Exception as error:
        if isinstance(error, (ExcitationError, OSError)) or not _is_foreign(kind):
            raise
        raise ExcitationError(
            f"{section} {kind.kind} of the plug-in {type(kind).__module__} fails: {type(error).__name__}: {error}"
        ) from error


def _try_surface(surface: Surface, cell: float) -> None:
    """Ask the surface of another package once for what every run asks it."""
    surface.describe()
    heights = surface.heights(numpy.array([0.0, cell]), numpy.array([-cell, 0.0, cell]))
    if numpy.shape(heights) != (2, 3):
        raise TypeError(f"heights at 2 x and 3 y have the shape {numpy.shape(heights)}, not (2, 3)")


def _setting(scene: ResolvedScene, section: str, kind: Kind, cell: float = 0.0) -> Setting:
    file = None if kind.input_file() is None else scene.file_path(f"{section}.file")
    unused = rigs()[scene.rig].unused_axes(scene.data["effects"])
    return Setting(scene.seed, scene.duration, requested(scene.accuracy), file, cell, unused)
