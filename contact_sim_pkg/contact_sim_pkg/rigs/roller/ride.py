"""The roller's ride over its tracks, interval by interval: heave, wear, energy, and the error of
the time acceleration.
"""

from __future__ import annotations

import copy
import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.roller.energy import Energies
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.theory.corrugation import moving_mean, wear
from contact_sim_pkg.rigs.roller.theory.ellipse import local_coefficients
from contact_sim_pkg.rigs.roller.theory.heave import (
    LARGEST_PHASE,
    Heave,
    Path,
    contact_energy,
    make_heave,
    natural_frequency,
    ride,
)
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach
from contact_sim_pkg.rigs.roller.wear import make_tracks, track_under
from contact_sim_pkg.run.errors import RunError

__all__ = ["Checked", "Ridden", "TrackRide", "joined"]

JUMPS = 4
"""Accelerated intervals of a check, at most."""
MOST_STEPS = 1000
"""Steps of the heave in a cell."""
MOST_CHECKED = 1000
"""Intervals that a check rides one by one, at most."""


class Ridden(NamedTuple):
    """A segment of the ride, cell by cell."""

    time: Vector  # [cells + 1] [s] from its start
    load: Vector  # [N]
    heave: Vector  # [m]
    speed: Vector  # [m/s]
    free: float  # share of the time without contact


def joined(parts: list[Ridden]) -> Ridden:
    """One section of several that follow each other; the place between two is the end of the
    first.
    """
    time, load, heave, speed = (
        numpy.concatenate([rows[0], *(row[1:] for row in rows[1:])])
        for rows in zip(*(part[:4] for part in parts), strict=True)
    )
    return Ridden(time, load, heave, speed, sum(part.free for part in parts) / len(parts))


class Checked(NamedTuple):
    """The time acceleration beside the same section ridden one by one."""

    intervals: int
    error: float  # of the change of heights, rms, over the change; NaN where nothing changes


class TrackRide:
    """The tracks, their wear, and the heave of the roller on them. An interval is a turn of the
    (larger) body with a track.
    """

    STATE = State((
        "tracks", "intervals", "state", "loads", "motion", "curvatures", "free", "heave", "_pressed", "_yaw", "_height",
        "_coefficient", "_shifted",
    ))  # fmt: skip

    def __init__(self, model: RollerModel, road: Surface | None) -> None:
        """Heights at the start; `road` is ridden as well."""
        effect = given(model.track_waves)
        self.model, self.road, self.zeta = model, road, effect.damping_ratio
        self.local = effect.local_curvature == "on"
        self.acceleration = model.acceleration
        self.tracks = make_tracks(model)
        self.cells = max(len(each.heights) for each in self.tracks)
        # A block holds whole turns, to the rounding that the scene's rules allow
        self.intervals_a_block = round(model.timing.block_length / max(each.turn_time for each in self.tracks))
        self.interval_time = model.timing.block_length / self.intervals_a_block
        self.intervals = 0
        self.state, self.loads = numpy.zeros(4), numpy.zeros(self.cells)
        self.motion = numpy.zeros((self.cells, 2))
        self.curvatures = model.programme.curvatures_at(0.0)
        self.free = 0.0
        self._pressed: tuple[float, float] | None = None
        self._height, self._coefficient = 0.0, 0.0  # under the roller
        self._shifted, self._start = 0.0, Energies()
        self._road_start = 0.0 if road is None else float(road.heights(numpy.zeros(1), numpy.zeros(1))[0, 0])
        self.press(float(model.programme.load[0]), model.start[1])
        self._start = self.energies()

    def copy(self) -> TrackRide:
        """A ride of its own from here."""
        other = copy.copy(self)
        other.tracks = [each.copy() for each in self.tracks]
        other.state, other.loads, other.motion = self.state.copy(), self.loads.copy(), self.motion.copy()
        return other

    def press(self, load: float, yaw: float) -> None:
        """Press on with another load [N], at a yaw [rad]. The roller moves to its new place at
        rest.
        """
        if (load, yaw) == self._pressed:
            return
        model = self.model
        one, here = model.contact(1.0, yaw, self.curvatures), model.contact(load, yaw, self.curvatures)
        before = None if self._pressed is None else self._stored()
        self.heave: Heave = make_heave(model.mass, self.zeta, load, one.approach, model.bending_compliance)
        gain = 0.0 if model.damage is None else model.damage.gain * self.acceleration
        for each in self.tracks:
            each.track = track_under(each, here, gain)
        self._pressed, self._yaw = (load, yaw), yaw
        self._coefficient = one.approach
        if before is not None:
            self._shifted += self._stored() - before

    def advance(self) -> Ridden:
        """An interval. Raises RunError where the range of a track passes its limit, or a place is
        too hollow to touch.
        """
        self.refuse_fast_heave()
        path = self._path()
        # The start of this interval lies on the worn track: its change supplies energy.
        before = self._stored()
        self._height, self._coefficient = float(path.height[0]), float(path.coefficient[0])
        self._shifted += self._stored() - before
        cell_time = self.interval_time / self.cells
        # Heave over the interval.
        self.free = ride(self.heave, path, cell_time, 1, self.state, self.loads, self.motion)
        self._height, self._coefficient = float(path.height[-1]), float(path.coefficient[-1])
        self.intervals += 1
        for each in self.tracks:
            # Wear of each track by the loads on its cells.
            each.loads = self.loads.reshape(each.turns, -1).mean(axis=0)
            each.turned += each.turns
            each.lowered += wear(each.track, float(each.turns), each.loads, each.heights).lowered
            if not each.range <= each.track.largest_range:
                raise RunError(
                    f"{self.intervals * self.interval_time:.6g} s: the track of the {each.body} is {each.range:.4g} m deep after "
                    f"{each.turned * self.acceleration:.6g} cycles, more than {each.track.largest_range:.4g} m: used up; a lower "
                    "damage.gain or roller.acceleration, or a shorter duration, ends before"
                )
        # Course of the interval.
        heave, speed = numpy.vstack([self.motion, self.state[:2]]).T
        time: Vector = numpy.arange(self.cells + 1, dtype=numpy.float64) * cell_time
        return Ridden(time, numpy.append(self.loads, self._load()), heave, speed, self.free)

    def refuse_fast_heave(self) -> None:
        """Raise RunError where the roller swings too fast for the steps of a cell."""
        phase = self.frequency * self.interval_time / self.cells
        if not phase <= LARGEST_PHASE * MOST_STEPS:
            at, most = self.intervals * self.interval_time, LARGEST_PHASE * MOST_STEPS
            raise RunError(
                f"{at:.6g} s: the heave swings by {self.frequency:.3g} rad/s, {phase:.3g} rad in a cell of the track; "
                f"at most {most:g} are simulated: give a larger mass, more cells or a higher speed"
            )

    def _path(self) -> Path:
        """Heights under the roller in the next interval, and k_c there."""
        places = numpy.arange(-1, self.cells + 2)
        heights = numpy.zeros(self.cells + 3)
        for each in self.tracks:
            mean = numpy.zeros(len(each.heights))
            moving_mean(each.heights, each.track.contact_cells, mean)
            heights += mean[places % len(mean)]
        cell_time = self.interval_time / self.cells
        speed = 2.0 * math.pi * self.model.shaft_radius / self.model.turn_time
        if self.road is not None:
            x: Vector = speed * (self.intervals * self.interval_time + cell_time * places.astype(numpy.float64))
            ahead = numpy.maximum(x, 0.0)  # no road lies behind its start
            heights += self.road.heights(ahead, numpy.zeros(1))[:, 0] - self._road_start
        coefficient = numpy.full(self.cells + 1, self.heave.contact_coefficient)
        if self.local:
            bends = numpy.diff(heights, 2) / (speed * cell_time) ** 2
            case = (self.curvatures, self._yaw, self.model.modulus, self.model.kind, bends, coefficient)
            if not local_coefficients(*case):
                raise RunError(
                    f"{self.intervals * self.interval_time:.6g} s: the track is hollow by {bends.max():.6g} 1/m, more than "
                    "roller and shaft are round: no elliptic contact; leave local_curvature off, or take fewer cells"
                )
        return Path(numpy.ascontiguousarray(heights[1:-1]), coefficient)

    def _load(self) -> float:
        rest = self.heave.contact_coefficient * self.heave.load ** (2.0 / 3.0)
        rest += self.heave.bending_compliance * self.heave.load
        approach = rest + self._height - float(self.state[0])
        return float(load_of_approach(self._coefficient, self.heave.bending_compliance, approach))

    def _stored(self) -> float:
        """Stored and potential energy [J]."""
        stored = contact_energy(self._coefficient, self.heave.bending_compliance, self._load())
        return float(stored) + self.heave.load * float(self.state[0])

    def energies(self) -> Energies:
        """Of the heave, since the start. What moves the roller or the track between two intervals
        counts as supplied.
        """
        stored = float(contact_energy(self._coefficient, self.heave.bending_compliance, self._load()))
        kinetic = 0.5 * self.model.mass * float(self.state[1]) ** 2
        now = Energies(
            kinetic,
            self.heave.load * float(self.state[0]),
            stored,
            float(self.state[3]),
            float(self.state[2]) + self._shifted,
        )
        return now.less(self._start)

    def accelerate(self, acceleration: float) -> None:
        """Let each turn that is ridden stand for another number."""
        self.acceleration = acceleration
        pressed, self._pressed = self._pressed, None
        if pressed is not None:
            self.press(*pressed)

    def check(self) -> Checked | None:
        """A section from here by the time acceleration and one by one; None where none acts, or it
        is too long to ride.
        """
        jumps = min(JUMPS, int(MOST_CHECKED / self.acceleration))
        if self.acceleration == 1.0 or jumps < 1:
            return None
        fast, slow = self.copy(), self.copy()
        count = round(jumps * self.acceleration)
        slow.accelerate(jumps * self.acceleration / count)
        try:
            for _ in range(jumps):
                fast.advance()
            for _ in range(count):
                slow.advance()
        except (RunError, ExcitationError):  # worn out, or the road ends in the section
            return Checked(count, math.nan)
        starts, ends, others = (
            numpy.concatenate([each.heights for each in side.tracks]) for side in (self, slow, fast)
        )
        change = float(numpy.linalg.norm(ends - starts))
        return Checked(count, float(numpy.linalg.norm(others - ends)) / change if change > 0.0 else math.nan)

    @property
    def frequency(self) -> float:
        """kappa [rad/s]."""
        return float(natural_frequency(self.heave))
