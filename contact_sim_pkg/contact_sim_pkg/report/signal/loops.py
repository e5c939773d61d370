"""Loops of a force over the displacement it works on, and the steady part of a run that they are
drawn for.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from scipy.integrate import trapezoid

from contact_sim_pkg.excitation.kinds import VibrationKind, kind_known
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.series import ContactSeries, FieldSeries, FloatArray

LAST_CYCLES = 2
"""Cycles of the drive at the end of a run that stand for its steady state."""
FEW_INSTANTS = 100
"""Fewer of them in the last cycles would make corners of a loop: it is shown as dots, over the
second half of the run.
"""


class Loop(NamedTuple):
    """A force over the displacement it works on, in the order of time."""

    time: FloatArray
    """[s]"""
    displacement: FloatArray
    """[m]"""
    force: FloatArray
    """[N]"""

    def since(self, time: float) -> Loop:
        """The part from this time [s] on."""
        chosen = self.time >= time
        return Loop(*(column[chosen] for column in self))

    def steady(self, begin: float) -> tuple[Loop, bool]:
        """What stands for the steady state of a run whose last cycles begin at `begin` [s]; whether
        it is shown as dots.
        """
        last = self.since(begin)
        if begin <= 0.0 or last.time.size >= FEW_INSTANTS:
            return last, False
        return self.since(min(begin, 0.5 * float(self.time[-1]))), True


class AreaRatio(NamedTuple):
    """Area of the contact domain over the area under the static load."""

    time: FloatArray
    """[s]"""
    ratio: FloatArray
    reference: float
    """[m^2] S_ref"""


def vibration_period(scene: dict[str, Any]) -> float | None:
    """Period [s] of the vibration of a scene; None for one without, or that this version does not know."""
    vibration: VibrationKind | None = kind_known("vibration", scene.get("vibration"))
    return None if vibration is None else vibration.period


def period_of(section: dict[str, Any]) -> float | None:
    """Period [s] of a section of the scene with a frequency [Hz]; None without one."""
    frequency = section.get("frequency")
    return 1.0 / frequency if isinstance(frequency, (int, float)) and frequency > 0.0 else None


def steady_start(end: float, period: float | None, cycles: int = LAST_CYCLES) -> float:
    """Time [s] from which the last `cycles` cycles run to `end` [s]; 0 without a period or in a
    shorter run.
    """
    return 0.0 if period is None else max(0.0, end - cycles * period)


def normal_loop(contact: ContactSeries) -> Loop:
    """Normal force of the whole contact over the approach of its deepest point, at the full
    rate.
    """
    return Loop(contact.time, contact.approach, contact.normal)


def point_loop(points: PointSeries) -> Loop:
    """Normal force over approach of point 1, at the rate of the fields."""
    return Loop(points.time, points.approach, points.normal)


def tangential_loop(contact: ContactSeries, points: PointSeries) -> Loop:
    """Friction of point 1 on the seat back, F_t of the paper's eq 9, over the displacement of the
    back along it.

    A single point is the whole contact, whose force is recorded at the full rate; its displacement,
    recorded at the rate of the fields, is then taken between by a cubic spline. Of one of many
    points both are at the rate of the fields. (The bag has the force on the back, of the other
    sign.)
    """
    if points.points > 1 or points.time.size < 4:
        return Loop(points.time, points.displacement, -points.tangential)
    from scipy.interpolate import CubicSpline  # on use: it takes 0.2 s to load

    inside = (contact.time >= points.time[0]) & (contact.time <= points.time[-1])
    time = contact.time[inside]
    displacement: FloatArray = CubicSpline(points.time, points.displacement)(time)
    return Loop(time, displacement, -contact.tangential[inside])


def loop_work(loop: Loop) -> float:
    """Work [J] done along the loop, integral of F d(displacement) by trapezia."""
    return float(trapezoid(loop.force, loop.displacement))


def area_ratio(field: FieldSeries) -> AreaRatio | None:
    """S(t)/S_ref; S_ref is the area of the first field, at rest under the static load. None where
    that is not in the bag.
    """
    if field.time[0] > 0.0 or field.area[0] <= 0.0:
        return None
    reference = float(field.area[0])
    return AreaRatio(field.time, field.area / reference, reference)
