"""Maps and surfaces of a field on the cells of a contact: seen from above, forward up, left to the
left.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from contact_sim_pkg.report.drawing import INK, MUTED, WIDTH
from contact_sim_pkg.report.series import FloatArray, PressureMap

FAR_HIGHER = 1.5
"""A colour scale leaves out a few values if the largest is that many times what the others
reach.
"""
SURFACE_LINES = 64
"""Most lines of a surface picture in each direction."""


class Window(NamedTuple):
    """Part of the contact plane that maps show, [mm]."""

    low_x: float
    high_x: float
    low_y: float
    high_y: float

    @property
    def aspect(self) -> float:
        """Length over width."""
        return (self.high_x - self.low_x) / (self.high_y - self.low_y)


class View(NamedTuple):
    """How a map is looked at: labels of its axes, and a sentence for the caption."""

    across: str
    along: str
    seen: str


FROM_ABOVE = View("← left, y, mm", "forward, x, mm →", "Seen from above, forward is up.")


class Quantity(NamedTuple):
    """Values on the cells of a field, and how they are shown."""

    values: FloatArray
    """[rows, cols] in `unit`"""
    label: str
    """name and unit, for axes"""
    colours: str
    """name of a colour map, perceptually uniform"""


def robust_limits(values: FloatArray, few: float) -> Normalize:
    """Limits of a colour scale for values [rows, cols], in their unit: from 0 to the largest.

    Where the share `few` [1] of those above 0 is far higher than the others, the limit is what
    these reach.
    """
    above = values[values > 0.0]
    if not above.size:
        return Normalize(0.0, 1.0)
    usual, highest = float(np.quantile(above, 1.0 - few)), float(above.max())
    return Normalize(0.0, highest if highest <= FAR_HIGHER * usual else usual)


def extension(values: FloatArray, limits: Normalize) -> str:
    """End of the colour bar of values [rows, cols]: with an arrow where some lie above its
    limits.
    """
    return "max" if limits.vmax is not None and np.any(values > limits.vmax) else "neither"


def loaded_window(field: PressureMap, margin: float = 2.0) -> Window:
    """Window [mm] of the loaded cells with `margin` [1] cells around them; the whole grid where
    none is loaded."""
    rows, cols = (np.flatnonzero(field.pressure.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return whole_window(field)
    side = margin + 0.5
    low_x, high_x = (field.origin_x + row * field.cell_x for row in (rows[0] - side, rows[-1] + side))
    low_y, high_y = (field.origin_y + col * field.cell_y for col in (cols[0] - side, cols[-1] + side))
    return Window(low_x * 1e3, high_x * 1e3, low_y * 1e3, high_y * 1e3)


def common_window(fields: list[PressureMap]) -> Window:
    """What shows the loaded cells of all fields; the first grid where none is loaded."""
    loaded = [field for field in fields if field.pressure.any()] or fields[:1]
    low_x, high_x, low_y, high_y = zip(*(loaded_window(field) for field in loaded), strict=True)
    return Window(min(low_x), max(high_x), min(low_y), max(high_y))


def whole_window(field: PressureMap) -> Window:
    """All cells."""
    low_y, high_y, low_x, high_x = extent(field)
    return Window(low_x, high_x, low_y, high_y)


def extent(field: PressureMap) -> tuple[float, float, float, float]:
    """[mm] outer edges of the cells: low y, high y, low x, high x."""
    rows, cols = field.pressure.shape
    low_x, low_y = field.origin_x - field.cell_x / 2, field.origin_y - field.cell_y / 2
    return (
        low_y * 1e3, (low_y + cols * field.cell_y) * 1e3, low_x * 1e3, (low_x + rows * field.cell_x) * 1e3
    )  # fmt: skip


def draw_map(
    axes: Axes, field: PressureMap, values: FloatArray, colours: str | Colormap, limits: Normalize
) -> AxesImage:
    """Draw values [rows, cols] of the cells as they are, not interpolated; nan is blank."""
    image = axes.imshow(
        values, origin="lower", extent=extent(field), cmap=colours, norm=limits, interpolation="nearest", aspect="equal"
    )
    axes.grid(visible=False)
    return image


def set_window(axes: Axes, window: Window) -> None:
    """Show this part, left on the left; no tick stands where the next map's may."""
    axes.xaxis.set_major_locator(MaxNLocator(4, prune="both"))
    axes.set_xlim(window.high_y, window.low_y)
    axes.set_ylim(window.low_x, window.high_x)


def draw_outline(axes: Axes, field: PressureMap, colour: str = INK) -> None:
    """The boundary of the cells under pressure, along their edges."""
    loaded = np.pad(field.pressure > 0.0, 1)
    low_y, high_y, low_x, high_x = extent(field)
    rows, cols = field.pressure.shape
    edges_x, edges_y = np.linspace(low_x, high_x, rows + 1), np.linspace(low_y, high_y, cols + 1)
    across = np.argwhere(loaded[1:, 1:-1] != loaded[:-1, 1:-1])
    along = np.argwhere(loaded[1:-1, 1:] != loaded[1:-1, :-1])
    lines_y = [(edges_y[col], edges_y[col + 1], np.nan) for _, col in across] + [
        (edges_y[c], edges_y[c], np.nan) for _, c in along
    ]
    lines_x = [(edges_x[row], edges_x[row], np.nan) for row, _ in across] + [
        (edges_x[r], edges_x[r + 1], np.nan) for r, _ in along
    ]
    axes.plot(np.ravel(lines_y), np.ravel(lines_x), color=colour, linewidth=0.9)


def surface_and_map(field: PressureMap, quantity: Quantity, window: Window, outline: bool) -> Figure:
    """A surface picture on the left, the same values as a map on the right; one colour scale for
    both.
    """
    limits = Normalize(min(0.0, float(np.nanmin(quantity.values))), float(np.nanmax(quantity.values)))
    figure = Figure(figsize=(WIDTH, 3.3))
    surface: Any = figure.add_axes((-0.015, 0.03, 0.45, 1.03), projection="3d")
    _draw_surface(surface, field, quantity, window, limits)
    axes = figure.add_axes((0.602, 0.15, 0.284, 0.74))
    shown = np.where(field.pressure > 0.0, quantity.values, np.nan) if not outline else quantity.values
    image = draw_map(axes, field, shown, quantity.colours, limits)
    if outline:
        draw_outline(axes, field, "#ffffff")
    set_window(axes, window)
    axes.set_xlabel("← left, y, mm")
    axes.set_ylabel("forward, x, mm →")
    bar = figure.colorbar(image, cax=axes.inset_axes((1.04, 0.0, 0.045, 1.0)), label=quantity.label)
    bar.ax.spines["outline"].set_visible(False)
    return figure


def _draw_surface(axes: Any, field: PressureMap, quantity: Quantity, window: Window, limits: Normalize) -> None:
    rows, cols = field.pressure.shape
    x = (field.origin_x + np.arange(rows) * field.cell_x) * 1e3
    y = (field.origin_y + np.arange(cols) * field.cell_y) * 1e3
    in_x, in_y = (x >= window.low_x) & (x <= window.high_x), (y >= window.low_y) & (y <= window.high_y)
    across, along = np.meshgrid(y[in_y], x[in_x])
    values = quantity.values[np.ix_(in_x, in_y)]
    shape = axes.plot_surface(
        along, across, values, cmap=colormaps[quantity.colours], norm=limits, rcount=SURFACE_LINES, ccount=SURFACE_LINES,
        linewidth=0.15, edgecolor="#00000038", antialiased=True, shade=False,
    )  # fmt: skip
    shape.set_rasterized(True)  # thousands of facets would be heavier as paths
    axes.view_init(elev=32, azim=-55)
    width, length = window.high_y - window.low_y, window.high_x - window.low_x
    largest = max(width, length)
    axes.set_box_aspect((max(length / largest, 0.45), max(width / largest, 0.45), 0.55), zoom=0.9)
    axes.set_xlabel("x, mm", labelpad=1)
    axes.set_ylabel("y, mm", labelpad=1)
    axes.set_zlabel(quantity.label, labelpad=2)
    axes.tick_params(pad=-1)
    axes.locator_params(axis="z", nbins=4)
    # where the axes meet, the labels of one would stand on those of the other
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        edge = 0.15 * (high - low)
        ticks = MaxNLocator(4).tick_values(low, high)
        axis.set_ticks(ticks[(ticks > low + edge) & (ticks < high - edge)])
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color((0.0, 0.0, 0.0, 0.0))
        axis.line.set_color(MUTED)
