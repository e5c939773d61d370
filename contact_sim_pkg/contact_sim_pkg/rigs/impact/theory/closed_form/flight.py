"""Flight of the sphere between two impacts: free fall in a drop tower, or the swing of a pendulum
that strikes at its lowest point.

The approach x is negative in flight. Drop: ``x = x0 + v0 t + g t^2/2``. Pendulum of length l: ``x =
l phi``, ``sin(phi/2) = -kappa cd(w0 (t - t_turn))``, ``w0 = sqrt(g/l)``, ``kappa = sin(phi_max/2)``
(Landau and Lifshitz, Mechanics, 11), at any amplitude; its weight has no part along the blow at the
lowest point.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.pressure.closed_form.jacobi import jacobi_cn, quarter_period
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = ["Drop", "Flight", "Machine", "Pendulum", "fall", "rebound"]


class Drop(NamedTuple):
    """Drop tower."""

    gravity: float  # [m/s^2], > 0


class Pendulum(NamedTuple):
    """Pendulum whose mass is at its end; the sample stands at the lowest point."""

    gravity: float  # [m/s^2], > 0
    length: float  # [m], > 0


Machine = Drop | Pendulum


class Flight(NamedTuple):
    """A flight from the sample to its highest point and back; or, from the highest point on, its
    second half.
    """

    machine: Machine
    speed: float  # [m/s] at the sample, both ways
    begin: float  # [s] behind leaving the sample, where the flight begins: 0, or half the flight

    @property
    def duration(self) -> float:
        """Time from its begin to the touch in [s]."""
        return 2.0 * half_time(self.machine, self.speed) - self.begin

    @property
    def height(self) -> float:
        """Height in [m] of the highest point above the sample."""
        return self.speed**2 / (2.0 * self.machine.gravity)

    def at(self, times: Vector) -> tuple[Vector, Vector]:
        """Approach x [m] (negative) and its rate [m/s] at ``times`` [s] behind the begin."""
        since = check_values("times", times, "s") + self.begin - half_time(self.machine, self.speed)
        if isinstance(self.machine, Drop):
            g = self.machine.gravity
            return 0.5 * g * since**2 - self.height, g * since
        return _swing(self.machine, self.speed, since)

    def potential(self, approach: Vector) -> Vector:
        """Energy a mass in [J/kg] above the sample's surface."""
        machine = self.machine
        if isinstance(machine, Drop):
            return -machine.gravity * approach
        return 2.0 * machine.gravity * machine.length * numpy.sin(0.5 * approach / machine.length) ** 2


def rebound(machine: Machine, speed: float) -> Flight:
    """Flight that leaves the sample with ``speed`` > 0 [m/s].

    Raises ImpactError where a pendulum would not swing back, and for a speed, gravity or length
    that is not above 0.
    """
    _check(machine, speed)
    return Flight(machine, speed, 0.0)


def fall(machine: Machine, speed: float) -> Flight:
    """Flight from rest at the height from which the sample is reached with ``speed`` > 0 [m/s].
    Errors as `rebound`.
    """
    _check(machine, speed)
    return Flight(machine, speed, half_time(machine, speed))


def half_time(machine: Machine, speed: float) -> float:
    """Time in [s] between the sample and the highest point."""
    if isinstance(machine, Drop):
        return speed / machine.gravity
    return quarter_period(1.0 - _parameter(machine, speed))[0] * math.sqrt(machine.length / machine.gravity)


def _parameter(machine: Pendulum, speed: float) -> float:
    """``kappa^2 = v^2/(4 g l)``."""
    return speed**2 / (4.0 * machine.gravity * machine.length)


def _check(machine: Machine, speed: float) -> None:
    check_positive("impact speed", speed, "m/s")
    check_fields("machine", machine, positive="gravity" if isinstance(machine, Drop) else "gravity length")
    if isinstance(machine, Pendulum) and not _parameter(machine, speed) <= 0.5:
        most = math.sqrt(2.0 * machine.gravity * machine.length)
        raise ImpactError(
            f"impact speed {speed:g} m/s: a pendulum of {machine.length:g} m reaches {most:.4g} m/s from the horizontal; "
            "take a longer one"
        )


def _swing(machine: Pendulum, speed: float, since: Vector) -> tuple[Vector, Vector]:
    """Arc and its rate at times from the turning point."""
    parameter = _parameter(machine, speed)
    pace = math.sqrt(machine.gravity / machine.length)
    cn = jacobi_cn(numpy.abs(since) * pace, 1.0 - parameter)
    dn = numpy.sqrt(1.0 - parameter + parameter * cn**2)
    half_sine = math.sqrt(parameter) * cn / dn
    sn = numpy.sqrt(numpy.clip(1.0 - cn**2, 0.0, None))
    cosine = numpy.sqrt(1.0 - half_sine**2)
    rate = 2.0 * math.sqrt(parameter) * pace * (1.0 - parameter) * sn / dn**2 / cosine
    return -2.0 * machine.length * numpy.arcsin(half_sine), machine.length * rate * numpy.sign(since)
