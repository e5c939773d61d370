"""The exact motion of a quadratic oscillator in cn^2, and the oscillator that a preloaded contact
spring is to second order.

``y'' = -w0^2 y - k y^2`` between the turning points y2 <= y <= y3, which are roots with y1 of ``k
y^3/3 + w0^2 y^2/2 = const``: ``y = y2 + (y3 - y2) cn^2(W t; m)``, ``W^2 = k (y3 - y1)/6``, ``m =
(y3 - y2)/(y3 - y1)``, period ``2 K(m)/W``. For k < 0 y is mirrored, for k = 0 the oscillator is
linear. m = 1 is the homoclinic motion: it needs for ever, and its period is infinite. Source:
Driver and Seat, appendix (eqs A1-A5), in the one case where one phase is exact; Abramowitz and
Stegun 16.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import ArrayLike

from contact_sim_pkg.laws.elastic_law import check_elastic
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.pressure.closed_form.jacobi import Array, cn_squared, quarter_period

LARGEST = 1.0e100  # of frequency, quadratic term and release, in SI units
LINEAR_BELOW = 1.0e-17  # of the way to the saddle: there m is below rounding


class CnoidalError(ValueError):
    """The requested motion is not periodic; the text says why."""


class QuadraticOscillator(NamedTuple):
    """``y'' = -frequency^2 y - quadratic y^2``."""

    frequency: float  # w0 [rad/s], > 0
    quadratic: float  # k [1/(m s^2)], any sign


class CnoidalMotion(NamedTuple):
    """The periodic motion that starts at rest at its turning point ``start``."""

    start: float  # [m], turning point at t = 0
    turn: float  # [m], the other turning point
    rate: float  # W [rad/s]
    complement: float  # 1 - m; 1 is the linear oscillator, 0 the homoclinic motion
    period: float  # [s]; infinite where homoclinic

    @property
    def homoclinic(self) -> bool:
        """Whether the motion ends at the saddle and never comes back."""
        return math.isinf(self.period)


def released_at(oscillator: QuadraticOscillator, start: float) -> CnoidalMotion:
    """Motion released at rest at ``start`` [m] on the side to which the spring stiffens (the sign
    of the quadratic term).

    ``start`` may be of either sign: the other turning point follows. Raises CnoidalError beyond the
    saddle, where the motion runs away, and ValueError where the frequency is not positive or a
    number is not finite.
    """
    w, k = oscillator
    if not (math.isfinite(w) and math.isfinite(k) and math.isfinite(start) and w > 0.0):
        raise ValueError(f"the oscillator (w0 {w} rad/s, k {k}) at {start} m needs finite numbers and w0 above 0")
    if not (1.0 / LARGEST <= w <= LARGEST and abs(k) <= LARGEST and abs(start) <= LARGEST):
        raise ValueError(f"the oscillator (w0 {w} rad/s, k {k}) at {start} m is beyond 1e-100 to 1e100")
    reach = 1.5 * w * w / abs(k) if k != 0.0 else math.inf  # the saddle lies at -2/3 of it
    if abs(start) <= LINEAR_BELOW * reach:
        return CnoidalMotion(start, -start, 0.5 * w, 1.0, 2.0 * math.pi / w)
    sign = math.copysign(1.0, k)
    y = sign * start
    upper, middle, lowest = _roots(y, reach) if y > 0.0 else _roots_from_below(y, reach)
    rate = math.sqrt(abs(k) * (upper - lowest) / 6.0)
    complement = (middle - lowest) / (upper - lowest)
    first, other = (upper, middle) if y > 0.0 else (middle, upper)
    period = 2.0 * quarter_period(complement)[0] / rate
    return CnoidalMotion(sign * first, sign * other, rate, complement, period)


def position(motion: CnoidalMotion, times: ArrayLike) -> Array:
    """y [m] at ``times`` [times] [s], in their shape; ``motion.start`` at t = 0. Raises ValueError
    for a time that is not finite."""
    t = numpy.asarray(times, dtype=numpy.float64)
    if not numpy.isfinite(t).all():
        raise ValueError("a time of the motion is not a finite number")
    if motion.complement == 1.0:
        return motion.turn + (motion.start - motion.turn) * numpy.cos(motion.rate * t) ** 2
    share = cn_squared(motion.rate * t, motion.complement)
    if _starts_at_the_soft_end(motion):  # then t counts from cn = 0
        share = cn_squared(motion.rate * t + quarter_period(motion.complement)[0], motion.complement)
        return motion.start + (motion.turn - motion.start) * share
    return motion.turn + (motion.start - motion.turn) * share


def contact_oscillator(mass: float, elastic: NormalElastic, preload: float) -> tuple[QuadraticOscillator, float]:
    """Oscillator of ``mass`` [kg] on ``F = A x^n`` under ``preload`` [N], to second order about its
    rest; and that approach.

    y counts deeper: ``w0^2 = n A x0^(n-1)/m``, ``k = n (n-1) A x0^(n-2)/(2 m)``, x0 in [m]. Raises
    ValueError where mass, preload or a parameter of the law is not a finite number above 0.
    """
    if not (0.0 < mass < math.inf and 0.0 < preload < math.inf):
        raise ValueError(f"a preloaded contact needs a finite mass and preload above 0, not {mass} kg and {preload} N")
    check_elastic(elastic)
    a, n = elastic.coefficient, elastic.exponent
    rest = float((preload / a) ** (1.0 / n))
    stiffness = n * a * rest ** (n - 1.0)
    return QuadraticOscillator(math.sqrt(stiffness / mass), float(0.5 * (n - 1.0) * stiffness / (rest * mass))), rest


def _starts_at_the_soft_end(motion: CnoidalMotion) -> bool:
    """The end with the smaller way from the origin is the stiff one: there cn = 1."""
    return abs(motion.start) > abs(motion.turn)


def _roots(upper: float, reach: float) -> tuple[float, float, float]:
    """Turning points for a release at ``upper`` > 0, mirrored so that k > 0: y^2 + b y + b y3 = 0
    with b = y3 + reach.
    """
    b = upper + reach
    discriminant = b * (b - 4.0 * upper)
    if discriminant < 0.0:
        raise CnoidalError(
            f"released at {upper:.6g} m the motion passes the saddle and runs away; at most {reach / 3.0:.6g} m"
        )
    lowest = -0.5 * (b + math.sqrt(discriminant))
    return upper, b * upper / lowest, lowest


def _roots_from_below(middle: float, reach: float) -> tuple[float, float, float]:
    """The same for a release at ``middle`` < 0, between the saddle and the origin."""
    if middle < -2.0 * reach / 3.0:
        raise CnoidalError(
            f"released at {middle:.6g} m, beyond the saddle at {-2.0 * reach / 3.0:.6g} m, the motion runs away"
        )
    b = middle + reach
    upper = 0.5 * (-b + math.sqrt(b * (b - 4.0 * middle)))
    return upper, middle, -(b + upper)
