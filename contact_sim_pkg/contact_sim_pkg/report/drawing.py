"""Drawing for the page: one style, and SVG that takes its colours from the page: light, dark or
print.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib
import numpy
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation
from numpy.typing import NDArray

from contact_sim_pkg.files import FileRefusedError, check_output, new_file
from contact_sim_pkg.report.rows import SUPERSCRIPT
from contact_sim_pkg.report.signal.decimate import BANDS, bands
from contact_sim_pkg.report.ticks import name_powers, thin_labels

# Each colour stands for a variable of the page's style sheet; the value is what is seen where that
# is missing.
INK = "#1c2126"
MUTED = "#69727b"
RULE = "#d9dee2"
ACCENT = "#0a6c9e"
SHADE = "#f1dfc6"
VARIABLES = {INK: "--ink", MUTED: "--muted", RULE: "--rule", ACCENT: "--accent", SHADE: "--shade"}

PRESSURE_COLOURS = "viridis"
DISPLACEMENT_COLOURS = "cividis"
STRESS_COLOURS = "magma"
SHEAR_COLOURS = "inferno"
WIDTH = 7.4
"""[inch] of a picture across the page's column"""

LEAST_FONT = 9.2
"""[pt] of every text: 11 px where a picture is 640 px wide, the least on a page"""

STYLE = {
    "font.size": LEAST_FONT,
    "font.family": "DejaVu Sans",  # comes with matplotlib; the page replaces it by its own
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "grid.color": RULE,
    "grid.linewidth": 0.6,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "text.color": INK,
    "lines.linewidth": 1.1,
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": LEAST_FONT,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "svg.fonttype": "none",
    "svg.hashsalt": "contact bench",
    "path.simplify": True,
}

_STYLE_ELEMENT = re.compile(r"<style[^>]*>.*?</style>", re.DOTALL)  # the page's style sheet has it
_SIX_DECIMALS = re.compile(r"(\.\d\d)\d{4}\b")  # of coordinates: a hundredth of a point is less than a pixel
_IMAGE_NUMBER = re.compile(r' id="image[0-9a-f]+"')  # of its content: the same colour bar twice would have one twice
_IDENTIFIER = re.compile(r'(\bid="|url\(#|href="#)')


FloatArray = NDArray[numpy.float64]


class Picture(NamedTuple):
    """One picture of the page."""

    svg: Markup
    description: str
    """read aloud in place of the picture"""
    caption: str
    """what one sees, with its numbers"""
    name: str = ""
    """of the picture on its page"""
    figure: Figure | None = None
    """that it was made from; printed by `report.printed`"""


class Margins(NamedTuple):
    """Room round and between the axes of a figure, in [inch]: fixed, for finding it by drawing doubles the work."""

    left: float = 0.88
    right: float = 0.26
    top: float = 0.32
    bottom: float = 0.46
    across: float = 0.78
    """between columns: tick labels and the label of an axis"""
    down: float = 0.62
    """between rows: labels of the upper axis, title of the lower one"""
    shared: float = 0.18
    """between rows that share their x axis"""


PLAIN = Margins()
WITH_BARS = Margins(right=0.75, across=1.45)
"""Margins where each axes has a colour bar at its right."""

MULTIPLES = Margins(left=0.72, bottom=0.5, across=0.14, shared=0.36)
"""Margins of many small maps with a title each, which share both axes."""


def new_figure(
    height: float, rows: int = 1, cols: int = 1, margins: Margins = PLAIN, **options: Any
) -> tuple[Figure, list[Axes]]:
    """A figure of the page's width and `height` [in], and its axes, row by row, within `margins`. Call inside
    `style()`."""
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.subplots(rows, cols, squeeze=False, **options)
    down = margins.shared if options.get("sharex") in (True, "col", "all") else margins.down
    wide = (WIDTH - margins.left - margins.right - (cols - 1) * margins.across) / cols
    high = (height - margins.top - margins.bottom - (rows - 1) * down) / rows
    figure.subplots_adjust(
        left=margins.left / WIDTH, right=1.0 - margins.right / WIDTH, bottom=margins.bottom / height,
        top=1.0 - margins.top / height, wspace=margins.across / wide, hspace=down / high,
    )  # fmt: skip
    return figure, [each for row in axes for each in row]


def legend_above(axes: Axes) -> None:
    """The legend in one row above the axes, whose curves may run anywhere."""
    handles, _ = axes.get_legend_handles_labels()
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=max(len(handles), 1), borderaxespad=0.0)


def style() -> AbstractContextManager[None]:
    """Context in which figures are made and rendered."""
    return matplotlib.rc_context(dict(STYLE))


BAND = " Band: smallest to largest value of each 350th of the time; line: its mean."
"""Sentence of a caption where `draw_series` draws a band."""


def draw_series(axes: Axes, time: FloatArray, values: FloatArray, **line: Any) -> str:
    """Draw values [samples] over time [samples] as a line, a long series as the band that it fills
    with its mean as a line.

    Returns `BAND` for the caption in the latter case.
    """
    if values.size <= 2 * BANDS:
        axes.plot(time, values, **line)
        return ""
    middle, low, mean, high = bands(time, values)
    axes.fill_between(middle, low, high, color=line.get("color"), alpha=0.3, linewidth=0.0)
    axes.plot(middle, mean, **line)
    return BAND


def check_picture(path: Path, inputs: Iterable[Path | None] = (), *, overwrite: bool = False) -> None:
    """Refuse a picture that could not be written in the end; see `files.check_output`.

    Raises:
        FileRefusedError: also for an ending of `path` that names no format.
    """
    known = Figure().canvas.get_supported_filetypes()
    if _format(path) not in known:
        raise FileRefusedError(path, f"is no name of a picture; it ends in one of {', '.join(sorted(known))}")
    check_output(path, inputs, overwrite=overwrite)


def save_picture(figure: Figure, path: str | Path, *, overwrite: bool = False, **options: Any) -> Path:
    """Write a figure into a new file, whose ending names the format; options as of
    `Figure.savefig`.

    Raises:
        FileRefusedError: as `check_picture`. OSError: it cannot be written.
    """
    check_picture(Path(path), overwrite=overwrite)
    with new_file(Path(path), overwrite=overwrite) as file:
        figure.savefig(file, format=_format(Path(path)), **options)
    return Path(path)


class _PlainPowers(LogFormatterSciNotation):
    """Labels of a logarithmic axis in plain text: an exponent set small would be the one text that nobody can read."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        """`0.01`, `10⁻⁵`, `2·10⁻⁵`; empty where matplotlib labels nothing."""
        if not super().__call__(x, pos):
            return ""
        if 1e-3 <= x < 1e5:
            return f"{x:g}"
        mantissa, exponent = f"{x:.0e}".split("e")
        power = f"10{str(int(exponent)).translate(SUPERSCRIPT)}"
        return power if mantissa == "1" else f"{mantissa}·{power}"


def _format(path: Path) -> str:
    return path.suffix.removeprefix(".").lower()


def picture(name: str, figure: Figure, description: str, caption: str) -> Picture:
    """Render a figure as inline SVG.

    Args:
        name: of the picture on its page; keeps the identifiers of several pictures apart.
        figure: made with `new_figure`.
        description: plain text for those who do not see the picture.
        caption: plain text below the picture.
    """
    FigureCanvasSVG(figure)
    buffer = io.StringIO()
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        if isinstance(axis.get_major_formatter(), LogFormatterSciNotation):
            axis.set_major_formatter(_PlainPowers())
            axis.set_minor_formatter(_PlainPowers())
        name_powers(axis)
    thin_labels(figure)
    figure.savefig(buffer, format="svg", dpi=150, metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    body = text[text.index("<svg") :]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.DOTALL)
    body = _IMAGE_NUMBER.sub("", _STYLE_ELEMENT.sub("", body))
    body = _SIX_DECIMALS.sub(r"\1", body)
    body = _IDENTIFIER.sub(rf"\g<1>{name}-", body)
    for colour, variable in VARIABLES.items():
        body = body.replace(colour, f"var({variable})")
    body = body.replace("<svg ", '<svg aria-hidden="true" focusable="false" ', 1)
    # Text in the figure went through matplotlib, which escapes it.
    return Picture(Markup(body), description, caption, name, figure)  # noqa: S704
