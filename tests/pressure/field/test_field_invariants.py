"""What must hold of every pressure field, whatever the gap: random gaps, all ways into the field, dense least squares as judge."""

from functools import cache

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.field.field_entries import ENTRIES, SolveRequest, holds_load
from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import CONVERGED, EDGE
from contact_sim_pkg.pressure.settings import BeltSettings
from contact_sim_pkg.rigs.vehicle.field.envelopment import belt_influence

SIDE, CELLS, MODULUS = 24, (1.0e-3, 1.4e-3), 6.58e6
GRID = make_half_space(SIDE, SIDE, *CELLS, MODULUS)
AREA = CELLS[0] * CELLS[1]
KINDS = ("smooth", "rough", "spiky", "noise", "steps")

every_entry = pytest.mark.parametrize("name", ENTRIES)
examples = settings(max_examples=12)


@cache
def dense():
    return reference.dense_influence(SIDE, SIDE, *CELLS, MODULUS)


def axes(side=SIDE):
    return ((numpy.arange(side) - 0.5 * (side - 1)) * cell for cell in CELLS)


def gap_of(kind, seed, side=SIDE):
    """A gap [m] of one kind: height range of some 0.1 mm over 24 mm x 34 mm."""
    random = numpy.random.default_rng(seed)
    x, y = axes(side)
    bowl = x[:, None] ** 2 / random.uniform(0.1, 1.0) + y[None, :] ** 2 / random.uniform(0.1, 1.0)
    if kind == "smooth":
        return bowl
    if kind == "rough":
        waves = random.uniform(-2000.0, 2000.0, (12, 2))
        phases, heights = random.uniform(0.0, 6.3, 12), random.uniform(0.0, 4e-5, 12)
        terms = zip(waves, phases, heights, strict=True)
        return bowl + sum(h * numpy.cos(a * x[:, None] + b * y[None, :] + c) for (a, b), c, h in terms)
    if kind == "spiky":
        gap = bowl.copy()
        for row, col in random.integers(0, side, (6, 2)):
            gap[row, col] -= 10.0 ** random.uniform(-5.0, -2.5)
        return gap
    if kind == "noise":
        return 2e-4 * random.standard_normal((side, side))
    return bowl + 1e-4 * random.integers(0, 3, (side // 3, side // 3)).repeat(3, axis=0).repeat(3, axis=1)


gaps = st.builds(gap_of, st.sampled_from(KINDS), st.integers(0, 10_000))
shares = st.floats(0.02, 0.9)


def approach_at(gap, share):
    """An approach [m] above the lowest cell, by a share of the range of heights but not beyond 2 mm."""
    lowest = float(gap.min())
    return lowest + share * min(float(gap.max()) - lowest, 2e-3)


def solve(name, gap, load, approach, half_space=GRID, tolerance=1e-11):
    return ENTRIES[name](half_space, numpy.ascontiguousarray(gap), SolveRequest(load, approach, tolerance, 4000))


def load_at(gap, approach, half_space=GRID):
    return solve("static, approach", gap, 0.0, approach, half_space)[1].load


@every_entry
@examples
@given(gap=gaps, share=shares)
def test_signorini_holds_in_every_cell(name, gap, share):
    approach = approach_at(gap, share)
    load = load_at(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    assert result.status in (CONVERGED, EDGE)
    displacement = reference.displacement(dense(), pressure)
    clearance = displacement + gap - result.approach
    height, most = float(displacement.max()), float(pressure.max())
    assert pressure.min() >= 0.0
    assert float(pressure.sum()) * AREA == pytest.approx(result.load, rel=1e-12)
    assert clearance[pressure == 0.0].min(initial=0.0) >= -1e-6 * height, "no cell penetrates"
    assert abs(pressure * clearance).max() <= 1e-6 * most * height, "no cell pushes across a gap"
    if holds_load(name):
        assert abs(result.load / load - 1.0) <= 1e-8


@every_entry
@settings(max_examples=8)
@given(gap=gaps, share=shares)
def test_the_field_is_that_of_dense_least_squares(name, gap, share):
    approach = approach_at(gap, share)
    expected = reference.pressure_at_approach(dense(), gap, approach)
    load = float(expected.sum()) * AREA
    pressure, result = solve(name, gap, load, approach, tolerance=1e-13)
    assert result.load == pytest.approx(load, rel=1e-8)
    assert result.approach - gap.min() == pytest.approx(approach - gap.min(), rel=1e-7)
    numpy.testing.assert_allclose(pressure, expected, atol=1e-6 * expected.max())


@every_entry
@examples
@given(
    kind=st.sampled_from(KINDS), seed=st.integers(0, 10_000), share=shares, move=st.tuples(*[st.integers(-4, 4)] * 2)
)
def test_moving_the_whole_gap_by_whole_cells_moves_the_field(name, kind, seed, share, move):
    inner = gap_of(kind, seed, 12)
    gap = numpy.full((SIDE, SIDE), inner.max() + 0.1)
    gap[6:18, 6:18] = inner
    approach = approach_at(inner, share)
    load = load_at(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    moved, result_moved = solve(name, numpy.roll(gap, move, (0, 1)), load, approach)
    assert result.status == result_moved.status == CONVERGED
    assert result_moved.load == pytest.approx(result.load, rel=1e-9)
    assert result_moved.approach - gap.min() == pytest.approx(result.approach - gap.min(), rel=1e-8)
    numpy.testing.assert_allclose(moved, numpy.roll(pressure, move, (0, 1)), atol=1e-6 * pressure.max())


@every_entry
@examples
@given(gap=gaps, share=shares, factor=st.floats(1e-3, 1e3))
def test_load_and_modulus_scaled_together_scale_the_pressure_and_nothing_else(name, gap, share, factor):
    approach = approach_at(gap, share)
    load = load_at(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    stiffer = make_half_space(SIDE, SIDE, *CELLS, factor * MODULUS)
    scaled, result_scaled = solve(name, gap, factor * load, approach, stiffer)
    assert result_scaled.load == pytest.approx(factor * result.load, rel=1e-8)
    assert result_scaled.approach - gap.min() == pytest.approx(result.approach - gap.min(), rel=1e-7)
    numpy.testing.assert_allclose(scaled, factor * pressure, atol=1e-6 * factor * pressure.max())


@every_entry
@examples
@given(gap=gaps, share=shares, factor=st.floats(1e-3, 1e3))
def test_all_lengths_scaled_together_leave_the_pressure_as_it_is(name, gap, share, factor):
    approach = approach_at(gap, share)
    load = load_at(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    larger = make_half_space(SIDE, SIDE, factor * CELLS[0], factor * CELLS[1], MODULUS)
    scaled, result_scaled = solve(name, factor * gap, factor**2 * load, factor * approach, larger)
    assert result_scaled.load == pytest.approx(factor**2 * result.load, rel=1e-8)
    assert result_scaled.approach == pytest.approx(factor * result.approach, rel=1e-7, abs=1e-9 * factor)
    numpy.testing.assert_allclose(scaled, pressure, atol=1e-6 * pressure.max())


@every_entry
@examples
@given(gap=gaps, share=shares)
def test_a_mirrored_gap_has_the_mirrored_field_and_a_symmetric_one_a_symmetric_field(name, gap, share):
    approach = approach_at(gap, share)
    load = load_at(gap, approach)
    pressure, _result = solve(name, gap, load, approach)
    for mirror in (numpy.flipud, numpy.fliplr):
        mirrored, _result = solve(name, mirror(gap), load, approach)
        numpy.testing.assert_allclose(mirrored, mirror(pressure), atol=1e-6 * pressure.max())
    both = 0.5 * (gap + numpy.flipud(gap))
    symmetric, _result = solve(name, both, load, approach_at(both, share))
    numpy.testing.assert_allclose(symmetric, numpy.flipud(symmetric), atol=1e-6 * symmetric.max())


@every_entry
@examples
@given(gap=gaps, share=shares, lift=st.floats(-10.0, 10.0))
def test_lifting_both_bodies_changes_nothing(name, gap, share, lift):
    approach = approach_at(gap, share)
    load = load_at(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    lifted, result_lifted = solve(name, gap + lift, load, approach + lift)
    assert result_lifted.approach == pytest.approx(result.approach + lift, abs=1e-9 * abs(lift) + 1e-10)
    numpy.testing.assert_allclose(lifted, pressure, atol=1e-5 * pressure.max())


@every_entry
@examples
@given(gap=gaps, first=shares, second=shares)
def test_more_approach_or_load_never_takes_load_or_approach_away(name, gap, first, second):
    low, high = sorted(approach_at(gap, share) for share in (first, second))
    loads = load_at(gap, low), load_at(gap, high)
    results = [solve(name, gap, load, approach)[1] for load, approach in zip(loads, (low, high), strict=True)]
    assert results[1].load >= results[0].load * (1.0 - 1e-9)
    assert results[1].approach >= results[0].approach - 1e-9 * abs(high - gap.min())


@every_entry
@settings(max_examples=8)
@given(gap=gaps, share=shares, softness=st.floats(-2.0, 2.0), length=st.floats(2.0, 200.0))
def test_with_a_belt_in_series_the_field_is_that_of_dense_least_squares(name, gap, share, softness, length):
    """Softness: by powers of ten, of the belt against the half-space; length: relaxation length in cells."""
    foundation = MODULUS * 10.0**-softness * CELLS[1]
    belt = belt_influence(BeltSettings((length * CELLS[0]) ** 2 * foundation, foundation), SIDE, SIDE, *CELLS)
    half_space = make_half_space(SIDE, SIDE, *CELLS, MODULUS, belt)
    row, col = numpy.divmod(numpy.arange(SIDE * SIDE), SIDE)
    influence = dense() + belt[abs(row[:, None] - row), abs(col[:, None] - col)]
    approach = approach_at(gap, share)
    expected = reference.pressure_at_approach(influence, gap, approach)
    load = float(expected.sum()) * AREA
    pressure, result = solve(name, gap, load, approach, half_space)
    assert result.status in (CONVERGED, EDGE)
    assert result.load == pytest.approx(load, rel=1e-6)
    numpy.testing.assert_allclose(pressure, expected, atol=1e-4 * expected.max())
