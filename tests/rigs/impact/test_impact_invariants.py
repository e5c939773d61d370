"""Powers of speed and modulus of the sphere's impact, and what its restitution does not depend on, over wide ranges."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import fold
from contact_sim_pkg.rigs.impact.theory.inverse import material_of_impact
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact

FAST = settings(max_examples=150)
MASSES, RADII, MODULI = st.floats(1e-6, 1e3), st.floats(1e-4, 10.0), st.floats(1e3, 1e12)
TANGENTS, SPEEDS, ENDS = st.floats(0.0, 5.0), st.floats(1e-6, 1e3), st.sampled_from(("force", "gap"))


def impact(mass, radius, modulus, loss_tangent, speed, end):
    """The solved impact; cases deeper than the radius or above the fold, which are refused, are none."""
    assume(end == "force" or loss_tangent < fold()[1])
    elastic = (1.25 * mass * speed**2 / (1.8856 * modulus * radius**0.5)) ** 0.4
    assume(elastic < 0.9 * radius)
    return solve_impact(Sphere(mass, radius), Material(modulus, loss_tangent), speed, end)


@FAST
@given(MASSES, RADII, MODULI, TANGENTS, SPEEDS, st.floats(1e-6, 1.0), ENDS)
def test_powers_of_the_impact_speed(mass, radius, modulus, loss_tangent, speed, ratio, end):
    fast = impact(mass, radius, modulus, loss_tangent, speed, end)
    slow = impact(mass, radius, modulus, loss_tangent, ratio * speed, end)
    assert slow.restitution == pytest.approx(fast.restitution, rel=1e-9)
    assert slow.depth == pytest.approx(ratio**0.8 * fast.depth, rel=1e-9)
    assert slow.duration == pytest.approx(ratio**-0.2 * fast.duration, rel=1e-9)
    assert slow.peak_force == pytest.approx(ratio**1.2 * fast.peak_force, rel=1e-9)


@FAST
@given(MASSES, RADII, MODULI, TANGENTS, SPEEDS, st.floats(1.0, 1e6), ENDS)
def test_powers_of_the_storage_modulus(mass, radius, modulus, loss_tangent, speed, ratio, end):
    soft = impact(mass, radius, modulus, loss_tangent, speed, end)
    stiff = impact(mass, radius, ratio * modulus, loss_tangent, speed, end)
    double = impact(mass, radius, 2.0 * modulus, loss_tangent, speed, end)
    assert double.duration == pytest.approx(2.0**-0.4 * soft.duration, rel=1e-9)
    assert stiff.duration == pytest.approx(ratio**-0.4 * soft.duration, rel=1e-9)
    assert stiff.depth == pytest.approx(ratio**-0.4 * soft.depth, rel=1e-9)
    assert stiff.restitution == pytest.approx(soft.restitution, rel=1e-9)


@FAST
@given(MASSES, RADII, MODULI, TANGENTS, SPEEDS, st.floats(0.5, 2.0), st.floats(0.5, 2.0), ENDS)
def test_powers_of_mass_and_radius(mass, radius, modulus, loss_tangent, speed, heavier, larger, end):
    one = impact(mass, radius, modulus, loss_tangent, speed, end)
    other = impact(heavier * mass, larger * radius, modulus, loss_tangent, speed, end)
    length = heavier**0.4 * larger**-0.2
    assert other.restitution == pytest.approx(one.restitution, rel=1e-9)
    assert other.depth == pytest.approx(length * one.depth, rel=1e-9)
    assert other.duration == pytest.approx(length * one.duration, rel=1e-9)


@FAST
@given(MASSES, RADII, MODULI, st.floats(1e-3, 5.0), SPEEDS, ENDS)
def test_the_material_comes_back_from_its_impact(mass, radius, modulus, loss_tangent, speed, end):
    found = impact(mass, radius, modulus, loss_tangent, speed, end)
    assume(end == "force" or loss_tangent < 0.99 * fold()[1])
    back = material_of_impact(found.sphere, speed, found.duration, found.restitution, end)
    assert back.storage_modulus == pytest.approx(modulus, rel=1e-9)
    assert back.loss_tangent == pytest.approx(loss_tangent, rel=1e-9)
