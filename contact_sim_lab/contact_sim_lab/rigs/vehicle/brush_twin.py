"""Brush friction: Pacejka's closed forms, steady strips by quadrature, and single bristles followed
in small steps.

`slip` is the theoretical slip sigma >= 0, deflection per way of the belt: `hypot(kappa, tan(alpha))
/ (1 + kappa)`. Forces are sizes, along the slip; moments are those of a lateral force, about the
middle, positive when they align. Stiffnesses [N/m^3] are equal in both directions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq

__all__ = ["follow_bristles", "hertz_brush", "linear_start", "parabolic_brush", "steady_strip"]

Values = NDArray[numpy.float64]


def parabolic_brush(
    load: float, half_length: float, width: float, stiffness: float, friction: float, slip: float
) -> tuple[float, float]:
    """Force [N] and moment [N m] for `p = 3P/(4 a w) (1 - (x/a)^2)`: Pacejka, ch. 3, with theta and
    lambda = 1 - theta sigma.
    """
    theta = 2.0 * stiffness * width * half_length**2 / (3.0 * friction * load)
    stick = 1.0 - theta * slip
    if stick <= 0.0:
        return friction * load, 0.0
    return friction * load * (1.0 - stick**3), friction * load * half_length * stick**3 * (1.0 - stick)


def steady_strip(
    pressure: Callable[[float], float], half_length: float, stiffness: float, static: float, kinetic: float, slip: float
) -> tuple[float, float]:
    """Force [N/m] and moment [N] of one strip: stress `k sigma (a - x)` up to its first meeting
    with `mu_s p`, `mu_k p` behind.

    pressure: p(x) [Pa], above the line near x = a (the bristles stick where they enter), zero at x
    = -a.
    """
    a = half_length

    def excess(x: float) -> float:
        return static * pressure(x) - stiffness * slip * (a - x)

    # Bristles stick ahead of the border and slide behind it.
    border = brentq(excess, -a, a * (1.0 - 1e-9), xtol=1e-15)
    total, moment = 0.0, 0.0
    for stress, low, high in (
        (lambda x: kinetic * pressure(x), -a, border),
        (lambda x: stiffness * slip * (a - x), border, a),
    ):
        total += quad(stress, low, high, epsabs=0.0, epsrel=1e-10)[0]
        moment -= quad(lambda x, stress=stress: x * stress(x), low, high, epsabs=1e-9, epsrel=1e-10)[0]
    return total, moment


def hertz_brush(
    peak: float, semi_axes: tuple[float, float], stiffness: float, static: float, kinetic: float, slip: float
) -> tuple[float, float]:
    """Force [N] and moment [N m] under `peak sqrt(1 - (x/a)^2 - (y/b)^2)`: strips, `y = b sin(t)`,
    by quadrature.
    """
    a, b = semi_axes

    def strip(t: float) -> tuple[float, float]:
        half = a * numpy.cos(t)
        top = peak * numpy.cos(t)
        return steady_strip(
            lambda x: top * numpy.sqrt(max(0.0, 1.0 - (x / half) ** 2)), half, stiffness, static, kinetic, slip
        )

    points, weights = numpy.polynomial.legendre.leggauss(24)
    angles = 0.25 * numpy.pi * (points + 1.0)  # 0 to pi/2, both halves by symmetry
    parts = numpy.array([strip(t) for t in angles]) * (0.5 * numpy.pi * weights * b * numpy.cos(angles))[:, None]
    return float(parts[:, 0].sum()), float(parts[:, 1].sum())


def linear_start(half_length: float, width: float, stiffness: float, slip: float, way: float) -> tuple[float, float]:
    """Force and moment without sliding, after `way` [m] of the belt from unstrained bristles: `u =
    sigma min(a - x, way)`.
    """
    a, s = half_length, min(way, 2.0 * half_length)
    scale = stiffness * width * slip
    return scale * (2.0 * a * s - 0.5 * s * s), scale * (0.5 * a * s * s - s**3 / 6.0)


def follow_bristles(
    pressure: Callable[[Values, float], Values], places: Values, stiffness: float, friction: tuple[float, float],
    belt: float, slide: tuple[float, float], steps: int,
) -> Values:  # fmt: skip
    """Stresses [Pa], [n, 2], of the bristles that stand at `places` [m] at the end, unstrained at
    the start.

    pressure(x, part): p [Pa] at the places x when `part` of the way is done; friction: static and
    kinetic ratio; belt: way backwards [m]; slide: way of the road relative to the belt [m]. Each
    bristle is followed from where it came.
    """
    deflection = numpy.zeros((len(places), 2))
    slid: NDArray[numpy.bool_] = numpy.zeros(len(places), dtype=bool)
    static, kinetic = friction
    for n in range(1, steps + 1):
        # Each bristle has its own place in the field at this instant.
        p = pressure(places + belt * (1.0 - n / steps), n / steps)
        deflection += numpy.array(slide) / steps
        stress = stiffness * numpy.hypot(deflection[:, 0], deflection[:, 1])
        # Kinetic friction holds once a bristle slides, static friction before.
        slid = stress > numpy.where(slid, kinetic, static) * p
        factor = numpy.where(slid, kinetic * p / numpy.where(stress > 0.0, stress, 1.0), 1.0)
        deflection *= factor[:, None]
        slid &= p > 0.0
    return stiffness * deflection
