"""Master curve: E' and tan(beta) of all temperatures and speeds over one reduced speed ``V
a_T(T)/a_T(T_r)``.

WLF (Tg known, or found) or Arrhenius (activation energy known, or found). What is unknown is found
as the value with which ln E' of all groups lies closest to one smooth curve over the logarithm of
the reduced speed (Chebyshev polynomial), each weighted by its standard error. That needs groups of
at least two speeds at two temperatures: with one speed every shift gives a curve.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.estimate import MaterialEstimate
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.shift import Arrhenius, Shift, Wlf, log_shift

__all__ = ["LAWS", "MasterCurve", "master_curve"]

LAWS = ("wlf", "arrhenius")
Vector = NDArray[numpy.float64]
LARGEST_DEGREE = 6
# Of ln E': groups of one impact, or of exact repeats, still get a finite weight
LEAST_ERROR = 1.0e-4
ENERGIES = (5.0e3, 1.0e6)  # [J/mol] searched
GLASS_BELOW = 150.0  # [K] below the coldest group, to where Tg is searched
SCAN = 121


class MasterCurve(NamedTuple):
    """The law and where each group stands on the curve."""

    law: Shift
    # Tg [K] or activation energy [J/mol] that was found; None where it was given
    found: float | None
    found_error: float | None  # its standard error
    scatter: float | None  # root mean square of ln E' about the curve; None with too few groups
    reference_temperature: float  # T_r [K]
    log_shift: tuple[float, ...]  # lg a_T(T)/a_T(T_r) of each group
    reduced_speed: tuple[float, ...]  # [m/s] of each group


def master_curve(
    estimates: list[MaterialEstimate], law: str, parameter: float | None = None, reference: float | None = None
) -> MasterCurve:
    """Shift all groups to ``reference`` [K] (that group's nearest the middle where None).

    ``parameter``: Tg [K] (`wlf`) or the activation energy [J/mol] (`arrhenius`); None finds it.
    Raises MaterialError where temperatures are missing, a temperature is outside the law, or
    nothing determines the parameter.
    """
    if law not in LAWS:
        raise ValueError(f"shift '{law}': {' or '.join(LAWS)} is needed")
    temperatures = numpy.array([math.nan if e.temperature is None else e.temperature for e in estimates])
    if not numpy.isfinite(temperatures).all():
        raise MaterialError("a master curve needs the temperature of every impact: a column T")
    at = _middle(temperatures) if reference is None else reference
    # The parameter is searched where it is not given.
    found = error = None
    if parameter is None:
        found, error = _search(estimates, temperatures, law, at)
    shift = _law(law, found if found is not None else parameter, at)
    logs = _shifts(shift, temperatures, at)
    # Reduced speeds V a_T.
    speeds = numpy.array([e.speed for e in estimates])
    _cost, scatter = _distance(estimates, logs)
    reduced = tuple(float(v) for v in speeds * 10.0**logs)
    return MasterCurve(shift, found, error, scatter, at, tuple(float(v) for v in logs), reduced)


def _middle(temperatures: Vector) -> float:
    return float(temperatures[numpy.argmin(numpy.abs(temperatures - 0.5 * (temperatures.min() + temperatures.max())))])


def _law(law: str, parameter: float | None, reference: float) -> Shift:
    value = 0.0 if parameter is None else parameter
    if not value > 0.0:
        raise MaterialError(
            f"{'glass temperature' if law == 'wlf' else 'activation energy'} {value:g}: a number above 0 is needed"
        )
    return Wlf(value) if law == "wlf" else Arrhenius(reference, value)


def _shifts(shift: Shift, temperatures: Vector, reference: float) -> Vector:
    try:
        base = log_shift(shift, reference)
        return numpy.array([log_shift(shift, float(t)) - base for t in temperatures])
    except ImpactError as error:
        raise MaterialError(f"master curve: {error}") from error


def _distance(estimates: list[MaterialEstimate], logs: Vector) -> tuple[float, float | None]:
    """Weighted sum of squares of ln E' about its curve, over the degrees of freedom; and the
    unweighted scatter.
    """
    place = numpy.log10(numpy.array([e.speed for e in estimates])) + logs
    value = numpy.log(numpy.array([e.storage_modulus.value for e in estimates]))
    degree = min(LARGEST_DEGREE, len(estimates) // 2 - 1)
    span = float(place.max() - place.min())
    if degree < 1 or span == 0.0:
        return math.inf, None
    scaled = 2.0 * (place - place.min()) / span - 1.0
    weights = 1.0 / numpy.array([_log_error(e) for e in estimates])
    with_weight = weights / weights.max()
    fit = chebyshev.chebfit(scaled, value, degree, w=with_weight)
    residual = value - chebyshev.chebval(scaled, fit)
    return float(numpy.sum((residual * weights) ** 2)), float(numpy.sqrt(numpy.mean(residual**2)))


def _log_error(estimate: MaterialEstimate) -> float:
    error = estimate.storage_modulus.error
    return LEAST_ERROR if error is None else max(LEAST_ERROR, error / estimate.storage_modulus.value)


def _search(
    estimates: list[MaterialEstimate], temperatures: Vector, law: str, reference: float
) -> tuple[float, float | None]:
    """Parameter of least distance: scan, then Brent between the neighbours; standard error from the
    curvature there.
    """
    # Several speeds at several temperatures are needed.
    speeds_at: dict[int, set[int]] = {}
    for e, t in zip(estimates, temperatures, strict=True):
        speeds_at.setdefault(round(t), set()).add(round(100 * math.log(e.speed)))
    if len(speeds_at) < 2 or len(estimates) < 6 or max(map(len, speeds_at.values())) < 2:
        raise MaterialError(
            f"master curve: {len(estimates)} groups at {len(speeds_at)} temperatures do not "
            "determine the shift; at least 6 groups with "
            "several speeds at several temperatures do, or give Tg or the activation energy"
        )
    # Scan of the parameter's range.
    coldest = float(temperatures.min())
    low, high = (max(20.0, coldest - GLASS_BELOW), coldest + 40.0) if law == "wlf" else ENERGIES
    grid = numpy.linspace(low, high, SCAN) if law == "wlf" else numpy.geomspace(low, high, SCAN)

    def cost(parameter: float) -> float:
        try:
            return _distance(estimates, _shifts(_law(law, parameter, reference), temperatures, reference))[0]
        except MaterialError:
            return math.inf

    costs = numpy.array([cost(float(value)) for value in grid])
    # Refined between the neighbours of the best.
    best = int(numpy.argmin(costs))
    if best in (0, len(grid) - 1) or not math.isfinite(costs[best]):
        raise MaterialError(f"master curve: no value from {low:g} to {high:g} brings the groups together; give it")
    ends = (float(grid[best - 1]), float(grid[best + 1]))
    value = float(minimize_scalar(cost, bounds=ends, method="bounded", options={"xatol": 1e-7 * ends[1]}).x)
    return value, _error(cost, value, len(estimates))


def _error(cost, value: float, count: int) -> float | None:  # type: ignore[no-untyped-def]
    """From the curvature: ``sqrt(2 max(1, s^2)/c'')``, s^2 the least cost over the degrees of
    freedom.
    """
    step = 1.0e-3 * value
    curvature = (cost(value + step) - 2.0 * cost(value) + cost(value - step)) / step**2
    if not (math.isfinite(curvature) and curvature > 0.0):
        return None
    freedom = max(1, count - min(LARGEST_DEGREE, count // 2 - 1) - 2)
    return math.sqrt(2.0 * max(1.0, cost(value) / freedom) / curvature)
