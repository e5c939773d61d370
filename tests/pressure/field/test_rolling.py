"""Rolling fields: whatever the prediction and the window, the answer is that of the whole grid."""

import numpy
import pytest

from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import (
    BAD_INPUT,
    CONVERGED,
    EDGE,
    make_workspace,
    solve_at_approach,
    solve_at_load,
)

ROWS, COLS, CELL = 52, 48, 2e-3
HALF_SPACE = make_half_space(ROWS, COLS, CELL, CELL, 6e6)
X = (numpy.arange(ROWS)[:, None] - 23.0) * CELL
Y = (numpy.arange(COLS)[None, :] - 19.0) * CELL
BOWL = X**2 / 0.6 + Y**2 / 0.6
TOLERANCE = 1e-11


def road(seed=1, length=160):
    return 8e-5 * numpy.random.default_rng(seed).standard_normal((length, COLS))


def gap_over(heights, first):
    return BOWL - heights[first : first + ROWS]


def whole(gap, load, tolerance=TOLERANCE):
    pressure = numpy.zeros((ROWS, COLS))
    result = solve_at_load(HALF_SPACE, make_workspace(HALF_SPACE), gap, load, tolerance, 900, pressure)
    return pressure, result


def must_agree(field, result, gap, load):
    expected, reference = whole(gap, load)
    assert result.status == reference.status
    assert result.residual <= TOLERANCE
    assert result.load == pytest.approx(load, rel=1e-12)
    assert result.approach == pytest.approx(reference.approach, rel=1e-9)
    numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


@pytest.mark.parametrize("travel", [[1] * 8, [2, 3, 0, 5], [-1] * 6, [1, 1, -2, -3, 4], [30, 7, -40, 60]])
def test_every_step_is_the_field_of_the_whole_grid(travel):
    heights, field, first = road(), RollingField(HALF_SPACE), 50
    for step, cells in enumerate([0, *travel]):
        first += cells
        field.roll(cells)
        gap, load = gap_over(heights, first), 150.0 + 20.0 * (step % 3)
        must_agree(field, field.solve_at_load(gap, load, TOLERANCE, 900), gap, load)


def test_a_given_approach_gives_the_field_of_the_whole_grid():
    heights, field = road(2), RollingField(HALF_SPACE)
    for step in range(6):
        gap, approach = gap_over(heights, step), 9e-4 + 3e-5 * step
        field.roll(1)
        result = field.solve_at_approach(gap, approach, TOLERANCE, 900)
        expected = numpy.zeros((ROWS, COLS))
        reference = solve_at_approach(HALF_SPACE, make_workspace(HALF_SPACE), gap, approach, TOLERANCE, 900, expected)
        assert (result.status, result.approach) == (CONVERGED, approach)
        assert result.load == pytest.approx(reference.load, rel=1e-9)
        numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


@pytest.mark.parametrize("place", [(3, 4), (44, 20), (24, 2), (40, 36)])
@pytest.mark.parametrize("holds_load", [True, False])
def test_a_spot_that_rises_far_outside_the_window_is_found(place, holds_load):
    field = RollingField(HALF_SPACE)
    first = field.solve_at_load(BOWL, 150.0, TOLERANCE, 900)
    gap = BOWL.copy()
    gap[place] = -1e-4
    if holds_load:
        result, load = field.solve_at_load(gap, 150.0, TOLERANCE, 900), 150.0
    else:
        result = field.solve_at_approach(gap, first.approach, TOLERANCE, 900)
        load = result.load
    assert field.pressure[place] > 0.0
    expected, _ = whole(gap, load)
    numpy.testing.assert_allclose(field.pressure, expected, atol=1e-5 * expected.max())


def test_the_road_may_jump():
    heights, field = road(3), RollingField(HALF_SPACE)
    for first, datum in ((0, 0.0), (90, 0.5), (91, -3.0)):
        gap = gap_over(heights, first) + datum
        field.roll(1)
        result = field.solve_at_load(gap, 120.0, TOLERANCE, 900)
        expected, reference = whole(gap, 120.0)
        assert result.approach == pytest.approx(reference.approach, abs=1e-12 + 1e-9 * 1e-3)
        numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


def test_lift_off_gives_zero_and_the_contact_comes_back():
    heights, field = road(4), RollingField(HALF_SPACE)
    gap = gap_over(heights, 0)
    field.solve_at_load(gap, 150.0, TOLERANCE, 900)
    for result in (field.solve_at_load(gap, 0.0, TOLERANCE, 900), field.solve_at_approach(gap, -1.0, TOLERANCE, 900)):
        assert (result.status, result.load) == (CONVERGED, 0.0)
        assert not field.pressure.any()
    field.roll(3)
    gap = gap_over(heights, 3)
    must_agree(field, field.solve_at_load(gap, 150.0, TOLERANCE, 900), gap, 150.0)


def test_full_contact_and_one_cell():
    field = RollingField(HALF_SPACE)
    assert field.solve_at_load(numpy.zeros((ROWS, COLS)), 5e4, 1e-8, 900).status == EDGE
    assert (field.pressure > 0.0).all()
    spike = numpy.full((ROWS, COLS), 1.0)
    spike[20, 20] = 0.0
    field.roll(2)
    result = field.solve_at_load(spike, 0.01, 1e-8, 900)
    assert result.status == CONVERGED
    assert numpy.argwhere(field.pressure).tolist() == [[20, 20]]
    field.roll(1)
    spike = numpy.roll(spike, -1, axis=0)
    assert field.solve_at_load(spike, 0.01, 1e-8, 900).iterations == 0
    assert numpy.argwhere(field.pressure).tolist() == [[19, 20]]


@pytest.mark.parametrize("bad", [numpy.nan, numpy.inf, -numpy.inf])
def test_a_height_that_is_not_finite_is_refused_and_nothing_forgotten(bad):
    heights, field, same = road(5), RollingField(HALF_SPACE), RollingField(HALF_SPACE)
    for each in (field, same):
        each.solve_at_load(gap_over(heights, 0), 150.0, 1e-6, 900)
    kept = field.pressure.copy()
    gap = gap_over(heights, 1)
    gap[0, 0] = bad
    field.roll(1)
    assert field.solve_at_load(gap, 150.0, 1e-6, 900).status == BAD_INPUT
    assert field.solve_at_load(gap_over(heights, 1), numpy.nan, 1e-6, 900).status == BAD_INPUT
    assert field.solve_at_load(gap_over(heights, 1), -1.0, 1e-6, 900).status == BAD_INPUT
    assert numpy.array_equal(field.pressure, kept)
    same.roll(1)
    assert field.solve_at_load(gap_over(heights, 1), 150.0, 1e-6, 900) == same.solve_at_load(
        gap_over(heights, 1), 150.0, 1e-6, 900
    )
    assert numpy.array_equal(field.pressure, same.pressure)


def test_the_same_sequence_gives_the_same_bits_whatever_was_solved_before():
    heights, fresh, used = road(6), RollingField(HALF_SPACE), RollingField(HALF_SPACE)
    for first in (80, 20, 60):
        used.solve_at_load(gap_over(heights, first), 400.0, 1e-4, 900)
    used.reset()
    for step in range(4):
        for field in (fresh, used):
            field.roll(1)
        gap = gap_over(heights, step)
        assert fresh.solve_at_load(gap, 150.0, 1e-5, 900) == used.solve_at_load(gap, 150.0, 1e-5, 900)
        assert fresh.pressure.tobytes() == used.pressure.tobytes()


@pytest.mark.parametrize("shape", [(52, 48), (51, 48), (30, 30), (1, 1)])
def test_a_cold_start_on_any_grid_is_the_field_of_that_grid(shape):
    half_space = make_half_space(*shape, CELL, CELL, 6e6)
    gap = numpy.ascontiguousarray(gap_over(road(7), 0)[: shape[0], : shape[1]])
    field, expected = RollingField(half_space), numpy.zeros(shape)
    result = field.solve_at_load(gap, 30.0, TOLERANCE, 900)
    reference = solve_at_load(half_space, make_workspace(half_space), gap, 30.0, TOLERANCE, 900, expected)
    assert result.status == reference.status
    assert result.approach == pytest.approx(reference.approach, rel=1e-8, abs=1e-12)
    numpy.testing.assert_allclose(field.pressure, expected, atol=1e-6 * expected.max())


def test_a_cold_start_finds_a_spot_that_the_coarser_grid_does_not_feel():
    gap = BOWL.copy()
    gap[4, 4] = -1e-5
    field = RollingField(HALF_SPACE)
    field.solve_at_load(gap, 150.0, TOLERANCE, 900)
    expected, _ = whole(gap, 150.0)
    assert expected[4, 4] > 0.0
    numpy.testing.assert_allclose(field.pressure, expected, atol=1e-5 * expected.max())


def test_a_prediction_saves_convolutions_on_a_smooth_road():
    x = (numpy.arange(160)[:, None] * CELL) * numpy.ones((1, COLS))
    heights, field = 1e-4 * numpy.sin(300.0 * x) * numpy.cos(200.0 * Y), RollingField(HALF_SPACE)
    field.solve_at_load(gap_over(heights, 0), 150.0, 1e-3, 900)
    workspace, pressure = make_workspace(HALF_SPACE), numpy.zeros((ROWS, COLS))
    solve_at_load(HALF_SPACE, workspace, gap_over(heights, 0), 150.0, 1e-3, 900, pressure)
    from_nothing, warm = int(workspace.buffers.convolutions[0]), []
    for step in range(1, 12):
        before = field.convolutions
        field.roll(1)
        field.solve_at_load(gap_over(heights, step), 150.0, 1e-3, 900)
        warm.append(field.convolutions - before)
    assert numpy.mean(warm[2:]) < 0.5 * from_nothing


def test_a_field_that_rolls_is_as_accurate_at_its_worst_as_elsewhere():
    heights, field, errors = road(8), RollingField(HALF_SPACE), []
    for step in range(40):
        field.roll(1)
        gap = gap_over(heights, step)
        field.solve_at_load(gap, 150.0, 2e-3, 900)
        expected, _ = whole(gap, 150.0)
        errors.append(numpy.linalg.norm(field.pressure - expected) / numpy.linalg.norm(expected))
    assert max(errors) <= 6.0 * 2e-3
    assert max(errors[3:]) <= 3.0 * numpy.median(errors[3:])


@pytest.mark.parametrize("holds_load", [True, False])
def test_solving_an_instant_again_is_a_solve_at_the_same_place(holds_load):
    heights, field, once = road(9), RollingField(HALF_SPACE), RollingField(HALF_SPACE)
    for step in range(4):
        gap = gap_over(heights, 2 * step)
        given = 150.0 if holds_load else 9e-4
        for each, shares in ((field, (0.9, 1.05, 1.0)), (once, (1.0,))):
            each.roll(2)
            solve = each.solve_at_load if holds_load else each.solve_at_approach
            results = [solve(gap, share * given, TOLERANCE, 900) for share in shares]
            must_agree(each, results[-1], gap, results[-1].load)
    numpy.testing.assert_allclose(field.pressure, once.pressure, atol=1e-6 * once.pressure.max())


def test_a_repeated_solve_starts_from_the_last():
    heights, field = road(10), RollingField(HALF_SPACE)
    field.solve_at_approach(gap_over(heights, 0), 9e-4, 1e-3, 900)
    before = field.convolutions
    result = field.solve_at_approach(gap_over(heights, 0), 9e-4 * (1.0 + 1e-5), 1e-3, 900)
    assert (result.status, field.convolutions - before) == (CONVERGED, 1)


def test_contact_at_the_grid_s_edge_is_reported_and_at_the_window_s_edge_is_not():
    field = RollingField(HALF_SPACE)
    assert field.solve_at_load(numpy.roll(BOWL, 20, axis=0), 150.0, 1e-6, 900).status == EDGE
    field.reset()
    assert field.solve_at_load(BOWL, 150.0, 1e-6, 900).status == CONVERGED
    assert field.solve_at_load(BOWL, 600.0, 1e-6, 900).status == CONVERGED


def test_a_gap_of_another_shape_is_refused():
    with pytest.raises(ValueError, match="it must be"):
        RollingField(HALF_SPACE).solve_at_load(BOWL[1:], 1.0, 1e-3, 10)
