"""Sobol's indices of a sweep drawn for them: the share of a metric's variance that a key has, alone and with the others."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.sweep.correlations import column_of
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import SALTELLI, SweepError

__all__ = ["SobolIndex", "drawn_points", "sobol_indices"]

Field = NDArray[numpy.float64]
RESAMPLES = 200
LEVEL = 0.95


class SobolIndex(NamedTuple):
    """Of a metric and a key: 0 where the metric does not follow it, 1 where it follows nothing else."""

    metric: str
    key: str
    first: float
    """share of the variance that goes if the key alone were known"""
    first_ends: tuple[float, float]
    """95 % interval, by bootstrap"""
    total: float
    """share that stays if all others were known: what the key does alone, and with any of them"""
    total_ends: tuple[float, float]


def drawn_points(sample: str) -> int:
    """N of `saltelli:N`; 0 for samples drawn otherwise."""
    kind, _, number = sample.partition(":")
    return int(number) if kind == SALTELLI and number.isdecimal() else 0


def sobol_indices(table: SweepTable, points: int, metrics: Sequence[str] | None = None) -> list[SobolIndex]:
    """First and total Sobol indices (Saltelli et al., Computer Physics Communications 181 (2010) 259; scipy).

    Args:
        table: of a sweep with ``--sample saltelli:N``: N cases of one sample, N of a second one, then of the first with each
            key in turn taken from the second.
        points: N.
        metrics: to be looked at; None: all that vary. One that a case lacks is left out.

    Raises:
        SweepError: the table is of another sample.
    """
    from scipy import stats

    keys = table.keys
    if not points or len(table) != points * (len(keys) + 2):
        raise SweepError(
            f"indices need a sweep with --sample saltelli:N; this one has {len(table)} cases of other values"
        )
    chosen = [each.metric for each in table.ranges()] if metrics is None else metrics
    again = numpy.random.default_rng(1).integers(points, size=(RESAMPLES, points))
    found = []
    for metric in chosen:
        # Rows: both samples, then the first one with each key of the second
        values = column_of(table, metric).reshape(len(keys) + 2, points)
        if not numpy.isfinite(values).all() or numpy.ptp(values) == 0.0:
            continue

        def indices(values: Field) -> Field:
            parts = {"f_A": values[:1], "f_B": values[1:2], "f_AB": values[2:, None, :]}
            of_all = stats.sobol_indices(func=parts, n=points)
            return numpy.array([of_all.first_order.ravel(), of_all.total_order.ravel()])

        best = indices(values)
        with numpy.errstate(invalid="ignore"):
            ends = numpy.nanquantile(
                [indices(values[:, each]) for each in again], [(1.0 - LEVEL) / 2.0, (1.0 + LEVEL) / 2.0], axis=0
            )
        for place, key in enumerate(keys):
            first, total = ((float(low), float(high)) for low, high in ends[:, :, place].T)
            found.append(SobolIndex(metric, key, float(best[0, place]), first, float(best[1, place]), total))
    return [each for each in found if math.isfinite(each.total)]
