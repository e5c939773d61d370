"""The traps of pressure-field solvers, requested of the periodic field; its judge is a dense matrix summed from cosines."""

import math
from functools import cache

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.field.field_entries import ENTRIES, SolveRequest
from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.periodic import PeriodicField, make_periodic_half_space
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, NOT_CONVERGED

SIDE, CELLS, MODULUS = 24, (1.0e-3, 1.4e-3), 6.58e6
AREA = CELLS[0] * CELLS[1]


@cache
def dense():
    """`K = sum over q of 2 cos(q (x - x')) / (E* |q| N)` and a constant, which a given load does not feel."""
    row, col = numpy.divmod(numpy.arange(SIDE * SIDE), SIDE)
    table = numpy.zeros((SIDE, SIDE))
    for a in range(SIDE):
        for b in range(SIDE):
            signed = [n if n <= SIDE // 2 else n - SIDE for n in (a, b)]
            wave = 2.0 * math.pi * math.hypot(signed[0] / (SIDE * CELLS[0]), signed[1] / (SIDE * CELLS[1]))
            phase = 2.0 * math.pi / SIDE * (a * numpy.arange(SIDE)[:, None] + b * numpy.arange(SIDE)[None, :])
            table += 2.0 / (MODULUS * wave * SIDE**2) * numpy.cos(phase) if wave > 0.0 else 0.0
    table += 0.2 * table[0, 0]
    return table[(row[:, None] - row) % SIDE, (col[:, None] - col) % SIDE]


def exact(gap, approach):
    """Pressure of a load, and the load, by dense least squares; approach: in the sense of the matrix with its constant."""
    pressure = reference.pressure_at_approach(dense(), gap, approach)
    return pressure, float(pressure.sum()) * AREA


def solve(gap, load, tolerance=1e-11, cap=3000):
    field = PeriodicField(make_periodic_half_space(SIDE, SIDE, *CELLS, MODULUS))
    result = field.solve_at_load(numpy.ascontiguousarray(gap), load, tolerance, cap)
    return field.pressure, result


def noise(seed=1, height=2e-4):
    return height * numpy.random.default_rng(seed).standard_normal((SIDE, SIDE))


def must_be_exact(gap, approach):
    expected, load = exact(gap, approach)
    pressure, result = solve(gap, load)
    assert result.status == CONVERGED
    assert result.load == pytest.approx(load, rel=1e-12)
    numpy.testing.assert_allclose(pressure, expected, atol=1e-6 * expected.max())
    return pressure


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.floats(-6.0, -3.0), st.floats(0.05, 0.95), st.booleans())
def test_the_field_is_that_of_dense_least_squares(seed, height, share, spiky):
    gap = noise(seed, 10.0**height)
    if spiky:
        gap[seed % SIDE, seed % 7] -= 5e-3
    low = float(gap.min())
    must_be_exact(gap, low + share * min(float(gap.max()) - low, 1e-3))


def test_zero_load_gives_zero_force_at_first_touch():
    gap = noise()
    pressure, result = solve(gap, 0.0)
    assert (result.status, result.load, result.approach) == (CONVERGED, 0.0, gap.min())
    assert not pressure.any()


def test_a_perfectly_flat_surface_carries_a_level_pressure():
    pressure, result = solve(numpy.full((SIDE, SIDE), 0.3), 50.0)
    assert result.status == CONVERGED
    numpy.testing.assert_allclose(pressure, 50.0 / (SIDE**2 * AREA), rtol=1e-9)


def test_a_one_cell_spike_of_20_mm_and_a_single_cell_carry_all():
    gap = noise()
    gap[3, 20] -= 0.02
    pressure, result = solve(gap, 1e-3)
    assert result.status == CONVERGED
    assert numpy.argwhere(pressure).tolist() == [[3, 20]]
    assert pressure[3, 20] * AREA == pytest.approx(1e-3, rel=1e-12)


def test_a_sharp_edged_punch_across_the_seam_of_the_period():
    gap = numpy.full((SIDE, SIDE), 1.0)
    gap[:8, :9] = 0.0
    pressure = must_be_exact(gap, 1e-3)
    seam = must_be_exact(numpy.roll(gap, (-4, -4), (0, 1)), 1e-3)
    numpy.testing.assert_allclose(numpy.roll(seam, (4, 4), (0, 1)), pressure, atol=1e-6 * pressure.max())


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_refused(bad):
    gap = noise()
    gap[23, 5] = bad
    assert solve(gap, 1.0)[1].status == BAD_INPUT
    assert solve(noise(), bad)[1].status == BAD_INPUT
    assert solve(noise(), -1.0)[1].status == BAD_INPUT


def test_a_cap_is_never_taken_for_convergence():
    assert solve(noise(), 5.0, 1e-13, 1)[1].status == NOT_CONVERGED


def test_images_cost_percents_at_a_contact_of_a_quarter_of_the_box_and_a_free_boundary_does_not():
    cells, semi_axis = 128, 0.25
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    gap = 0.5 * (x[:, None] ** 2 + x[None, :] ** 2)
    load = 4.0 / 3.0 * semi_axis**3  # E* = R = 1
    hertz = 2.0 * semi_axis / math.pi * numpy.sqrt(numpy.maximum(1.0 - 2.0 * gap / semi_axis**2, 0.0))
    periodic = PeriodicField(make_periodic_half_space(cells, cells, 1 / cells, 1 / cells, 1.0))
    assert periodic.solve_at_load(gap, load, 1e-8, 2000).status == CONVERGED
    half_space = make_half_space(cells, cells, 1 / cells, 1 / cells, 1.0)
    free, _result = ENTRIES["static, load"](half_space, gap, SolveRequest(load, 0.0, 1e-8))
    images, alone = (numpy.linalg.norm(p - hertz) / numpy.linalg.norm(hertz) for p in (periodic.pressure, free))
    assert images == pytest.approx(0.034, rel=0.15)
    assert alone < 0.01
