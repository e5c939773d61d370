"""What the metrics of a sweep follow: rank correlations, and cases that do not go with the others."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.metric import SELF_CHECK
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import SEED

__all__ = ["Outlier", "column_of", "correlation", "numeric_keys", "outliers", "varied_keys", "varying_metrics"]

Field = NDArray[numpy.float64]
FAR = 3.5
"""Modified z score of an outlier (Iglewicz and Hoaglin, How to detect and handle outliers, 1993)."""
NORMAL = 0.6745  # of a normal distribution: median of the distances from its middle over its standard deviation
LEAST_SHARE = 0.05  # of the range of a metric: what is less is no outlier, however alike the others are
ROUNDING = 1e-12
"""Difference that is none, in the units of metrics."""
WEAK = 0.3
"""Largest rank correlation of a metric that follows no key."""
LEAST_FREEDOM = 4  # cases beyond the terms of the model


class Outlier(NamedTuple):
    """A case of which a metric lies off what the others let expect."""

    number: int
    metric: str
    value: float
    expected: float
    score: float
    """modified z score"""


def varied_keys(table: SweepTable) -> list[str]:
    """Keys with two values or more, the seed left out."""
    return [key for key in table.keys if key != SEED and len({row[key] for row in table}) > 1]


def numeric_keys(table: SweepTable) -> list[str]:
    """Those of them whose values are all numbers."""
    return [key for key in varied_keys(table) if not any(isinstance(row[key], str) for row in table)]


def column_of(table: SweepTable, name: str) -> Field:
    """A metric or a numeric key [cases], nan where it is not known."""
    return numpy.asarray(table[name], dtype=numpy.float64)


def varying_metrics(table: SweepTable, first: Sequence[str] = ()) -> list[str]:
    """Metrics that differ between cases in the order of their list: those of ``first`` in front, behind all others those
    that follow no key, and self-checks of the run are left out.
    """
    checks = {each["key"] for _, row in table.cases for each in row["metrics"] if each["basis"] == SELF_CHECK}
    found = [
        each
        for each in table.ranges()
        if each.largest - each.smallest > ROUNDING and each.metric not in checks - {*first}
    ]

    def strength(metric: str) -> float:
        values = (correlation(column_of(table, key), column_of(table, metric))[0] for key in numeric_keys(table))
        return max((abs(each) for each in values if math.isfinite(each)), default=0.0)

    return sorted((each.metric for each in found), key=lambda name: (name not in first, strength(name) < WEAK))


def correlation(key: Field, metric: Field) -> tuple[float, float]:
    """Spearman's rank correlation and its p value (scipy), over the cases where both are known; nan for fewer than 3."""
    from scipy.stats import spearmanr

    known = numpy.isfinite(key) & numpy.isfinite(metric)
    if known.sum() < 3 or numpy.ptp(key[known]) == 0.0 or numpy.ptp(metric[known]) == 0.0:
        return math.nan, math.nan
    found = spearmanr(key[known], metric[known])
    return float(found.statistic), float(found.pvalue)


def outliers(table: SweepTable, metrics: Sequence[str]) -> list[Outlier]:
    """Cases whose metric lies off a least-squares model of the keys: constant, linear and square in each numeric key
    (linear where it has two values), a constant for each value of the others; the modified z score of what is left is
    above 3.5. None where the cases are too few for the model. The largest score first.
    """
    terms = _terms(table)
    found = []
    for metric in metrics:
        values = column_of(table, metric)
        known = numpy.flatnonzero(numpy.isfinite(values))
        if known.size < terms.shape[1] + LEAST_FREEDOM:
            continue
        model = terms[known] @ numpy.linalg.lstsq(terms[known], values[known], rcond=None)[0]
        left = values[known] - model
        off = left - numpy.median(left)
        middle = float(numpy.median(numpy.abs(off)))
        least = LEAST_SHARE * float(numpy.ptp(values[known]))
        for place, distance in enumerate(off):
            score = NORMAL * abs(float(distance)) / max(middle, 1e-300)
            if score > FAR and abs(distance) > least:
                row = int(known[place])
                found.append(Outlier(table[row]["number"], metric, float(values[row]), float(model[place]), score))
    return sorted(found, key=lambda each: -each.score)


def _terms(table: SweepTable) -> Field:
    """Columns of the model [cases, terms]."""
    columns = [numpy.ones(len(table))]
    numeric = numeric_keys(table)
    for key in varied_keys(table):
        values = [row[key] for row in table]
        if key in numeric:
            number = numpy.asarray(values, dtype=numpy.float64)
            scaled = (number - number.mean()) / number.std()
            columns += [scaled, scaled**2] if len(set(values)) > 2 else [scaled]
        else:
            columns += [
                numpy.asarray([str(each) == level for each in values], dtype=numpy.float64)
                for level in sorted({*map(str, values)})[1:]
            ]
    return numpy.column_stack(columns)
