"""Traps of pressure-field solvers, requested of every way into the field: static, windowed, rolling; load and approach given."""

import math
from functools import cache

import numpy
import pytest

from contact_sim_lab.field.field_entries import ENTRIES, SolveRequest, holds_load
from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, EDGE, NOT_CONVERGED, refuse_bad_gap
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldEdgeError, FieldError, PressureField

SIDE, CELL, MODULUS = 24, 0.01, 4.0e6
GRID = make_half_space(SIDE, SIDE, CELL, CELL, MODULUS)
X = (numpy.arange(SIDE) - 0.5 * (SIDE - 1)) * CELL
BOWL = X[:, None] ** 2 + X[None, :] ** 2  # a sphere of 0.5 m

every_entry = pytest.mark.parametrize("name", ENTRIES)


@cache
def dense():
    return reference.dense_influence(SIDE, SIDE, CELL, CELL, MODULUS)


@cache
def _exact(gap_bytes, approach):
    gap = numpy.frombuffer(gap_bytes).reshape(SIDE, SIDE)
    pressure = reference.pressure_at_approach(dense(), gap, approach)
    return pressure, float(pressure.sum()) * CELL**2


def exact(gap, approach):
    """Pressure and load by dense non-negative least squares."""
    return _exact(numpy.ascontiguousarray(gap).tobytes(), approach)


def solve(name, gap, load, approach, tolerance=1e-11, cap=3000):
    return ENTRIES[name](GRID, numpy.ascontiguousarray(gap), SolveRequest(load, approach, tolerance, cap))


def must_be_exact(name, gap, approach, status=CONVERGED):
    """The field is that of dense least squares, and what was given comes back."""
    expected, load = exact(gap, approach)
    pressure, result = solve(name, gap, load, approach)
    assert result.status == status
    assert result.load == pytest.approx(load, rel=1e-12 if holds_load(name) else 1e-8)
    assert result.approach == pytest.approx(approach, rel=1e-8)
    numpy.testing.assert_allclose(pressure, expected, atol=2e-7 * expected.max())
    return pressure, result


def true_residual(gap, pressure, approach):
    """The certified number, from the returned field alone, by the dense matrix."""
    displacement = reference.displacement(dense(), pressure)
    clearance = displacement + gap - approach
    penetration = max(0.0, -clearance[pressure == 0.0].min(initial=0.0))
    return (float((pressure * abs(clearance)).sum()) + penetration * pressure.sum()) / float(
        (pressure * displacement).sum()
    )


@every_entry
def test_zero_load_and_no_approach_give_exactly_nothing(name):
    lowest = float(BOWL.min())
    for approach in (lowest, lowest - 1e-12, -1.0):
        pressure, result = solve(name, BOWL, 0.0, approach)
        assert (result.status, result.load) == (CONVERGED, 0.0)
        assert not pressure.any()
    if holds_load(name):
        assert solve(name, BOWL, 0.0, 0.0)[1].approach == lowest


@every_entry
@pytest.mark.parametrize("place", [(10, 13), (2, 21), (22, 1)])
def test_a_one_cell_spike_of_20_mm_carries_its_true_pressure(name, place):
    gap = BOWL.copy()
    gap[place] -= 0.02
    pressure, _result = must_be_exact(name, gap, 0.004)
    assert numpy.unravel_index(pressure.argmax(), pressure.shape) == place


@every_entry
@pytest.mark.parametrize("height", [0.0, -7.0])
def test_a_perfectly_flat_surface_is_the_dense_solution_and_reaches_the_edge(name, height):
    expected = numpy.linalg.solve(dense(), numpy.full(SIDE * SIDE, 1e-3)).reshape(SIDE, SIDE)
    load = float(expected.sum()) * CELL**2
    pressure, result = solve(name, numpy.full((SIDE, SIDE), height), load, height + 1e-3)
    assert result.status == EDGE
    assert result.approach == pytest.approx(height + 1e-3, rel=1e-8)
    numpy.testing.assert_allclose(pressure, expected, rtol=1e-6)


@every_entry
def test_full_contact_of_a_wavy_surface_is_a_plain_linear_solve(name):
    wave = 1e-5 * numpy.cos(0.9 * numpy.arange(SIDE))[:, None] * numpy.cos(0.6 * numpy.arange(SIDE))[None, :]
    expected = numpy.linalg.solve(dense(), (2e-3 - wave).ravel()).reshape(SIDE, SIDE)
    assert expected.min() > 0.0
    pressure, result = solve(name, wave, float(expected.sum()) * CELL**2, 2e-3)
    assert result.status == EDGE
    numpy.testing.assert_allclose(pressure, expected, rtol=1e-6)


@every_entry
@pytest.mark.parametrize("place", [(11, 12), (1, 1), (20, 3)])
def test_one_cell_carries_its_closed_form(name, place):
    gap = numpy.full((SIDE, SIDE), 0.5)
    gap[place] = 0.0
    own = 4.0 * CELL * math.log(1.0 + math.sqrt(2.0)) / (math.pi * MODULUS)
    load = 1e-3 / own * CELL**2
    pressure, result = solve(name, gap, load, 1e-3)
    assert result.status == CONVERGED
    assert numpy.argwhere(pressure).tolist() == [list(place)]
    assert pressure[place] == pytest.approx(1e-3 / own, rel=1e-10)
    assert result.approach == pytest.approx(1e-3, rel=1e-10)


@every_entry
def test_a_sharp_edged_punch_has_its_peaks_in_its_corners(name):
    gap = numpy.full((SIDE, SIDE), 1.0)
    gap[6:17, 8:19] = 0.0
    pressure, _result = must_be_exact(name, gap, 1e-3)
    assert pressure[6, 8] == pytest.approx(pressure.max(), rel=1e-6)
    assert numpy.count_nonzero(pressure) == 11 * 11


@every_entry
@pytest.mark.parametrize("seed", [1, 2])
def test_white_noise_is_solved(name, seed):
    gap = 1e-3 * numpy.random.default_rng(seed).standard_normal((SIDE, SIDE))
    expected, load = exact(gap, 1e-3)
    pressure, result = solve(name, gap, load, 1e-3)
    assert result.status in (CONVERGED, EDGE)
    assert (result.status == EDGE) == bool(
        expected[0].any() or expected[-1].any() or expected[:, 0].any() or expected[:, -1].any()
    )
    numpy.testing.assert_allclose(pressure, expected, atol=2e-7 * expected.max())


@every_entry
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [(0, 0), (12, 12), (23, 5)])
def test_a_height_that_is_not_finite_is_refused_wherever_it_is(name, bad, place):
    gap = BOWL.copy()
    gap[place] = bad
    _pressure, result = solve(name, gap, 100.0, 0.004)
    assert (result.status, result.load) == (BAD_INPUT, 0.0)
    assert math.isnan(result.approach)
    with pytest.raises(ValueError, match=rf"gap: the height of row {place[0]}, column {place[1]} is {bad}"):
        refuse_bad_gap(gap)


@every_entry
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_load_or_approach_that_is_not_finite_is_refused(name, bad):
    pressure, result = solve(name, BOWL, bad, bad)
    assert (result.status, result.load) == (BAD_INPUT, 0.0)
    assert numpy.isfinite(pressure).all()
    if holds_load(name):
        assert solve(name, BOWL, -1.0, 0.0)[1].status == BAD_INPUT


@every_entry
@pytest.mark.parametrize("shift", [(10, 0), (-10, 0), (0, 10), (0, -10)])
def test_contact_at_each_edge_of_the_grid_is_detected(name, shift):
    x, y = X[:, None] - shift[0] * CELL, X[None, :] - shift[1] * CELL
    must_be_exact(name, x**2 + y**2, 0.004, EDGE)


@every_entry
def test_contact_one_cell_from_the_edge_is_not_at_the_edge(name):
    gap = numpy.full((SIDE, SIDE), 1.0)
    gap[1:-1, 1:-1] = 0.0
    must_be_exact(name, gap, 1e-3)


@every_entry
@pytest.mark.parametrize("tolerance", [1e-1, 1e-3, 1e-6])
def test_converged_is_true_of_the_returned_field(name, tolerance):
    gap = BOWL + 1e-3 * numpy.random.default_rng(3).standard_normal((SIDE, SIDE))
    _expected, load = exact(gap, 0.005)
    pressure, result = solve(name, gap, load, 0.005, tolerance)
    assert result.status == CONVERGED
    assert result.residual <= tolerance
    assert true_residual(gap, pressure, result.approach) <= 1.001 * tolerance
    if holds_load(name):
        assert result.load == pytest.approx(load, rel=1e-12)


@every_entry
def test_a_cap_on_the_iterations_is_never_taken_for_convergence(name):
    gap = BOWL + 2e-3 * numpy.random.default_rng(5).standard_normal((SIDE, SIDE))
    _expected, load = exact(gap, 0.005)
    pressure, result = solve(name, gap, load, 0.005, 1e-13, 1)
    assert result.status == NOT_CONVERGED
    assert result.residual > 1e-13
    assert numpy.isfinite(pressure).all()
    assert pressure.min() >= 0.0


@every_entry
def test_only_the_contact_modulus_enters_so_incompressible_is_no_singularity(name):
    expected, load = exact(BOWL, 0.004)
    for poisson in (0.0, 0.49, 0.5):
        modulus = 3e6 / (1.0 - poisson**2)
        half_space = make_half_space(SIDE, SIDE, CELL, CELL, modulus)
        ratio = modulus / MODULUS
        pressure, result = ENTRIES[name](half_space, BOWL, SolveRequest(ratio * load, 0.004, 1e-11))
        assert result.status == CONVERGED
        numpy.testing.assert_allclose(pressure, ratio * expected, atol=2e-7 * ratio * expected.max())


@every_entry
def test_a_contact_of_a_quarter_of_the_box_knows_of_no_images(name):
    cells, radius, semi_axis = 64, 1.0, 0.25  # the box is 1 wide; its images would change load and approach by percents
    half_space = make_half_space(cells, cells, 1 / cells, 1 / cells, 1.0)
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    gap = (x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius)
    load, approach = 4.0 / 3.0 * semi_axis**3 / radius, semi_axis**2 / radius
    _pressure, result = ENTRIES[name](half_space, gap, SolveRequest(load, approach, 1e-8))
    assert result.load == pytest.approx(load, rel=1e-3)
    assert result.approach == pytest.approx(approach, rel=1e-3)


@every_entry
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("level", [2, 4])
def test_a_range_of_curvature_of_a_million_is_solved(name, seed, level):
    random = numpy.random.default_rng(seed)
    gap, inner = BOWL / 1e3, numpy.zeros((SIDE - 2, SIDE - 2))  # a bowl of 2e-3 1/m
    inner.ravel()[random.permutation(inner.size)[:120]] = 10.0 ** random.uniform(-7.0, -1.0, 120)  # spikes to 2e3 1/m
    gap[1:-1, 1:-1] -= inner
    approach = -(10.0**-level)
    expected, load = exact(gap, approach)
    assert numpy.count_nonzero(expected) > 3
    pressure, result = solve(name, gap, load, approach, 1e-10)
    assert result.status == CONVERGED
    numpy.testing.assert_allclose(pressure, expected, atol=1e-6 * expected.max())


@pytest.mark.parametrize("load", [1e-12, 1e-6, 1e6])
def test_tiny_and_huge_loads_are_carried_exactly(load):
    for name in filter(holds_load, ENTRIES):
        pressure, result = solve(name, BOWL, load, 1e-3, 1e-9)
        assert result.status in (CONVERGED, EDGE)
        assert pressure.sum() * CELL**2 == pytest.approx(load, rel=1e-8)


def test_the_field_of_a_run_names_the_cell_that_is_not_finite_and_the_edge():
    field = PressureField(FieldSettings(SIDE, SIDE, CELL, CELL, MODULUS, 1e-6, 500, 0), "tire")
    gap = BOWL.copy()
    gap[3, 17] = math.nan
    for call in (lambda: field.solve(gap, 0.004), lambda: field.solve_load(gap, 50.0)):
        with pytest.raises(FieldError, match=r"tire: .* row 3, column 17"):
            call()
    with pytest.raises(FieldEdgeError, match="edge of the grid"):
        field.solve(BOWL, 0.05)
