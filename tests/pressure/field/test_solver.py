"""The pressure field: closed forms, dense non-negative least squares, invariants and the traps of such solvers."""

from __future__ import annotations

import math

import numpy
import pytest
from numpy.typing import NDArray

from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, make_half_space
from contact_sim_pkg.pressure.field.solver import (
    BAD_INPUT,
    CONVERGED,
    EDGE,
    NOT_CONVERGED,
    SENTENCES,
    FieldResult,
    first_bad_cell,
    make_workspace,
    overlap_approach,
    refuse_bad_gap,
    solve_at_approach,
    solve_at_load,
)

Field = NDArray[numpy.float64]
MODULUS = 6.58e6


class Problem:
    """A gap on a grid, with independent checks of an answer."""

    def __init__(self, gap: Field, cell_x: float = 1e-3, cell_y: float = 1e-3, modulus: float = MODULUS) -> None:
        self.gap = numpy.ascontiguousarray(gap, dtype=numpy.float64)
        self.half_space: HalfSpace = make_half_space(*gap.shape, cell_x, cell_y, modulus)
        self.workspace = make_workspace(self.half_space)
        self.pressure = numpy.zeros(gap.shape)
        self.cell = cell_x * cell_y

    def at_approach(self, approach: float, tolerance: float = 1e-10, iterations: int = 500) -> FieldResult:
        arguments = (self.half_space, self.workspace, self.gap, approach, tolerance, iterations, self.pressure)
        return solve_at_approach(*arguments)

    def at_load(self, load: float, tolerance: float = 1e-10, iterations: int = 500) -> FieldResult:
        return solve_at_load(self.half_space, self.workspace, self.gap, load, tolerance, iterations, self.pressure)

    def clearance(self, approach: float) -> Field:
        """Gap of the deformed surfaces by a direct sum over the loaded cells, without transforms."""
        rows, cols = self.gap.shape
        result = self.gap - approach
        table = self.half_space.influence
        for row, col in numpy.argwhere(self.pressure):
            away = table[abs(numpy.arange(rows) - row)][:, abs(numpy.arange(cols) - col)]
            result += self.pressure[row, col] * away
        return result

    def must_hold(self, result: FieldResult, tolerance: float) -> None:
        """p >= 0, clearance >= 0, p * clearance = 0, load = sum of p: from the returned field alone."""
        clearance = self.clearance(result.approach)
        p = self.pressure
        assert numpy.isfinite(p).all()
        assert p.min() >= 0.0
        assert result.load == pytest.approx(p.sum() * self.cell, rel=1e-13)
        energy = float((p * (clearance + result.approach - self.gap)).sum())
        penetration = float(max(0.0, -clearance[p == 0.0].min(initial=0.0)))
        residual = float((p * abs(clearance)).sum()) + penetration * float(p.sum())
        rounding = 1e-12 + 1e-15 * abs(self.gap).max() * p.sum() / energy  # of this check, from gap - approach
        assert residual / energy <= 1.001 * tolerance + rounding
        assert result.residual == pytest.approx(residual / energy, rel=1e-3, abs=rounding)


def paraboloid(rows: int, cols: int, cell_x: float, cell_y: float, radius_x: float, radius_y: float) -> Field:
    x = (numpy.arange(rows) - 0.5 * (rows - 1)) * cell_x
    y = (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y
    return numpy.asarray(x[:, None] ** 2 / (2.0 * radius_x) + y[None, :] ** 2 / (2.0 * radius_y))


def rough(rows: int, cols: int, height: float, seed: int = 1) -> Field:
    """A crowned surface with white noise on it."""
    noise = height * numpy.random.default_rng(seed).standard_normal((rows, cols))
    return numpy.asarray(paraboloid(rows, cols, 1e-3, 1e-3, 0.05, 0.08) + noise)


def test_a_sphere_has_hertz_s_pressure_load_and_radius() -> None:
    cells, radius, semi_axis = 128, 2.0, 0.25
    problem = Problem(paraboloid(cells, cells, 1 / cells, 1 / cells, radius, radius), 1 / cells, 1 / cells, 1.0)
    load = 4.0 / 3.0 * semi_axis**3 / radius
    result = problem.at_load(load, 1e-8)
    assert result.status == CONVERGED
    assert result.load == pytest.approx(load, rel=1e-13)
    assert result.approach == pytest.approx(semi_axis**2 / radius, rel=2e-4)
    peak = 3.0 * load / (2.0 * math.pi * semi_axis**2)
    assert problem.pressure.max() == pytest.approx(peak, rel=5e-4)
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    expected = peak * numpy.sqrt(numpy.maximum(1.0 - (x[:, None] ** 2 + x[None, :] ** 2) / semi_axis**2, 0.0))
    assert numpy.linalg.norm(problem.pressure - expected) <= 0.01 * numpy.linalg.norm(expected)


def test_80_cells_across_a_sphere_s_contact_have_the_known_accuracy() -> None:
    cells, semi_axis = 128, 40.0 / 128.0
    problem = Problem(paraboloid(cells, cells, 1 / cells, 1 / cells, 1.0, 1.0), 1 / cells, 1 / cells, 1.0)
    load = 4.0 / 3.0 * semi_axis**3
    result = problem.at_load(load, 1e-8)
    assert problem.pressure.max() == pytest.approx(1.5 * load / (math.pi * semi_axis**2), rel=2e-4)
    assert result.approach == pytest.approx(semi_axis**2, rel=4e-5)
    area = numpy.count_nonzero(problem.pressure) * problem.cell
    assert area == pytest.approx(math.pi * semi_axis**2, rel=5e-3)
    assert result.iterations <= 46


def test_the_load_of_a_sphere_grows_with_approach_to_the_power_of_one_and_a_half() -> None:
    problem = Problem(paraboloid(96, 96, 1e-3, 1e-3, 0.3, 0.3))
    loads = [problem.at_approach(approach).load for approach in (1e-3, 2e-3, 3e-3)]
    assert loads[1] / loads[0] == pytest.approx(2.0**1.5, rel=2e-3)
    assert loads[2] / loads[0] == pytest.approx(3.0**1.5, rel=2e-3)


def test_an_elliptic_contact_has_its_closed_form() -> None:
    problem = Problem(paraboloid(160, 192, 1e-3, 1.5e-3, 0.3, 1.0), 1e-3, 1.5e-3, 3e6 / 0.75)
    result = problem.at_load(4000.0, 1e-8)
    assert result.status == CONVERGED
    assert result.approach == pytest.approx(9.892e-3, rel=3e-4)  # the check values of the tire, to their digits
    assert problem.pressure.max() == pytest.approx(0.35927e6, rel=1e-3)
    length_x = numpy.count_nonzero(problem.pressure.any(axis=1)) * 1e-3
    length_y = numpy.count_nonzero(problem.pressure.any(axis=0)) * 1.5e-3
    assert (length_x, length_y) == pytest.approx((2 * 0.04893, 2 * 0.10864), abs=2.5e-3)


@pytest.mark.parametrize("height", [0.0, 2e-5, 3e-4])
@pytest.mark.parametrize("approach", [2e-4, 8e-4])
def test_the_field_equals_dense_non_negative_least_squares(height: float, approach: float) -> None:
    problem = Problem(rough(24, 24, height))
    dense = reference.dense_influence(24, 24, 1e-3, 1e-3, MODULUS)
    expected = reference.pressure_at_approach(dense, problem.gap, approach)
    result = problem.at_approach(approach, 1e-13)
    assert problem.pressure == pytest.approx(expected, rel=1e-8, abs=1e-8 * expected.max())
    assert (problem.pressure > 0.0).tolist() == (expected > 0.0).tolist()
    assert result.load == pytest.approx(expected.sum() * 1e-6, rel=1e-10)


@pytest.mark.parametrize("approach", [4e-4, 1.5e-3])
def test_given_load_and_given_approach_are_the_same_contact(approach: float) -> None:
    problem = Problem(rough(48, 40, 1e-4))
    first = problem.at_approach(approach, 1e-12)
    field = problem.pressure.copy()
    problem.pressure[:] = 0.0
    second = problem.at_load(first.load, 1e-12)
    assert second.approach == pytest.approx(approach, rel=1e-10)
    assert problem.pressure == pytest.approx(field, abs=1e-7 * field.max())


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3, 1e-6, 1e-10])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_what_is_certified_holds_on_the_returned_field(tolerance: float, seed: int) -> None:
    problem = Problem(rough(40, 33, 2e-4, seed), 1.3e-3, 0.9e-3)
    problem.must_hold(problem.at_approach(6e-4, tolerance), tolerance)
    problem.pressure[:] = 0.0
    result = problem.at_load(20.0, tolerance)
    problem.must_hold(result, tolerance)
    assert result.load == pytest.approx(20.0, rel=1e-14)


def test_the_error_of_the_field_falls_with_the_tolerance() -> None:
    problem = Problem(rough(64, 48, 1e-4))
    problem.at_load(50.0, 1e-12)
    exact = problem.pressure.copy()
    errors = []
    for tolerance in (1e-2, 1e-4, 1e-6, 1e-8):
        problem.pressure[:] = 0.0
        assert problem.at_load(50.0, tolerance).status == CONVERGED
        errors.append(numpy.linalg.norm(problem.pressure - exact) / numpy.linalg.norm(exact))
    assert all(error <= bound for error, bound in zip(errors, (0.2, 2e-2, 2e-3, 2e-4), strict=True)), errors


def test_a_spike_is_solved_and_its_field_is_true() -> None:
    gap = paraboloid(48, 48, 1e-3, 1e-3, 0.3, 0.3)
    gap[20, 30] -= 0.02
    problem = Problem(gap)
    problem.must_hold(problem.at_load(300.0, 1e-8, 2000), 1e-8)
    assert problem.pressure.argmax() == 20 * 48 + 30
    result = problem.at_approach(1e-3, 1e-8, 2000)
    assert result.status == CONVERGED
    problem.must_hold(result, 1e-8)


def test_one_cell_in_contact_carries_its_closed_form() -> None:
    gap = numpy.full((15, 15), 1.0)
    gap[7, 4] = 0.0
    problem = Problem(gap)
    result = problem.at_approach(2e-5)
    own = 4.0 * 1e-3 * math.log(1.0 + 2.0**0.5) / (math.pi * MODULUS)  # displacement of a cell under its own pressure
    assert problem.pressure[7, 4] == pytest.approx(2e-5 / own, rel=1e-12)
    assert (numpy.count_nonzero(problem.pressure), result.status) == (1, CONVERGED)
    problem.pressure[:] = 0.0
    result = problem.at_load(result.load)
    assert result.approach == pytest.approx(2e-5, rel=1e-12)
    assert numpy.count_nonzero(problem.pressure) == 1


def test_a_grid_of_one_cell_works() -> None:
    problem = Problem(numpy.zeros((1, 1)))
    own = 4.0 * 1e-3 * math.log(1.0 + 2.0**0.5) / (math.pi * MODULUS)
    assert problem.at_approach(1e-5).load == pytest.approx(1e-5 / own * 1e-6, rel=1e-12)
    assert problem.at_load(3.0).load == 3.0


@pytest.mark.parametrize("height", [0.0, 5.0, -0.3])
def test_a_flat_surface_is_a_punch_in_full_contact_and_says_that_it_reaches_the_edge(height: float) -> None:
    problem = Problem(numpy.full((20, 24), height))
    dense = reference.dense_influence(20, 24, 1e-3, 1e-3, MODULUS)
    expected = numpy.linalg.solve(dense, numpy.full(480, 1e-4)).reshape(20, 24)
    result = problem.at_approach(height + 1e-4, 1e-10)
    assert result.status == EDGE
    assert problem.pressure == pytest.approx(expected, rel=1e-6)
    problem.pressure[:] = 0.0
    result = problem.at_load(float(expected.sum()) * 1e-6, 1e-10)
    assert result.status == EDGE
    assert result.approach == pytest.approx(height + 1e-4, rel=1e-8)
    problem.must_hold(result, 1e-10)


def test_a_sharp_edged_round_punch_has_its_closed_form() -> None:
    cells, radius = 128, 0.25
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    inside = x[:, None] ** 2 + x[None, :] ** 2 <= radius**2
    problem = Problem(numpy.where(inside, 0.0, 1.0), 1 / cells, 1 / cells, 1.0)
    result = problem.at_approach(1e-3)
    assert result.status == CONVERGED
    assert result.load == pytest.approx(2.0 * 1e-3 * radius, rel=0.01)  # P = 2 E* a delta
    assert problem.pressure[64, 64] == pytest.approx(1e-3 / (math.pi * radius), rel=0.01)


def test_white_noise_is_solved() -> None:
    noise = 1e-3 * numpy.random.default_rng(4).standard_normal((64, 48))
    problem = Problem(noise)
    result = problem.at_load(30.0, 1e-9, 1000)
    assert result.residual <= 1e-9
    problem.must_hold(result, 1e-9)


def test_full_contact_of_a_wavy_surface() -> None:
    wave = 1e-6 * numpy.cos(numpy.arange(32) * 0.7)[:, None] * numpy.cos(numpy.arange(24) * 0.4)[None, :]
    problem = Problem(wave)
    result = problem.at_approach(1e-3, 1e-11)
    dense = reference.dense_influence(32, 24, 1e-3, 1e-3, MODULUS)
    expected = numpy.linalg.solve(dense, (1e-3 - wave).ravel()).reshape(32, 24)
    assert expected.min() > 0.0
    assert result.status == EDGE
    assert problem.pressure == pytest.approx(expected, rel=1e-6)


def test_contact_at_the_grid_s_edge_is_reported_and_the_field_returned() -> None:
    gap = paraboloid(64, 64, 1e-3, 1e-3, 0.3, 0.3)
    problem = Problem(numpy.roll(gap, 28, axis=0))
    result = problem.at_approach(5e-4)
    assert result.status == EDGE
    assert "edge" in SENTENCES[result.status]
    assert result.load > 0.0
    assert Problem(gap).at_approach(5e-4).status == CONVERGED


@pytest.mark.parametrize("approach", [-1.0, 0.0, 0.5, 1.0])
def test_without_contact_the_field_is_exactly_zero(approach: float) -> None:
    bowl = paraboloid(16, 16, 1e-3, 1e-3, 0.3, 0.3)
    problem = Problem(1.0 + (bowl - bowl.min()))
    problem.pressure[:] = 5.0
    assert problem.at_approach(approach) == (CONVERGED, 0, 0.0, approach, 0.0)
    assert not problem.pressure.any()


def test_zero_load_gives_zero_force_at_first_touch() -> None:
    problem = Problem(rough(16, 16, 1e-4) + 3.0)
    problem.pressure[:] = 5.0
    assert problem.at_load(0.0) == (CONVERGED, 0, 0.0, problem.gap.min(), 0.0)
    assert not problem.pressure.any()


@pytest.mark.parametrize("load", [1e-12, 1e-3, 1e9])
def test_tiny_and_huge_loads_are_carried(load: float) -> None:
    problem = Problem(rough(32, 32, 1e-4))
    result = problem.at_load(load, 1e-9, 1000)
    assert result.load == pytest.approx(load, rel=1e-13)
    problem.must_hold(result, 1e-9)


@pytest.mark.parametrize("bad", [numpy.nan, numpy.inf, -numpy.inf])
def test_a_gap_that_is_not_finite_is_refused_and_its_cell_named(bad: float) -> None:
    gap = paraboloid(16, 20, 1e-3, 1e-3, 0.3, 0.3)
    gap[3, 17] = bad
    problem = Problem(gap)
    problem.pressure[5, 5] = 2.0
    for result in (problem.at_approach(1e-3), problem.at_load(10.0)):
        assert result.status == BAD_INPUT
        assert result.load == 0.0
    assert problem.pressure.sum() == 2.0
    assert first_bad_cell(gap) == 3 * 20 + 17
    with pytest.raises(ValueError, match="road: the height of row 3, column 17"):
        refuse_bad_gap(gap, "road")
    refuse_bad_gap(numpy.zeros((2, 2)))


@pytest.mark.parametrize("bad", [numpy.nan, -1.0, numpy.inf])
def test_an_impossible_start_or_load_is_refused(bad: float) -> None:
    problem = Problem(paraboloid(16, 16, 1e-3, 1e-3, 0.3, 0.3))
    assert problem.at_load(bad).status == BAD_INPUT
    problem.pressure[2, 2] = bad
    assert problem.at_approach(1e-3).status == BAD_INPUT
    problem.pressure[2, 2] = 0.0
    assert problem.at_approach(numpy.nan).status == BAD_INPUT


def test_arrays_of_the_wrong_shape_are_refused_before_compiled_code_sees_them() -> None:
    problem = Problem(paraboloid(16, 16, 1e-3, 1e-3, 0.3, 0.3))
    problem.gap = problem.gap[:10]
    with pytest.raises(ValueError, match=r"gap is \(10, 16\)"):
        problem.at_approach(1e-3)


def test_without_a_pressure_to_start_from_the_overlap_of_a_ball_gives_the_approach_of_hertz() -> None:
    half_space = make_half_space(64, 64, 1e-3, 1e-3, 1e6)
    radius, load = 0.2, 2.0
    place = (numpy.arange(64) - 31.5) * 1e-3
    height = (place[:, None] ** 2 + place[None, :] ** 2) / (2.0 * radius)
    hertz = (0.75 * load / (1e6 * math.sqrt(radius))) ** (2.0 / 3.0)
    assert overlap_approach(half_space, height, load) == pytest.approx(hertz, rel=0.03)


@pytest.mark.fault("D4")
def test_the_iteration_cap_is_reported_with_the_true_residual() -> None:
    problem = Problem(rough(48, 48, 2e-4))
    result = problem.at_approach(1e-3, 1e-10, 3)
    assert (result.status, result.iterations) == (NOT_CONVERGED, 3)
    assert result.residual > 1e-10
    problem.must_hold(result, result.residual)


@pytest.mark.parametrize("shift", [1e-3, -7.0, 1e3])
def test_lifting_both_bodies_changes_nothing(shift: float) -> None:
    problem = Problem(rough(32, 32, 1e-4))
    problem.at_approach(8e-4)
    field = problem.pressure.copy()
    problem.gap = problem.gap + shift
    problem.pressure[:] = 0.0
    problem.at_approach(8e-4 + shift)
    assert problem.pressure == pytest.approx(field, abs=1e-6 * field.max())


@pytest.mark.parametrize("move", [(5, 0), (0, -6), (-3, 4)])
def test_moving_the_whole_gap_moves_the_field(move: tuple[int, int]) -> None:
    gap = numpy.full((48, 48), 1.0)
    gap[8:40, 8:40] = rough(32, 32, 1e-4)
    problem, moved = Problem(gap), Problem(numpy.roll(gap, move, (0, 1)))
    first, second = problem.at_load(15.0, 1e-12), moved.at_load(15.0, 1e-12)
    assert second.approach == pytest.approx(first.approach, rel=1e-11)
    expected = numpy.roll(problem.pressure, move, (0, 1))
    assert moved.pressure == pytest.approx(expected, abs=1e-7 * expected.max())


def test_pressure_scales_with_the_modulus_and_only_the_modulus_enters() -> None:
    gap = rough(32, 32, 1e-4)
    soft, hard = Problem(gap, modulus=3e6 / (1.0 - 0.5**2)), Problem(gap, modulus=2.0 * 3e6 / (1.0 - 0.5**2))
    soft.at_approach(8e-4, 1e-12)
    hard.at_approach(8e-4, 1e-12)
    assert hard.pressure == pytest.approx(2.0 * soft.pressure, abs=1e-8 * soft.pressure.max())


def test_turning_the_grid_by_a_right_angle_turns_the_field() -> None:
    gap = rough(40, 28, 1e-4)
    problem, turned = Problem(gap, 1e-3, 1.4e-3), Problem(numpy.rot90(gap), 1.4e-3, 1e-3)
    problem.at_approach(8e-4, 1e-12)
    turned.at_approach(8e-4, 1e-12)
    assert turned.pressure == pytest.approx(numpy.rot90(problem.pressure), abs=1e-8 * problem.pressure.max())


@pytest.mark.parametrize("start", ["exact", "zero", "random", "elsewhere"])
def test_the_answer_does_not_depend_on_the_start(start: str) -> None:
    problem = Problem(rough(40, 40, 1e-4))
    problem.at_approach(8e-4, 1e-12)
    exact = problem.pressure.copy()
    random = numpy.random.default_rng(9).random((40, 40)) * exact.max()
    starts = {"exact": exact, "zero": 0.0 * exact, "random": random, "elsewhere": numpy.roll(exact, 15, axis=0)}
    problem.pressure[:] = starts[start]
    result = problem.at_approach(8e-4, 1e-12)
    assert result.status == CONVERGED
    assert problem.pressure == pytest.approx(exact, abs=1e-7 * exact.max())
    problem.pressure[:] = starts[start]
    assert problem.at_load(result.load, 1e-12).approach == pytest.approx(8e-4, rel=1e-10)


def test_a_warm_start_takes_at_most_one_iteration_for_a_tiny_change() -> None:
    problem = Problem(rough(64, 48, 1e-4))
    problem.at_approach(8e-4, 1e-4)
    result = problem.at_approach(8e-4 * (1.0 + 1e-5), 1e-3)
    assert result.iterations <= 1
    problem.must_hold(result, 1e-3)


def test_the_same_solve_gives_the_same_bits_whatever_the_workspace_held_before() -> None:
    problem = Problem(rough(48, 40, 1e-4))
    first = problem.at_load(12.0, 1e-6)
    field = problem.pressure.copy()
    for buffer in problem.workspace[1:-2]:
        buffer[:] = numpy.nan
    problem.pressure[:] = 0.0
    assert problem.at_load(12.0, 1e-6) == first
    assert numpy.array_equal(problem.pressure, field)


def test_load_never_falls_while_the_approach_grows() -> None:
    problem = Problem(rough(48, 48, 3e-4))
    lowest = float(problem.gap.min())
    loads = [problem.at_approach(lowest + depth, 1e-9).load for depth in numpy.linspace(0.0, 1.2e-3, 25)]
    assert loads[0] == 0.0
    assert (numpy.diff(loads) > 0.0).all()
