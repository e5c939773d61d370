"""Tissue between body and seat: springs in series, a plate in closed form, maps that add up to the force."""

import numpy
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from tests.pressure.cushion.cushions import PAN, pan_layer

from contact_sim_pkg.laws.elastic_law import elastic_energy, elastic_force
from contact_sim_pkg.pressure.cushion import VALID_STRAIN
from contact_sim_pkg.pressure.cushion.foam_layer import CushionError, FoamGrid
from contact_sim_pkg.pressure.cushion.force_table import at_load, make_table
from contact_sim_pkg.pressure.cushion.tissue import PlateUnderTissue, Tissue, TissueOnFoam, form_without_load

SMALL = FoamGrid(20, 16, 0.02, 0.02)
A, C0 = 2.0e3, 0.01
TISSUE = Tissue(A, C0)
FIRM = PAN._replace(thickness=0.04, modulus=1.1e5, plateau=8.4e3, densification=200.0)


def stress(foam, strain):
    """Stress [Pa] of an even load, by the formula of models.md."""
    ratio, a = 1.0 - strain, foam.modulus / foam.plateau
    soft = foam.plateau * (1.0 / ratio - ratio ** (a - 1.0))
    return soft + foam.densification * (ratio ** (-foam.densification_exponent - 1.0) - 1.0 / ratio)


def sphere(radius):
    x, y = ((numpy.arange(n) - 0.5 * (n - 1)) * 0.02 for n in (SMALL.rows, SMALL.cols))
    return (x[:, None] ** 2 + y[None, :] ** 2) / (2.0 * radius)


@pytest.fixture(scope="module")
def person():
    """Median body on firm foam under tissue, and its form without load."""
    default = pan_layer()
    reference = at_load(default, 559.0)
    form = form_without_load(default.gap, TISSUE, reference.pressure)
    return default, reference, form


@pytest.mark.parametrize("approach", [0.001, 0.02, 0.05, 0.07])
@pytest.mark.parametrize("share", [0.0, 0.3])
def test_an_even_load_is_two_springs_in_series(approach, share):
    layer = TissueOnFoam(SMALL, FIRM, numpy.zeros((20, 16)), TISSUE, share)
    found = layer.solve(approach)

    def beyond(w):
        return stress(FIRM, w / FIRM.thickness) - A * numpy.expm1((approach - w) / C0)

    w = brentq(beyond, 0.0, min(approach, 0.99 * FIRM.thickness), xtol=1e-15)
    assert found.deflection == pytest.approx(w, rel=1e-8)
    assert found.pressure == pytest.approx(stress(FIRM, w / FIRM.thickness), rel=1e-7)
    assert found.force == pytest.approx(found.pressure[0, 0] * 320 * 4e-4, rel=1e-12)


def test_small_loads_add_the_compliances():
    layer = TissueOnFoam(SMALL, FIRM, numpy.zeros((20, 16)), TISSUE, 0.0)
    found = layer.solve(1e-7)
    first = FIRM.modulus + FIRM.densification_exponent * FIRM.densification  # slope of `stress` at 0
    stiffness = 320 * 4e-4 / (FIRM.thickness / first + C0 / A)
    assert found.force == pytest.approx(stiffness * 1e-7, rel=1e-4)
    assert layer.tangent(found) == pytest.approx(stiffness, rel=1e-4)


def test_a_sphere_on_a_plate_is_its_integral():
    """∫ A (exp((δ − r²/2R)/c₀) − 1) 2πr dr over r² < 2Rδ is 2πRA (c₀ (exp(δ/c₀) − 1) − δ)."""
    x = (numpy.arange(400) - 199.5) * 1e-3
    plate = PlateUnderTissue(FoamGrid(400, 400, 1e-3, 1e-3), (x[:, None] ** 2 + x[None, :] ** 2) / 0.4, TISSUE)
    for approach in (0.01, 0.03):
        exact = 2.0 * numpy.pi * 0.2 * A * (C0 * numpy.expm1(approach / C0) - approach)
        found = plate.solve(approach)
        assert found.force == pytest.approx(exact, rel=2e-4)
        assert found.pressure.max() == pytest.approx(A * numpy.expm1(approach / C0), rel=1e-3)
        assert plate.tangent(found) == pytest.approx(2.0 * numpy.pi * 0.2 * A * numpy.expm1(approach / C0), rel=1e-3)
    assert plate.solve(-0.01).force == 0.0


def test_ever_harder_foam_is_the_plate():
    gap, differences = sphere(0.2), []
    exact = PlateUnderTissue(SMALL, gap, TISSUE).solve(0.02)
    for factor in (10.0, 100.0, 1000.0):
        foam = FIRM._replace(modulus=factor * 1.1e5, plateau=factor * 8.4e3, densification=factor * 200.0)
        found = TissueOnFoam(SMALL, foam, gap, TISSUE).solve(0.02)
        differences.append(abs(found.force / exact.force - 1.0))
    assert differences == sorted(differences, reverse=True)
    assert differences[-1] < 3e-3


def test_ever_harder_tissue_is_the_rigid_body():
    layer = pan_layer(cell=0.02)
    exact = layer.solve(0.03)
    stiff = TissueOnFoam(layer.grid, PAN, layer.gap, Tissue(1e7, 0.01))
    found = stiff.solve(0.03)
    assert found.force == pytest.approx(exact.force, rel=1e-3)
    assert numpy.abs(found.pressure - exact.pressure).max() < 0.01 * exact.pressure.max()


def test_on_the_reference_the_map_is_the_reference(person):
    default, reference, form = person
    layer = TissueOnFoam(default.grid, PAN, form, TISSUE)
    found = at_load(layer, 559.0)
    assert numpy.abs(found.pressure - reference.pressure).max() < 2e-4 * reference.pressure.max()


@pytest.mark.parametrize("load", [100.0, 559.0, 900.0])
def test_force_is_the_slope_of_the_energy_and_both_sides_see_one_pressure(person, load):
    default, _reference, form = person
    layer = TissueOnFoam(default.grid, FIRM, form, TISSUE)
    found = at_load(layer, load)
    assert found.force == pytest.approx(load, rel=2e-4)
    ends = [layer.solve(found.approach + d, found) for d in (-1e-5, 1e-5)]
    assert (layer.energy(ends[1]) - layer.energy(ends[0])) / 2e-5 == pytest.approx(found.force, rel=1e-5)
    assert (ends[1].force - ends[0].force) / 2e-5 == pytest.approx(layer.tangent(found), rel=1e-4)
    overlap = found.approach - form - found.deflection
    assert found.pressure == pytest.approx(A * numpy.expm1(numpy.maximum(overlap, 0.0) / C0), rel=1e-9, abs=1e-9)
    assert found.pressure.min() >= 0.0


@pytest.mark.parametrize("kind", ["plate", "firm"])
def test_maps_of_the_table_add_up_to_the_force(person, kind):
    default, _reference, form = person
    layer = (
        PlateUnderTissue(default.grid, form, TISSUE)
        if kind == "plate"
        else TissueOnFoam(default.grid, FIRM, form, TISSUE)
    )
    table = make_table(layer)
    law = table.law()
    assert (numpy.diff(table.force) > 0.0).all()
    for approach in (0.00123, 0.0207, 0.0399, law.reach, 1.2 * law.reach):
        force = elastic_force(law, approach)
        pressure = table.map_at(approach, force)
        assert pressure.min() >= 0.0
        assert pressure.sum() * table.cell_area == pytest.approx(force, rel=1e-12)
    for approach in (0.02025, 0.03525):
        found = layer.solve(approach)
        assert elastic_force(law, approach) == pytest.approx(found.force, rel=2e-3)
        assert elastic_energy(law, approach) == pytest.approx(layer.energy(found), rel=3e-3)
    assert table.most_force() > 1200.0
    assert (table.largest_strain.max() > VALID_STRAIN) == (kind == "firm")


def test_the_energy_of_a_column_is_the_integral_of_its_pressure():
    for compression in (-0.01, 0.0, 0.004, 0.03):
        exact = quad(lambda c: float(TISSUE.pressure_at(numpy.array(c))), 0.0, max(compression, 0.0))[0]
        assert TISSUE.energy_at(numpy.array(compression)) == pytest.approx(exact, rel=1e-9, abs=1e-15)
    pressure = numpy.array([0.0, 1.0, 5e3, 1e5])
    assert TISSUE.pressure_at(TISSUE.compression_at(pressure)) == pytest.approx(pressure, rel=1e-12)


def test_tissue_flattens_the_map_of_a_hard_seat(person):
    """Hard plate under 600 N and office chair under 546 N, means ± two standard deviations of what was published."""
    default, _reference, form = person
    cell = default.grid.cell_area
    plate = at_load(PlateUnderTissue(default.grid, form, TISSUE), 600.0).pressure
    chair = at_load(TissueOnFoam(default.grid, FIRM, form, TISSUE), 546.0).pressure
    for pressure, area, mean in ((plate, (667e-4, 993e-4), (5.8e3, 9.2e3)), (chair, (754e-4, 984e-4), (5.6e3, 7.0e3))):
        loaded = pressure[pressure > 500.0]
        assert area[0] < len(loaded) * cell < area[1]
        assert mean[0] < loaded.mean() < mean[1]
    # Over the tuberosities of people who sit nearly half of 74 ± 9 mm goes (MRI).
    assert 0.028 < TISSUE.compression_at(plate).max() < 0.042


def test_values_outside_the_range_are_refused(person):
    default, _reference, form = person
    with pytest.raises(ValueError, match="pressure"):
        PlateUnderTissue(default.grid, form, Tissue(0.0, 0.01))
    with pytest.raises(ValueError, match="reference map"):
        form_without_load(form, TISSUE, -numpy.ones_like(form))
    with pytest.raises(CushionError, match="more than the cushion carries"):
        at_load(PlateUnderTissue(default.grid, form, TISSUE), 1e5)
    with pytest.raises(CushionError, match="edge"):
        TissueOnFoam(SMALL, FIRM, sphere(0.5), TISSUE).solve(0.03)
