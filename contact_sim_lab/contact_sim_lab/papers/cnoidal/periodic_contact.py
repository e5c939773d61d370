"""Periodic motions of the back-rest contact, integrated: the free one under preload, and the steady
response to a shaken seat.

Set-up of Driver and Seat's figures 4-7: 45.6 kg, A = 2.46e5 N/m^1.5, damping 1.950 s/m (e = 0.6 at
0.5 m/s), 0.5 g (contact kept) and 1.5 g (slaps) at 4.75, 5.25, 5.75 and 6.25 Hz.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import NormalDissipative, NormalElastic

__all__ = ["AMPLITUDES", "FREQUENCIES", "GRAVITY", "LAW", "MASS", "Steady", "exact_period", "steady_response"]

Array = NDArray[numpy.float64]

MASS, GRAVITY = 45.6, 9.81
LAW, DISSIPATIVE = NormalElastic(2.46e5, 1.5), NormalDissipative(1.950)
FREQUENCIES = (4.75, 5.25, 5.75, 6.25)  # [Hz], the spine's
AMPLITUDES = (0.5, 1.5)  # [g]
TRANSIENT, SAMPLES = 60, 256  # periods before the one that is looked at; samples of it


class Steady(NamedTuple):
    """One period of the approach."""

    approach: Array  # [SAMPLES] [m]
    # Of the last two periods, relative to the spread: 0 where the response has the drive's period
    mismatch: float


def exact_period(elastic: NormalElastic, mass: float, preload: float, deepest: float) -> float:
    """Period [s] of the free motion released at the approach ``deepest`` [m]: the energy integral
    by quadrature.
    """

    def potential(x: float) -> float:
        return float(
            elastic.coefficient * max(x, 0.0) ** (elastic.exponent + 1.0) / (elastic.exponent + 1.0) - preload * x
        )

    rest = (preload / elastic.coefficient) ** (1.0 / elastic.exponent)
    level = potential(deepest)
    lowest = brentq(lambda x: potential(x) - level, -1e3 * rest, rest, xtol=1e-16, rtol=1e-15)
    middle, half = 0.5 * (deepest + lowest), 0.5 * (deepest - lowest)

    # dt over the angle of a sine along the path: no singularity at the turning points
    def slowness(angle: float) -> float:
        left = level - potential(middle + half * math.sin(angle))
        return half * math.cos(angle) / math.sqrt(2.0 / mass * left) if left > 0.0 else 0.0

    return 2.0 * float(quad(slowness, -0.5 * math.pi, 0.5 * math.pi, epsabs=1e-13, epsrel=1e-12, limit=400)[0])


def steady_response(frequency: float, amplitude: float, tolerance: float = 1e-9) -> Steady:
    """Approach over one period after the transient, for a seat shaken at ``frequency`` [Hz] and
    ``amplitude`` [g].
    """
    angular = 2.0 * math.pi * frequency
    stroke = amplitude * GRAVITY / angular**2
    rig = PointContact(MASS, GRAVITY, stroke, angular, LAW, DISSIPATIVE)
    rest = (MASS * GRAVITY / LAW.coefficient) ** (1.0 / LAW.exponent)
    start, scale = numpy.array([-rest, stroke * angular]), numpy.array([rest, 1.0]) * tolerance
    period = 1.0 / frequency
    times = numpy.concatenate([[0.0], TRANSIENT * period + numpy.arange(2 * SAMPLES) * period / SAMPLES])
    states = integrate(rig, start, scale, times).states[1:]
    approach = stroke * numpy.sin(angular * times[1:]) - states[:, 0]
    first, last = approach[:SAMPLES], approach[SAMPLES:]
    return Steady(last, float(numpy.abs(last - first).max() / last.std()))
