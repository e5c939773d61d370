"""Stated domains of the closed formulas of an impact, for their property tests."""

import math

import pytest
from hypothesis import strategies as st
from tests.properties import positive

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere

FORM = st.sampled_from(["corrected", "printed"])
MODULUS, TIME, LENGTH = positive(1e3, 1e12), positive(1e-6, 1e4), positive(1e-5, 10.0)
SPEED, FREQUENCY, MASS = positive(1e-4, 100.0), positive(1e-2, 1e6), positive(1e-6, 1e3)
LOSS = st.one_of(st.just(0.0), positive(1e-9, 50.0))
SHAPE = st.floats(1.0, math.sqrt(2.0))
POISSON = st.floats(-0.99, 0.5)
MATERIAL, SPHERE = st.builds(Material, MODULUS, LOSS), st.builds(Sphere, MASS, LENGTH)
COMPLEX = st.builds(lambda size, part: complex(size, part * size), MODULUS, st.floats(0.0, 2.0))


def near(expected: float) -> object:
    return pytest.approx(expected, rel=1e-12)
