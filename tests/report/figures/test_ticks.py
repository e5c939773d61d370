"""Tick labels as matplotlib itself draws them: none on another, and no power of ten apart from its axis."""

from itertools import combinations

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from contact_sim_pkg.report.drawing import MULTIPLES, Margins, new_figure, picture, style


def below(figure):
    """Boxes of the labels along x that are seen."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    return [
        (label.get_window_extent(renderer), label.get_text())
        for axes in figure.axes
        for label in axes.get_xticklabels()
        if label.get_visible() and label.get_text()
        and min(axes.get_xlim()) <= label.get_position()[0] <= max(axes.get_xlim())
    ]  # fmt: skip


@pytest.mark.parametrize("ends", [(-0.4, 0.43), (130.0, -210.0), (-0.07, 0.001), (-1e-3, 2e5), (0.123456, 0.123459)])
@pytest.mark.parametrize(("columns", "margins"), [(1, Margins()), (3, Margins(across=0.95)), (8, MULTIPLES)])
def test_labels_along_x_do_not_meet(ends, columns, margins):
    with style():
        figure, axes = new_figure(2.0, 1, columns, margins)
        for place in axes:
            place.set_xlim(*ends)
        picture("strip", figure, "a strip", "")
        found = below(figure)
    assert len(found) >= min(columns, 1)
    meeting = [(one, other) for (a, one), (b, other) in combinations(found, 2) if a.overlaps(b)]
    assert meeting == []


@pytest.mark.parametrize(("label", "said"), [("cycles", "cycles, 10⁶"), ("force, N", "force, 10⁶ N")])
def test_a_power_of_ten_stands_in_the_label(label, said):
    with style():
        figure, (axes,) = new_figure(2.0)
        axes.plot([0.0, 1.0], [0.0, 3.2e6])
        axes.set_ylabel(label)
        drawn = picture("power", figure, "a power", "").svg
    assert f">{said}<" in drawn
    assert "1e6" not in drawn
