"""The tracks of the roller rig: whose they are, their heights, and what wears them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.roller.damage import Table, damage_table
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.schema import Damage, TrackWaves
from contact_sim_pkg.rigs.roller.theory.corrugation import WearTrack, make_track, moving_mean
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact

__all__ = ["BodyTrack", "hardness_round", "make_tracks", "track_under"]


@dataclass
class BodyTrack:
    """A body's track: what changes is its heights and what it has lost."""

    body: str  # "shaft" or "roller"
    radius: float  # [m]
    turn_time: float  # [s]
    turns: int  # of an interval
    heights: Vector  # [cells] [m]
    hardness: Vector  # [cells]
    table: Table
    track: WearTrack
    loads: Vector  # [cells] [N] of the last interval
    axial: Vector  # [cells] [m] x_c of the last interval; none where the tilt is fixed
    turned: int = 0
    lowered: float = 0.0  # [m]

    STATE: ClassVar[State] = State(("heights", "loads", "axial", "turned", "lowered", "track"))

    def copy(self) -> BodyTrack:
        """With heights of its own."""
        return replace(self, heights=self.heights.copy(), loads=self.loads.copy())

    def shift(self, places: Vector) -> None:
        """Take the places x_c [m] of the contact over an interval, as `loads`: means over its
        turns.
        """
        self.axial = places.reshape(self.turns, -1).mean(axis=0)

    @property
    def range(self) -> float:
        """Highest less lowest cell [m]."""
        return float(numpy.ptp(self.heights))

    def ridden(self) -> Vector:
        """[cells] [m] heights as the roller feels them: their mean over the contact."""
        out = numpy.zeros_like(self.heights)
        moving_mean(self.heights, self.track.contact_cells, out)
        return out


def make_tracks(model: RollerModel) -> list[BodyTrack]:
    """The tracks of a scene at its start, the shaft's first; measures the dangerous volumes where
    the scene has damage.
    """
    effect = given(model.track_waves)
    which, cells = effect.track, effect.cells
    radii = {"shaft": model.shaft_radius, "roller": model.roller.radius}
    bodies = ("shaft", "roller") if which == "both" else (which,)
    # On the larger of two bodies the cells are as long as on the smaller.
    least, most = (pick(radii[body] for body in bodies) for pick in (min, max))
    found: list[BodyTrack] = []
    for body in bodies:
        number = cells * round(radii[body] / least)
        # The seed's waves are on the first body alone, roughness on each.
        heights = _first_heights(effect, [model.seed, 1] if found else model.seed, number, waves=not found)
        table = damage_table(model, body)
        turn_time = model.turn_time * radii[body] / model.shaft_radius
        hardness = hardness_round(model.damage, body, number)
        track = make_track(
            radius=radii[body],
            turn_time=turn_time,
            cells=number,
            contact_length=0.0,
            gain=0.0,
            approach=0.0,
            table=table,
            hardness=hardness,
        )
        turns = round(most / radii[body])
        found.append(
            BodyTrack(
                body=body,
                radius=radii[body],
                turn_time=turn_time,
                turns=turns,
                heights=heights,
                hardness=hardness,
                table=table,
                track=track,
                loads=numpy.zeros(number),
                axial=numpy.zeros(0),
            )
        )
    return found


def track_under(track: BodyTrack, contact: RollingContact, gain: float) -> WearTrack:
    """Wear track of a body under the contact of the load pressed on; gain: gamma [1]."""
    return make_track(
        radius=track.radius,
        turn_time=track.turn_time,
        cells=len(track.heights),
        contact_length=2.0 * contact.along_y,
        gain=gain,
        approach=contact.approach,
        table=track.table,
        hardness=track.hardness,
    )


def _first_heights(effect: TrackWaves, seed: int | list[int], cells: int, waves: bool) -> Vector:
    heights = effect.roughness * numpy.random.default_rng(seed).uniform(-1.0, 1.0, cells)
    place = 2.0 * math.pi * numpy.arange(cells) / cells
    for amplitudes, wave in ((effect.cosines, numpy.cos), (effect.sines, numpy.sin)) if waves else ():
        for number, amplitude in enumerate(amplitudes, start=1):
            heights += amplitude * wave(number * place)
    level: Vector = heights - heights.mean()
    return level


def hardness_round(damage: Damage | None, body: str, cells: int) -> Vector:
    """Limits [cells] round a track over those of `subsurface`: straight between the given places, 1
    where none are given.
    """
    limits = [] if damage is None else damage.roller_hardness if body == "roller" else damage.hardness
    limits = limits or [1.0]
    places = numpy.arange(cells, dtype=numpy.float64) / cells * len(limits)
    hardness: Vector = numpy.interp(places, numpy.arange(len(limits) + 1), [*limits, limits[0]])
    return hardness
