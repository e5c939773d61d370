"""The picture of an accuracy study, from rows as the parts give them."""

import math

import pytest
from matplotlib import pyplot

from contact_sim_lab.accuracy import scene_plot as accuracy_cost_plot
from contact_sim_lab.accuracy.lines import parts_of_rigs


def row(error, milliseconds=2.0, tolerance=1e-3, part="contact model"):
    return {
        "quantity": "distance", "part": part, "level": "located", "grid": None, "tolerance": tolerance, "error": error,
        "ms_per_simulated_s": milliseconds,
    }  # fmt: skip


@pytest.fixture
def axes():
    figure, axes = pyplot.subplots()
    yield axes
    pyplot.close(figure)


@pytest.mark.parametrize("first", [0.0, 1e-5])
def test_an_error_of_zero_is_drawn_below_the_others_and_said(axes, first):
    """A block that falls onto a plane is exact at some tolerances: it was divided by that error."""
    accuracy_cost_plot._panel(axes, [row(first, 1.0, 1e-2), row(0.0, 2.0, 1e-4), row(3e-7, 4.0, 1e-6)])
    joined, alone = axes.lines
    assert list(joined.get_ydata()) == ([first, 3e-7] if first else [3e-7])
    assert list(alone.get_ydata()) == ([1e-8] if first else [1e-8, 1e-8])
    assert (joined.get_linestyle(), alone.get_linestyle()) == ("-", "None"), "no line leads to an error of 0"
    assert [text.get_text() for text in axes.get_legend().texts] == ["distance"]
    assert axes.get_ylabel() == "relative error (0 drawn at 1e-08)"


@pytest.mark.parametrize("bad", [row(None), row(math.nan), row(math.inf), row(1e-3, 0.0), row(1e-3, None)])
def test_a_row_without_a_number_is_left_out_and_said(axes, bad):
    accuracy_cost_plot._panel(axes, [row(1e-3), bad])
    assert list(axes.lines[0].get_ydata()) == [1e-3]
    assert axes.get_ylabel() == "relative error (1 without a number left out)"


def test_a_point_is_named_by_what_was_asked_and_by_no_grid_that_is_not_there(axes):
    accuracy_cost_plot._panel(axes, [row(1e-3)])
    assert [text.get_text() for text in axes.texts] == ["located"]


def test_every_part_of_a_block_s_study_has_a_panel():
    drawn = {part.part for part in parts_of_rigs()}
    assert {"turning on active contacts", "friction cone", "contact model"} <= drawn


@pytest.mark.parametrize("rows", [[], [row(math.nan)], [row(0.0)], [row(0.0), row(0.0, part="friction cone")]])
def test_a_picture_is_written_whatever_the_rows_hold(rows, tmp_path):
    path = accuracy_cost_plot.write_plot(rows, tmp_path / "plot.png")
    assert path.read_bytes().startswith(b"\x89PNG")
