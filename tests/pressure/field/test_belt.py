"""The part of the preconditioner that a belt adds, against dense matrices."""

import numpy
import pytest

from contact_sim_pkg.pressure.field.belt import factor_belt, keep_lines, make_belt_workspace, relieve, weigh_scatter
from contact_sim_pkg.pressure.field.halfspace import make_buffers, make_half_space, part_of, precondition
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import CONVERGED
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import inflated_influence, make_belt

BELT = make_belt(220e3, 0.316, 1.2, 0.06, 0.15, 1e5, 4.4e5, 2.0, 1.4e6)
CELL = 4e-3


def _belted(rows: int, cols: int):  # type: ignore[no-untyped-def]
    return make_half_space(rows, cols, CELL, CELL, 5e6, inflated_influence(BELT, rows, cols, CELL, CELL))


def _prepared(rows: int, cols: int):  # type: ignore[no-untyped-def]
    """Half-space with a belt, its factor with all cells in contact, and the dense `G^-1 + A`."""
    half_space = _belted(rows, cols)
    scratch = make_belt_workspace(rows)
    factor_belt(half_space.belt, half_space.strip, numpy.ones((rows, cols)), scratch)
    return half_space, scratch, half_space.belt + half_space.strip


def test_the_inverse_of_the_belt_is_that_of_its_influence_on_lines() -> None:
    half_space = _belted(24, 20)
    rows = numpy.arange(24)
    along = inflated_influence(BELT, 24, 1, CELL, CELL)[:, 0]
    lines = numpy.sin(0.3 * rows) + 2.0
    taken = half_space.belt @ (along[abs(rows[:, None] - rows)] @ lines)
    # Up to what is added under the load
    assert taken == pytest.approx(lines, rel=1e-2)


def test_the_strip_sums_what_the_preconditioner_makes_of_each_line() -> None:
    half_space = _belted(16, 12)
    buffers, result = make_buffers(half_space), numpy.empty((16, 12))
    for line in (0, 7, 15):
        clearance = numpy.zeros((16, 12))
        clearance[line] = 1.0
        precondition(half_space.without_belt, buffers, clearance, result)
        assert half_space.strip[:, line] == pytest.approx(result.sum(axis=1), rel=1e-9, abs=1e-9 * abs(result).max())


def test_lines_are_relieved_by_the_part_of_the_belt() -> None:
    half_space, scratch, both = _prepared(16, 12)
    rng = numpy.random.default_rng(1)
    residual, filtered = rng.random((16, 12)) + 0.1, rng.random((16, 12))
    lines = filtered.sum(axis=1)
    relieve(half_space.belt, residual, filtered, scratch)
    left = half_space.belt @ numpy.linalg.solve(both, lines)
    assert filtered.sum(axis=1) == pytest.approx(left, rel=1e-8, abs=1e-8 * abs(lines).max())


def test_a_scattered_contact_sends_the_belt_less_far() -> None:
    """Every other cell presses: of a clearance of 1 the preconditioner makes larger lines than the strip, and the belt is
    left the fourth root of that less of them.
    """
    half_space, scratch = _belted(16, 12), make_belt_workspace(16)
    pressing = (numpy.indices((16, 12)).sum(axis=0) % 2).astype(numpy.float64)
    made = numpy.empty((16, 12))
    precondition(half_space.without_belt, make_buffers(half_space), pressing, made)
    larger = (made * pressing).sum() / (0.5 * half_space.strip).sum()
    assert larger > 2.0
    factor_belt(half_space.belt, half_space.strip, pressing, scratch)
    weigh_scatter(half_space.strip, pressing, made, scratch)
    filtered = numpy.random.default_rng(3).random((16, 12))
    lines = (filtered * pressing).sum(axis=1)
    relieve(half_space.belt, pressing, filtered, scratch)
    left = half_space.belt @ numpy.linalg.solve(half_space.belt + 0.5 * half_space.strip, lines) / larger**0.25
    assert (filtered * pressing).sum(axis=1) == pytest.approx(left, rel=1e-8, abs=1e-8 * abs(lines).max())


def test_rows_lose_what_clipping_added_and_the_belt_would_yield_under() -> None:
    half_space, scratch, both = _prepared(16, 12)
    rng = numpy.random.default_rng(2)
    pressure, clipped = rng.random((16, 12)) + 1.0, 0.1 * rng.random(10)
    leaving = rng.permutation(16 * 12)[:10]
    added = numpy.bincount(leaving // 12, clipped, minlength=16)
    before = pressure.sum(axis=1)
    keep_lines(half_space.belt, pressure, clipped, leaving, 10, scratch)
    taken = half_space.strip @ numpy.linalg.solve(both, added)
    assert before - pressure.sum(axis=1) == pytest.approx(taken, rel=1e-8, abs=1e-8 * added.max())


def test_a_belt_takes_few_corrections_and_a_fine_one_stays_definite() -> None:
    for cell in (4e-3, 1e-3):
        influence = inflated_influence(BELT, 64, 8, cell, cell)
        half_space = part_of(make_half_space(64, 8, cell, cell, 5e6, influence), 60, 8)
        scratch = make_belt_workspace(60)
        factor_belt(half_space.belt, half_space.strip, numpy.ones((60, 8)), scratch)
        assert numpy.isfinite(scratch.factor).all()
    field = RollingField(_belted(48, 40))
    x, y = (numpy.arange(48) - 24) * CELL, (numpy.arange(40) - 19.5) * CELL
    smooth = 0.5 * x[:, None] ** 2 / 0.316 + 0.5 * y[None, :] ** 2 / 0.5
    waves = numpy.sin(0.5 * numpy.arange(48 + 40))[:, None] * numpy.cos(0.3 * numpy.arange(40))[None, :]
    rough = 3e-4 * waves
    done = 0
    for place in (0, 12, 24, 36):  # a quarter of the contact and more from one to the next
        field.roll(12)
        found = field.solve_at_approach(smooth + rough[place : place + 48], 5e-3, 1e-3, 50)
        assert found.status == CONVERGED
        assert place == 0 or field.convolutions - done <= 8
        done = field.convolutions


@pytest.mark.parametrize("rows", [2, 3, 12, 13, 14, 15])
def test_the_belt_is_factored_whatever_number_of_rows(rows: int) -> None:
    _half_space, scratch, both = _prepared(rows, 12)
    expected = numpy.linalg.cholesky(both).T
    assert numpy.triu(scratch.factor) == pytest.approx(expected, rel=1e-9, abs=1e-9 * abs(expected).max())
