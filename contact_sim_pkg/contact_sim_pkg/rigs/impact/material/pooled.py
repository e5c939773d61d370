"""All speeds at one temperature taken together, and whether the groups agree.

A material that does not depend on speed has one E' and one tan(beta) at a temperature: its groups
may be pooled, which narrows the intervals. Groups are weighted by their impacts; the scatter within
all of them together, with N - G degrees of freedom, gives the interval. Agreement: the probability
that groups of one material lie as far apart as these (F test of the means, one-way analysis of
variance). Where it is small the material depends on speed, and the row reports it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.special import fdtrc

from contact_sim_pkg.rigs.impact.material.estimate import (
    EstimatedValue,
    MaterialEstimate,
    around,
    of_logarithm,
    student,
)
from contact_sim_pkg.rigs.impact.material.options import Options

__all__ = ["Pooled", "pooled_speeds"]

Vector = NDArray[numpy.float64]
UNLIKELY = 0.01
DIFFERENT = "groups differ more than their scatter: the material depends on speed, and this is a mean over speeds"


class Pooled(NamedTuple):
    """The groups of one temperature as one material."""

    impacts: int
    groups: int
    temperature: float | None  # [K], mean
    slowest: float  # [m/s], mean speed of the slowest group
    fastest: float  # [m/s]
    storage_modulus: EstimatedValue  # E' [Pa]
    loss_modulus: EstimatedValue  # E'' [Pa]
    loss_tangent: EstimatedValue
    # Smaller probability of E' and tan(beta), twice, at most 1; None without repeats
    agreement: float | None
    note: str | None


def pooled_speeds(estimates: list[MaterialEstimate], options: Options) -> list[Pooled]:
    """One row for each temperature that several groups share; ``estimates`` by rising temperature,
    as `groups` orders them.
    """
    found = []
    for together in _of_one_temperature(estimates, options.temperature_span):
        if len(together) > 1:
            found.append(_pool(together, options.confidence))
    return found


def _of_one_temperature(estimates: list[MaterialEstimate], span: float) -> list[list[MaterialEstimate]]:
    parts: list[list[MaterialEstimate]] = []
    for estimate in estimates:
        first = parts[-1][0].temperature if parts else None
        if parts and (estimate.temperature is None or first is None or abs(estimate.temperature - first) <= span):
            parts[-1].append(estimate)
        else:
            parts.append([estimate])
    return parts


def _pool(together: list[MaterialEstimate], confidence: float) -> Pooled:
    counts = numpy.array([float(each.impacts) for each in together])
    total = float(counts.sum())
    storage, loss, tangent = (
        [getattr(each, name) for each in together] for name in ("storage_modulus", "loss_modulus", "loss_tangent")
    )
    logs = [
        EstimatedValue(math.log(v.value), None if v.error is None else v.error / v.value, None, None) for v in storage
    ]  # of E' its logarithm, as in its interval
    freedom = int(total) - len(together)
    factor = student(freedom + 1 if freedom else len(together), confidence)
    values = [_mean(part, counts) for part in (logs, loss, tangent)]
    chances = [chance for chance in (values[0][2], values[2][2]) if chance is not None]
    agreement = min(1.0, 2.0 * min(chances)) if chances else None
    temperatures = [each.temperature for each in together if each.temperature is not None]
    speeds = [each.speed for each in together]
    return Pooled(
        impacts=int(total),
        groups=len(together),
        temperature=float(numpy.average(temperatures, weights=counts)) if temperatures else None,
        slowest=min(speeds),
        fastest=max(speeds),
        storage_modulus=of_logarithm(math.exp(values[0][0]), values[0][1], factor),
        loss_modulus=around(*values[1][:2], factor),
        loss_tangent=around(*values[2][:2], factor),
        agreement=agreement,
        note=DIFFERENT if agreement is not None and agreement < UNLIKELY else None,
    )


def _mean(parts: list[EstimatedValue], counts: Vector) -> tuple[float, float, float | None]:
    """Mean, its standard error, and the chance of groups so far apart; without repeats the groups
    themselves are the scatter.
    """
    total, number = float(counts.sum()), len(parts)
    centre = numpy.array([part.value for part in parts])
    mean = float(numpy.average(centre, weights=counts))
    between = float(counts @ (centre - mean) ** 2) / (number - 1)
    # Without repeats the scatter between groups is all there is.
    freedom = total - number
    if freedom < 1.0:
        return mean, math.sqrt(between / total), None
    # One-way analysis of variance: scatter within groups against that between them.
    squares = sum(
        count * (count - 1.0) * part.error**2
        for count, part in zip(counts, parts, strict=True)
        if part.error is not None
    )
    within = float(squares) / freedom
    if within == 0.0:
        return mean, 0.0, None
    return mean, math.sqrt(within / total), float(fdtrc(number - 1, freedom, between / within))
