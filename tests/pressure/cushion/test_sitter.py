"""Sitters by percentile on pan and back: bands for areas, pressures and sinkage, and regression of this project's tables."""

import math

import numpy
import pytest
from scipy.ndimage import label
from tests.pressure.cushion.cushions import SENSITIVITY, back_layer, figures, pan_layer, under

from contact_sim_pkg.pressure.cushion import bonded_layer, sitter
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, LumbarSupport, back_gap, pan_gap
from contact_sim_pkg.pressure.field import belt

PAN_TABLE = {  # sink mm, stiffness kN/m, area cm^2, peak kPa, mean kPa
    (50, 498.0): (39.4, 22.0, 1096, 10.6, 4.54),
    (50, 559.0): (42.1, 22.9, 1168, 11.4, 4.78),
    (5, 358.0): (36.4, 17.5, 830, 10.4, 4.31),
    (95, 731.0): (44.5, 29.0, 1482, 11.9, 4.93),
}
BACK_TABLE = {
    (50, 80.0): (10.3, 11.4, 384, 3.0, 2.06),
    (50, 150.0): (14.8, 18.9, 662, 3.5, 2.25),
    (5, 55.0): (9.2, 8.8, 268, 2.9, 2.03),
    (95, 105.0): (11.2, 14.6, 498, 3.0, 2.09),
}


@pytest.mark.parametrize(("case", "row"), PAN_TABLE.items())
def test_regression_of_the_pan_by_percentile(case, row):
    layer = pan_layer(case[0])
    found = figures(layer, under(layer, case[1]))
    assert list(found.values()) == pytest.approx(row, rel=0.015)


@pytest.mark.parametrize(("case", "row"), BACK_TABLE.items())
def test_regression_of_the_back_by_percentile(case, row):
    layer = back_layer(case[0])
    found = figures(layer, under(layer, case[1]))
    assert list(found.values()) == pytest.approx(row, rel=0.03)


def test_the_median_sits_as_pressure_mats_in_cars_show():
    """1000 to 1200 cm^2, peak 10 to 20 kPa, mean 4 to 5 kPa on the pan; 1 to 3 kPa on the back at 80 N."""
    layer = pan_layer()
    pan = figures(layer, under(layer, 498.0))
    assert 1000.0 < pan["area"] < 1200.0
    assert 10.0 < pan["peak"] < 20.0
    assert 4.0 < pan["mean"] < 5.0
    layer = back_layer()
    assert 1.0 < figures(layer, under(layer, 80.0))["mean"] < 3.0


def test_each_side_of_the_contact_is_one_piece():
    """No empty band between buttock and thigh, no island at the thigh's end."""
    layer = pan_layer()
    loaded = under(layer, 498.0).pressure > SENSITIVITY
    assert label(loaded[:, :32])[1] == 1
    assert label(loaded[:, 32:])[1] == 1


def test_the_peaks_lie_under_the_tuberosities():
    layer = pan_layer()
    pressure = under(layer, 498.0).pressure
    row, col = numpy.unravel_index(pressure[:, 32:].argmax(), (72, 32))
    assert -0.24 + 0.01 * row == pytest.approx(0.0, abs=0.0101)
    assert 0.005 + 0.01 * col == pytest.approx(0.0625, abs=0.0101)
    assert pressure == pytest.approx(pressure[:, ::-1], rel=1e-6, abs=1e-3)


def test_the_result_converges_with_the_cells():
    fine, usual, coarse = (
        figures(layer, under(layer, 498.0)) for layer in (pan_layer(cell=cell) for cell in (0.005, 0.01, 0.02))
    )
    assert usual["sink"] == pytest.approx(fine["sink"], rel=1e-3)
    assert usual["stiffness"] == pytest.approx(fine["stiffness"], rel=0.01)
    assert usual["peak"] == pytest.approx(fine["peak"], rel=0.01)
    assert usual["area"] == pytest.approx(fine["area"], rel=0.01)
    assert abs(coarse["peak"] - fine["peak"]) > 3.0 * abs(usual["peak"] - fine["peak"])


def test_a_pan_tilted_front_up_moves_the_load_to_the_thighs():
    centres = []
    for tilt in (0.0, 0.05):
        layer = pan_layer(tilt=tilt)
        pressure = under(layer, 498.0).pressure.sum(axis=1)
        centres.append(pressure @ (numpy.arange(72) * 0.01 - 0.24) / pressure.sum())
    assert centres[1] - centres[0] > 0.02


def test_a_lumbar_support_carries_where_it_stands():
    x = (numpy.arange(72) + 0.5) * 0.01 - 0.06
    lumbar = numpy.abs(x - 0.20) < 0.06
    shares = []
    for support in (0.0, 0.02):
        pressure = under(back_layer(support=support), 80.0).pressure
        shares.append(pressure[lumbar].sum() / pressure.sum())
    assert shares[0] < 0.05
    assert shares[1] > 0.3


def test_the_gap_is_over_the_lowest_point_wherever_the_cells_lie():
    """Moved by half a cell the gap is the same surface: at common points equal to the lattice's error."""
    x, y = 0.01 * numpy.arange(60) - 0.2, 0.01 * numpy.arange(40) - 0.2
    sitter = PERCENTILES[50]
    coarse, fine = (
        pan_gap(sitter, x, y),
        pan_gap(sitter, x[0] + 0.005 * numpy.arange(119), y[0] + 0.005 * numpy.arange(79)),
    )
    assert fine[::2, ::2] == pytest.approx(coarse, abs=2e-5)
    back = back_gap(sitter, LumbarSupport(), x, y)
    assert 0.0 <= back.min() < 1e-3


ROW = numpy.linspace(-0.1, 0.1, 5)


@pytest.mark.parametrize(
    ("call", "named"),
    [
        *(
            (lambda tilt=tilt: sitter.pan_gap(sitter.PERCENTILES[50], ROW, ROW, tilt), "tilt")
            for tilt in (math.nan, math.inf, 10.0)
        ),
        *(
            (lambda row=row: sitter.pan_gap(sitter.PERCENTILES[50], row, ROW), "x")
            for row in (ROW[:0], ROW[:1], -ROW, 1e3 * ROW)
        ),
        *((lambda mass=mass: sitter.pan_weight(sitter.Sitter(mass, 1.0, 1.0)), "mass") for mass in (math.nan, -1.0)),
        (lambda: sitter.back_gap(sitter.PERCENTILES[50], sitter.LumbarSupport(math.nan), ROW, ROW), "depth"),
        (lambda: bonded_layer.layer_influence(ROW, 0.1, math.nan), "modulus"),
        *(
            (lambda along=along: belt.stiffness_of_belt(along), "belt")
            for along in (ROW[:0], 0.0 * ROW, math.nan * ROW)
        ),
    ],
)
def test_what_cannot_be_computed_is_refused_by_name(call, named):
    with pytest.raises(ValueError, match=f"{named}.* needed") as refused:
        call()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("inextensible", [False, True])
def test_the_influence_of_the_shortest_wave_falls_as_that_of_a_half_space(inextensible):
    """(1 - nu)/(G q), with a cover times (3 - 4 nu)/(4 (1 - nu)^2): nu = 0, G = E/2."""
    found = bonded_layer.layer_influence(numpy.array([1e300]), 0.1, 2e4, inextensible=inextensible)
    assert found[0] == pytest.approx((0.75 if inextensible else 1.0) / (1e4 * 1e300), rel=1e-12, abs=0.0)
