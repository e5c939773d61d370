"""Work-precision studies of the tire: known errors of inexpensive levels, convergence of the others, a reference in every row."""

import itertools
import math

import numpy
import pytest

from contact_sim_lab.accuracy import work_precision as whole_study
from contact_sim_lab.accuracy import work_precision_plot as study_plot
from contact_sim_lab.accuracy import work_precision_table as study_table
from contact_sim_lab.records import work_precision as study_row
from contact_sim_lab.rigs.vehicle.work_precision import area as study_area
from contact_sim_lab.rigs.vehicle.work_precision import elliptic as study_elliptic
from contact_sim_lab.rigs.vehicle.work_precision import exponent as study_exponent
from contact_sim_lab.rigs.vehicle.work_precision import road as study_road
from contact_sim_lab.rigs.vehicle.work_precision import rough as study_rough
from contact_sim_lab.rigs.vehicle.work_precision import smooth as study_smooth
from contact_sim_lab.rigs.vehicle.work_precision.fields import (
    FIELD,
    FORCE,
    GIVEN,
    PEAK,
    Answer,
    distances,
    solve,
)
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import (
    LOAD,
    PATCH,
    means_over,
    patch_problem,
    road_heights,
)
from contact_sim_lab.rigs.vehicle.work_precision.rolling_problem import FINEST, FIRST, rough_road


@pytest.fixture(scope="module", autouse=True)
def few_samples():
    """Times are not looked at here."""
    kept = study_row.FEWEST, study_row.BUDGET
    study_row.FEWEST, study_row.BUDGET = 1, 0.0
    yield
    study_row.FEWEST, study_row.BUDGET = kept


ROUGH = dict(zip(GIVEN, (f"{given}{study_rough.WORST}" for given in GIVEN), strict=True))


def error_of(rows, quantity, level, case=None, grid=None, key="error"):
    found = [
        row[key]
        for row in rows
        if (row["quantity"], row["level"]) == (quantity, level)
        and case in (None, row["case"])
        and grid in (None, row["grid"])
    ]
    assert len(found) == 1, found
    return found[0]


@pytest.fixture(scope="module")
def smooth_rows():
    return study_smooth.rows()


@pytest.fixture(scope="module")
def rough_rows():
    return study_rough.rows()


@pytest.fixture(scope="module")
def exponent_rows():
    return study_exponent.rows()


def test_the_road_of_the_patch_goes_through_the_nodes_of_the_road():
    cells = (128, 96)
    x, y = ((numpy.arange(n) - 0.5 * (n - 1)) * side / n for n, side in zip(cells, PATCH, strict=True))
    first = [start + 1 for start in FIRST]  # a coarse cell's centre lies on a node
    nodes = rough_road(5)[first[0] : first[0] + 256 : 2, first[1] : first[1] + 192 : 2]
    numpy.testing.assert_allclose(road_heights(5, x, y), nodes, atol=1e-15)


def test_the_road_of_the_patch_has_no_wave_above_its_limit():
    x = numpy.arange(2048) * FINEST / 3.0
    heights = road_heights(2, x, numpy.zeros(1))[:, 0] * numpy.hanning(2048)
    wave = numpy.fft.rfftfreq(2048, FINEST / 3.0)
    spectrum = abs(numpy.fft.rfft(heights))
    assert spectrum[wave > 215.0].max() < 1e-4 * spectrum.max()


def test_means_over_cells_refuse_grids_that_do_not_fit():
    assert means_over(numpy.arange(16.0).reshape(4, 4), (2, 2)).tolist() == [[2.5, 4.5], [10.5, 12.5]]
    with pytest.raises(ValueError, match="no whole number"):
        means_over(numpy.zeros((6, 4)), (4, 2))


def test_polynomial_power_and_table_are_worse_than_the_exact_root():
    rows = study_elliptic.rows()
    for case in dict.fromkeys(row["case"] for row in rows):
        assert error_of(rows, "peak pressure", "AGM and Newton", case) < 1e-14
        assert 1e-14 < error_of(rows, "peak pressure", "table in ln(1-Ω)", case) < 1e-6
    assert error_of(rows, "peak pressure", "polynomial (eq 10)", "Ω = 0.93") == pytest.approx(0.01, rel=0.1)


def test_on_a_smooth_road_the_closed_form_is_exact_and_the_field_converges_to_it(smooth_rows):
    for given in GIVEN:
        assert error_of(smooth_rows, FIELD, "Hertz ellipse", given) < 1e-13
        errors = [error_of(smooth_rows, FIELD, level.name, given) for level in study_smooth.LEVELS]
        assert errors == sorted(errors, reverse=True)
        assert errors[-1] < 4e-3
    assert error_of(smooth_rows, "approach", "FFT-CG reference", GIVEN[0]) < 2e-5
    assert error_of(smooth_rows, FORCE, "FFT-CG reference", GIVEN[1]) < 3e-5


def test_on_a_rough_road_the_winkler_bed_is_far_off_and_the_tiers_come_closer(rough_rows):
    for given in GIVEN:
        errors = [error_of(rough_rows, FIELD, level.name, ROUGH[given]) for level in study_smooth.LEVELS]
        assert error_of(rough_rows, FIELD, "Winkler bed", ROUGH[given]) > 0.5 > errors[0]
        assert errors[-1] < errors[1] < 0.2
        assert error_of(rough_rows, PEAK, "Winkler bed", ROUGH[given]) > 0.5


def test_what_is_given_comes_back_exactly(rough_rows):
    for level in study_smooth.LEVELS:
        assert error_of(rough_rows, FORCE, level.name, ROUGH[GIVEN[0]]) < 1e-8
        assert error_of(rough_rows, "approach", level.name, ROUGH[GIVEN[1]]) == 0.0


def test_grid_error_stands_beside_solver_error_and_bounds_the_error_with_it(rough_rows):
    on_grids = [row for row in rough_rows if row["solver_error"] is not None]
    assert len(on_grids) == 2 * 3 * 5
    for row in on_grids:
        assert (
            row["error"]
            <= 1.1 * (row["solver_error"] + row["grid_error"] + row["solver_error"] * row["grid_error"]) + 1e-12
        )
    last = study_smooth.LEVELS[-1].name
    for given in GIVEN:
        assert error_of(rough_rows, FIELD, last, ROUGH[given], key="solver_error") < 1e-4
        assert error_of(rough_rows, FIELD, last, ROUGH[given], key="grid_error") > 1e-3


@pytest.mark.parametrize("given", GIVEN)
@pytest.mark.parametrize("seed", [21, 25])
def test_two_tiers_differ_on_a_further_road_by_less_than_twice_what_both_announce(rough_rows, seed, given):
    assert seed not in study_rough.SEEDS
    value = LOAD if given == GIVEN[0] else 7.6e-3
    answers = [solve(patch_problem(level.cells, seed), given, value, level.tolerance) for level in study_smooth.LEVELS]
    pairs = zip(study_smooth.LEVELS, answers, strict=True)
    for (coarse, one), (fine, other) in itertools.combinations(pairs, 2):
        for quantity, difference in distances(one, other).items():
            announced = [error_of(rough_rows, quantity, level.name, ROUGH[given]) for level in (coarse, fine)]
            assert difference <= 2.0 * sum(announced) + 1e-12, (quantity, coarse, fine)


def test_the_check_is_against_dense_least_squares_and_falls_with_the_tolerance():
    rows = study_rough.check_rows()
    assert {row["reference"] for row in rows} == {study_rough.DENSE}
    for given in GIVEN:
        errors = [row["error"] for row in rows if (row["case"], row["quantity"]) == (given, FIELD)]
        assert errors[0] < 0.1
        assert errors[-1] < 1e-6


def test_an_edge_between_cells_comes_closest_to_the_area():
    rows = study_area.rows()
    for case in ("smooth road", "rough road"):
        for grid in ("64x48", "128x96", "256x192"):
            between = error_of(rows, "contact area", "cells, edge between them", case, grid)
            assert between < error_of(rows, "contact area", "cells counted", case, grid)
            assert between < error_of(rows, "contact area", "Lamé fit", case, grid)


@pytest.mark.parametrize(
    ("exponent", "centre_high", "ansatz_low", "ellipse_high"), [(3.0, 0.29, 0.107, 0.13), (4.0, 0.44, 0.134, 0.212)]
)
def test_closed_forms_of_other_exponents_have_the_announced_errors(
    exponent_rows, exponent, centre_high, ansatz_low, ellipse_high
):
    rows = [row for row in exponent_rows if row["case"].startswith(f"gap exponent {exponent:g}")]
    assert error_of(rows, study_exponent.CENTRE, "Lamé ansatz") == pytest.approx(centre_high, abs=0.01)
    assert error_of(rows, "approach", "Lamé ansatz") == pytest.approx(ansatz_low, abs=0.01)
    assert error_of(rows, "approach", "equivalent ellipse") == pytest.approx(ellipse_high, abs=0.01)
    ansatz = next(row for row in rows if (row["level"], row["quantity"]) == ("Lamé ansatz", "approach"))
    assert ansatz["value"] < ansatz["expected"]
    assert error_of(rows, "approach", "FFT-CG", grid="192x192") < 1e-4


def test_the_power_of_sines_is_what_their_heights_have():
    road = study_road.sine_road(20)
    x = numpy.arange(400_000) * 0.1
    assert road.heights(x).var() == pytest.approx(road.power(0.0, math.inf), rel=0.01)


def test_few_sines_have_the_variance_but_not_the_spectrum():
    rows = study_road.rows()
    for level in ("20 sines", "400 sines", "inverse FFT"):
        assert error_of(rows, "variance", level) < 1e-6
    assert error_of(rows, "third octaves, rms", "20 sines") > 0.3
    assert error_of(rows, "third octaves, rms", "400 sines") < 0.1
    assert error_of(rows, "third octaves, rms", "inverse FFT") < 0.1


def test_distances_of_equal_answers_are_zero_and_of_others_as_by_hand():
    field = numpy.array([[1.0, 2.0], [3.0, 4.0]])
    one = Answer(10.0, 2.0, 4.0, 1.0, field)
    assert set(distances(one, one).values()) == {0.0}
    other = Answer(11.0, 2.0, 5.0, 1.0, field + 1.0)
    assert distances(other, one) == pytest.approx(
        {FORCE: 0.1, "approach": 0.0, PEAK: 0.25, "contact area": 0.0, FIELD: 2.0 / math.sqrt(30.0)}
    )


def test_a_field_that_is_not_certified_ends_the_study():
    with pytest.raises(RuntimeError, match="edge of the grid"):
        solve(patch_problem((24, 24)), GIVEN[0], 100.0 * LOAD, 1e-6)


def test_every_row_has_every_column_and_the_table_and_the_plot_show_each_study(smooth_rows, monkeypatch, tmp_path):
    studies = (*study_road.WORK_PRECISION, study_row.WorkPrecision(study_smooth.PART, lambda: smooth_rows))
    monkeypatch.setattr(whole_study, "studies_of", lambda _rig: studies)
    notes: list[str] = []
    rows = whole_study.study("rig", notes.append)
    assert notes == ["rig: road", "rig: pressure field, smooth road"]
    assert all(tuple(row) == study_row.COLUMNS for row in rows)
    assert all(row["ms_per_call"] > 0.0 and row["reference"] for row in rows)
    sections = study_table.sections(rows)
    assert [section.title for section in sections][1:] == [f"{study_smooth.PART}: {given}" for given in GIVEN]
    assert FORCE not in sections[1].rows[0], "the given quantity has no column"
    path = study_plot.write_plot(rows, tmp_path / "plot.png")
    assert path.read_bytes().startswith(b"\x89PNG")


def test_the_table_puts_the_grid_s_error_beside_the_solver_s():
    rows = [
        {
            "part": "field", "case": "given load", "quantity": name, "level": "FFT-CG", "grid": "64x48", "tolerance": 1e-2,
            "error": 0.3, "solver_error": 0.1, "grid_error": 0.2, "reference": "own code", "ms_per_call": 1.5,
        }
        for name in ("approach", "peak pressure")
    ]  # fmt: skip
    (section,) = study_table.sections(rows)
    assert list(section.rows[0]) == [
        "level", "grid", "tolerance", "approach: solver", "approach: grid", "peak pressure: solver", "peak pressure: grid",
        "ms a call",
    ]  # fmt: skip
    assert section.note == "error against: own code"
