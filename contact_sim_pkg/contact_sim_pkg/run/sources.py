"""The excitation of a scene as sources of numbered blocks: the one place where a scene's road and
vibration are made.

Kinds of excitation are imported where they are made: a node that sends a sine starts without what a
recording needs.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Protocol

import numpy

from contact_sim_pkg.excitation.blocks import RoadBlocks, RoadLattice, Signal, Surface, VibrationBlocks
from contact_sim_pkg.excitation.borders import TurnedBeginning
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested

if TYPE_CHECKING:
    from contact_sim_pkg.excitation.signals import Waveform
    from contact_sim_pkg.scene.schema.vibration import SweepSection, Vibration

BORDER_NAMES = {"refuse": "none", "zero": "zero", "keep": "constant", "repeat": "repeat", "reflect": "reflect"}
USUAL_RATES = (1000, 2000, 2500, 4000, 5000, 10_000, 12_500, 20_000, 25_000, 40_000, 50_000, 100_000)
"""[Hz] of samples, a whole number of nanoseconds apart."""


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
    if road.kind == "iso8608":
        from contact_sim_pkg.excitation.iso8608 import Iso8608Road, roughness_of_class

        roughness = road.roughness if road.roughness_class is None else roughness_of_class(road.roughness_class)
        assert roughness is not None
        return Iso8608Road(
            roughness, scene.seed, road.length, road.exponent,
            shortest_wavelength=road.shortest_wavelength, longest_wavelength=road.longest_wavelength,
            texture_wavelength=None if road.texture is None else road.texture.shortest_wavelength, lattice_cell=cell,
        )  # fmt: skip
    if road.kind == "self_affine":
        from contact_sim_pkg.excitation.self_affine import SelfAffineRoad

        waves = (road.longest_wavelength, road.shortest_wavelength)
        return SelfAffineRoad(road.hurst, road.rms, *waves, scene.seed, lattice_cell=cell)
    if road.kind == "opencrg":
        from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad

        grid = OpenCrgRoad(
            scene.file_path("road.file"), start=road.start, lateral_offset=road.track_offset, missing=road.missing_cells,
            hole_depth=road.hole_depth, border_u=BORDER_NAMES[road.border_u], border_v=BORDER_NAMES[road.border_v],
            level="mean" if road.remove_mean else "origin", file_settings=road.file_settings,
        )  # fmt: skip
        return TurnedBeginning(grid)
    if road.kind == "profile":
        from contact_sim_pkg.excitation.profile.road import ProfileRoad

        profile = ProfileRoad(
            scene.file_path("road.file"), start=road.start, track_offset=road.track_offset, track_width=road.track_width,
            border_u=BORDER_NAMES[road.border_u], level="mean" if road.remove_mean else "origin", header_line=road.header_line,
        )  # fmt: skip
        return TurnedBeginning(profile)
    from contact_sim_pkg.excitation.obstacles import FlatRoad, Obstacle

    if road.kind == "flat":
        return FlatRoad()
    if road.kind == "step":
        return Obstacle(road.kind, road.position, road.height, road.length)
    if road.kind == "bump":
        return Obstacle(road.kind, road.position, road.height, road.length, period=road.period)
    height = road.depth if road.kind == "pothole" else road.height
    return Obstacle(road.kind, road.position, height, road.length, road.edge, road.period)


def make_vibration(scene: ResolvedScene) -> VibrationBlocks:
    """The vibration of a resolved scene."""
    vibration = scene.vibration
    assert vibration is not None
    return VibrationBlocks(_signal(scene, vibration), scene.block_length, vibration.sample_rate)


def _signal(scene: ResolvedScene, vibration: Vibration) -> Signal:
    if vibration.kind == "recorded":
        from contact_sim_pkg.excitation.recorded import RecordedVibration

        recording = RecordedVibration(
            scene.file_path("vibration.file"), vibration.rate, vibration.vertical_column, vibration.forward_column,
            time=vibration.time_column, tilt="correct" if vibration.correct_tilt else "keep", beyond=vibration.beyond,
            start=vibration.start, sample_rate=vibration.sample_rate,
            unused=rigs()[scene.rig].unused_axes(scene.data["effects"]), unit=vibration.unit,
            lateral=vibration.lateral_column, time_unit=vibration.time_unit,
            header_line=vibration.header_line,
        )  # fmt: skip
        recording.refuse_longer_run(scene.duration)
        return recording
    from contact_sim_pkg.excitation.signals import AxisSignal, HalfSine, NoiseSignal, Sine, SweepSignal

    wave: Waveform
    fastest = 0.0  # [Hz] of a sine, whose samples are joined by straight lines
    if vibration.kind == "sine":
        wave, fastest = Sine(vibration.amplitude, vibration.frequency), vibration.frequency
    elif vibration.kind == "noise":
        wave = NoiseSignal(vibration.rms, vibration.low, vibration.high, scene.seed)
    elif vibration.kind == "half_sine":
        wave = HalfSine(vibration.amplitude, vibration.start, vibration.duration)
    else:
        wave = SweepSignal(
            vibration.amplitude, vibration.start_frequency, vibration.end_frequency, _sweep_duration(vibration)
        )
        fastest = max(vibration.start_frequency, vibration.end_frequency)
    notes = _notes(fastest, vibration.sample_rate, requested(scene.accuracy))
    return AxisSignal(x=(wave,), notes=notes) if vibration.axis == "x" else AxisSignal(z=(wave,), notes=notes)


def _sweep_duration(sweep: SweepSection) -> float:
    """Time [s] from the start frequency to the end frequency: as given, else by the octaves per
    minute.
    """
    if sweep.duration is not None:
        return sweep.duration
    assert sweep.octaves_per_minute is not None
    return 60.0 * abs(math.log2(sweep.end_frequency / sweep.start_frequency)) / sweep.octaves_per_minute


def _notes(fastest: float, rate: float, accuracy: float) -> list[str]:
    """Sentence where straight lines between the samples are less accurate than requested: ``1 -
    cos(pi f / rate)`` of a sine.
    """
    off = 1.0 - math.cos(math.pi * fastest / rate)
    if off <= accuracy:
        return []
    needed = math.pi * fastest / math.acos(1.0 - accuracy)
    enough = next((each for each in USUAL_RATES if each >= needed), USUAL_RATES[-1])
    sentence = (
        f"The excitation is straight between its {rate:g} samples a second, at {fastest:g} Hz up to {off:.2g} of its amplitude "
        f"off; vibration.sample_rate: {enough} leaves {1.0 - math.cos(math.pi * fastest / enough):.2g}."
    )
    return [sentence]
