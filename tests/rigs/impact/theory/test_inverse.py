"""The material of a measured impact: published example, round trips, what closed forms give instead."""

import math

import pytest

from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.inverse import material_of_impact
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact

SPHERE = Sphere(0.02, 0.01)


@pytest.mark.parametrize(
    ("end", "form", "modulus", "loss_tangent"),
    [
        ("force", "exact", 3.7948e7, 0.11431), ("gap", "exact", 4.9000e7, 0.09920),
        ("force", "corrected", 1.0790e8, 0.18480), ("force", "printed", 1.0790e8 * 5.03 / 5.3033, 0.18480),
    ],
)  # fmt: skip
def test_the_published_example_comes_out(end, form, modulus, loss_tangent):
    found = material_of_impact(SPHERE, 2.0, 1e-3, 0.7, end, form)
    assert found.storage_modulus == pytest.approx(modulus, rel=2e-5)
    assert found.loss_tangent == pytest.approx(loss_tangent, abs=5e-6)


@pytest.mark.parametrize("loss_tangent", [0.0, 1e-4, 0.05, 0.2, 0.39, 1.0, 3.0])
@pytest.mark.parametrize("shape", ["small", "iterate"])
@pytest.mark.parametrize("end", ["force", "gap"])
def test_a_simulated_impact_gives_its_material_back(loss_tangent, shape, end):
    if end == "gap" and loss_tangent > 0.4:
        return
    impact = solve_impact(SPHERE, Material(8e6, loss_tangent), 2.0, end, shape)
    found = material_of_impact(SPHERE, 2.0, impact.duration, impact.restitution, end, shape=shape)
    assert found.storage_modulus == pytest.approx(8e6, rel=1e-10)
    assert found.loss_tangent == pytest.approx(loss_tangent, rel=1e-9, abs=1e-14)


def test_the_slow_reference_gives_its_material_back():
    scaled = goloshchapov.impact(goloshchapov.severity(0.3, "force"), "force")
    coefficient = 4 / 3 * math.sqrt(2.0) * 5e6 * math.sqrt(SPHERE.radius)
    length = (SPHERE.mass * 1.5**2 / coefficient) ** 0.4
    found = material_of_impact(SPHERE, 1.5, scaled.duration * length / 1.5, scaled.restitution)
    assert found.storage_modulus == pytest.approx(5e6, rel=1e-8)
    assert found.loss_tangent == pytest.approx(0.3, rel=1e-8)


def test_without_loss_the_corrected_closed_form_gives_2_15_times_the_modulus():
    impact = solve_impact(SPHERE, Material(8e6, 0.0), 2.0)
    exact = material_of_impact(SPHERE, 2.0, impact.duration, 1.0)
    closed = material_of_impact(SPHERE, 2.0, impact.duration, 1.0, form="corrected")
    assert exact.storage_modulus == pytest.approx(8e6, rel=1e-14)
    assert closed.storage_modulus / 8e6 == pytest.approx(2.15, abs=5e-3)
    group = SPHERE.mass / (math.sqrt(2.0) * math.sqrt(2.0 * SPHERE.radius) * impact.duration**2.5)
    assert exact.storage_modulus / group == pytest.approx(13.93, abs=5e-3)
    assert closed.storage_modulus / group == pytest.approx(30.0, abs=5e-3)


@pytest.mark.parametrize("restitution", [0.0, -0.2, 1.2, 1e-5])
def test_a_restitution_without_a_material_is_refused(restitution):
    with pytest.raises(ImpactError, match="restitution"):
        material_of_impact(SPHERE, 2.0, 1e-3, restitution)


def test_a_contact_so_long_that_the_sphere_would_sink_in_is_refused():
    with pytest.raises(ImpactError, match="depth over radius"):
        material_of_impact(SPHERE, 2.0, 0.1, 0.7)


def test_another_form_is_refused_by_its_name():
    with pytest.raises(ValueError, match="form 'best'"):
        material_of_impact(SPHERE, 2.0, 1e-3, 0.7, form="best")
