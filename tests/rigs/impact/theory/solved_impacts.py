"""Impacts that have a solution with either end rule, for property tests."""

from hypothesis import strategies as st
from tests.properties import positive

from contact_sim_pkg.rigs.impact.theory import motion
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere

END = st.sampled_from(["force", "gap"])
LOSS = st.just(0.0) | positive(1e-6, 0.39)
SPHERE = st.builds(Sphere, positive(1e-3, 10.0), positive(0.05, 1.0))
MATERIAL = st.builds(Material, positive(1e7, 1e10), LOSS)
SPEED = positive(1e-2, 3.0)
IMPACT = st.builds(motion.solve_impact, SPHERE, MATERIAL, SPEED, END, st.sampled_from(["small", "iterate"]))
