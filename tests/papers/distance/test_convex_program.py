"""Interior points against scipy's linear programs and a closed form."""

from __future__ import annotations

import math

import numpy
import pytest
import scipy.optimize

from contact_sim_lab.papers.distance.convex_program import Program, minimise


def linear_program(cost: numpy.ndarray, rows: numpy.ndarray, bounds: numpy.ndarray) -> Program:
    size = cost.size
    none = numpy.zeros((0, size))
    return Program(
        numpy.zeros((size, size)), cost, rows, bounds, numpy.zeros((0, size, size)), none, none, numpy.zeros(0)
    )


@pytest.mark.parametrize("seed", range(8))
def test_linear_programs_have_the_cost_of_scipy_s(seed: int) -> None:
    random = numpy.random.default_rng(seed)
    rows = random.standard_normal((40, 4))
    rows = numpy.concatenate([rows, numpy.eye(4), -numpy.eye(4)])
    bounds = numpy.concatenate([random.uniform(0.5, 2.0, 40), numpy.full(8, 3.0)])
    cost = random.standard_normal(4)
    found = minimise(linear_program(cost, rows, bounds), numpy.zeros(4), 1e-12)
    expected = scipy.optimize.linprog(cost, A_ub=rows, b_ub=bounds, bounds=[(None, None)] * 4)
    assert cost @ found.unknowns == pytest.approx(expected.fun, abs=1e-10)
    assert (rows @ found.unknowns <= bounds).all()
    assert abs(cost + found.multipliers @ rows).max() < 2e-9
    assert found.gap <= 1e-11


def test_a_linear_cost_on_a_sphere_ends_opposite_to_it() -> None:
    cost = numpy.array([1.0, -2.0, 2.0])
    none = numpy.zeros((0, 3))
    program = Program(
        numpy.zeros((3, 3)), cost, none, numpy.zeros(0), numpy.eye(3)[None] * 0.25, numpy.ones((1, 3)), numpy.zeros((1, 3)),
        numpy.ones(1),
    )  # fmt: skip
    found = minimise(program, numpy.ones(3), 1e-13)
    assert found.unknowns == pytest.approx(1.0 - 2.0 * cost / 3.0, abs=1e-7)
    assert cost @ found.unknowns == pytest.approx(1.0 - 6.0, abs=1e-12)


def test_a_start_on_a_constraint_comes_back_with_an_infinite_gap() -> None:
    program = linear_program(numpy.ones(2), -numpy.eye(2), numpy.zeros(2))
    found = minimise(program, numpy.array([1.0, 0.0]), 1e-9)
    assert (found.unknowns.tolist(), found.gap, found.steps) == ([1.0, 0.0], math.inf, 0)
