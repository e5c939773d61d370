"""Sitters by percentile on pan and back: bands for areas, pressures and sinkage, and regression of this project's tables."""

import math

import numpy
import pytest
from scipy.ndimage import binary_erosion, label
from scipy.optimize import brentq
from tests.pressure.cushion.cushions import BACK, SENSITIVITY, back_layer, figures, pan_layer, under

from contact_sim_pkg.pressure.cushion import bonded_layer, sitter
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, LumbarSupport, back_gap, pan_gap
from contact_sim_pkg.pressure.field import belt

PAN_TABLE = {  # sink mm, stiffness kN/m, area cm^2, peak kPa, mean kPa
    (50, 498.0): (40.1, 22.4, 1106, 10.4, 4.50),
    (50, 559.0): (42.7, 23.4, 1176, 11.3, 4.75),
    (5, 358.0): (37.3, 17.8, 826, 10.3, 4.33),
    (95, 731.0): (45.0, 30.0, 1492, 11.8, 4.90),
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


@pytest.mark.parametrize("percentile", PERCENTILES)
def test_height_and_slope_of_the_body_are_continuous(percentile):
    """Between neighbouring differences of a continuous slope the step falls with the spacing; a kink keeps its own."""

    def steepest_step(spacing, axis):
        fine, coarse = numpy.arange(-0.15, 0.35, spacing), numpy.arange(-0.15, 0.35, 5e-3)
        x, y = (fine, coarse[10:]) if axis == 0 else (coarse, fine)
        gap = pan_gap(PERCENTILES[percentile], x, y)
        steps = numpy.abs(numpy.diff(gap, 2, axis=axis)) / spacing
        touched = numpy.take(gap, range(1, len(fine) - 1), axis=axis) < 0.06
        return steps[touched].max()

    for axis in (0, 1):
        coarse, fine = steepest_step(5e-4, axis), steepest_step(2.5e-4, axis)
        assert fine <= 0.6 * coarse, f"a kink of {fine:.3g} along axis {axis}"


@pytest.mark.parametrize("percentile", PERCENTILES)
def test_the_outline_has_no_waist_between_buttock_and_thigh(percentile):
    """At every depth the outer edge goes outwards once and inwards once, from behind to the knee."""
    x, y = numpy.arange(-0.2, 0.45, 2e-3), numpy.arange(0.0, 0.3, 5e-4)
    gap = pan_gap(PERCENTILES[percentile], x, y)
    for depth in (0.01, 0.02, 0.03, 0.04, 0.05, 0.06):
        edge = numpy.array([y[row < depth].max() for row in gap if (row < depth).any()])
        widest = int(edge.argmax())
        assert (numpy.diff(edge[: widest + 1]) >= 0.0).all(), f"at {depth} m"
        assert (numpy.diff(edge[widest:]) <= 0.0).all(), f"at {depth} m"


@pytest.mark.parametrize(("percentile", "load"), PAN_TABLE)
def test_the_map_is_whole_and_falls_from_the_tuberosities_to_hip_and_knee(percentile, load):
    """Loaded cells of a side are one run in every row and column, and the largest pressure of a row falls both ways. From one
    inner cell to the next the pressure changes by no more than foam at its first modulus and half as much for the layer's
    remainder make of the difference in depth.
    """
    layer = pan_layer(percentile)
    found = under(layer, load)
    side = found.pressure[:, 32:]
    for cells in (side > 0.0, (side > 0.0).T):
        starts = numpy.diff(cells.astype(int), axis=1, prepend=0) == 1
        assert (starts.sum(axis=1) <= 1).all()
    along = side.max(axis=1)
    peak = int(along.argmax())
    assert (numpy.diff(along[: peak + 1]) >= 0.0).all()
    assert (numpy.diff(along[peak:]) <= 0.0).all()
    # 40 mm before the tuberosity a sixth to a third of what it adds to the pressure of the thigh remains.
    thigh = along[peak + 15]
    assert 0.15 < (along[peak + 4] - thigh) / (along[peak] - thigh) < 0.33
    inner = binary_erosion(found.pressure > 0.0)
    for axis in (0, 1):
        both = numpy.delete(inner & numpy.roll(inner, -1, axis), -1, axis)
        jump, deeper = (numpy.abs(numpy.diff(field, axis=axis))[both] for field in (found.pressure, layer.gap))
        assert (jump <= 100.0 + 1.5 * layer.first_modulus / 0.08 * deeper).all()


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


@pytest.mark.parametrize("load", [80.0, 110.0, 150.0])
def test_a_lumbar_support_takes_the_load_that_columns_of_foam_would_give_it(load):
    """Columns of the foam's own law under the same gap, without shear: share of the load at the lumbar spine and centre of
    pressure for supports of 0 to 30 mm. 20 mm take it from 3 to 15 % to 50 to 66 %.
    """
    x = (numpy.arange(72) + 0.5) * 0.01 - 0.06
    lumbar = numpy.abs(x - 0.20) < 0.06

    def stress(strain):
        left, slope = 1.0 - numpy.clip(strain, 0.0, 0.9), BACK.modulus / BACK.plateau
        first = BACK.plateau * (1.0 / left - left ** (slope - 1.0))
        return first + BACK.densification * (left ** (-BACK.densification_exponent - 1.0) - 1.0 / left)

    for depth in (0.0, 0.01, 0.02, 0.03):
        layer = back_layer(support=depth)
        found = under(layer, load).pressure.sum(axis=1)
        deep = brentq(lambda d, gap=layer.gap: 1e-4 * stress((d - gap) / BACK.thickness).sum() - load, 1e-3, 0.045)
        expected = stress((deep - layer.gap) / BACK.thickness).sum(axis=1)
        assert found[lumbar].sum() / found.sum() == pytest.approx(expected[lumbar].sum() / expected.sum(), abs=0.02)
        assert found @ x / found.sum() == pytest.approx(expected @ x / expected.sum(), abs=0.002)


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
        *(
            (lambda mass=mass: sitter.pan_gap(sitter.Sitter(mass, 1.0, 1.0), ROW, ROW), "mass")
            for mass in (math.nan, -1.0)
        ),
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
