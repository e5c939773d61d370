"""Foam layer under a body: limits in closed form, an independent minimiser, energy and stiffness by differences."""

import mpmath
import numpy
import pytest
from scipy.optimize import minimize
from tests.pressure.cushion.cushions import PAN, pan_layer
from tests.pressure.cushion.test_bonded_layer import navier_influence

from contact_sim_pkg.laws.parameters import FoamCurve, FoamElastic
from contact_sim_pkg.pressure.cushion.foam_layer import CushionError, FoamGrid, FoamLayer

SMALL = FoamGrid(20, 16, 0.02, 0.02)
FIRST_MODULUS = PAN.modulus + PAN.densification_exponent * PAN.densification


def stress(foam, strain):
    l, a, r = 1 - strain, foam.modulus / foam.plateau, foam.densification_exponent  # noqa: E741
    return foam.plateau * (1 / l - l ** (a - 1)) + foam.densification * (l ** (-r - 1) - 1 / l)


def sphere_gap(grid, radius):
    x = (numpy.arange(grid.rows) - 0.5 * grid.rows) * grid.cell_x
    y = (numpy.arange(grid.cols) - 0.5 * grid.cols) * grid.cell_y
    return (x[:, None] ** 2 + y**2) / 2 / radius


@pytest.mark.parametrize("shear_share", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("strain", [0.02, 0.25, 0.65])
def test_an_even_load_has_the_stress_of_the_foam(strain, shear_share):
    layer = FoamLayer(SMALL, PAN, numpy.zeros((20, 16)), shear_share)
    found = layer.solve(strain * PAN.thickness)
    assert found.pressure == pytest.approx(float(stress(PAN, mpmath.mpf(strain))), rel=1e-10)


@pytest.mark.parametrize("shear_share", [0.0, 0.3])
def test_an_even_load_follows_a_measured_curve(shear_share):
    strain, measured = (0.05, 0.15, 0.3, 0.5, 0.6), (1500.0, 2600.0, 3300.0, 5100.0, 8000.0)
    layer = FoamLayer(SMALL, FoamCurve(0.06, strain, measured), numpy.zeros((20, 16)), shear_share)
    for place, expected in zip(strain, measured, strict=True):
        assert layer.solve(place * 0.06).pressure == pytest.approx(expected, rel=1e-10)


def test_a_curve_of_the_formula_carries_as_the_formula():
    """Sampled at every percent of strain: the monotone cubic is within 2e-5 of the closed form from 3 % on."""
    gap, strain = sphere_gap(SMALL, 0.1), 0.01 * numpy.arange(1, 71)
    curve = FoamCurve(PAN.thickness, tuple(strain), tuple(stress(PAN, strain)))
    for approach in (0.01, 0.03, 0.04):
        expected = FoamLayer(SMALL, PAN, gap).solve(approach).force
        assert FoamLayer(SMALL, curve, gap).solve(approach).force == pytest.approx(expected, rel=1e-3)
    columns = numpy.maximum(0.04 - gap, 0.0) / PAN.thickness
    alone = FoamLayer(SMALL, curve, gap, 0.0).solve(0.04)
    assert alone.force == pytest.approx(stress(PAN, columns).sum() * SMALL.cell_area, rel=1e-4)


def test_without_shear_each_cell_is_a_column():
    gap = sphere_gap(SMALL, 0.1)
    found = FoamLayer(SMALL, PAN, gap, 0.0).solve(0.03)
    expected = stress(PAN, numpy.maximum(0.03 - gap, 0.0) / PAN.thickness)
    assert found.pressure == pytest.approx(expected, rel=1e-12, abs=1e-9)
    assert found.force == pytest.approx(expected.sum() * 4e-4, rel=1e-12)


def test_the_solution_is_the_least_energy_that_an_independent_minimiser_finds():
    """Dense remainder from the Navier equations, energy by its formula, scipy's bounded minimiser."""
    gap, approach, share, h = sphere_gap(SMALL, 0.15), 0.03, 0.6, PAN.thickness
    q = numpy.hypot(*numpy.meshgrid(*(2 * numpy.pi * numpy.fft.fftfreq(n, 0.02) for n in (20, 16)), indexing="ij"))
    # The remainder does not know the modulus that the reference was made with, only its ratio.
    ratio = FIRST_MODULUS / 5.0e4
    transform = [0.0 if k == 0.0 else ratio / navier_influence(k, 0.0, False) - FIRST_MODULUS / h for k in q.ravel()]
    remainder = share * numpy.reshape(transform, q.shape)

    def energy(e):
        e = e.reshape(gap.shape)
        w = e * h
        l, a, r = 1 - numpy.maximum(e, 0.0), PAN.modulus / PAN.plateau, PAN.densification_exponent  # noqa: E741
        foam = PAN.plateau * (-numpy.log(l) - (1 - l**a) / a) + PAN.densification * ((l**-r - 1) / r + numpy.log(l))
        foam = numpy.where(e > 0, foam, FIRST_MODULUS / 2 * e**2)
        spread = numpy.fft.ifft2(remainder * numpy.fft.fft2(w)).real
        slope = numpy.where(e > 0, stress(PAN, numpy.maximum(e, 0.0)), FIRST_MODULUS * e) + spread
        return (h * foam + w * spread / 2).sum(), h * slope.ravel()

    bound = (approach - gap).ravel() / h
    start = numpy.maximum(bound, 0.0)
    least = minimize(
        energy, start, jac=True, method="L-BFGS-B", bounds=[(b, 0.9) for b in bound],
        options={"maxiter": 20000, "maxfun": 100000, "ftol": 1e-16, "gtol": 1e-9},
    )  # fmt: skip
    layer = FoamLayer(SMALL, PAN, gap, share)
    found = layer.solve(approach)
    assert found.deflection.ravel() == pytest.approx(h * least.x, abs=1e-7)
    assert layer.energy(found) == pytest.approx(least.fun * 4e-4, rel=1e-8)


@pytest.mark.parametrize("approach", [0.004, 0.02, 0.04, 0.06])
def test_pressure_and_gap_exclude_each_other(approach):
    layer = pan_layer()
    found = layer.solve(approach)
    off = found.deflection - (approach - layer.gap)
    assert found.pressure.min() >= 0.0
    assert off.min() > -1e-15
    assert numpy.abs(found.pressure * off).max() <= 1e-15 * found.pressure.max()
    free = layer._pressure(found.deflection)[~found.touching]
    assert numpy.abs(free).max() <= 1e-8 * found.pressure.max()
    assert found.newton_steps <= 8


@pytest.mark.parametrize("approach", [0.0107, 0.0202, 0.0353, 0.0501])
def test_the_force_is_the_slope_of_the_energy_and_the_tangent_that_of_the_force(approach):
    layer, step = pan_layer(), 1e-5
    found = layer.solve(approach)
    below, above = (layer.solve(approach + side, found) for side in (-step, step))
    assert (layer.energy(above) - layer.energy(below)) / 2 / step == pytest.approx(found.force, rel=2e-6)
    # A cell that enters between the two bends the force: hence the tolerance.
    assert (above.force - below.force) / 2 / step == pytest.approx(layer.tangent(found), rel=5e-3)


def test_the_stiffness_is_that_of_differences_where_the_contact_does_not_change():
    layer, step = FoamLayer(SMALL, PAN, sphere_gap(SMALL, 0.15)), 1e-6
    found = layer.solve(0.03)
    below, above = (layer.solve(0.03 + side, found) for side in (-step, step))
    assert (below.touching == above.touching).all()
    assert (above.force - below.force) / 2 / step == pytest.approx(layer.tangent(found), rel=1e-6)


def test_a_solution_does_not_depend_on_its_start():
    layer = pan_layer()
    from_near, afresh = layer.solve(0.0395, layer.solve(0.045)), layer.solve(0.0395)
    assert from_near.pressure == pytest.approx(afresh.pressure, abs=1e-6 * afresh.pressure.max())


def test_without_overlap_there_is_no_force():
    found = pan_layer().solve(-0.01)
    assert found.force == 0.0
    assert not found.pressure.any()


def test_a_contact_near_the_edge_is_refused_with_its_place():
    layer = FoamLayer(SMALL, PAN, sphere_gap(SMALL, 1.0))
    with pytest.raises(CushionError, match=r"cushion at 30 mm: .* edge of the cells .*, where 50 mm must stay free"):
        layer.solve(0.03)


def test_input_outside_the_range_is_refused():
    gap = numpy.zeros((20, 16))
    with pytest.raises(ValueError, match=r"shear share 1\.5"):
        FoamLayer(SMALL, PAN, gap, 1.5)
    with pytest.raises(ValueError, match="shape"):
        FoamLayer(SMALL, PAN, gap.T)
    with pytest.raises(ValueError, match="modulus above the plateau"):
        FoamLayer(SMALL, FoamElastic(1.0, 0.08, 1e3, 2e3, 80.0, 3.0), gap)
    with pytest.raises(ValueError, match="approach nan"):
        FoamLayer(SMALL, PAN, gap).solve(float("nan"))
    with pytest.raises(ValueError, match=r"approach 0\.08 m: .*at most 0\.0792 is needed"):
        FoamLayer(SMALL, PAN, gap).solve(0.08)
