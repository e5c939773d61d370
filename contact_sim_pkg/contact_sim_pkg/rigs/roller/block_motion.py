"""Tilt and yaw of the roller rig in time."""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.roller.energy import Energies
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.theory.motion import (
    DIVERGED,
    DONE,
    LARGEST_TILT,
    energies,
    gauss_rule,
    integrate_tilt_yaw,
)
from contact_sim_pkg.rigs.roller.theory.stability import stability
from contact_sim_pkg.run.errors import RunError

Matrix = NDArray[numpy.float64]

LARGEST_PHASE = 0.15
"""[rad] of the fastest motion of tilt and yaw in a step of order 6."""
MOST_PARTS = 10000
"""Steps from one given time to the next."""
SMALL_PHASE = 0.02
"""[rad] up to which order 4 errs no more."""


class TiltYaw:
    """Tilt and yaw from the static angles on."""

    STATE = State(("state", "_load", "_shifted"), ("rule",))

    def __init__(self, model: RollerModel, load: float) -> None:
        """At rest, off the static angles under `load` [N] by the start angles of the scene."""
        self.model, self.rules = model, (gauss_rule(2), gauss_rule(3))
        self.rule = self.rules[1]  # until a block chooses
        curvatures = model.programme.curvatures_at(0.0)
        found = stability(model.roller, curvatures, model.bending_at(0.0), model.modulus, load)
        tilt, yaw = found.linear.tilt + model.start[0], found.linear.yaw + model.start[1]
        self.state = numpy.array([tilt, yaw, 0.0, 0.0, 0.0, 0.0])
        self._load, self._shifted, self._start = load, 0.0, Energies()
        self._start = self.energies()
        self.fastest = max(float(abs(found.roots).max()), 1.0)

    def advance(self, start: float, times: Vector, loads: Vector) -> Matrix:
        """States [times, 4] at even `times` [s] from `start` [s] on, under `loads` [N]."""
        before = self._potential()
        self._load = float(loads[0])
        self._shifted += self._potential() - before
        self._load = float(loads[-1])
        model, length = self.model, float(times[1] - times[0])
        parts = self.parts(start, length)
        self.rule = self.rules[0 if self.fastest * length / parts <= SMALL_PHASE else 1]
        record = numpy.empty((len(times), 4))
        if model.programme.turns_bodies or model.programme.bends_shaft:
            for i in range(len(times) - 1):
                middle = start + float(times[i]) + 0.5 * length
                pair = self._integrate(
                    middle, _finer(loads[i : i + 2], parts), length / parts, 2, start + float(times[i])
                )
                record[i : i + 2] = pair
            return record
        return self._integrate(start, _finer(loads, parts), length / parts, len(times), start)

    def parts(self, start: float, length: float) -> int:
        """Steps in a `length` [s] from `start` [s] on. Raises RunError where they are too many."""
        parts = max(1, math.ceil(self.fastest * length / LARGEST_PHASE))
        if parts > MOST_PARTS:
            raise RunError(
                f"{start:.6g} s: tilt and yaw move by {self.fastest:.3g} rad/s, which takes {parts:.3g} steps in {length:.3g} s; "
                f"at most {MOST_PARTS} are taken: give larger inertias or softer springs, or leave tilt_yaw out"
            )
        return parts

    def _potential(self) -> float:
        return float(energies(self.model.roller, self._load, self.state).potential)

    def energies(self) -> Energies:
        """Since the start. A load that jumps between two phases supplies."""
        now = energies(self.model.roller, self._load, self.state)
        state = self.state
        return Energies(now.kinetic, now.potential, now.stored, float(state[5]), float(state[4]) + self._shifted).less(
            self._start
        )

    def _integrate(self, at: float, loads: Vector, step: float, rows: int, start: float) -> Matrix:
        model, record = self.model, numpy.empty((rows, 4))
        status = integrate_tilt_yaw(
            model.roller,
            model.programme.curvatures_at(at),
            model.bending_at(at),
            model.modulus,
            loads=loads,
            step=step,
            table=self.rule,
            state=self.state,
            record=record,
        )
        if status == DONE:
            return record
        # Time at which the record ends.
        if status == DIVERGED:
            place = start + step * float(numpy.flatnonzero(numpy.isnan(record[:, 0]))[0]) * (len(loads) - 1) / (
                rows - 1
            )
            raise RunError(
                f"{place:.6g} s: the roller tips over, its tilt passes {LARGEST_TILT:g} rad; a lower load, "
                "stiffer springs or more damping hold it"
            )
        raise RunError(f"{start:.6g} s: tilt and yaw are too fast for their steps of {step:.3g} s")


def _finer(loads: Vector, parts: int) -> Vector:
    rows = len(loads) - 1
    return numpy.interp(numpy.arange(rows * parts + 1) / parts, numpy.arange(rows + 1), loads)
