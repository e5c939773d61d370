"""Free impact of one mass on a Hunt-Crossley or an elastic power law: closed forms in multiple
precision.

`m x'' = -A x^n (1 + damping x')`, x(0) = 0, x'(0) = v0 > 0. Sources: Hunt and Crossley (1975), J.
Appl. Mech. 42, 440; Johnson (1985), Contact Mechanics, 11.4.
"""

from __future__ import annotations

import mpmath

__all__ = [
    "damping_of_restitution",
    "deepest_approach",
    "duration",
    "elastic_impact",
    "restitution",
    "sphere_coefficient",
]

DIGITS = 40


def restitution(damping: float) -> float:
    """Coefficient of restitution e [1] by bisection: `d (1 + e) = ln[(1 + d)/(1 - d e)]`, `damping`
    d
    = damping * v0 > 0 [1]."""
    with mpmath.workdps(DIGITS):
        d = mpmath.mpf(damping)
        low, high = mpmath.mpf(0), min(mpmath.mpf(1), 1 / d)
        for _ in range(150):
            e = (low + high) / 2
            if d * (1 + e) - mpmath.log((1 + d) / (1 - d * e)) > 0:
                low = e
            else:
                high = e
        return float((low + high) / 2)


def damping_of_restitution(ratio: float, speed: float) -> float:
    """Damping [s/m] that ends a free impact at `speed` [m/s] with `ratio` (0 < ratio < 1) of it, by
    bisection in ln d.
    """
    with mpmath.workdps(DIGITS):
        e = mpmath.mpf(ratio)
        low, high = mpmath.mpf(10) ** -12, (1 - mpmath.mpf(10) ** -38) / e
        for _ in range(400):
            d = mpmath.sqrt(low * high)
            if d * (1 + e) - mpmath.log((1 + d) / (1 - d * e)) > 0:
                low = d
            else:
                high = d
        return float(mpmath.sqrt(low * high) / mpmath.mpf(speed))


def deepest_approach(mass: float, speed: float, coefficient: float, exponent: float, damping: float) -> float:
    """Largest approach [m]: `A x^(n+1)/(n+1) = m [v0/damping - ln(1 + damping v0)/damping^2]`;
    elastic where damping is 0.
    """
    with mpmath.workdps(DIGITS):
        m, v, a, n, c = (mpmath.mpf(value) for value in (mass, speed, coefficient, exponent, damping))
        energy = m * v**2 / 2 if c == 0 else m * (v / c - mpmath.log(1 + c * v) / c**2)
        return float(((n + 1) * energy / a) ** (1 / (n + 1)))


def duration(mass: float, speed: float, coefficient: float, exponent: float, damping: float) -> float:
    """Time in contact [s]: `integral of dv / |v'|` from v0 to -e v0, with x(v) from the first
    integral, by quadrature.
    """
    if damping == 0.0:
        return elastic_impact(mass, speed, coefficient, exponent)[0]
    with mpmath.workdps(30):
        m, v0, a, n, c = (mpmath.mpf(value) for value in (mass, speed, coefficient, exponent, damping))
        rebound = mpmath.findroot(
            lambda v: (v0 - v) / c - mpmath.log((1 + c * v0) / (1 + c * v)) / c**2,
            -mpmath.mpf(restitution(damping * speed)) * v0,
        )

        def slowness(v: mpmath.mpf) -> mpmath.mpf:
            work = m * ((v0 - v) / c - mpmath.log((1 + c * v0) / (1 + c * v)) / c**2)
            force = a * ((n + 1) * abs(work) / a) ** (n / (n + 1)) * (1 + c * v)
            return m / force

        return float(mpmath.quad(slowness, [rebound, 0, v0], maxdegree=12))


def elastic_impact(mass: float, speed: float, coefficient: float, exponent: float) -> tuple[float, float, float]:
    """Duration [s], depth [m] and peak force [N] without dissipation: `T = 2/(n+1) B(1/(n+1), 1/2)
    x_m / v0`.
    """
    with mpmath.workdps(DIGITS):
        m, v, a, n = (mpmath.mpf(value) for value in (mass, speed, coefficient, exponent))
        depth = ((n + 1) * m * v**2 / (2 * a)) ** (1 / (n + 1))
        time = 2 / (n + 1) * mpmath.beta(1 / (n + 1), mpmath.mpf(1) / 2) * depth / v
        return float(time), float(depth), float(a * depth**n)


def sphere_coefficient(radius: float, young_modulus: float, poisson_ratio: float) -> float:
    """A [N/m^1.5] of a ball on a flat of the same material: `4/3 E* sqrt(R)`, `E* = E / (2 (1 -
    nu^2))`.
    """
    modulus = young_modulus / (2.0 * (1.0 - poisson_ratio**2))
    return 4.0 / 3.0 * modulus * float(mpmath.sqrt(radius))
