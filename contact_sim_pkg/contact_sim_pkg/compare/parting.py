"""Two runs that part for good: a chaotic scene, whose runs agree until an instant although both
keep their tolerances. Beyond it only statistics can be compared.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy

from contact_sim_pkg.compare.columns import NANOSECONDS, Column, Instants, Key, paired
from contact_sim_pkg.compare.judgement import Scale
from contact_sim_pkg.compiled.arrays import Vector

__all__ = ["Parting", "Statistic", "parting_of", "until"]

PARTS = 40  # equal parts of a run, in each of which the largest difference counts
LEAST_SAMPLES = 10  # of a part
LAST = 4  # parts at the end, at least, in all of which the difference exceeds the request
LARGE, LARGEST = 10.0, 0.3
"""Median difference of these parts: so many times the request, or so much of the scale."""
QUANTILES = (0.05, 0.5, 0.95)


class Statistic(NamedTuple):
    """Statistics of a column beyond the parting: differences of the two runs over the scale."""

    place: str
    column: str
    mean: float
    rms: float
    quantiles: float  # largest difference of `QUANTILES`


class Parting(NamedTuple):
    """Where two runs part, and how their statistics differ beyond it."""

    time: float  # [s] until which they agree
    statistics: tuple[Statistic, ...]


def parting_of(
    run: Mapping[Key, Column], finer: Mapping[Key, Column], scales: Mapping[Key, Scale], request: float
) -> Parting | None:
    """Where the forces and motions of two runs part for good; None where they do not."""
    compared = {
        key: paired(column, finer[key])
        for key, column in run.items()
        if column.kind in ("force", "motion") and key in finer and key in scales and scales[key].scale > 0.0
    }
    times = [
        _parted(instants, numpy.abs(values - others) / scales[key].scale, request)
        for key, (instants, values, others) in compared.items()
    ]
    parted = [time for time in times if time is not None]
    if not parted:
        return None
    first = min(parted)
    statistics = [
        _statistic(key, values[instants >= first], others[instants >= first], scales[key].scale)
        for key, (instants, values, others) in compared.items()
    ]
    return Parting(first / NANOSECONDS, tuple(statistics))


def until(columns: Mapping[Key, Column], time: float) -> dict[Key, Column]:
    """Columns up to a time [s], which is left out."""
    found = {}
    for key, column in columns.items():
        kept = column.instants < round(time * NANOSECONDS)
        found[key] = column._replace(instants=column.instants[kept], values=column.values[kept])
    return found


def _parted(instants: Instants, ratio: Vector, request: float) -> int | None:
    """Instant [ns] from which on the ratio exceeds the request in each part of the run."""
    if len(instants) < PARTS * LEAST_SAMPLES:
        return None
    parts = numpy.array_split(numpy.arange(len(instants)), PARTS)
    largest = numpy.array([ratio[part].max() for part in parts])
    below = numpy.flatnonzero(largest <= request)
    first = int(below[-1]) + 1 if len(below) else 0
    tail = largest[first:]
    # An error that is there from the start is no parting
    if first == 0 or len(tail) < LAST or float(numpy.median(tail)) < min(LARGE * request, LARGEST):
        return None
    part = parts[first]
    return int(instants[part[int(numpy.argmax(ratio[part] > request))]])


def _statistic(key: Key, values: Vector, others: Vector, scale: float) -> Statistic:
    mean = abs(float(values.mean() - others.mean()))
    rms = abs(float(numpy.sqrt(numpy.mean(values**2)) - numpy.sqrt(numpy.mean(others**2))))
    quantiles = numpy.abs(numpy.quantile(values, QUANTILES) - numpy.quantile(others, QUANTILES))
    return Statistic(key.place, key.label, mean / scale, rms / scale, float(quantiles.max()) / scale)
