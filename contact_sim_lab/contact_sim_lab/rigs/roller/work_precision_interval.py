"""Work-precision study of the interval procedure: one turn of the track stands for many; against
every turn ridden.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, row, timed_once
from contact_sim_lab.rigs.roller.paper_bench import (
    BENDING_COMPLIANCE,
    CURVATURES,
    LOAD,
    MASS,
    MODULUS,
    SHAFT_RADIUS,
)
from contact_sim_pkg.rigs.roller.theory.corrugation import Interval, WearTrack, make_track, run_intervals
from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.heave import Heave, make_heave

__all__ = ["PART", "WORK_PRECISION", "hour", "rows"]

PART = "interval procedure"

Values = NDArray[numpy.float64]

CELLS, RATE = 256, 200.0  # round the track, turns of the shaft in a second
TURNS = 4000
JUMPS = (10, 100, 500)
GAIN = 2e-4  # of a turn
LOADS = numpy.array([0.0, 30.0, 60.0, 100.0, 150.0, 200.0, 300.0])
SHARES = numpy.array([0.0, 0.028, 0.079, 0.171, 0.315, 0.482, 0.9])
"""Dangerous share of the working volume of the bench under these loads, rounded."""
STARTS = {"wave of 0.1 µm": 1e-7, "wave of 10 µm": 1e-5, "wave of 20 µm, the roller leaves the track": 2e-5}


def _bench() -> tuple[Heave, WearTrack]:
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    heave = make_heave(MASS, 0.05, LOAD, contact.approach / LOAD ** (2.0 / 3.0), BENDING_COMPLIANCE)
    width, table = 2.0 * contact.along_y, (LOADS, SHARES)
    return heave, make_track(SHAFT_RADIUS, 1.0 / RATE, CELLS, width, GAIN, contact.approach, table)


def _ridden(heave: Heave, track: WearTrack, jump: int, intervals: int, heights: Values, state: Values) -> Interval:
    """Each interval rides one turn that wears as `jump`."""
    loads, motion = numpy.zeros(CELLS), numpy.zeros((CELLS, 2))
    return run_intervals(heave, track._replace(gain=track.gain * jump), 1, intervals, heights, state, loads, motion)


def rows() -> list[Row]:
    """Change of the heights over 20 s of the rig, rms, over the change with every turn ridden; time
    of a second of the rig.
    """
    heave, track = _bench()
    found = []
    for case, size in STARTS.items():
        first = size * numpy.cos(4.0 * math.pi * numpy.arange(CELLS) / CELLS)
        settled = numpy.zeros(2)
        _ridden(heave, track._replace(gain=0.0), 1, 200, first, settled)

        def run(jump: int, first: Values = first, settled: Values = settled) -> Values:
            heights, state = first.copy(), settled.copy()
            _ridden(heave, track, jump, TURNS // jump, heights, state)
            return heights - first

        right, cost = timed_once(lambda run=run: run(1))  # type: ignore[misc]
        change = float(numpy.linalg.norm(right))
        reference = f"every turn ridden, {cost * RATE / TURNS:.3g} ms a second of the rig"
        for jump in JUMPS:
            value, cost = timed_once(lambda run=run, jump=jump: run(jump))  # type: ignore[misc]
            fidelity = FidelityLevel(f"a turn stands for {jump}", cost * RATE / TURNS, f"{CELLS} cells")
            error = float(numpy.linalg.norm(value - right)) / change
            found.append(row(PART, case, f"change over {TURNS} turns", fidelity, reference, error))
    return found


def hour(jump: int) -> float:
    """Computing time [s] of an hour of the rig, heave and wear: 720 000 turns, one ridden for each
    `jump`.
    """
    heave, track = _bench()
    heights = 1e-9 * numpy.random.default_rng(1).uniform(-1.0, 1.0, CELLS)
    _ridden(heave, track, jump, 1, heights, numpy.zeros(2))
    intervals = round(3600.0 * RATE / jump)
    _, cost = timed_once(lambda: _ridden(heave, track, jump, intervals, heights, numpy.zeros(2)))
    return 1e-3 * cost


WORK_PRECISION = (WorkPrecision(PART, rows),)
