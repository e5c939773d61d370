"""A known wrench on the body besides gravity and contact: a force at the centre of mass and a
torque, in world axes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline, make_interp_spline

from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["NO_WRENCH", "ExternalWrench", "constant", "sampled"]


SMALLEST, LARGEST = 1e-9, 1e12  # component of a wrench, [N] or [N m]


class _Course(NamedTuple):
    """One vector over time with its first and second integral."""

    value: BSpline
    integral: BSpline
    double_integral: BSpline


class ExternalWrench(NamedTuple):
    """Force in [N] and torque in [N m] over time; `None` for what is absent."""

    force: _Course | None
    torque: _Course | None
    begin: float  # [s] from which it is known
    end: float  # [s]

    @property
    def present(self) -> bool:
        """Whether there is any."""
        return self.force is not None or self.torque is not None

    def torque_at(self, time: Array) -> Array:
        """Torque [..., 3] in [N m]."""
        return numpy.zeros((*numpy.shape(time), 3)) if self.torque is None else numpy.asarray(self.torque.value(time))

    def push(self, begin: float, end: Array | float) -> Array:
        """Integral of the force from `begin` to `end`, [..., 3] in [N s]."""
        return _integral(self.force, begin, end)

    def twist(self, begin: float, end: Array | float) -> Array:
        """Integral of the torque, [..., 3] in [N m s]."""
        return _integral(self.torque, begin, end)

    def shift(self, begin: float, end: Array) -> Array:
        """`int int F dt dt` from rest at `begin`, [..., 3] in [N s^2]."""
        if self.force is None:
            return numpy.zeros((*numpy.shape(end), 3))
        way = self.force.double_integral(end) - self.force.double_integral(begin)
        slope = self.force.integral(begin)
        return numpy.asarray(way - (numpy.asarray(end) - begin)[..., None] * slope)


def _integral(course: _Course | None, begin: float, end: Array | float) -> Array:
    if course is None:
        return numpy.zeros((*numpy.shape(end), 3))
    return numpy.asarray(course.integral(end) - course.integral(begin))


def constant(force: ArrayLike | None = None, torque: ArrayLike | None = None) -> ExternalWrench:
    """The same force [x, y, z] [N] and torque [x, y, z] [N m] all the time, in world axes."""
    time = numpy.array([0.0, 1.0])
    values = [
        None if each is None else numpy.tile(numpy.asarray(each, dtype=numpy.float64), (2, 1))
        for each in (force, torque)
    ]
    return sampled(time, values[0], values[1])._replace(begin=-numpy.inf, end=numpy.inf)


def sampled(time: Array, force: Array | None, torque: Array | None) -> ExternalWrench:
    """Force and torque [n, 3] at `time` [n] in [s], linear between; IdentificationError where
    something is not finite.
    """
    if len(time) < 2 or not (numpy.diff(time) > 0.0).all():
        raise IdentificationError(f"a wrench over time needs two or more instants that grow; there are {len(time)}")
    return ExternalWrench(
        _course(time, force, "force"), _course(time, torque, "torque"), float(time[0]), float(time[-1])
    )


def _course(time: Array, values: Array | None, name: str) -> _Course | None:
    if values is None or not numpy.any(values):
        return None
    if values.shape != (len(time), 3) or not (abs(values) <= LARGEST).all():
        raise IdentificationError(
            f"the external {name} needs three components of at most {LARGEST:g} (N, N m), not {values.tolist()[0]}"
        )
    if abs(values).max() < SMALLEST:
        raise IdentificationError(
            f"the external {name} is at most {abs(values).max():.3g} (N, N m): give one of {SMALLEST:g} or more, or none"
        )
    value = make_interp_spline(time, values, k=1)
    return _Course(value, value.antiderivative(1), value.antiderivative(2))


NO_WRENCH = ExternalWrench(None, None, -numpy.inf, numpy.inf)
