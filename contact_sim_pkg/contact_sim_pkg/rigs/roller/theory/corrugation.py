"""The paper's interval procedure (figure 15): the track wears where its dangerous volume is large,
and waves may grow from that.

An interval is `turns` turns of the track. The roller rides it (`rigs/roller/theory/heave.py`), the
loads met give the share of dangerous volume `omega(F)` of each cell, and the track is lowered where
it is above the mean:

    w_j <- w_j - gamma delta(F_N) turns (omega_j - mean omega)

The mean lowers the whole track and is counted separately. W, which the roller rides, is the mean of
w over the length of the contact, straight between the cells; the length need not be whole cells.
Where the hardness c of a cell raises the limits, `omega_c(F) = c^3 omega(F / c^3)`: stress scales
with F^(1/3), the volume that bears it with F. Small waves of n_w round the track, Omega_w = 2 pi
n_w turns/s, grow by `growth_of_wave` a turn.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import (
    require,
    require_count,
    require_not_negative,
    require_positive,
    require_values,
)
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.roller.theory.heave import Heave, Path, linear_stiffness, natural_frequency, ride

__all__ = [
    "Interval",
    "Wear",
    "WearTrack",
    "growth_of_wave",
    "make_track",
    "mean_weights",
    "moving_mean",
    "run_intervals",
    "wear",
]

Values = NDArray[numpy.float64]

STRAIN = 0.14
"""Radial strain of the track at which the paper's specimen was used up."""


class WearTrack(NamedTuple):
    """What a track feels and how it answers."""

    turn_time: float  # [s] of one turn
    contact_cells: float  # of the moving mean: length of the contact over that of a cell
    gain: float  # gamma [1]; 0: the track stays as it is
    approach: float  # delta(F_N) [m]
    table_loads: Values  # [n] [N], rising from 0
    table_shares: Values  # [n] omega of these, [1]
    hardness: Values  # [cells] c: limits over those of the table
    largest_range: float  # [m]: a range above it ends the run


class Wear(NamedTuple):
    """Wear of an interval."""

    lowered: float  # [m] by the mean
    range: float  # [m] max w - min w behind it


class Interval(NamedTuple):
    """What an interval came to."""

    lowest_load: float  # [N] of the means of the cells
    highest_load: float
    range: float  # [m] max w - min w behind the interval
    lowered: float  # [m] by the mean
    free: float  # share of time without contact
    ended: bool  # the range has passed its limit


def make_track(
    radius: float, turn_time: float, cells: int, contact_length: float, gain: float, approach: float,
    table: tuple[Values, Values], hardness: Values | None = None,
) -> WearTrack:  # fmt: skip
    """Track of `radius` [m] cut into `cells`; `table`: loads [N], rising from 0, and the shares
    omega of these.

    hardness: of each cell, 1 where None. turn_time [s] and radius above 0, at least 8 cells,
    contact_length [m], gain and approach [m] at least 0. Raises `ValueError` for a table that does
    not rise from 0 N and values out of range.
    """
    # Values within their ranges.
    for name, value, unit in (("radius", radius, "m"), ("turn time", turn_time, "s")):
        require_positive(f"track: {name}", value, unit)
    for name, value, unit in (("contact length", contact_length, "m"), ("gain", gain, ""), ("approach", approach, "m")):
        require_not_negative(f"track: {name}", value, unit)
    cells = require_count("track: cells", cells, least=8)
    loads = require_values("track: loads of the table", table[0], "N", shape=(None,), least=0.0, rising=True)
    shares = require_values("track: shares of the table", table[1], shape=loads.shape, least=0.0)
    if len(loads) < 2 or loads[0] != 0.0:
        raise ValueError("track: the table needs loads that rise from 0 N, and a share for each")
    hard = require_values(
        "track: hardness", numpy.ones(cells) if hardness is None else hardness, shape=(cells,), above=0.0
    )
    # Contact length over the length of a cell.
    within = contact_length / (2.0 * math.pi * radius / cells)
    return WearTrack(
        turn_time=turn_time,
        contact_cells=within,
        gain=gain,
        approach=approach,
        table_loads=loads,
        table_shares=shares,
        hardness=hard,
        largest_range=STRAIN * radius,
    )


@entry
def run_intervals(
    heave: Heave, track: WearTrack, turns: int, intervals: int, heights: Values, state: Values, loads: Values,
    motion: Values,
) -> Interval:  # fmt: skip
    """`intervals` intervals in a row; not checked.

    heights [cells] [m] and state (z [m], z' [m/s]) change in place; loads [cells] [N] and motion
    [cells, 2] hold the last turn.
    """
    cells = heights.shape[0]
    path = Path(numpy.zeros(cells + 1), numpy.full(cells + 1, heave.contact_coefficient))
    lowered, free = 0.0, 0.0
    lowest, highest, width = numpy.inf, 0.0, 0.0
    for n in range(intervals):
        # The roller rides the mean over the contact; then the load of each cell wears it.
        moving_mean(heights, track.contact_cells, path.height)
        free += ride(heave, path, track.turn_time / cells, turns, state, loads, motion)
        for j in range(cells):
            lowest, highest = min(lowest, loads[j]), max(highest, loads[j])
        worn = wear(track, turns, loads, heights)
        lowered += worn.lowered
        width = worn.range
        # A track that is worn out ends the run.
        if not width <= track.largest_range:
            return Interval(lowest, highest, width, lowered, free / (n + 1), True)
    return Interval(lowest, highest, width, lowered, free / max(1, intervals), False)


@entry
def wear(track: WearTrack, turns: float, loads: Values, heights: Values) -> Wear:
    """Take off what `turns` turns under `loads` [cells] [N] cost; `heights` [cells] [m] change in
    place. Not checked.
    """
    cells, mean = heights.shape[0], 0.0
    step = track.gain * track.approach * turns
    for j in range(cells):
        mean += _share(track, j, loads[j]) / cells
    top, bottom = -numpy.inf, numpy.inf
    for j in range(cells):
        heights[j] -= step * (_share(track, j, loads[j]) - mean)
        top, bottom = max(top, heights[j]), min(bottom, heights[j])
    return Wear(step * mean, top - bottom)


@kernel
def _share(track: WearTrack, cell: int, load: float) -> float:
    """omega of a cell under a load [N]."""
    harder = track.hardness[cell] ** 3
    return float(harder * _read(track.table_loads, track.table_shares, load / harder))


@entry
def mean_weights(width: float) -> Values:
    """Weights [1] of a place itself and of each place k cells before and behind it, in a mean over
    `width` cells.

    Heights are linear between places. width: in cells, any number not below 0; 0 takes the height
    of the place. The result: [k]. Not checked.
    """
    half = 0.5 * width
    whole = int(half)
    rest = half - whole
    weights = numpy.zeros(whole + 2)
    if width <= 0.0:
        weights[0] = 1.0
        return weights
    for k in range(whole):
        weights[k] += 0.5
        weights[k + 1] += 0.5
    weights[whole] += rest - 0.5 * rest * rest
    weights[whole + 1] += 0.5 * rest * rest
    weights[0] *= 2.0  # it stands at the end of both sides
    return weights / width


@entry
def moving_mean(heights: Values, width: float, out: Values) -> None:
    """Mean of `heights` [cells] [m] over `width` cells about each, round the track.

    An `out` of one cell more is closed. The width is at most that of the track. Not checked.
    """
    cells, weights = heights.shape[0], mean_weights(width)
    for j in range(cells):
        total = weights[0] * heights[j]
        for k in range(1, weights.shape[0]):
            total += weights[k] * (heights[(j + k) % cells] + heights[(j - k) % cells])
        out[j] = total
    if out.shape[0] > cells:
        out[cells] = out[0]


@kernel
def _read(places: Values, values: Values, place: float) -> float:
    """Straight between the rows of a table, and on beyond its end."""
    low, high = 0, places.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if places[middle] <= place:
            low = middle
        else:
            high = middle
    return float(values[low] + (values[high] - values[low]) * (place - places[low]) / (places[high] - places[low]))


def growth_of_wave(heave: Heave, track: WearTrack, waves: int, slope: float, cells: int) -> float:
    """Growth of a small wave in a turn, dimensionless.

    `-gamma delta(F_N) F omega'(F) (k_lin / F_N) Re(1 - H)` times the moving mean's factor; waves:
    n_w round the track; slope: `F d omega / dF` at F_N; `H = kappa^2 / (kappa^2 - Omega^2 + 2 i
    zeta kappa Omega)`. Positive exactly below `kappa sqrt(1 - 4 zeta^2)` with a positive slope, but
    for the sign of the moving mean. Raises `ValueError` for waves below 0, fewer than 8 cells and a
    slope that is not finite.
    """
    require_not_negative("growth of a wave: waves", waves)
    require("growth of a wave: slope", slope)
    require_count("growth of a wave: cells", cells, least=8)
    kappa, omega = natural_frequency(heave), 2.0 * math.pi * waves / track.turn_time
    answer = kappa**2 / (kappa**2 - omega**2 + 2j * heave.damping_ratio * kappa * omega)
    weights = mean_weights(track.contact_cells)
    places = 2.0 * math.pi * waves / cells * numpy.arange(len(weights))
    mean = float(2.0 * weights @ numpy.cos(places) - weights[0])
    return -track.gain * track.approach * slope * linear_stiffness(heave) / heave.load * (1.0 - answer).real * mean
