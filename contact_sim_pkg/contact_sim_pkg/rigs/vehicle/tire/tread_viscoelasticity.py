"""Viscoelasticity of the tread rubber in a rolling pressure field: Kelvin-Voigt and Maxwell
branches, cell by cell.

For a half-space whose Poisson's ratio does not change in time the elastic-viscoelastic
correspondence holds at every point of its surface, loaded or not: with the elastic operator K of
the long-time modulus,

    K p(t) = integral of [1 + T dirac(t-s) + sum r_k exp(-(t-s)/t_k)] u'(s) ds = u + T u' + sum q_k,
    q_k' = r_k u' - q_k/t_k.

Over a step h in which u changes linearly (T: backward difference) q_k becomes `a_k q_k + w_k (u -
u_before)`, a_k = exp(-h/t_k), w_k = r_k (t_k/h)(1 - a_k), so that

    u = K p / s + g,    s = 1 + T/h + sum w_k,    g = [(T/h + sum w_k) u_before - sum a_k q_k] / s:

an elastic contact with the modulus raised by s, and the gap raised by g. The contact may grow,
shrink and move. Material points of a rolling tread lie still against the road, so u and q are
carried on the road's lattice; rows that enter are taken to be as the row beside them.

An inflated tire loses in the rubber of belt and sidewalls, not in what the inflation holds. Of the mode n
of the ring (`inflated_belt.py`) only V_n has the memory:

    D_n w + V_n [T w' + sum q_k] = q,    V_n = k_0 / 2 + B (n^2 - 1)^2 / R^4,

so that over a step, with S = s - 1 of its own branches, the ring is stiffer by S V_n, and

    w = q / (D_n + S V_n) + g,    g = V_n / (D_n + S V_n) [S w_before - sum a_k q_k].

u is the sum of both. Both together are the rolling resistance: it rises with the speed and falls with
the inflation.

Sources: Lee and Radok (1960), J. Appl. Mech. 27, 438; Johnson, Contact Mechanics, 6.5; Taylor,
Pister and Goudreau (1970), Int. J. Num. Meth. Eng. 2, 45 (exponential update).
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray
from scipy.linalg import toeplitz

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space
from contact_sim_pkg.pressure.settings import FieldSettings, InflatedBelt
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import inflated_influence, rubber_share, stiffened
from contact_sim_pkg.rigs.vehicle.tire.parameters import TreadViscoelasticity

__all__ = ["TreadState", "stiffening"]

Field = NDArray[numpy.float64]


def _weights(tread: TreadViscoelasticity, step: float) -> tuple[float, Field, Field]:
    """T/h, w_k and a_k of a step in [s]."""
    ratio, time = numpy.asarray(tread.ratios, dtype=float), numpy.asarray(tread.times, dtype=float)
    return tread.retardation_time / step, -ratio * (time / step) * numpy.expm1(-step / time), numpy.exp(-step / time)


def stiffening(tread: TreadViscoelasticity, step: float) -> float:
    """`s = 1 + T/h + sum r_k (t_k/h)(1 - exp(-h/t_k))` [1]: modulus over a step h [s] against the
    long-time modulus.
    """
    viscous, weights, _decay = _weights(tread, step)
    return 1.0 + viscous + float(weights.sum())


class _Memory:
    """A displacement [m] with its branches, from field instant to field instant: of the tread
    [rows, cols], or of the belt [rows, 1].
    """

    STATE = State(("_displacement", "_branches", "gap"))

    def __init__(self, tread: TreadViscoelasticity, step: float, shape: tuple[int, int]) -> None:
        self._viscous, self._weights, self._decay = _weights(tread, step)
        self._stiffening = stiffening(tread, step)
        self._displacement: Field = numpy.zeros(shape)
        self._branches: Field = numpy.zeros((len(self._weights), *shape))
        self.gap: Field = numpy.zeros(shape)

    def settle(self, relaxed: Field) -> None:
        """The pressure that displaces the surface by ``relaxed`` [m] at long times has stood for
        long.
        """
        self._displacement[:] = relaxed
        self._branches.fill(0.0)
        self._update_gap()

    def move(self, cells: int) -> None:
        """Roll on by so many rows."""
        for field in (self._displacement, *self._branches):
            shift_rows(field, cells)
        self._update_gap()

    def store(self, pressed: Field) -> None:
        """Store the pressure that displaces the surface by ``pressed`` [m] beside the gap."""
        update_branches(pressed, self.gap, self._weights, self._decay, self._displacement, self._branches)
        self._update_gap()

    def _update_gap(self) -> None:
        viscoelastic_gap(
            self._displacement, self._branches, self._viscous, self._weights, self._decay, self.gap
        )  # fmt: skip


class _BeltMemory(_Memory):
    """The same of a belt [rows, 1], of whose rigidity only the rubber has it."""

    def __init__(self, tread: TreadViscoelasticity, step: float, share: Field) -> None:
        """``share`` [rows, rows]: `rubber_share` of the belt."""
        super().__init__(tread, step, (len(share), 1))
        self._share = self._stiffening * share

    def _update_gap(self) -> None:
        super()._update_gap()
        self.gap = self._share @ self.gap


class TreadState:
    """Displacement of tread and belt and the branches' share of it on one grid, from field instant to
    field instant.

    `move_to` the row of the instant, solve with the gap raised by `gap`, then `store` the pressure
    that was found.
    """

    STATE = State(("_tread", "_belt", "_row", "gap"))

    def __init__(
        self, settings: FieldSettings, relaxed: float, tread: TreadViscoelasticity, step: float,
        belt: tuple[InflatedBelt, TreadViscoelasticity] | None = None,
    ) -> None:  # fmt: skip
        """Grid of `settings`; `relaxed` [Pa]: its contact modulus at long times; `step` [s] between
        two field instants; ``belt`` at long times with its memory, None for an elastic one.
        """
        shape = (settings.rows, settings.cols)
        self._relaxed = make_half_space(*shape, settings.cell_x, settings.cell_y, relaxed)
        self._buffers = make_buffers(self._relaxed)
        self._tread, self._stiffening = _Memory(tread, step, shape), stiffening(tread, step)
        self._belt: _BeltMemory | None = None
        self._along: Field = numpy.zeros((2, 0, 0))  # of the belt at long times, and within a step
        if belt is not None:
            ring, memory = belt[0]._replace(ring_compliance=0.0), belt[1]  # its translation has no memory
            at_once, cells = stiffened(ring, stiffening(memory, step)), (settings.rows, settings.cell_x)
            self._along = numpy.array([
                toeplitz(inflated_influence(each, settings.rows, 1, settings.cell_x, 1.0)[:, 0]) for each in (ring, at_once)
            ])  # fmt: skip
            self._belt = _BeltMemory(memory, step, toeplitz(rubber_share(ring, stiffening(memory, step) - 1.0, *cells)))
        self._row, self._cell_y = 0, settings.cell_y
        self._displaced: Field = numpy.zeros(shape)
        self.gap: Field = numpy.zeros(shape)  # [m] to be added to the gap at the present instant

    def reset(self) -> None:
        """Reset to an unloaded tread."""
        self._tread.settle(numpy.zeros_like(self.gap))
        if self._belt is not None:
            self._belt.settle(numpy.zeros((len(self.gap), 1)))
        self.gap.fill(0.0)

    @property
    def bent(self) -> Field:
        """What the belt yields by its memory [rows] [m], a part of `gap`."""
        return numpy.zeros(len(self.gap)) if self._belt is None else self._belt.gap[:, 0]

    def settle(self, row: int, pressure: Field, beside: Field | None = None) -> None:
        """The tread has stood under `pressure` [Pa] for long, with its first row at lattice row
        `row`, and its belt under the line load ``beside`` it [N/m].
        """
        self._row = row
        displacement(self._relaxed, self._buffers, pressure, self._displaced)
        self._tread.settle(self._displaced)
        if self._belt is not None:
            self._belt.settle(self._bent(self._along[0], pressure, beside))
        self._add_up()

    def move_to(self, row: int) -> None:
        """The tread rolled on: its first row is lattice row `row` now."""
        cells, self._row = row - self._row, row
        if cells != 0:
            self._tread.move(cells)
            if self._belt is not None:
                self._belt.move(cells)
            self._add_up()

    def roll(self, cells: int) -> None:
        """Roll on by so many rows in place: the first row keeps its number."""
        row = self._row
        self.move_to(row + cells)
        self._row = row

    def store(self, pressure: Field, beside: Field | None = None) -> None:
        """Store the pressure [Pa] that was found with the present `gap`, and the line load ``beside`` it
        [N/m] on the belt.
        """
        displacement(self._relaxed, self._buffers, pressure, self._displaced)
        self._tread.store(self._displaced / self._stiffening)
        if self._belt is not None:
            self._belt.store(self._bent(self._along[1], pressure, beside))
        self._add_up()

    def _bent(self, along: Field, pressure: Field, beside: Field | None) -> Field:
        """Displacement ``along`` of the belt [rows, 1] [m] under its loads."""
        line = self._cell_y * pressure.sum(axis=1)
        return numpy.asarray(along @ (line if beside is None else line + beside))[:, None]

    def _add_up(self) -> None:
        self.gap[:] = self._tread.gap
        if self._belt is not None:
            self.gap += self._belt.gap


@entry
def shift_rows(field: Field, cells: int) -> None:
    """Move all rows by `cells` towards row 0 (negative: away); rows that enter are copies of the
    row at that side.

    field: [rows, cols].
    """
    rows, cols = field.shape
    for k in range(rows):
        i = k if cells >= 0 else rows - 1 - k  # a row is read before it is written
        source = min(max(i + cells, 0), rows - 1)
        for j in range(cols):
            field[i, j] = field[source, j]


@entry
def viscoelastic_gap(
    displaced: Field, branches: Field, viscous: float, weights: Field, decay: Field, gap: Field
) -> None:
    """Write the gap `g = [(T/h + sum w) u - sum a q] / s` [m], see the module; weights are
    dimensionless.

    Fields: [rows, cols] [m], branches: [branches, rows, cols] [m]; weights, decay: [branches].
    """
    ratio = viscous
    for k in range(weights.shape[0]):
        ratio += weights[k]
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            total = ratio * displaced[i, j]
            for k in range(weights.shape[0]):
                total -= decay[k] * branches[k, i, j]
            gap[i, j] = total / (1.0 + ratio)


@entry
def update_branches(
    pressed: Field, gap: Field, weights: Field, decay: Field, displaced: Field, branches: Field
) -> None:
    """`u = K p / s + g`, `q = a q + w (u - u_before)`.

    Fields: [rows, cols] [m], branches: [branches, rows, cols] [m]; weights, decay: [branches] [1].
    """
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            now = pressed[i, j] + gap[i, j]
            change = now - displaced[i, j]
            displaced[i, j] = now
            for k in range(weights.shape[0]):
                branches[k, i, j] = decay[k] * branches[k, i, j] + weights[k] * change
