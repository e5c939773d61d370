"""What moves in the roller rig, block by block: heave over the track with its wear, and tilt and yaw."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.roller.corrugation import Track, make_track, moving_mean, run_intervals
from contact_sim_pkg.core.roller.heave import Heave, make_heave, natural_frequency
from contact_sim_pkg.core.roller.motion import DIVERGED, DONE, LARGEST_TILT, gauss_rule, march
from contact_sim_pkg.core.roller.stability import stability
from contact_sim_pkg.core.roller.volumes import box_volume, dangerous_volumes
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.build_roller import RollerModel

Matrix = NDArray[numpy.float64]

STAGES = 3
LARGEST_PHASE = 0.15
"""[rad] of the fastest motion of tilt and yaw in a step: of order 6, 1e-9 of the growth rate's frequency."""


@dataclass
class Ridden:
    """A block of the ride, cell by cell."""

    time: Vector  # [cells of all turns + 1] [s] from the start of the block
    load: Vector  # [N]
    heave: Vector  # [m]
    speed: Vector  # [m/s]
    free: float  # share of the time without contact


class TrackRide:
    """The track, its wear, and the heave of the roller on it."""

    def __init__(self, model: RollerModel) -> None:
        """Heights at the start; measures the dangerous volumes where the scene asks for damage."""
        effect = model.effects["track_waves"]
        self.model, self.zeta = model, float(effect["damping_ratio"])
        self.turns_a_block = round(model.timing.block_length / model.turn_time)
        self.heights = _first_heights(effect, model.seed)
        self.state, self.loads = numpy.zeros(2), numpy.zeros(len(self.heights))
        self.motion = numpy.zeros((len(self.heights), 2))
        self.turns, self.lowered, self.range, self.free = 0, 0.0, float(numpy.ptp(self.heights)), 0.0
        self.curvatures = model.programme.curvatures_at(0.0)
        self.table = damage_table(model)
        self.ended = False
        self._load = math.nan
        self._set_load(self._load_at(0))

    def _load_at(self, block: int) -> float:
        return float(self.model.programme.loads(numpy.array([block * self.model.timing.block_length]))[0])

    def _set_load(self, load: float) -> None:
        if load == self._load:
            return
        self._load = load
        model = self.model
        one = model.contact(1.0, 0.0, self.curvatures)
        here = model.contact(load, 0.0, self.curvatures)
        self.heave: Heave = make_heave(model.mass, self.zeta, load, one.approach, model.bending_compliance)
        damage = model.effects.get("damage")
        gain = 0.0 if damage is None else float(damage["gain"]) * model.acceleration
        self.track: Track = make_track(
            model.shaft_radius, model.turn_time, len(self.heights), 2.0 * here.along_y, gain, here.approach, self.table
        )

    def advance(self, block: int) -> Ridden:
        """All turns of a block, an interval each. Raises RunError where the range of the track passes its limit."""
        self._set_load(self._load_at(block))
        loads, motions = [], []
        self.free = 0.0
        for _ in range(self.turns_a_block):
            found = run_intervals(self.heave, self.track, 1, 1, self.heights, self.state, self.loads, self.motion)
            loads.append(self.loads.copy())
            motions.append(self.motion.copy())
            self.turns += 1
            self.lowered += found.lowered
            self.range = found.range
            self.free += found.free / self.turns_a_block
            if found.ended:
                raise RunError(
                    f"block {block}: the track is {found.range:.4g} m deep after {self.turns * self.model.acceleration:.6g} "
                    f"cycles, more than {self.track.largest_range:.4g} m: used up"
                )
        load, motion = numpy.concatenate(loads), numpy.concatenate(motions)
        time: Vector = numpy.arange(len(load) + 1, dtype=numpy.float64) * (self.model.timing.block_length / len(load))
        end = numpy.append(load, load[-1])
        heave, speed = numpy.vstack([motion, self.state]).T
        return Ridden(time, end, heave, speed, self.free)

    @property
    def frequency(self) -> float:
        """kappa [rad/s]."""
        return float(natural_frequency(self.heave))

    @property
    def ridden_track(self) -> Vector:
        """[cells] [m] heights as the roller feels them."""
        out = numpy.zeros_like(self.heights)
        moving_mean(self.heights, self.track.contact_cells, out)
        return out


def _first_heights(effect: dict[str, Any], seed: int) -> Vector:
    cells, size = int(effect["cells"]), float(effect["roughness"])
    heights = size * numpy.random.default_rng(seed).uniform(-1.0, 1.0, cells)
    place = 2.0 * math.pi * numpy.arange(cells) / cells
    for name, wave in (("cosines", numpy.cos), ("sines", numpy.sin)):
        for number, amplitude in enumerate(effect[name], start=1):
            heights += amplitude * wave(number * place)
    level: Vector = heights - heights.mean()
    return level


def damage_table(model: RollerModel) -> tuple[Vector, Vector]:
    """Loads [N] from 0, and the dangerous share of the working volume under each; two rows of zeros without damage."""
    damage, below = model.effects.get("damage"), model.effects.get("subsurface")
    if damage is None or below is None:
        return numpy.array([0.0, 1.0]), numpy.zeros(2)
    curvatures = model.programme.curvatures_at(0.0)
    first = float(model.programme.load[0])
    working = box_volume(model.contact(first, 0.0, curvatures))
    loads = numpy.linspace(0.0, float(damage["largest_load"]) * model.largest_load, int(damage["table_rows"])).astype(
        numpy.float64
    )
    shares = [0.0]
    for load in loads[1:]:
        contact = model.contact(float(load), 0.0, curvatures)
        volumes = dangerous_volumes(contact, model.poisson_ratio, *volume_settings(below))
        shares.append(volumes.any / working)
    return loads, numpy.array(shares, dtype=numpy.float64)


def volume_settings(
    below: dict[str, float],
) -> tuple[tuple[float, float], tuple[int, int, int], None, tuple[float, float]]:
    """Limits, cells, no bending, traction of the effect `subsurface`, as `dangerous_volumes` takes them."""
    limits = (float(below["normal_limit"]), float(below["shear_limit"]))
    cells = (int(below["cells_x"]), int(below["cells_y"]), int(below["cells_z"]))
    return limits, cells, None, (float(below["traction_x"]), float(below["traction_y"]))


class TiltYaw:
    """Tilt and yaw from the static angles on."""

    def __init__(self, model: RollerModel, load: float) -> None:
        """At rest, off the static angles under `load` [N] by what the scene says."""
        self.model, self.rule = model, gauss_rule(STAGES)
        curvatures = model.programme.curvatures_at(0.0)
        found = stability(model.roller, curvatures, model.bending, model.modulus, load)
        tilt, yaw = found.linear.tilt + model.start[0], found.linear.yaw + model.start[1]
        self.state = numpy.array([tilt, yaw, 0.0, 0.0])
        self.fastest = max(float(abs(found.roots.imag).max()), 1.0)

    def advance(self, start: float, times: Vector, loads: Vector) -> Matrix:
        """States [times, 4] at even `times` [s] from the start of the block at `start` [s], under `loads` [N]."""
        model, length = self.model, float(times[1] - times[0])
        parts = max(1, math.ceil(self.fastest * length / LARGEST_PHASE))
        record = numpy.empty((len(times), 4))
        if model.programme.turns_bodies:
            for i in range(len(times) - 1):
                middle = start + float(times[i]) + 0.5 * length
                pair = self._march(middle, _finer(loads[i : i + 2], parts), length / parts, 2, start + float(times[i]))
                record[i : i + 2] = pair
            return record
        return self._march(start, _finer(loads, parts), length / parts, len(times), start)

    def _march(self, at: float, loads: Vector, step: float, rows: int, start: float) -> Matrix:
        model, record = self.model, numpy.empty((rows, 4))
        status = march(
            model.roller, model.programme.curvatures_at(at), model.bending, model.modulus, loads, step, self.rule,
            self.state, record,
        )  # fmt: skip
        if status == DONE:
            return record
        if status == DIVERGED:
            place = start + step * float(numpy.flatnonzero(numpy.isnan(record[:, 0]))[0]) * (len(loads) - 1) / (
                rows - 1
            )
            raise RunError(f"{place:.6g} s: the roller tips over, its tilt passes {LARGEST_TILT:g} rad")
        raise RunError(f"{start:.6g} s: tilt and yaw are too fast for their steps of {step:.3g} s")


def _finer(loads: Vector, parts: int) -> Vector:
    rows = len(loads) - 1
    return numpy.interp(numpy.arange(rows * parts + 1) / parts, numpy.arange(rows + 1), loads)
