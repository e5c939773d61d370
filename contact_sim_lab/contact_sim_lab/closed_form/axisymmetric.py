"""Axisymmetric contact of a rigid profile of any shape with an elastic half-space (Sneddon's dual
integrals).

Profile height f(r) above its tip [m], contact radius a [m], E* [Pa]:

    approach  d(a) = a integral over 0..pi/2 of f'(a sin t) dt
    load      P(a) = 2 E* a^2 integral over 0..pi/2 of sin(t)^2 f'(a sin t) dt
    pressure  p(r) = (E*/pi) integral over r..a of d'(s) / sqrt(s^2 - r^2) ds

The pressure is integrated by parts, so that the slope f' is all that a profile must supply. With s
= r cosh(u), U = acosh(a/r):

    p(r) = (E*/pi) [ (d(a) - d(r)) / sqrt(a^2 - r^2) + integral over 0..U of (d(s) - d(r)) cosh(u) /
    (r sinh(u)^2) du ]

`f = C r^k` has closed forms of approach and load. The solution holds where the contact is one disc:
d(a) has to rise with a. Accuracy for profiles that are smooth between their breaks: 1e-12 in
approach and load, 1e-10 in the pressure, and at the very edge (1e-7 a from it) 3e-10 of the largest
pressure.

Sources: Sneddon (1965), Int. J. Engng Sci. 3, 47; Johnson (1985), Contact Mechanics, section 5.3.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form.axisymmetric_profile import (
    AxisymmetricError,
    PowerProfile,
    Profile,
    SlopeProfile,
    refuse_profile,
)

__all__ = [
    "approach_at_radius",
    "load_at_radius",
    "pressure",
    "radius_at_approach",
    "radius_at_load",
]

Field = NDArray[numpy.float64]

GRADING = 4
"""The panel at the tip runs over w^4: a slope like r^(k-1) stays smooth enough for any k from 1."""

LONGEST_PANEL = 1.0
"""In u; the integrand is analytic within pi/2 of the real axis."""

SHORT_RANGE = 0.1
"""In u, see above: r is within 0.5 % of the contact radius."""

PULL = 1e-8
"""Of E* approach / a: a negative pressure below it is rounding at the edge."""


def approach_at_radius(profile: Profile, radius: float) -> float:
    """Approach [m] at contact radius a [m], 0 <= a <= reach; for `C r^k` it is `C a^k sqrt(pi)
    G(k/2+1) / G((k+1)/2)`.

    Raises `AxisymmetricError` for a profile or a radius outside its range.
    """
    _refuse_radius(profile, radius)
    if isinstance(profile, PowerProfile):
        return float(_power_factor(profile) * radius**profile.exponent)
    return _finite(float(_approaches(profile, numpy.array([radius]))[0]), "approach", radius)


def load_at_radius(profile: Profile, modulus: float, radius: float) -> float:
    """Load [N] at contact radius a [m], modulus E* [Pa]; for `C r^k` it is `2 E* a d k / (k + 1)`.
    Errors as before.
    """
    _refuse_modulus(modulus)
    if isinstance(profile, PowerProfile):
        k = profile.exponent
        return 2.0 * modulus * radius * approach_at_radius(profile, radius) * k / (k + 1.0)
    _refuse_radius(profile, radius)
    sine, weight = _slope_nodes(profile, numpy.array([radius]))
    integral = numpy.sum(weight * sine**2 * profile.slope(sine * radius))
    return _finite(float(2.0 * modulus * radius**2 * integral), "load", radius)


def pressure(profile: Profile, modulus: float, radius: float, r: Field) -> Field:
    """Pressure [Pa] at the distances r [m] >= 0 from the axis (any shape); zero from r = a
    outwards.

    A slope that does not vanish at the tip gives an infinite pressure at r = 0. modulus: E* [Pa];
    radius: a [m]. Raises `AxisymmetricError` as `load_at_radius`, for a negative r and where the
    pressure comes out negative.
    """
    _refuse_modulus(modulus)
    _refuse_radius(profile, radius)
    distance = numpy.asarray(r, dtype=float)
    if not numpy.all(distance >= 0.0):
        raise AxisymmetricError("axisymmetric contact: a distance r from the axis is negative or not a number")
    # One quadrature a distance
    inside = [_pressure_integral(profile, radius, float(x)) if x < radius else 0.0 for x in distance.ravel()]
    # A pull beyond the error of quadrature: the contact is no disc
    if min(inside, default=0.0) < -PULL * approach_at_radius(profile, radius) / max(radius, 1e-300):
        raise AxisymmetricError(
            f"axisymmetric contact: negative pressure within a = {radius} m: the contact is not one disc, the profile falls "
            "or bends back there; use the pressure field (effect contact_field) instead"
        )
    return numpy.asarray(modulus / math.pi * numpy.array(inside).reshape(distance.shape))


def radius_at_approach(profile: Profile, approach: float) -> float:
    """Contact radius [m] at an approach [m]; 0 for approach <= 0. Raises `AxisymmetricError` beyond
    the reach.
    """
    refuse_profile(profile)
    _refuse_target(approach, "approach [m]")
    if isinstance(profile, PowerProfile):
        return float((max(approach, 0.0) / _power_factor(profile)) ** (1.0 / profile.exponent))
    return _rising_root(lambda a: approach_at_radius(profile, a), approach, profile, "approach [m]")


def radius_at_load(profile: Profile, modulus: float, load: float) -> float:
    """Contact radius [m] under a load [N]; 0 for load <= 0. Raises `AxisymmetricError` beyond the
    reach.
    """
    refuse_profile(profile)
    _refuse_modulus(modulus)
    _refuse_target(load, "load [N]")
    if isinstance(profile, PowerProfile):
        k = profile.exponent
        return float((max(load, 0.0) * (k + 1.0) / (2.0 * modulus * k * _power_factor(profile))) ** (1.0 / (k + 1.0)))
    return _rising_root(lambda a: load_at_radius(profile, modulus, a), load, profile, "load [N]")


def _power_factor(profile: PowerProfile) -> float:
    """`C sqrt(pi) Gamma(k/2 + 1) / Gamma((k + 1)/2)`: approach over a^k."""
    k = profile.exponent
    ratio = math.exp(math.lgamma(0.5 * k + 1.0) - math.lgamma(0.5 * (k + 1.0)))
    return profile.coefficient * math.sqrt(math.pi) * ratio


def _approaches(profile: SlopeProfile, radius: Field) -> Field:
    """Approach of each contact radius of a row."""
    sine, weight = _slope_nodes(profile, radius)
    return numpy.asarray(radius * numpy.sum(weight * profile.slope(sine * radius[:, None]), axis=1))


def _slope_nodes(profile: SlopeProfile, radius: Field) -> tuple[Field, Field]:
    """sin(t) and weights, [radii, nodes], for integrals over t from 0 to pi/2 with panels between
    the breaks.
    """
    breaks = numpy.array(profile.breaks)
    inner = numpy.arcsin(numpy.minimum(breaks[None, :] / numpy.maximum(radius[:, None], 1e-300), 1.0))
    column = numpy.ones((radius.size, 1))
    edges = numpy.concatenate([0.0 * column, inner, 0.5 * math.pi * column], axis=1)
    point, share = _unit_gauss(profile.nodes)
    first, first_share = point**GRADING, GRADING * point ** (GRADING - 1) * share
    width = numpy.diff(edges, axis=1)[:, :, None]
    inside = numpy.broadcast_to(point, (width.shape[1], point.size)).copy()
    shares = numpy.broadcast_to(share, inside.shape).copy()
    inside[0], shares[0] = first, first_share
    angle = edges[:, :-1, None] + width * inside[None]
    return numpy.sin(angle).reshape(radius.size, -1), (width * shares[None]).reshape(radius.size, -1)


def _pressure_integral(profile: Profile, radius: float, r: float) -> float:
    """The bracket of the formula for p, at 0 <= r < a."""
    if r == 0.0:
        return _centre_integral(profile, radius)
    reach = math.acosh(radius / r)
    if isinstance(profile, PowerProfile):
        u, weight = _panels([0.0, reach], 16)
        slope = _power_factor(profile) * profile.exponent * (r * numpy.cosh(u)) ** (profile.exponent - 1.0)
        return float(numpy.sum(weight * slope))
    # Close to the edge few points do, and none of them comes so close to r that the rise loses its
    # digits.
    edges = [0.0, *(math.acosh(s / r) for s in profile.breaks if r < s < radius), reach]
    u, weight = _panels(edges, profile.nodes if reach > SHORT_RANGE else 8)
    own = _approaches(profile, numpy.array([r]))[0]
    rise = _approaches(profile, r * (1.0 + 2.0 * numpy.sinh(0.5 * u) ** 2)) - own
    integral = numpy.sum(weight * rise * numpy.cosh(u) / (r * numpy.sinh(u) ** 2))
    return float((approach_at_radius(profile, radius) - own) / math.sqrt((radius - r) * (radius + r)) + integral)


def _centre_integral(profile: Profile, radius: float) -> float:
    """`d(a)/a + integral over 0..a of d(s)/s^2 ds`; infinite for a pointed tip."""
    if isinstance(profile, PowerProfile):
        k = profile.exponent
        return math.inf if k <= 1.0 else _power_factor(profile) * k / (k - 1.0) * radius ** (k - 1.0)
    if float(profile.slope(numpy.array([0.0]))[0]) > 0.0:
        return math.inf
    # s = a e^-v: d(s)/s falls like e^(-(k-1) v); 40 / (k - 1) of v would be needed, k = 1.1 is
    # taken as the limit.
    breaks = [math.log(radius / s) for s in profile.breaks[::-1] if s < radius]
    v, weight = _panels([0.0, *breaks, (breaks[-1] if breaks else 0.0) + 330.0], profile.nodes)
    s = radius * numpy.exp(-v)
    return approach_at_radius(profile, radius) / radius + float(numpy.sum(weight * _approaches(profile, s) / s))


def _panels(edges: list[float], nodes: int) -> tuple[Field, Field]:
    """Gauss points and weights over rising edges; a panel behind a break is graded, the approach
    has a root there.
    """
    point, share = _unit_gauss(nodes)
    points, weights = [], []
    for number, (low, high) in enumerate(itertools.pairwise(edges)):
        parts = max(1, math.ceil((high - low) / LONGEST_PANEL))
        for part in range(parts):
            start, width = low + (high - low) * part / parts, (high - low) / parts
            graded = number > 0 and part == 0
            points.append(start + width * (point**2 if graded else point))
            weights.append(width * (2.0 * point * share if graded else share))
    return numpy.concatenate(points), numpy.concatenate(weights)


def _unit_gauss(nodes: int) -> tuple[Field, Field]:
    """Gauss-Legendre points and weights on 0..1."""
    point, weight = numpy.polynomial.legendre.leggauss(nodes)
    return 0.5 * (point + 1.0), 0.5 * weight


def _rising_root(function: Callable[[float], float], target: float, profile: SlopeProfile, name: str) -> float:
    """Radius where a rising function of it reaches the target: bracketed, then false position
    (Anderson, Bjorck 1973).
    """
    if target <= 0.0:
        return 0.0
    low, high = _bracket(function, target, profile, name)
    error_low, error_high = function(low) - target, function(high) - target
    # A root between low and high at every iteration
    for _ in range(200):
        middle = high - error_high * (high - low) / (error_high - error_low)
        error = function(middle) - target
        if error == 0.0 or abs(high - low) <= 4e-16 * high:
            return middle
        if error * error_high < 0.0:
            low, error_low = high, error_high
        else:
            # The end that stays gets a smaller error, so that it moves at the next iteration
            keep = 1.0 - error / error_high
            error_low *= keep if keep > 0.0 else 0.5
        if abs(error) <= 2e-16 * target:
            return middle
        high, error_high = middle, error
    return high


def _bracket(
    function: Callable[[float], float], target: float, profile: SlopeProfile, name: str
) -> tuple[float, float]:
    """Two radii a factor 2 apart (or the reach) that enclose the target."""
    high = min(profile.reach, profile.breaks[0] if profile.breaks else 1.0)
    while function(high) < target:
        if high >= min(profile.reach, 1e12):
            raise AxisymmetricError(
                f"axisymmetric contact: {name} {target} needs more than the profile's reach of {profile.reach} m, "
                f"where it is {function(high)}; give more of the profile"
            )
        high = min(2.0 * high, profile.reach, 1e12)
    low = 0.5 * high
    while low > 1e-30 and function(low) > target:
        high, low = low, 0.5 * low
    return low, high


def _refuse_radius(profile: Profile, radius: float) -> None:
    refuse_profile(profile)
    reach = math.inf if isinstance(profile, PowerProfile) else profile.reach
    if not (0.0 <= radius < math.inf and radius <= reach):
        raise AxisymmetricError(f"axisymmetric contact: radius is {radius} m, allowed are 0 to {reach} m")


def _finite(value: float, name: str, radius: float) -> float:
    """Refuse what a slope gives that is no number."""
    if not math.isfinite(value):
        raise AxisymmetricError(
            f"axisymmetric contact: {name} at a = {radius} m is {value}: the slope must be finite there"
        )
    return value


def _refuse_modulus(modulus: float) -> None:
    if not 0.0 < modulus < math.inf:
        raise AxisymmetricError(f"axisymmetric contact: E* is {modulus} Pa, it must be a finite number above 0")


def _refuse_target(target: float, name: str) -> None:
    if not math.isfinite(target):
        raise AxisymmetricError(f"axisymmetric contact: {name} is {target}, it must be a finite number")
