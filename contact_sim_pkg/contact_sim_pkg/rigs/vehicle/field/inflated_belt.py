"""Belt of an inflated tire: a ring under tension on the sidewalls, that bends along and is rigid
across.

Inflation carries the wheel through the belt. The sidewalls are membranes, arcs of half angle phi
over a chord c: they take a share of the pressure on the belt of width b, and hold it with a spring
that grows with the pressure. The belt takes the rest as a hoop:

* share ``f = 1 - (c / b) cot phi``, tension ``T = f p b R``;
* radial foundation of both sidewalls ``k_r = k_0 + C p``, ``C = (cos phi + phi sin phi) / (sin phi -
  phi cos phi)``, from an arc of fixed length.

Under a unit line force the inextensible ring takes the form

    G(x) = 1 / (pi R) sum over n >= 2 of cos(n x / R) / D_n
    D_n = k_r + k_t / n^2 + T (n^2 - 1) / R^2 + B (n^2 - 1)^2 / R^4

The translation n = 1 is not in G: it is the rigid ring on the sidewalls, of stiffness K_b, which
moves the whole contact by F / K_b. There is no n = 0. G changes its sign at 0.15 m; with all D_n
above 0 the sum with the half-space is positive definite, and one solve finds both in series.

Under a flat road the belt is straight, so it pushes with ``T / R + k_r w`` along the contact: a
plateau of f p, and what the sidewalls add to it.

``C p`` is the sidewalls' stiffness at rest. As the belt comes closer to the rim by w, the ring's
translation included, their arcs keep the length L = phi c / sin phi and open:

    S(w) = 2 p (h_0 - h),  h = L cos phi' / (2 phi'),  sin phi' / phi' = (c - w) / L

What they bear less, ``D(x) = C p w - S(w)``, loads the belt beside the road:

    w = G * (q + D) + c (F + sum c D) / K_b,  c = cos(x / R)

since the ring's translation moves the belt by c; D is that of the lower half. `Softening` finds it by
fixed point. What of it is linear in the pressure, about a usual contact, the field is solved with.

Valid for 120 to 300 kPa, deflections up to 40 mm, road slopes that are small, contact within 0.12 m
of its middle. Sources: Gong, A study of in-plane dynamics of tires (1993), for the ring; Pacejka,
Tire and Vehicle Dynamics, ch. 9, for the rigid ring; the membrane is derived in
``rigs/vehicle/tire/README.md``.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

from contact_sim_pkg.compiled.guards import require, require_positive
from contact_sim_pkg.pressure.settings import InflatedBelt, SidewallArc

__all__ = [
    "Softening", "arc_force", "belt_share", "inflated_influence", "make_belt", "membrane_stiffness", "ring_modes",
    "ring_stiffness", "rubber_share", "stiffened",
]  # fmt: skip

Field = NDArray[numpy.float64]

MODES = 1000
"""Of the sum: 5e-8 of G at the force."""

ARC_POINTS = 2000
"""Of the table of S: straight lines between them miss 1e-6 of it."""

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

STRAIGHTER, CLOSED = 0.7, 2.4  # ends of that table: of phi, and [rad]; the belt is near the rim

NOMINAL_PRESSURE = 220e3  # [Pa]
OF_RUBBER = 0.5
"""Share of the structural stiffness k_0 that has the memory of rubber, the rest is cord; fitted to the
rolling resistance over load and inflation.
"""

OF_STRUCTURE = 0.25
"""Share of the rigid ring's stiffness at the nominal pressure that is there without inflation; a
choice.
"""


def belt_share(half_angle: float, chord: float, width: float) -> float:
    """Share [1] of the inflation that the hoop tension of the belt carries, ``1 - (c / b) cot phi``.

    half_angle: phi [rad] of the sidewall's arc; chord: c [m] of it; width: b [m] of the belt under
    pressure. Raises ValueError unless 0 < phi < pi, c, b > 0, and where the sidewalls carry all.
    """
    phi = require("half_angle", half_angle, "rad", above=0.0, below=math.pi)
    share = 1.0 - require_positive("chord", chord, "m") / require_positive("width", width, "m") / math.tan(phi)
    return require("share of the inflation on the belt", share, above=0.0)


def membrane_stiffness(half_angle: float) -> float:
    """Radial stiffness of two sidewalls, per circumference and inflation [N/m^2/Pa = 1]: C.

    half_angle: phi [rad]. Raises ValueError unless 0 < phi < pi.
    """
    phi = require("half_angle", half_angle, "rad", above=0.0, below=math.pi)
    return (math.cos(phi) + phi * math.sin(phi)) / (math.sin(phi) - phi * math.cos(phi))


def ring_stiffness(nominal: float, pressure: float) -> float:
    """Stiffness [N/m] of the rigid ring against the rim at an inflation of ``pressure`` [Pa], where
    it is ``nominal`` [N/m] at 220 kPa.
    """
    return nominal * (OF_STRUCTURE + (1.0 - OF_STRUCTURE) * pressure / NOMINAL_PRESSURE)


def make_belt(
    pressure: float, radius: float, half_angle: float, chord: float, width: float, structure: float,
    tangential: float, bending: float, ring: float, ring_is_body: bool = False,
) -> InflatedBelt:  # fmt: skip
    """The belt of a tire of free ``radius`` [m] at an inflation of ``pressure`` [Pa].

    half_angle [rad], chord, width [m] of the sidewalls and the belt; structure: k_0, tangential: k_t
    [N/m^2]; bending: B [N m^2]; ring: K_b [N/m]; ring_is_body: whether the rigid ring is a body of its own.
    """
    share = belt_share(half_angle, chord, width)
    return InflatedBelt(
        radius, share * pressure * width * radius, structure + membrane_stiffness(half_angle) * pressure, tangential,
        bending, 0.0 if ring_is_body else 1.0 / ring, SidewallArc(pressure, half_angle, chord, 1.0 / ring),
        OF_RUBBER * structure,
    )  # fmt: skip


def stiffened(belt: InflatedBelt, factor: float) -> InflatedBelt:
    """The belt with its rubber, bending and a part of the sidewalls, stiffer by a ``factor``; tension and the rest of
    the foundation are the inflation's.
    """
    rubber = factor * belt.rubber
    return belt._replace(
        bending=factor * belt.bending, rubber=rubber, foundation=belt.foundation + rubber - belt.rubber
    )


def rubber_share(belt: InflatedBelt, stiffer: float, rows: int, cell_x: float) -> Field:
    """What a unit curve imposed on the rubber alone is of the belt, i cells of ``cell_x`` [m] away from it, [rows] [1]:
    ``V_n / (D_n + S V_n)`` of every mode n, V_n the part of D_n of the rubber, S how much ``stiffer`` it is, >= 0.

    Of the shortest waves of a belt that bends 1 / (1 + S): that stands where the curve does, the rest is a sum that
    converges.
    """
    n = numpy.arange(MODES + 1, dtype=numpy.float64)
    rigidity, rubber = ring_modes(belt, numpy.maximum(n, 2.0))
    rubber[:2] = 0.0  # translations
    shortest = 1.0 / (1.0 + stiffer) if belt.bending > 0.0 else 0.0
    weight = rubber / (rigidity + stiffer * rubber) - shortest
    weight *= numpy.sinc(0.5 * n * cell_x / belt.radius / math.pi) * cell_x / (math.pi * belt.radius)
    weight[0] *= 0.5
    share = numpy.cos(numpy.outer(numpy.arange(rows) * cell_x / belt.radius, n)) @ weight
    share[0] += shortest
    return numpy.asarray(share)


def ring_modes(belt: InflatedBelt, n: Field) -> tuple[Field, Field]:
    """Rigidity D_n and what of it is rubber, V_n [N/m^2], of the modes ``n`` >= 2 of the ring."""
    bends = belt.bending * (n**2 - 1.0) ** 2 / belt.radius**4
    rigidity = belt.foundation + belt.tangential / n**2 + belt.tension * (n**2 - 1.0) / belt.radius**2 + bends
    return rigidity, belt.rubber + bends


def inflated_influence(
    belt: InflatedBelt, rows: int, cols: int, cell_x: float, cell_y: float
) -> NDArray[numpy.float64]:
    """Displacement [m/Pa] i rows and j cols away from a cell under unit pressure, [rows, cols]; the
    same for every j.

    The exact integral of G over the loaded cell, term n of it by ``sin(n c / 2R) / (n c / 2R)``, and
    the translation of the rigid ring. cell_x, cell_y: size of a cell [m].
    """
    n = numpy.arange(2, MODES + 1, dtype=numpy.float64)
    half = 0.5 * n * cell_x / belt.radius
    weight = numpy.sin(half) / half / ring_modes(belt, n)[0] / (math.pi * belt.radius)
    along = numpy.cos(numpy.outer(numpy.arange(rows) * cell_x / belt.radius, n)) @ weight
    return numpy.repeat(((along + belt.ring_compliance) * cell_x * cell_y)[:, None], cols, axis=1)


def arc_force(arc: SidewallArc) -> tuple[Field, Field]:
    """How much closer [m] the belt is to the rim, increasing, and the force S [N/m] of both sidewalls
    against that, [points]. It goes on straight beyond both ends.
    """
    length = arc.half_angle * arc.chord / math.sin(arc.half_angle)
    opened = numpy.linspace(STRAIGHTER * arc.half_angle, CLOSED, ARC_POINTS)
    closer = arc.chord - length * numpy.sin(opened) / opened
    height = 0.5 * length * numpy.cos(opened) / opened
    rest = 0.5 * length * math.cos(arc.half_angle) / arc.half_angle
    return closer, 2.0 * arc.pressure * (rest - height)


class Softening:
    """What the sidewalls of a belt bear less than their linear foundation, over the lower half of the
    ring: `place` it, `start` an instant, `follow` each solution of the field, then solve again with the
    gap raised by `opening`, on a belt that `yields` more. Grids of any number of rows share it, middle
    on middle.

    D about a usual contact is linear in the line load, ``D = D_0 + d * q``: `gap` is ``opening + h * q``
    with ``h = G * d`` and what the ring's translation adds. With h among its influences a solution is
    settled but for the difference; without, a second one is needed whenever the load changes.
    """

    def __init__(self, belt: InflatedBelt, rows: int, cell_x: float) -> None:
        """Under a belt with an arc, unloaded, on cells of ``cell_x`` [m]; no grid has more than so many
        ``rows``.
        """
        assert belt.arc is not None
        self._arc, self._cell_x = belt.arc, cell_x
        self._middle = max(math.ceil(0.5 * math.pi * belt.radius / cell_x) + 1, rows - rows // 2)
        count = 2 * self._middle + 1
        self._size = next_fast_len(2 * count, real=True)
        self._along = self._transform(
            inflated_influence(belt._replace(ring_compliance=0.0), count, 1, cell_x, 1.0)[:, 0]
        )
        self._angle: Field = numpy.arange(-self._middle, self._middle + 1, dtype=numpy.float64) * (cell_x / belt.radius)
        self._radius = belt.radius
        self._nearer, self._force = arc_force(belt.arc)
        self._slopes = numpy.diff(self._force)[[0, -1]] / numpy.diff(self._nearer)[[0, -1]]
        self._linear = membrane_stiffness(belt.arc.half_angle) * belt.arc.pressure
        self.load: Field = numpy.zeros(count)  # [N/m] D
        self.opening: Field = numpy.zeros(count)  # [m] that it opens the gap by, but for what goes with the line load
        self.bent: Field = numpy.zeros(count)  # [m] of the belt beside that of its loads: of its memory
        self._taken: Field = numpy.zeros(count)  # [m] opening that the last solution was made with
        self._line: Field = numpy.zeros_like(self._along)  # transform of that line load
        self._placed = 0.0  # [m]
        self.start()
        self.place(0.0)
        self._more, self._yields = self._by_line(belt.tension / belt.radius)  # transforms of d and h

    def reset(self) -> None:
        """Reset to an unloaded belt."""
        for field in (self.load, self.opening, self._taken, self.bent, self._line):
            field.fill(0.0)

    def place(self, middle: float) -> None:
        """Set where the ``middle`` row lies ahead of the wheel's centre [m]: a grid follows the wheel by whole cells, the
        ring stays with it.
        """
        moved, self._placed = (middle - self._placed) / self._cell_x, middle
        if moved != 0.0:  # what the ring bears stays with it too
            number = numpy.arange(len(self.load), dtype=numpy.float64)
            self.load, self.opening = (numpy.interp(number + moved, number, each) for each in (self.load, self.opening))
            self._line = self._line * numpy.exp(2j * math.pi * rfftfreq(self._size) * moved)
        angle = self._angle + middle / self._radius
        below = 0.5 + (0.5 * math.pi - abs(angle)) * self._radius / self._cell_x
        self._lower: Field = numpy.clip(below, 0.0, 1.0)  # part of a row that is of the lower half
        self._lowered: Field = numpy.maximum(numpy.cos(angle), 0.0) * self._lower

    def rows(self, count: int) -> slice:
        """Place of a grid of so many rows in `load`, `gap` and `bent`."""
        first = self._middle - count // 2
        return slice(first, first + count)

    def start(self) -> None:
        """Begin an instant: its first pass is a whole one."""
        self._part: float
        self._step: Field | None
        self._part, self._step = 1.0, None

    def follow(self, line: Field) -> float:
        """Take the line load ``line`` [N/m] [rows of a grid] of the road; returns by how much the belt under it
        opens further [m]: the change of `opening`, the mean under the load, without one the largest.
        """
        whole, place, total = numpy.zeros_like(self.load), self.rows(len(line)), float(line.sum())
        whole[place] = line
        before, self._line = self._line, rfft(whole, self._size)
        self.load += self._spread(self._more * (self._line - before))
        missed = self._softer(self._line, total) - self.load
        # With what D draws after it about a usual contact
        step = missed + self._spread(self._more * rfft(missed, self._size))
        if self._step is not None:
            turned = step - self._step
            square = float(turned @ turned)
            if square > 0.0:
                self._part = min(max(-self._part * float(self._step @ turned) / square, LEAST), MOST)
        self._step = step
        self.load += self._part * step
        linear = self._yields * self._line
        opening = self._spread(self._along * rfft(self.load, self._size) - linear) + self._translated(0.0)
        change, self._taken, self.opening = opening - self.opening, self.opening, opening
        return float(abs(change).max()) if total == 0.0 else float(line @ change[place]) / total

    def yields(self, rows: int) -> Field:
        """Displacement h [m^2/N] i ``rows`` away from a unit line load on a row of cells, [rows]."""
        along = numpy.zeros(rows)
        half = irfft(self._yields, self._size)[: min(rows, len(self.load))]
        along[: len(half)] = half
        return along

    @property
    def gap(self) -> Field:
        """How far the load moves the belt [m]."""
        return self.opening + self._spread(self._yields * self._line)

    def climb(self, line: Field) -> float:
        """Force [N] against the travel of a line load ``line`` [N/m] [rows of a grid] on the slope of the gap that it was
        found with: of the ring's translation, which stays with the wheel; what the belt's memory does in it is
        `remembered`.
        """
        taken = self._taken + self._spread(self._yields * self._line)
        return float(line @ numpy.gradient(taken[self.rows(len(line))])) - self.remembered()

    def remembered(self) -> float:
        """Force [N] against the travel, negative where it takes energy, of `load` on the slope of `bent`."""
        return float(self.load @ numpy.gradient(self.bent))

    def _spread(self, transform: Field) -> Field:
        """What has a ``transform``, on the rows of the ring."""
        return numpy.asarray(irfft(transform, self._size)[: len(self.load)])

    def _translated(self, total: float) -> Field:
        """How much closer [m] the translation of the ring brings the belt, under `load` and so much, the ``total`` [N/m] of
        the rows, of the road.
        """
        ring = self._cell_x * self._arc.ring_compliance
        return (total + float(self._lowered @ self.load)) * ring * self._lowered

    def _closer(self, line: Field, total: float) -> Field:
        """How much closer [m] to the rim the belt is under `load` and the transform of a ``line`` load of the road, whose
        rows sum up to a ``total`` [N/m].
        """
        return self._spread(self._along * (line + rfft(self.load, self._size))) + self._translated(total) + self.bent

    def _softer(self, line: Field, total: float) -> Field:
        """D [N/m] of the belt as it lies under that."""
        closer = self._closer(line, total)
        return numpy.asarray((self._linear * closer - self._borne(closer)) * self._lower)

    def _by_line(self, plateau: float) -> tuple[Field, Field]:
        """Transforms of d and h: what D gains by a unit line load in the middle of a usual contact, and how far
        that moves the belt. ``plateau`` [N/m]: the hoop's T / R.
        """
        usual = numpy.where(abs(self._angle) <= 0.5 * CONTACT, OF_PLATEAU * plateau, 0.0)
        line, total = rfft(usual, self._size), float(usual.sum())
        for _ in range(SETTLING):
            self.load = self._softer(line, total)
        # The slope of D there, by a small difference
        closer, small = self._closer(line, total), 1e-6 * self._radius
        slope = self._linear - (self._borne(closer + small) - self._borne(closer - small)) / (2.0 * small)
        unit = rfft((self._angle == 0.0).astype(numpy.float64), self._size)
        # Sidewalls that would draw more and more after them are taken to go with the load in part, or not at all
        for part in PARTS:
            self.load, change = numpy.zeros_like(closer), numpy.zeros_like(closer)
            for _ in range(SETTLING):
                more = part * slope * self._closer(unit, 1.0) * self._lower
                self.load, change = more, more - self.load
            if abs(change).sum() <= SETTLED * abs(self.load).sum():
                break
        more, yields = self.load, self._closer(numpy.zeros_like(unit), 0.0)
        self.load = numpy.zeros_like(closer)
        return self._transform(more[self._middle :]), self._transform(yields[self._middle :])

    def _transform(self, half: Field) -> Field:
        """Transform of an influence by distance, zero beyond that ``half``."""
        whole = numpy.zeros(self._size)
        whole[: len(half)] = half
        whole[len(whole) - len(half) + 1 :] = half[:0:-1]
        return numpy.asarray(rfft(whole))

    def _borne(self, closer: Field) -> Field:
        """S [N/m]."""
        first, last = closer - self._nearer[0], closer - self._nearer[-1]
        beyond = self._slopes[0] * numpy.minimum(first, 0.0) + self._slopes[1] * numpy.maximum(last, 0.0)
        return numpy.asarray(numpy.interp(closer, self._nearer, self._force) + beyond)
