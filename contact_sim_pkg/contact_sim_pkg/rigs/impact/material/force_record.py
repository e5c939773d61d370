"""One impact from its force over time: impulse, duration and restitution."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import simpson

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import RecordedTable
from contact_sim_pkg.excitation.table_files import read_recording
from contact_sim_pkg.excitation.table_words import bare_name
from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.reading import FORCE_NAMES, Impacts

__all__ = ["ForceRecord", "read_force"]

FEWEST = 10
"""samples in contact"""
FEWEST_OUTSIDE = 5
"""samples without contact, before and after"""
LOWEST = 1e-3
"""of the peak: force from which on there is contact, where noise is lower still"""
NOISE = 5.0
"""standard deviations of the noise that are no contact"""
DRIFT = 0.02
"""of the peak: difference of the zeros before and after"""
FLAT = 0.1
"""of the samples in contact that may lie at the largest value; at 8 bits 0.06 of a half sine do"""
OTHER_CONTACT = 0.05
"""of the peak"""
ABOVE_ONE = 0.05
"""that noise may add to a restitution of 1"""

Vector = NDArray[numpy.float64]


class ForceRecord(NamedTuple):
    """What a force over time says of its impact."""

    file: str
    line: int
    """of the largest force"""
    impulse: float
    """[N s] of the force"""
    duration: float
    """[s] from the first force to the last"""
    restitution: float
    """k of `J = m V0 (1 + k) + m g tau`"""
    peak: float
    """[N]"""
    samples: int
    """in contact"""
    notes: tuple[str, ...]
    """what was found and done, a sentence each"""

    def impacts(self, mass: float, radius: float, speed: float, gravity: float) -> Impacts:
        """The impact of a sphere as a line of a file of impacts; [kg], [m], [m/s], [m/s^2]."""
        one = {
            "mass": mass,
            "radius": radius,
            "speed": speed,
            "duration": self.duration,
            "restitution": self.restitution,
        }
        columns: dict[str, Vector] = {name: numpy.array([value]) for name, value in one.items()}
        weight = numpy.array([gravity]) if gravity else None
        return Impacts(
            file=self.file, line=numpy.array([self.line]), temperature=None, notes=(), gravity=weight, **columns
        )


def read_force(
    path: Path,
    mass: float,
    speed: float,
    *,
    gravity: float = 0.0,
    column: str | None = None,
    time_unit: str | None = None,
) -> ForceRecord:
    """Impulse, duration and restitution of the largest impact in a table of time and force.

    The zero before the contact is taken off. Contact lasts where the force is above 1/1000 of its peak and five standard
    deviations of the noise; its two ends are where straight lines through the force there and twice it meet zero. The
    impulse is Simpson's, the restitution k = J/(m V0) - g tau/V0 - 1.

    Args:
        path: of a recording of any format.
        mass: [kg] of what strikes.
        speed: V0 [m/s] at the first touch.
        gravity: [m/s^2] along the blow during the contact.
        column: of the force; None: by its usual names, or the only one in N.
        time_unit: s, ms, us or ns; None: as the file says, else s.

    Raises:
        MaterialError: no whole contact between two zeros, too few samples, clipped, or a restitution outside 0 to 1.
    """
    try:
        table = read_recording(path)
        name = column or _force_of(table)
        force, (time, said) = table.column(name), table.time(None, time_unit)
    except ExcitationError as error:
        raise MaterialError(str(error).replace("vibration.", "")) from None
    if time is None:
        raise MaterialError(
            f"{path}: there is no column of times; the header names {', '.join(table.columns)}; call one time [s]"
        )
    back = numpy.flatnonzero(numpy.diff(time) <= 0.0)
    if back.size:
        raise MaterialError(f"{path}, line {table.lines[back[0] + 1]}: the time does not go on; cut the record there")
    notes = [*table.notes, *([said] if said else [])]
    if table.units.get(bare_name(name)) is None:
        notes.append(f"The column {name} has no unit: N is assumed.")
    if -force.min() > force.max():
        force = -force
        notes.append("The force is largest below zero: its sign is turned.")
    contact = _contact(str(path), time, force)
    notes += contact.notes
    start, end = contact.start, contact.end
    inside = (time > start) & (time < end)
    _refuse_unfit(str(path), time, force, inside)
    places = numpy.concatenate([[start], time[inside], [end]])
    values = numpy.concatenate([[0.0], force[inside] - contact.zero(time[inside]), [0.0]])
    impulse, duration = float(simpson(values, x=places)), end - start
    k = impulse / (mass * speed) - gravity * duration / speed - 1.0
    if not 0.0 < k <= 1.0 + ABOVE_ONE:
        raise MaterialError(
            f"{path}: restitution {k:.4g} from an impulse of {impulse:.4g} N s within {duration:.4g} s, {mass:g} kg and {speed:g} "
            "m/s; 0 to 1 is possible; check mass, speed, the unit of the force (in brackets behind its name) and that of the time "
            "(--time-unit)"
        )
    peak = int(force.argmax())
    return ForceRecord(
        str(path), int(table.lines[peak]), impulse, duration, k, float(values.max()), int(inside.sum()), tuple(notes)
    )


def _force_of(table: RecordedTable) -> str:
    """Name of the column of the force. Raises MaterialError where none or several can be it."""
    usual = [name for name in FORCE_NAMES if name in table.columns and table.units.get(name, "N") == "N"]
    found = usual[:1] or [name for name, unit in table.units.items() if unit == "N"]
    if len(found) != 1:
        what = "no column of a force" if not found else f"several forces ({', '.join(found)})"
        raise MaterialError(
            f"{table.file}: {what}; the header names {', '.join(table.columns)}; name it by --force COLUMN"
        )
    return found[0]


class _Contact(NamedTuple):
    start: float
    end: float
    """[s]"""
    before: float
    after: float
    """[N] the zeros, as recorded"""
    notes: list[str]

    def zero(self, time: Vector) -> Vector:
        """What is no force [N]: the zero before, the one after, a straight line between them in the contact."""
        found: Vector = numpy.interp(time, [self.start, self.end], [self.before, self.after])
        return found


def _contact(name: str, time: Vector, force: Vector) -> _Contact:
    """The contact round the largest force, between its zeros. Raises MaterialError."""
    top, many = int(force.argmax()), max(FEWEST_OUTSIDE, len(force) // 50)
    first, last = many, len(force) - many
    for _ in range(2):  # again, with all that lies before and after the contact
        (before, noise), (after, _) = _level(force[:first]), _level(force[last:])
        height = float(force[top]) - before
        least = max(LOWEST * height, NOISE * noise)
        if not height > 0.0:
            raise MaterialError(f"{name}: no force rises above the first {many} samples; record a whole impact")
        if not 4.0 * least < height:
            raise MaterialError(
                f"{name}: the force before the contact scatters by {noise:.3g} N, its peak is {height:.3g} N: the record begins in "
                "contact or hides it in noise; record from before the touch, or filter it"
            )
        if abs(after - before) > DRIFT * height:
            raise MaterialError(
                f"{name}: the force does not return to its zero: {before:.4g} N before, {after:.4g} N after, peak {height:.4g} N; "
                "record until after the rebound, or take the drift off"
            )
        without = numpy.flatnonzero(~(force - numpy.where(time <= time[top], before, after) > least))
        earlier, later = without[without < top], without[without > top]
        if earlier.size < FEWEST_OUTSIDE or later.size < FEWEST_OUTSIDE:
            side = "before" if earlier.size < FEWEST_OUTSIDE else "after"
            raise MaterialError(
                f"{name}: less than {FEWEST_OUTSIDE} samples without force {side} the contact; record from before the touch until "
                "after the rebound"
            )
        first, last = int(earlier[-1]) + 1, int(later[0])
    notes = []
    if abs(before) > LOWEST * height:
        notes.append(f"An offset of {before:.4g} N, the zero before the contact, is taken off.")
    if abs(after - before) > NOISE * noise + LOWEST * height:
        notes.append(f"The zero drifts by {after - before:.3g} N from before to after the contact.")
    largest = max(float(force[:first].max()) - before, float(force[last:].max()) - after)
    if largest > max(OTHER_CONTACT * height, least):
        notes.append("The record holds another contact: only that of the largest force is taken.")
    quiet = max(noise, 0.1 * LOWEST * height)
    start = _foot(time[: top + 1], force[: top + 1] - before, first, quiet)
    end = -_foot(-time[top:][::-1], force[top:][::-1] - after, len(force) - last, quiet)
    return _Contact(start, end, before, after, notes)


def _level(force: Vector) -> tuple[float, float]:
    """Middle of a force without contact [N], and the standard deviation of its noise by the median deviation."""
    middle = float(numpy.median(force))
    return middle, 1.4826 * float(numpy.median(numpy.abs(force - middle)))


def _foot(time: Vector, force: Vector, first: int, quiet: float) -> float:
    """Where a line through the first force and the first one twice as large meets zero, [s]; not before the last sample that
    is quiet.

    Args:
        time: [n] [s] up to the peak.
        force: [n] [N].
        first: sample of the first force.
        quiet: [N] that is none.
    """
    still = numpy.flatnonzero(force[:first] <= quiet)
    earliest = float(time[still[-1]]) if still.size else float(time[0])
    place = first + int(numpy.argmax(force[first:] >= 2.0 * force[first]))
    if place == first:  # none is twice as large
        return earliest
    slope = (force[place] - force[first]) / (time[place] - time[first])
    return max(float(time[first] - force[first] / slope), earliest)


def _refuse_unfit(name: str, time: Vector, force: Vector, inside: NDArray[numpy.bool_]) -> None:
    """Raises MaterialError for a contact that is sampled too coarsely, with a gap, or clipped."""
    count = int(inside.sum())
    if count < FEWEST:
        span = float(numpy.ptp(time[inside])) if count > 1 else float(numpy.median(numpy.diff(time)))
        raise MaterialError(
            f"{name}: {count} samples in the contact, at least {FEWEST} are needed; record at {2.0 * FEWEST / span:.2g} Hz or more"
        )
    steps = numpy.diff(time[inside])
    if steps.max() > 3.0 * float(numpy.median(steps)):
        raise MaterialError(
            f"{name}: samples are missing within the contact, {steps.max():.3g} s at once; record it again"
        )
    flat = int((force[inside] == force[inside].max()).sum())
    if flat > max(2.0, FLAT * count):
        raise MaterialError(
            f"{name}: clipped: {flat} of {count} samples in the contact are {force[inside].max():.5g} N; widen the range of the "
            "gauge"
        )
