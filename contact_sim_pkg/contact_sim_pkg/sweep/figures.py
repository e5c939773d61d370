"""Pictures of a sweep: main effects, response map, scatter matrix."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy
from matplotlib.axes import Axes
from matplotlib.ticker import EngFormatter, MaxNLocator, NullLocator
from numpy.typing import NDArray

from contact_sim_pkg.report.drawing import (
    ACCENT,
    MUTED,
    PRESSURE_COLOURS,
    WITH_BARS,
    Margins,
    Picture,
    new_figure,
    picture,
)
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.sweep.correlations import column_of, correlation, numeric_keys, varied_keys
from contact_sim_pkg.sweep.table import SweepTable

__all__ = ["main_effects", "response_map", "scatter_matrix"]

Field = NDArray[numpy.float64]
MOST_METRICS, MOST_KEYS = 4, 3
MOST_LEVELS = 9
"""Values of a key that have a mean each; more are taken together."""
BINS = 6
LARGE = 1e4
"""From here on labels are in thousands."""
SMALL = Margins(left=0.92, bottom=0.66, across=0.22, shared=0.22, right=0.2)
MATRIX = Margins(left=0.92, bottom=0.66, across=0.24, shared=0.2, right=0.2, top=0.16)


def main_effects(table: SweepTable, metrics: Sequence[str], name: str) -> Picture | None:
    """Each metric over each key, all cases as points and the mean of each value of the key as a line; None without."""
    keys, shown = varied_keys(table)[:MOST_KEYS], metrics[:MOST_METRICS]
    if not keys or not shown:
        return None
    figure, axes = new_figure(1.0 + 1.35 * len(shown), len(shown), len(keys), SMALL, sharex="col", sharey="row")
    for place, axis in enumerate(axes):
        metric, key = shown[place // len(keys)], keys[place % len(keys)]
        _draw_effect(axis, table, key, column_of(table, metric))
        if place % len(keys) == 0:
            axis.set_ylabel(_label(metric, _unit(table, metric)))
        if place >= len(axes) - len(keys):
            axis.set_xlabel(_short(key))
    caption = (
        "Points: cases. Line: mean over the cases of that value, or of a sixth of them where there are many values."
    )
    return picture(name, figure, f"Main effects of {', '.join(keys)}", caption)


def _draw_effect(axis: Axes, table: SweepTable, key: str, values: Field) -> None:
    given = [row[key] for row in table]
    names: list[str] = []
    if key in numeric_keys(table):
        places = numpy.asarray(given, dtype=numpy.float64)
    else:
        names = sorted({*map(str, given)})
        places = numpy.asarray([names.index(str(each)) for each in given], dtype=numpy.float64)
    axis.plot(places, values, linestyle="", marker="o", markersize=3.0, color=MUTED, alpha=0.6)
    axis.plot(*_means(places, values), color=ACCENT, marker="o", markersize=3.5)
    _few_ticks(axis)
    if names:
        axis.set_xticks(range(len(names)), [each if len(each) < 14 else f"{each[:12]}…" for each in names])
        axis.margins(x=0.2)


def _means(places: Field, values: Field) -> tuple[Field, Field]:
    """Mean of the values at each place, or in `BINS` parts of as many cases where there are many places."""
    known = numpy.isfinite(values)
    places, values = places[known], values[known]
    levels = numpy.unique(places)
    if levels.size <= MOST_LEVELS:
        return levels, numpy.array([values[places == each].mean() for each in levels])
    parts = numpy.array_split(numpy.argsort(places, kind="stable"), BINS)
    return numpy.array([places[each].mean() for each in parts]), numpy.array([values[each].mean() for each in parts])


def response_map(table: SweepTable, metric: str, name: str) -> Picture | None:
    """A metric over the two numeric keys that it follows most, the mean over the others; None where there are not two."""
    keys = numeric_keys(table)
    values = column_of(table, metric)
    if len(keys) < 2 or numpy.isfinite(values).sum() < 4:
        return None
    across, up = sorted(keys, key=lambda key: -abs(numpy.nan_to_num(correlation(column_of(table, key), values)[0])))[:2]
    x, y = column_of(table, across), column_of(table, up)
    figure, (axis,) = new_figure(3.4, margins=WITH_BARS)
    axis.grid(visible=False)
    columns, rows = numpy.unique(x), numpy.unique(y)
    cells = [values[(x == column) & (y == row) & numpy.isfinite(values)] for row in rows for column in columns]
    if all(each.size for each in cells):  # a whole grid
        mean = numpy.array([each.mean() for each in cells]).reshape(rows.size, columns.size)
        drawn: Any = axis.pcolormesh(columns, rows, mean, cmap=PRESSURE_COLOURS, shading="nearest")
        dark = mean < 0.5 * (mean.min() + mean.max())
        for (row, column), value in numpy.ndenumerate(mean):
            if mean.size <= 64:
                colour = "white" if dark[row, column] else "black"
                axis.text(
                    float(columns[column]),
                    float(rows[row]),
                    number(float(value)),
                    ha="center",
                    va="center",
                    color=colour,
                )
        said = "Each cell: the mean of the cases of these two values."
    else:
        known = numpy.isfinite(values)
        drawn = axis.scatter(x[known], y[known], c=values[known], cmap=PRESSURE_COLOURS, s=60.0)
        said = "Each point: a case."
    figure.colorbar(drawn, ax=axis, pad=0.02)
    _few_ticks(axis, 6)
    axis.set_xlabel(across)
    axis.set_ylabel(_short(up))
    axis.set_title(_label(metric, _unit(table, metric)).replace("\n", ""))
    lowest, highest = float(numpy.nanmin(values)), float(numpy.nanmax(values))
    caption = f"{metric} from {lowest:.4g} to {highest:.4g} {_unit(table, metric)}. {said}".replace(" .", ".")
    return picture(name, figure, f"Response of {metric} to {across} and {up}", caption)


def scatter_matrix(table: SweepTable, metrics: Sequence[str], name: str) -> Picture | None:
    """Keys and metrics against each other, their distributions on the diagonal; None for fewer than two of them."""
    names = [*numeric_keys(table)[:MOST_KEYS], *metrics[:3]]
    if len(names) < 2 or len(table) < 3:
        return None
    figure, axes = new_figure(0.75 + 1.15 * len(names), len(names), len(names), MATRIX, sharex="col")
    columns = {each: column_of(table, each) for each in names}
    for place, axis in enumerate(axes):
        row, column = divmod(place, len(names))
        if column > row:
            axis.set_visible(False)
            continue
        across, up = columns[names[column]], columns[names[row]]
        if row == column:
            axis.hist(across[numpy.isfinite(across)], bins=10, color=ACCENT, alpha=0.5)
            axis.yaxis.set_major_locator(NullLocator())
        else:
            axis.plot(across, up, linestyle="", marker="o", markersize=2.6, color=ACCENT, alpha=0.7)
        _few_ticks(axis)
        axis.tick_params(labelleft=column == 0 and row > 0, labelbottom=row == len(names) - 1)
        if column == 0:
            axis.set_ylabel(_short(names[row]))
        if row == len(names) - 1:
            axis.set_xlabel(_short(names[column]))
    return picture(
        name, figure, "Scatter matrix of keys and metrics", "Points: cases. On the diagonal: how many have a value."
    )


def _few_ticks(axis: Axes, most: int = 3) -> None:
    """Ticks whose labels find room: at most so many, thousands as `180k`."""
    for each in (axis.xaxis, axis.yaxis):
        if not isinstance(each.get_major_locator(), NullLocator):
            each.set_major_locator(MaxNLocator(most))
            if max(map(abs, each.get_view_interval())) >= LARGE:
                each.set_major_formatter(EngFormatter(sep=""))


def _unit(table: SweepTable, metric: str) -> str:
    return next((each.unit for each in table.ranges() if each.metric == metric), "")


def _short(name: str) -> str:
    """A dotted name in lines that fit beside a small axis: `tire.` above `load_largest`."""
    head, dot, tail = name.rpartition(".")
    return f"{head.rpartition('.')[2]}.\n{tail}" if dot else tail


def _label(metric: str, unit: str) -> str:
    return f"{_short(metric)}, {unit}" if unit else _short(metric)
