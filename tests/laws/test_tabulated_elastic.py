"""Elastic law by a table: scipy's PCHIP, its integral, its inverse, and the straight line beyond the last node."""

import math

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from contact_sim_pkg.laws.elastic_law import (
    approach_of_force,
    elastic_energy,
    elastic_force,
    elastic_order,
    elastic_stiffness,
)
from contact_sim_pkg.laws.tabulated_elastic import tabulated_law

NODES = 0.5e-3 * numpy.arange(60)
FORCE = 2e5 * NODES**1.5 + 3e9 * numpy.maximum(NODES - 0.012, 0.0) ** 3
LAW = tabulated_law(0.5e-3, FORCE)
PCHIP = PchipInterpolator(NODES, FORCE)
PLACES = (1e-9, 2e-4, 5e-4, 7.7e-4, 0.0123, 0.0291, 0.0295)


@pytest.mark.parametrize("x", PLACES)
def test_force_stiffness_and_energy_are_those_of_scipys_pchip(x):
    assert elastic_force(LAW, x) == pytest.approx(float(PCHIP(x)), rel=1e-9)
    assert elastic_stiffness(LAW, x) == pytest.approx(float(PCHIP(x, 1)), rel=1e-9)
    assert elastic_energy(LAW, x) == pytest.approx(float(PCHIP.integrate(0.0, x)), rel=1e-9)


@given(st.lists(st.floats(0.0, 1e3), min_size=3, max_size=12))
def test_any_rising_table_is_that_of_scipy_and_never_falls(steps):
    force = numpy.concatenate([[0.0], numpy.cumsum(steps), [sum(steps) + 1.0]])
    law = tabulated_law(0.01, force)
    reference = PchipInterpolator(0.01 * numpy.arange(len(force)), force)
    places = numpy.linspace(1e-6, 0.01 * (len(force) - 1), 57)
    found = numpy.array([elastic_force(law, float(x)) for x in places])
    assert found == pytest.approx(reference(places), rel=1e-9, abs=1e-9 * force[-1])
    assert (numpy.diff(found) >= -1e-12 * force[-1]).all()


def test_beyond_the_last_node_the_slope_stays():
    end = float(NODES[-1])
    slope = float(PCHIP(end, 1))
    assert LAW.reach == pytest.approx(end)
    assert elastic_force(LAW, end + 0.02) == pytest.approx(FORCE[-1] + 0.02 * slope, rel=1e-12)
    assert elastic_stiffness(LAW, end + 0.02) == pytest.approx(slope, rel=1e-12)
    stored = float(PCHIP.integrate(0.0, end)) + 0.02 * FORCE[-1] + 0.5 * slope * 0.02**2
    assert elastic_energy(LAW, end + 0.02) == pytest.approx(stored, rel=1e-9)


@given(st.floats(1e-6, 1e4))
def test_the_approach_of_a_force_has_that_force(force):
    assert elastic_force(LAW, approach_of_force(LAW, force)) == pytest.approx(force, rel=1e-12)


def test_there_is_no_force_without_contact():
    for part in (elastic_force, elastic_stiffness, elastic_energy):
        assert part(LAW, 0.0) == part(LAW, -1.0) == 0.0
    assert approach_of_force(LAW, 0.0) == 0.0


def test_the_order_is_the_power_with_which_the_force_begins():
    linear = tabulated_law(0.1, numpy.array([0.0, 1.0, 2.0]))
    square = tabulated_law(0.1, numpy.array([0.0, 0.1, 10.0]))
    for law in (linear, square):
        ratio = math.log2(elastic_force(law, 2e-9) / elastic_force(law, 1e-9))
        assert elastic_order(law) == pytest.approx(ratio, rel=1e-6)


def test_a_table_that_is_no_law_is_refused():
    for force in ([0.0, 1.0], [1.0, 2.0, 3.0], [0.0, 2.0, 1.0], [0.0, 1.0, 1.0], [0.0, math.nan, 1.0]):
        with pytest.raises(ValueError, match="is needed"):
            tabulated_law(0.1, numpy.array(force))
    with pytest.raises(ValueError, match="spacing"):
        tabulated_law(0.0, FORCE)
