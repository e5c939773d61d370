"""E', E'' and tan(beta) of each impact, and of repeated impacts with intervals.

Every form of the inversion is ``E' = q h(k)``, ``tan(beta) = g(k)``
(`rigs/impact/theory/inverse.py`). Repeated impacts: the means of ``q^(-2/5)``, a contact time, and
of k are inverted, not the inverses averaged, so that noise that lifts single restitutions above 1
does no harm and the bias of the mean falls with 1/n. Intervals: Student's t on the linearised
values of the single impacts, in which the common noise of k in E' and tan(beta) is counted; for E'
in ln E'.

With Gaussian noise these means are as narrow as any: k alone determines tan(beta), for what tau
determines goes into E'. No unbiased reading of n impacts scatters less than ``|g'(k)|
sigma_k/sqrt(n)`` (bound of Cramer and Rao), and this one scatters so much.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.special import stdtrit

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.theory.bodies import Sphere
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.inverse import group_factor, material_of_impact, reading, shape_of_depth

__all__ = ["EstimatedValue", "MaterialEstimate", "around", "each_impact", "of_logarithm", "repeated_impacts", "student"]

STEP = 1.0e-5  # of k, for the slopes of h and g
# Of a mean restitution over 1, beside three standard errors; a larger one is no impact
ABOVE_BY_NOISE = 0.05
FAR_OFF = 6.0  # standard deviations, estimated from the median deviation, off the median of a group
LEAST_FAR = 0.1  # of k, and of the logarithm of the contact time, below which nothing is far off
ABOVE_ONE = "mean restitution above 1, by noise: read as no loss"
Indices = NDArray[numpy.intp]


class EstimatedValue(NamedTuple):
    """A value with its standard error and the interval of the requested confidence; None where a
    single impact has none.
    """

    value: float
    error: float | None
    low: float | None
    high: float | None


class MaterialEstimate(NamedTuple):
    """Material estimated from repeated impacts."""

    impacts: int
    temperature: float | None  # [K], mean
    speed: float  # [m/s], geometric mean
    restitution: float  # mean
    storage_modulus: EstimatedValue  # E' [Pa]
    loss_modulus: EstimatedValue  # E'' [Pa]
    loss_tangent: EstimatedValue
    note: str | None = None  # what to mind


class _Curve(NamedTuple):
    """ln h and g at the mean restitution, with their slopes."""

    log_factor: float
    log_factor_slope: float
    loss_tangent: float
    loss_tangent_slope: float
    depth_factor: float


def each_impact(impacts: Impacts, options: Options) -> list[dict[str, float | int | str | None]]:
    """One row for each impact: T [K], V0 [m/s], tau [s], k [1], E' [Pa] and tan(beta) [1].

    A restitution that the form does not reach gives no material and a note in its place.
    """
    rows: list[dict[str, float | int | str | None]] = []
    for i in range(len(impacts.mass)):
        row: dict[str, float | int | str | None] = {
            "line": int(impacts.line[i]), "T": None if impacts.temperature is None else float(impacts.temperature[i]),
            "V0": float(impacts.speed[i]), "tau": float(impacts.duration[i]), "k": float(impacts.restitution[i]),
        }  # fmt: skip
        sphere = Sphere(float(impacts.mass[i]), float(impacts.radius[i]))
        speed, duration, k = (float(v[i]) for v in (impacts.speed, impacts.duration, impacts.restitution))
        try:
            gravity = 0.0 if impacts.gravity is None else float(impacts.gravity[i])
            found = material_of_impact(
                sphere, speed, duration, k, end=options.end, form=options.form, shape=options.shape, gravity=gravity
            )
        except ImpactError as error:
            rows.append({**row, "E'": None, "E''": None, "tan_beta": None, "note": str(error)})
            continue
        parts = {"E'": found.storage_modulus, "E''": found.loss_modulus, "tan_beta": found.loss_tangent}
        rows.append({**row, **parts, "note": None})
    return rows


def repeated_impacts(impacts: Impacts, chosen: Indices, options: Options) -> MaterialEstimate:
    """The material from the impacts ``chosen``, taken as repeats of one state of it.

    Impacts far off the others of the group are named in the note; they count all the same.
    Raises MaterialError where k determines none, or lies above 1 by more than noise.
    """
    k = impacts.restitution[chosen]
    _refuse_gain(impacts, chosen)
    # Moduli from the means of times and restitution.
    times = numpy.array([_group_factor(impacts, int(i)) ** -0.4 for i in chosen])
    curve = _curve(float(k.mean()), impacts, chosen, options)
    scale = impacts.speed[chosen] * impacts.duration[chosen] / impacts.radius[chosen]
    try:
        shape = shape_of_depth(curve.depth_factor * float(scale.mean()), 1.0, options.shape)
    except ImpactError as error:
        raise MaterialError(f"{_where(impacts, chosen)}: {error}") from error
    storage = float(times.mean()) ** -2.5 * math.exp(curve.log_factor) / shape
    tangent = curve.loss_tangent
    # Errors from the scatter, by the slopes of the moduli over time and restitution.
    deviation = k - k.mean()
    log_storage = -2.5 * times / times.mean() + curve.log_factor_slope * deviation
    log_error, factor = _standard_error(log_storage), student(len(chosen), options.confidence)
    tangent_error = _standard_error(curve.loss_tangent_slope * deviation)
    loss_error = _standard_error(storage * (tangent * log_storage + curve.loss_tangent_slope * deviation))
    temperature = None if impacts.temperature is None else float(impacts.temperature[chosen].mean())
    return MaterialEstimate(
        impacts=len(chosen),
        temperature=temperature,
        speed=math.exp(float(numpy.log(impacts.speed[chosen]).mean())),
        restitution=float(k.mean()),
        storage_modulus=of_logarithm(storage, log_error, factor),
        loss_modulus=around(storage * tangent, loss_error, factor),
        loss_tangent=around(tangent, tangent_error, factor),
        note=_note(impacts, chosen, times),
    )


def _refuse_gain(impacts: Impacts, chosen: Indices) -> None:
    k = impacts.restitution[chosen]
    if float(k.mean()) - 1.0 > max(ABOVE_BY_NOISE, 3.0 * (_standard_error(k) or 0.0)):
        worst = int(chosen[k.argmax()])
        raise MaterialError(
            f"{impacts.file}, line {impacts.line[worst]}: restitution {impacts.restitution[worst]:g}, mean of its "
            f"{len(chosen)} repeats {k.mean():.4g}; no impact rebounds faster than it came, 0 to 1 is possible; check the speeds, "
            "or leave the impact out"
        )


def _note(impacts: Impacts, chosen: Indices, times: NDArray[numpy.float64]) -> str | None:
    """What to mind: a mean above 1, single impacts above 1 that noise does not explain, impacts far
    off their group.
    """
    k, parts = impacts.restitution[chosen], []
    if k.mean() > 1.0:
        parts.append(ABOVE_ONE)
    for name, values, shown in (("k", k, k), ("tau", numpy.log(times), impacts.duration[chosen])):
        far = numpy.flatnonzero(_far_off(values))
        if far.size:
            named = ", ".join(f"{shown[i]:g} (line {impacts.line[chosen[i]]})" for i in far[:3])
            parts.append(
                f"{name} = {named}{' …' if far.size > 3 else ''} far off the group's median {numpy.median(shown):.3g}"
            )
    return "; ".join(parts) or None


def _far_off(values: NDArray[numpy.float64]) -> NDArray[numpy.bool_]:
    """Which values lie far from the median, by the median deviation; of two, both where they lie
    far apart.
    """
    distance = numpy.abs(values - numpy.median(values))
    spread = 0.0 if len(values) == 2 else 1.4826 * float(numpy.median(distance))
    return numpy.asarray(distance > max(LEAST_FAR, FAR_OFF * spread))


def _group_factor(impacts: Impacts, i: int) -> float:
    sphere = Sphere(float(impacts.mass[i]), float(impacts.radius[i]))
    return group_factor(sphere, float(impacts.speed[i]), float(impacts.duration[i]))


def _curve(k: float, impacts: Impacts, chosen: Indices, options: Options) -> _Curve:
    """At a mean restitution above 1 by noise, the limit without loss is taken, with the slopes from
    below.
    """
    held, weight = min(k, 1.0), _weight(impacts, chosen)
    low, high = held - STEP, min(held + STEP, 1.0)
    try:
        at, below, above = (reading(value, options.end, options.form, weight) for value in (held, low, high))
    except ImpactError as error:
        raise MaterialError(f"{_where(impacts, chosen)}: mean of the restitution: {error}") from error
    width = high - low
    return _Curve(
        math.log(at.modulus_factor), math.log(above.modulus_factor / below.modulus_factor) / width,
        at.loss_tangent, (above.loss_tangent - below.loss_tangent) / width, at.depth_factor,
    )  # fmt: skip


def _weight(impacts: Impacts, chosen: Indices) -> float:
    """Mean of ``g tau/V0``; 0 where no weight acts along the blow."""
    if impacts.gravity is None:
        return 0.0
    return float((impacts.gravity[chosen] * impacts.duration[chosen] / impacts.speed[chosen]).mean())


def _where(impacts: Impacts, chosen: Indices) -> str:
    return f"{impacts.file}, lines {impacts.line[chosen[0]]} to {impacts.line[chosen[-1]]}"


def _standard_error(values: NDArray[numpy.float64]) -> float | None:
    return float(values.std(ddof=1)) / math.sqrt(len(values)) if len(values) > 1 else None


def student(count: int, confidence: float) -> float:
    """Half width of an interval in standard errors [1], of the mean of ``count`` values; NaN for
    one.
    """
    return float(stdtrit(count - 1, 0.5 + 0.5 * confidence)) if count > 1 else math.nan


def around(value: float, error: float | None, factor: float) -> EstimatedValue:
    """Value with an interval of ``factor`` [1] standard errors, not below 0.

    value and error: in one unit, E' and E'' in [Pa], tan(beta) in [1].
    """
    if error is None:
        return EstimatedValue(value, None, None, None)
    return EstimatedValue(value, error, max(0.0, value - factor * error), value + factor * error)


def of_logarithm(value: float, error: float | None, factor: float) -> EstimatedValue:
    """Value with an interval of ``factor`` standard errors of its logarithm, ``error``.

    value: [Pa]; error and factor: [1].
    """
    if error is None:
        return EstimatedValue(value, None, None, None)
    return EstimatedValue(value, value * error, value * math.exp(-factor * error), value * math.exp(factor * error))
