"""The micro-impact wave: how fast the border of the contact and the front around it grow
(Goloshchapov eqs 75-80).

``r' = k_p sqrt(R) x'/(2 sqrt x)``, ``r_AW' = (1 + sqrt 2)/2 r'``: without bound at first touch. The
front is faster than the shear wave, ``V_s = sqrt(G'/rho)``, for 0 < t < t_s; a speed requested in
that phase is given as V_s and flagged. t_s is the root of r_AW' = V_s on the integrated motion;
less expensive: on the damped sine (eq 80), and for small times ``[k_p sqrt(R)(1 + sqrt 2)/4]^2
V0/V_s^2``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.rigs.impact.theory.checks import check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.closed_form.scalings import damped_sine
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, course
from contact_sim_pkg.rigs.impact.theory.roots import bracketed_root

__all__ = ["Front", "border_speed", "front_of_damped_sine", "front_of_small_times", "front_speed", "front_time"]

FRONT_OVER_BORDER = 0.5 * (1.0 + math.sqrt(2.0))
EARLIEST = 1.0e-12  # part of the compression time where the search begins


class Front(NamedTuple):
    """The end of the supersonic phase."""

    time: float  # t_s [s]
    depth: float  # x_s [m], the least depth for which a viscous stress is given
    speed: float  # x' at t_s [m/s]
    heat: float  # [J] that the viscous force has turned into heat by then


def border_speed(impact: FreeImpact, depth: float, speed: float, shear_speed: float) -> tuple[float, bool]:
    """Speed of the contact's border in [m/s] (eq 76), and whether it is above the shear wave's:
    then it is given as V_s.

    depth [m], speed [m/s], shear_speed > 0 [m/s]; raises ImpactError otherwise.
    """
    _check_state(depth, speed, shear_speed)
    return _limited(_border(impact, depth, speed), shear_speed)


def front_speed(impact: FreeImpact, depth: float, speed: float, shear_speed: float) -> tuple[float, bool]:
    """Speed of the wave front in [m/s] (eq 77), and whether it is above the shear wave's: then it
    is given as V_s.

    Arguments as `border_speed`.
    """
    _check_state(depth, speed, shear_speed)
    return _limited(FRONT_OVER_BORDER * _border(impact, depth, speed), shear_speed)


def front_time(impact: FreeImpact, shear_speed: float) -> Front:
    """End of the supersonic phase on the integrated motion. There is always one: the front stands
    still at the turning point.

    shear_speed: [m/s].
    """
    check_positive("shear wave speed", shear_speed, "m/s")

    def excess(time: float) -> float:
        now = course(impact, numpy.array([time]))
        speed = FRONT_OVER_BORDER * _border(impact, float(now.depth[0]), float(now.speed[0]))
        return math.log(max(speed, 1e-300) / shear_speed)

    first = _earliest(impact, shear_speed)
    time = bracketed_root(excess, first, impact.compression_time, 1.0e-14)
    now = course(impact, numpy.array([time]))
    return Front(time, float(now.depth[0]), float(now.speed[0]), viscous_heat(impact, time))


def front_of_small_times(impact: FreeImpact, shear_speed: float) -> Front:
    """The same with ``x = V0 t``, for t_s far below tau_1; heat ``8/3 k_p sqrt(R) (E''/w) V0 (V0
    t_s)^(3/2)``.

    shear_speed: [m/s].
    """
    check_positive("shear wave speed", shear_speed, "m/s")
    time = _small_time(impact, shear_speed)
    depth = impact.speed * time
    return Front(time, depth, impact.speed, 2.0 / 3.0 * impact.viscous * impact.speed * depth**1.5)


def front_of_damped_sine(impact: FreeImpact, shear_speed: float) -> float:
    """t_s [s] as the root of eq 80: the damped sine of constant parameters in place of the motion.
    Up to tan(beta) = 0.43701.
    """
    check_positive("shear wave speed", shear_speed, "m/s")
    sine = damped_sine(impact.sphere, impact.material, impact.speed, "corrected", impact.shape)

    def excess(time: float) -> float:
        angle, fall = sine.frequency * time, impact.speed / sine.frequency * math.exp(-sine.damping * time)
        depth = fall * math.sin(angle)
        speed = fall * (sine.frequency * math.cos(angle) - sine.damping * math.sin(angle))
        return FRONT_OVER_BORDER * _border(impact, depth, speed) - shear_speed

    first = min(0.1 * _small_time(impact, shear_speed), EARLIEST * sine.compression_time)
    return bracketed_root(excess, first, sine.compression_time, 1.0e-14)


def viscous_heat(impact: FreeImpact, time: float) -> float:
    """Work of the viscous force from first touch to ``time`` in [J], 0 to tau_1: 40 Gauss points in
    sqrt(t), where it is smooth.
    """
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    edge = math.sqrt(time)
    root = 0.5 * edge * (nodes + 1.0)
    now = course(impact, root**2)
    return float(0.5 * edge * numpy.sum(weights * now.viscous_force * now.speed * 2.0 * root))


def _check_state(depth: float, speed: float, shear_speed: float) -> None:
    check_number("depth", depth, "m")
    check_number("speed", speed, "m/s")
    check_positive("shear wave speed", shear_speed, "m/s")


def _border(impact: FreeImpact, depth: float, speed: float) -> float:
    if depth <= 0.0:
        return math.inf if speed > 0.0 else 0.0
    return 0.5 * impact.shape * math.sqrt(impact.sphere.radius / depth) * speed


def _limited(speed: float, shear_speed: float) -> tuple[float, bool]:
    supersonic = speed > shear_speed
    return (shear_speed if supersonic else speed), supersonic


def _small_time(impact: FreeImpact, shear_speed: float) -> float:
    return (0.5 * FRONT_OVER_BORDER * impact.shape / shear_speed) ** 2 * impact.sphere.radius * impact.speed


def _earliest(impact: FreeImpact, shear_speed: float) -> float:
    """A time at which the front is surely supersonic: a tenth of the formula for small times,
    within the compression.
    """
    return min(0.1 * _small_time(impact, shear_speed), 0.01 * impact.compression_time)
