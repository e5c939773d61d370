"""The pressure field as the contact: at a field instant the force is the integral of the field.

At instants of the run the half-space problem is solved for the rigid approach that the bodies have.
Between two instants the field's tangent acts: the power law ``A x**n`` fitted to the field at its
working load (``fit_tangent``), read at the approach plus an effective-height correction with which
it equals the field's force at the instant. The correction is a height of road or cushion; it
changes linearly from instant to instant and is corrected by solving the field again at the new end
state. What is left after the last correction is a jump at the instant, measured and published as
``field_jump``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.held import Held
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import ElasticLaw, NormalElastic
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, make_half_space
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, EDGE, SENTENCES, FieldResult, refuse_bad_gap
from contact_sim_pkg.pressure.field.window import Part
from contact_sim_pkg.pressure.settings import FieldSettings, InflatedBelt, widened
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.envelopment import yielding_of
from contact_sim_pkg.rigs.vehicle.field.sidewalls import Softening
from contact_sim_pkg.scene.errors import Fault, SceneError

Field = NDArray[numpy.float64]
TANGENT_LOAD_STEP = 1.05  # ratio of the two loads through which the tangent law is laid
TANGENT_TOLERANCE = 1e-7  # of these two solutions: their difference is a thirtieth of the approach
SOFTENING_PASSES = 40  # most solutions at one instant of a belt whose sidewalls soften; each is closer by a factor of 7

OF_SIDEWALLS = 0.15
"""Of the field's tolerance: what its sidewalls may miss of the depth; the height takes the mean of it off."""

FEW_PASSES, NOISE = 12, 1e-5  # what the line load of a certified field leaves of that depth undecided
SHALLOW = 1e-3  # [m]: a contact less deep has its sidewalls settled as if it were so deep


def effect_of(contact: str) -> str:
    """Key of the effect that calls for the field of a contact."""
    return f"effects.{contact}.{'half_space_field' if contact == 'seat' else 'contact_field'}"


class FieldError(RuntimeError):
    """The field could not be solved: contact at the grid's edge, or no convergence."""


class FieldEdgeError(FieldError):
    """The contact reached the edge of the grid."""


def half_space_of(settings: FieldSettings, softening: Softening | None) -> HalfSpace:
    """Half-space of a field's grid, with the belt that yields beside it where there is one, and what its
    ``softening`` sidewalls yield with the load.
    """
    size = (settings.rows, settings.cols, settings.cell_x, settings.cell_y)
    yielding = yielding_of(settings.belt, *size)
    if yielding is not None and softening is not None:
        yielding += softening.yields(settings.rows)[:, None] * settings.cell_y
    return make_half_space(*size, settings.modulus, yielding)


class PressureField:
    """One pressure field that follows its contact: influence tables, buffers, and the last
    solution.
    """

    STATE = State(
        ("_field", "softening", "load", "_approach", "unsettled"), ("_row", "closer", "residual", "iterations")
    )

    def __init__(self, settings: FieldSettings, contact: str, softening: Softening | None = None) -> None:
        """Make tables and buffers for ``settings``; ``contact`` (``tire``, ``seat``) is its name in
        messages. The ``softening`` of sidewalls may be that of another grid with the same cells.
        """
        self.settings = settings
        self.contact = contact
        belt, self.softening = settings.belt, softening
        if softening is None and isinstance(belt, InflatedBelt) and belt.arc is not None:
            self.softening = Softening(belt, settings.rows, settings.cell_x)
        self._field = (settings.solver or RollingField)(half_space_of(settings, self.softening))
        self.whole: Held[Part] = self._field.whole
        self._row: int | None = None  # of the road under row 0, at the last solve
        self.pressure: Field = self._field.pressure
        self.closer = 1.0  # times the tolerance
        self.looser_sidewalls = 1.0  # times what they may miss
        self.load = self._approach = 0.0
        self._opened: Field = numpy.empty((settings.rows, settings.cols))
        self.unsettled = 0.0  # [m] by which the sidewalls open the gap further than it was solved with
        self.iterations = 0
        self.residual = 0.0

    def reset(self) -> None:
        """Drop the previous solution."""
        self.forget()
        if self.softening is not None:
            self.softening.reset()

    def forget(self) -> None:
        """Drop the previous pressure, not what the sidewalls bear."""
        self._field.reset()
        self._row, self.residual = None, 0.0

    def roll_to(self, row: int, origin: float) -> None:
        """Set ``row`` of the road under row 0 of the grid, ``origin`` [m] ahead of the wheel's centre, before each solve.

        The previous solution moves with the road. Several solves at one row repeat the instant.
        """
        if self._row is not None and row != self._row:
            self._field.roll(row - self._row)
        self._row = row
        if self.softening is not None:
            self.softening.place(origin + self.settings.rows // 2 * self.settings.cell_x)

    def solve(self, gap: Field, approach: float) -> float:
        """Load [N] at ``gap`` [rows, cols] [m] (undeformed, at zero approach) and ``approach`` [m], to ``closer`` times
        the tolerance of the settings.

        0 without contact. Starts from the previous solution. Raises FieldError where the contact
        reaches the edge or the solver does not converge.
        """
        s = self.settings
        for opened in self._passes(gap, s.tolerance):
            result = self._field.solve_at_approach(opened, approach, self.closer * s.tolerance, s.maximum_iterations)
            self._accept(result, gap)
        return self.load

    def solve_load(self, gap: Field, load: float, tolerance: float | None = None) -> float:
        """Approach [m] under ``load`` [N]; ``tolerance`` None: that of the settings. Errors as
        ``solve``.
        """
        s = self.settings
        requested = s.tolerance if tolerance is None else tolerance
        result = FieldResult(BAD_INPUT, 0, 0.0, math.nan, math.inf)
        for opened in self._passes(gap, requested):
            result = self._field.solve_at_load(opened, load, requested, s.maximum_iterations)
            self._accept(result, gap)
        return float(result.approach)

    def opened(self, gap: Field) -> Field:
        """The gap [rows, cols] [m] as the sidewalls open it beside what they yield with the load, of any grid with the cells
        of this one.
        """
        if self.softening is None:
            return gap
        self.softening.open(gap, self._opened)
        return self._opened

    def _passes(self, gap: Field, tolerance: float) -> Iterator[Field]:
        """Gaps to be solved one after the other, until the sidewalls bear what they were taken to bear: to
        `OF_SIDEWALLS` of a ``tolerance`` of the depth of the contact, or after `FEW_PASSES` to `NOISE`. Raises FieldError where
        that is not so after `SOFTENING_PASSES`.
        """
        if self.softening is None:
            yield gap
            return
        self.softening.start()
        for count in range(SOFTENING_PASSES):
            lowest = self.softening.open(gap, self._opened)
            yield self._opened
            self.unsettled = self.softening.follow(self.pressure, self.settings.cell_y)
            allowed = self.looser_sidewalls * OF_SIDEWALLS * tolerance
            if count >= FEW_PASSES:
                allowed = max(allowed, NOISE)
            if abs(self.unsettled) <= allowed * max(self._approach - lowest, SHALLOW):
                return
        raise FieldError(
            f"{self.contact}: the sidewalls do not settle, {abs(self.unsettled):.2g} m are left after {SOFTENING_PASSES} passes"
        )

    def _accept(self, result: FieldResult, gap: Field) -> None:
        if result.status == BAD_INPUT:
            self._refuse_bad_cell(gap)
        if result.status != CONVERGED:
            kind = FieldEdgeError if result.status == EDGE else FieldError
            raise kind(
                f"{self.contact}: {SENTENCES[result.status]} (load {result.load:.6g} N, residual {result.residual:.2g}, grid "
                f"{self.settings.rows} x {self.settings.cols} over {self.settings.rows * self.settings.cell_x:.4g} m x "
                f"{self.settings.cols * self.settings.cell_y:.4g} m; see {effect_of(self.contact)})"
            )
        self.load, self._approach = float(result.load), float(result.approach)
        self.iterations += int(result.iterations)
        self.residual = float(result.residual)

    def _refuse_bad_cell(self, gap: Field) -> None:
        """Name the cell whose height is not finite, where that is the fault."""
        try:
            refuse_bad_gap(gap)
        except ValueError as error:
            raise FieldError(f"{self.contact}: {error}") from None


@dataclass(frozen=True)
class FieldGrids:
    """The pressure field of one contact, and the wider one that takes over where the contact
    outgrows it.
    """

    STATE: ClassVar[State] = State(("usual", "wide"))

    usual: PressureField
    wide: PressureField

    def both(self) -> tuple[PressureField, PressureField]:
        """Usual grid first."""
        return (self.usual, self.wide)


def make_grids(settings: FieldSettings, contact: str) -> FieldGrids:
    """Field of a contact on its usual grid and on the wide one."""
    wide = PressureField(widened(settings), contact)
    return FieldGrids(PressureField(settings, contact, wide.softening), wide)


def fit_tangent(field: PressureField, gap: Field, load: float) -> NormalElastic:
    """Power law through the field's approach at ``load`` [N] and at 5 % more: the tangent between
    instants.

    gap: [rows, cols] [m]. Both are solved to 1e-7 whatever the field's own tolerance: dissipation
    and effective height are read from this law.
    """
    tolerance = min(TANGENT_TOLERANCE, field.settings.tolerance)
    first = field.solve_load(gap, load, tolerance)
    second = field.solve_load(gap, load * TANGENT_LOAD_STEP, tolerance)
    exponent = math.log(TANGENT_LOAD_STEP) / math.log(second / first)
    return NormalElastic(load / first**exponent, exponent)


def tangent_law(
    grids: FieldGrids, gap_on: Callable[[FieldSettings], NDArray[numpy.float64]], load: float, contact: str
) -> tuple[NormalElastic, float]:
    """Tangent law of a contact at its standing ``load`` [N], and the length [m] of the contact
    along the rows.

    gap_on: settings of a grid -> undeformed gap [rows, cols] [m]. On the wide grid where the usual
    one does not hold the contact. Raises SceneError where that does not either.
    """
    for field in grids.both():
        try:
            law = fit_tangent(field, gap_on(field.settings), load)
            return law, int((field.pressure > 0.0).any(axis=1).sum()) * field.settings.cell_x
        except FieldError as error:
            reason = error
    # Neither grid holds the contact: the scene is wrong.
    sentence = (
        f"the contact does not fit on its grid at the standing load of {load:.6g} N: {reason}; enlarge length and width"
    )
    raise SceneError([Fault("scene", 0, 0, effect_of(contact), sentence)])


def correction_of(elastic: ElasticLaw, field: PressureField, gap: Field, approach: float, geometric: float) -> float:
    """Effective-height correction [m] of the ``geometric`` approach [m]: the law then has the
    field's force.

    ``field`` was solved at ``gap`` [rows, cols] [m] and ``approach`` [m]. By as much as its sidewalls have
    yet to open the gap, the body is nearer to the road than it would be with them. Without contact the
    law's approach is minus the smallest distance.
    """
    if field.load > 0.0:
        return approach_at(elastic, field.load) - field.unsettled - geometric
    return min(0.0, approach - float(gap.min())) - geometric


@entry
def law_at(elastic: ElasticLaw, approach: float, change: float) -> tuple[float, float, float, float]:
    """Force [N] and stiffness [N/m] of a law at an ``approach`` [m]; force [N] and energy [J] that it
    gains with a ``change`` [m] of that.
    """
    force, energy, moved = elastic_force(elastic, approach), elastic_energy(elastic, approach), approach + change
    more, stored = elastic_force(elastic, moved) - force, elastic_energy(elastic, moved) - energy
    return force, elastic_stiffness(elastic, approach), more, stored


@entry
def approach_at(elastic: ElasticLaw, force: float) -> float:
    """Approach [m] at which a law gives a ``force`` [N]."""
    return approach_of_force(elastic, force)
