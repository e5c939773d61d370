"""Sidewalls of an inflated tire that soften as the belt comes closer to the rim.

``inflated_belt.py`` says what they bear less than their linear foundation, D [N/m], and how the belt lies under it:

    w = G * (q + D) + c (F + sum c D) / K_b + b,  D = (C p w - S(w)) on the lower half

with b what the memory of the belt adds. Each pass takes D of the belt as it lies, and, with an Aitken part, what that draws
after it about a usual contact.

D about a usual contact is linear in the line load, ``D = D_0 + d * q``, so that the belt lies at ``opening + h * q`` beside the
road, ``h = G * d`` and what the ring's translation adds. With h among its influences a solution of the field is settled but for
the difference; without, a second one is needed whenever the load changes.

Sums over rows are made as they are written: on 150 to 300 rows that is quicker than by transforms. Source: as
``inflated_belt.py``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.held import Held, hold
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.pressure.field.outside import total_of_row
from contact_sim_pkg.pressure.settings import InflatedBelt
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import arc_force, inflated_influence, membrane_stiffness

__all__ = ["Softening"]

Field = NDArray[numpy.float64]

LEAST, MOST = 0.1, 1.3
"""Of a pass after the first of an instant, by what the one before left (Aitken): of a belt far beyond a usual contact it
goes too far.
"""

PARTS, SETTLED = (1.0, 0.5, 0.25, 0.0), 1e-3
"""Of what sidewalls yield with the load, and its last change at which it is taken."""

CONTACT, OF_PLATEAU, SETTLING = 0.31, 1.9, 30
"""Of a usual contact: length over the radius, line load over the hoop's T / R, passes that settle the sidewalls beside it. How
soon a field settles hangs on them, nothing else.
"""


class _Ring(NamedTuple):
    """Belt and sidewalls on the rows of the lower half of the ring."""

    along: Field  # [m^2/N] G: by distance from a row under line load, [2 rows - 1]
    more: Field  # [1] d, so too
    yields: Field  # [m^2/N] h, so too
    nearer: Field  # [m] table of S
    force: Field  # [N/m]
    lower: Field  # part of a row that is of the lower half, [rows]
    lowered: Field  # that times c, [rows]
    linear: float  # [N/m^2] C p
    ring: float  # [m^2/N] of a row, 1 / K_b


class _Borne(NamedTuple):
    """What lies on the belt, and how that moves it, [rows] each."""

    load: Field  # [N/m] D
    line: Field  # [N/m] q
    bent: Field  # [m] b
    opening: Field  # [m]
    taken: Field  # [m] opening that the last solution was made with
    yielded: Field  # [m] h * q
    step: Field  # [N/m] of the last pass
    missed: Field  # buffers
    closer: Field


class Softening:
    """What the sidewalls of a belt bear less than their linear foundation, over the lower half of the
    ring: `place` it, `start` an instant, `follow` each solution of the field, then solve again with the
    gap raised by `opening`, on a belt that `yields` more. Grids of any number of rows share it, middle
    on middle.
    """

    STATE = State(("_borne",), ("_ring", "_placed", "_part"), ("_borne", "_ring"))

    load: Field
    """D [N/m]."""
    opening: Field
    """[m] that D opens the gap by, but for what goes with the line load."""
    bent: Field
    """[m] of the belt beside that of its loads: of its memory."""

    def __init__(self, belt: InflatedBelt, rows: int, cell_x: float) -> None:
        """Under a belt with an arc, unloaded, on cells of ``cell_x`` [m]; no grid has more than so many
        ``rows``.
        """
        assert belt.arc is not None
        self._cell_x, self._radius = cell_x, belt.radius
        self._middle = max(math.ceil(0.5 * math.pi * belt.radius / cell_x) + 1, rows - rows // 2)
        count = 2 * self._middle + 1
        along = inflated_influence(belt._replace(ring_compliance=0.0), count, 1, cell_x, 1.0)[:, 0]
        self._angle: Field = numpy.arange(-self._middle, self._middle + 1, dtype=numpy.float64) * (cell_x / belt.radius)
        self._ring = _Ring(
            _both_ways(along), numpy.zeros(2 * count - 1), numpy.zeros(2 * count - 1), *arc_force(belt.arc), numpy.zeros(count),
            numpy.zeros(count), membrane_stiffness(belt.arc.half_angle) * belt.arc.pressure, cell_x * belt.arc.ring_compliance,
        )  # fmt: skip
        self._borne = _Borne(*(numpy.zeros(count) for _ in _Borne._fields))
        self._held: tuple[Held[_Ring], Held[_Borne]] = hold(self._ring), hold(self._borne)
        self.load, self.opening, self.bent = self._borne.load, self._borne.opening, self._borne.bent
        self._placed = math.nan  # [m]
        self.start()
        self.place(0.0)
        self._by_line(belt.tension / belt.radius)

    def reset(self) -> None:
        """Reset to an unloaded belt."""
        for field in self._borne:
            field.fill(0.0)

    def place(self, middle: float) -> None:
        """Set where the ``middle`` row lies ahead of the wheel's centre [m]: a grid follows the wheel by whole cells, the
        ring stays with it.
        """
        if middle == self._placed:
            return
        moved = 0.0 if math.isnan(self._placed) else (middle - self._placed) / self._cell_x
        self._placed = middle
        _place(*self._held, self._angle, moved, middle, self._cell_x, self._radius)

    def rows(self, count: int) -> slice:
        """Place of a grid of so many rows in `load`, `gap` and `bent`."""
        first = self._middle - count // 2
        return slice(first, first + count)

    def _first(self, field: Field) -> int:
        """Place of the first row of a field [rows, cols] there."""
        return self._middle - len(field) // 2

    def start(self) -> None:
        """Begin an instant: its first pass is a whole one."""
        self._part = math.nan

    def follow(self, pressure: Field, cell_y: float) -> float:
        """Take the line load [N/m] of a ``pressure`` [rows, cols] [Pa] of the road on cells ``cell_y`` [m] wide; returns
        by how much the belt under it opens further [m]: the change of `opening`, the mean under the load, without one the
        largest.
        """
        change, self._part = _follow(*self._held, pressure, cell_y, self._first(pressure), self._part)
        return change

    def yields(self, rows: int) -> Field:
        """Displacement h [m^2/N] i ``rows`` away from a unit line load on a row of cells, [rows]."""
        along, count = numpy.zeros(rows), min(rows, len(self.load))
        along[:count] = self._ring.yields[len(self.load) - 1 :][:count]
        return along

    def open(self, gap: Field, opened: Field) -> float:
        """Write a ``gap`` [rows, cols] [m] into ``opened`` as D opens it; returns its least [m] before."""
        return float(_open(self._held[1], gap, self._first(gap), opened))

    @property
    def gap(self) -> Field:
        """How far the load moves the belt [m]."""
        return self.opening + self._borne.yielded

    def climb(self, pressure: Field, cell_y: float) -> float:
        """Force against the travel [N/m] a row, over its line load [N/m] in all, of a ``pressure`` [rows, cols] [Pa] on cells
        ``cell_y`` [m] wide, on the slope of the gap that it was found with; 0 without one. Of the ring's translation,
        which stays with the wheel; what the belt's memory does in it is `remembered`.
        """
        climb, total = _climb(self._held[1], pressure, cell_y, self._first(pressure))
        return (climb - self.remembered()) / total if total > 0.0 else 0.0

    def remembered(self) -> float:
        """Force [N] against the travel, negative where it takes energy, of `load` on the slope of `bent`."""
        return float(self.load @ numpy.gradient(self.bent)) if self.bent.any() else 0.0

    def _by_line(self, plateau: float) -> None:
        """Find d and h: what D gains by a unit line load in the middle of a usual contact, and how far that moves
        the belt. ``plateau`` [N/m]: the hoop's T / R.
        """
        ring, borne = self._ring, self._borne
        borne.line[abs(self._angle) <= 0.5 * CONTACT] = OF_PLATEAU * plateau
        total = float(borne.line.sum())
        for _ in range(SETTLING):
            _soften(*self._held, total)
            borne.load[:] = borne.missed
        # The slope of D there
        _soften(*self._held, total)
        slope = ring.linear - numpy.interp(
            borne.closer, ring.nearer[1:], numpy.diff(ring.force) / numpy.diff(ring.nearer)
        )
        # Sidewalls that would draw more and more after them are taken to go with the load in part, or not at all
        borne.line[:] = self._angle == 0.0
        for part in PARTS:
            borne.load.fill(0.0)
            change = numpy.zeros_like(slope)
            for _ in range(SETTLING):
                _soften(*self._held, 1.0)
                more = part * slope * borne.closer * ring.lower
                change = more - borne.load
                borne.load[:] = more
            if abs(change).sum() <= SETTLED * abs(borne.load).sum():
                break
        ring.more[:] = _both_ways(_far(borne.load))
        borne.line.fill(0.0)
        _soften(*self._held, 0.0)
        ring.yields[:] = _both_ways(_far(borne.closer))
        self.reset()


def _both_ways(half: Field) -> Field:
    """An influence by distance, to either side."""
    return numpy.concatenate((half[:0:-1], half))


def _far(rows: Field) -> Field:
    """Values on rows of the ring around its middle, by distance from it, zero beyond."""
    half = numpy.zeros(len(rows))
    half[: len(rows) - len(rows) // 2] = rows[len(rows) // 2 :]
    return half


@borrowing_kernel
def _spread(influence: Field, load: Field, moved: Field) -> None:
    """Add to ``moved`` how a ``load`` moves each row, by its ``influence``."""
    rows = load.size
    for j in range(0, rows - 3, 4):  # four at a time: each row is read and written once
        first, second, third, fourth = load[j], load[j + 1], load[j + 2], load[j + 3]
        if first == 0.0 and second == 0.0 and third == 0.0 and fourth == 0.0:
            continue
        of_first, of_second = influence[rows - 1 - j :], influence[rows - 2 - j :]
        of_third, of_fourth = influence[rows - 3 - j :], influence[rows - 4 - j :]
        for i in range(rows):
            moved[i] += (first * of_first[i] + second * of_second[i]) + (third * of_third[i] + fourth * of_fourth[i])
    for j in range(rows - rows % 4, rows):
        of_rest = influence[rows - 1 - j :]
        for i in range(rows):
            moved[i] += load[j] * of_rest[i]


@borrowing_kernel
def _translate(ring: _Ring, load: Field, total: float, moved: Field) -> None:
    """Add to ``moved`` how much closer [m] the translation of the ring brings each row, under D and a ``total`` [N/m] of the
    rows of the road.
    """
    for i in range(load.size):
        total += ring.lowered[i] * load[i]
    for i in range(load.size):
        moved[i] += total * ring.ring * ring.lowered[i]


@borrowing_kernel
def _soften_kernel(ring: _Ring, borne: _Borne, total: float) -> None:
    """As `_soften`."""
    closer = borne.closer
    for i in range(closer.size):
        closer[i], borne.missed[i] = borne.bent[i], borne.line[i] + borne.load[i]
    _spread(ring.along, borne.missed, closer)
    _translate(ring, borne.load, total, closer)
    k, last = 0, ring.nearer.size - 2
    for i in range(closer.size):  # S by straight lines, from one row to the next along its table
        while k < last and closer[i] >= ring.nearer[k + 1]:
            k += 1
        while k > 0 and closer[i] < ring.nearer[k]:
            k -= 1
        slope = (ring.force[k + 1] - ring.force[k]) / (ring.nearer[k + 1] - ring.nearer[k])
        bears = ring.force[k] + slope * (closer[i] - ring.nearer[k])
        borne.missed[i] = (ring.linear * closer[i] - bears) * ring.lower[i]


@entry
def _soften(ring: Held[_Ring], borne: Held[_Borne], total: float) -> None:
    """How much ``closer`` [m] to the rim the belt is under what it has ``borne`` and a ``total`` [N/m] of the rows of the
    road, and into ``missed`` D [N/m] of the belt as it lies there.
    """
    _soften_kernel(ring.value, borne.value, total)


@entry
def _place(
    ring_held: Held[_Ring], borne_held: Held[_Borne], angles: Field, moved: float, middle: float, cell_x: float, radius: float
) -> None:  # fmt: skip
    """As `Softening.place`, ``moved`` by so many rows; ``angles`` [rows]: of rows about the ``middle`` one."""
    ring, borne = ring_held.value, borne_held.value
    # What the ring bears stays with it, straight from row to row
    if moved != 0.0:
        _shift(borne.load, moved, borne.closer)
        _shift(borne.opening, moved, borne.closer)
        _shift(borne.line, moved, borne.closer)
        _shift(borne.yielded, moved, borne.closer)
    for i in range(angles.size):
        angle = angles[i] + middle / radius
        below = 0.5 + (0.5 * math.pi - abs(angle)) * radius / cell_x
        ring.lower[i] = min(max(below, 0.0), 1.0)
        ring.lowered[i] = max(math.cos(angle), 0.0) * ring.lower[i]


@borrowing_kernel
def _shift(values: Field, moved: float, before: Field) -> None:
    """Take ``values`` from ``moved`` rows farther on, those at the ends from there; ``before`` is scratch."""
    last = values.size - 1
    for i in range(values.size):
        before[i] = values[i]
    for i in range(values.size):
        place = min(max(i + moved, 0.0), float(last))
        k = min(int(place), last - 1)
        values[i] = before[k] + (before[k + 1] - before[k]) * (place - k)


@entry
def _open(borne_held: Held[_Borne], gap: Field, first: int, opened: Field) -> float:
    """As `Softening.open`, row 0 of the ``gap`` being row ``first``."""
    opening, least = borne_held.value.opening, numpy.inf
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            here = gap[i, j]
            least = here if here < least else least  # `min` would take longer, for NaN
            opened[i, j] = here + opening[first + i]
    return least


@entry
def _climb(borne_held: Held[_Borne], pressure: Field, cell_y: float, first: int) -> tuple[float, float]:
    """Force [N] of a ``pressure`` [rows, cols] [Pa] on the differences of what opens the gap under it, from row ``first`` on,
    and the sum of its line loads [N/m].
    """
    borne, last, climb, total = borne_held.value, len(pressure) - 1, 0.0, 0.0
    for i in range(len(pressure)):
        behind, ahead = first + max(i - 1, 0), first + min(i + 1, last)
        rise = borne.taken[ahead] + borne.yielded[ahead] - (borne.taken[behind] + borne.yielded[behind])
        line = total_of_row(pressure[i]) * cell_y
        total += line
        climb += line * rise / max(ahead - behind, 1)
    return climb, total


@entry
def _follow(
    ring_held: Held[_Ring], borne_held: Held[_Borne], pressure: Field, cell_y: float, first: int, part: float
) -> tuple[float, float]:
    """One pass under the ``pressure`` on the rows from the ``first``: as `Softening.follow`, and the Aitken part.

    part: that of the pass before at this instant, NaN at its first.
    """
    ring, borne = ring_held.value, borne_held.value
    rows, is_first = borne.load.size, math.isnan(part)
    # D goes with the line load as about a usual contact
    total = 0.0
    for i in range(rows):
        now = total_of_row(pressure[i - first]) * cell_y if first <= i < first + len(pressure) else 0.0
        total += now
        borne.missed[i], borne.line[i] = now - borne.line[i], now
    _spread(ring.more, borne.missed, borne.load)
    # and by what that misses, with what it draws after it
    _soften_kernel(ring, borne, total)
    step = borne.closer
    for i in range(rows):
        borne.missed[i] -= borne.load[i]
    copy_row(borne.missed, step)
    _spread(ring.more, borne.missed, step)
    along, square = 0.0, 0.0
    for i in range(rows):
        turned = step[i] - borne.step[i]
        along += borne.step[i] * turned
        square += turned * turned
        borne.step[i] = step[i]
    if is_first:
        part = 1.0
    elif square > 0.0:
        part = min(max(-part * along / square, LEAST), MOST)
    for i in range(rows):
        borne.load[i] += part * step[i]
    # How the belt lies then, but for what goes with the line load
    borne.yielded[:] = 0.0
    _spread(ring.yields, borne.line, borne.yielded)
    copy_row(borne.opening, borne.taken)
    for i in range(rows):
        borne.opening[i] = -borne.yielded[i]
    _spread(ring.along, borne.load, borne.opening)
    _translate(ring, borne.load, 0.0, borne.opening)
    mean, largest = 0.0, 0.0
    for i in range(rows):
        change = borne.opening[i] - borne.taken[i]
        mean += borne.line[i] * change
        largest = max(largest, abs(change))
    return largest if total == 0.0 else mean / total, part
