"""The page of test procedures: the curves of each sheet, its rows, and how to run it again."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from itertools import chain
from pathlib import Path

import numpy
from matplotlib.axes import Axes

from contact_sim_pkg.files import new_file
from contact_sim_pkg.records.procedure import Curve, Map, Procedure, Quantity, Rows, Sheet
from contact_sim_pkg.report.answer import Answer
from contact_sim_pkg.report.drawing import ACCENT, INK, PRESSURE_COLOURS, Margins, Picture, new_figure, picture, style
from contact_sim_pkg.report.place import is_page
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.sweep.page import Call, Part, page_of_parts
from contact_sim_pkg.sweep.procedure import Tested

__all__ = ["write_test_page"]

LINES = (ACCENT, "#c4622d", "#5b8c3a", "#8a5aa8", "#b08a1e", "#3aa0a0")
ROOM = Margins(left=0.92, across=1.08, down=0.72, right=0.18)
MAPS = Margins(left=0.8, right=1.0, across=0.3, down=0.45, top=0.4)
MOST_ROWS = 120
NONE = "–"
COLUMNS = 3
"""Of a legend."""
LETTERS = 22
"""Of a line beside an axis, where panels are low."""

Quantities = Mapping[str, Quantity]


def write_test_page(
    path: Path, title: str, tested: Sequence[Tested], quantities: Quantities, notes: str, again: Mapping[str, str]
) -> Path:
    """Write the page of procedures that have run, which may be one of an earlier call.

    Args:
        path: of the page.
        title: of the page.
        tested: a part each.
        quantities: words and units of the columns.
        notes: a line on what was tested.
        again: by procedure, the command that runs it.

    Raises:
        FileRefusedError: another file is in the way.
    """
    with style():
        parts = [_part(each, quantities, again[each.procedure.name]) for each in tested]
    cases = sum(len(each.cases) for each in tested)
    page = page_of_parts("test", title, cases, _answer(tested), parts, description=notes)
    with new_file(path, ours=is_page) as file:
        file.write(page.encode())
    return path


def _answer(tested: Sequence[Tested]) -> Answer:
    failures = [each for one in tested for each in one.failures]
    cases = sum(len(each.cases) for each in tested)
    said = f"{cases - len(failures)} of {cases} cases of {len(tested)} procedure{'s' * (len(tested) > 1)} finished"
    if failures:
        case, sentence = failures[0]
        return Answer("outside", "Failed cases", f"{said}; {case.procedure}, {case.condition_text}: {sentence}.")
    return Answer("good", "Complete", f"{said}.")


def _part(tested: Tested, quantities: Quantities, again: str) -> Part:
    procedure = tested.procedure
    pictures, tables = [], []
    for sheet in procedure.sheets:
        curves = [each for each in sheet.curves if isinstance(each, Curve)]
        if curves:
            pictures.append(_curves(tested, sheet, curves, quantities))
        pictures += [_maps(tested, sheet, each, quantities) for each in sheet.curves if isinstance(each, Map)]
        if not any(isinstance(each, Map) for each in sheet.curves):
            tables.append(_table(tested, sheet, quantities))
    call = Call(procedure.name, procedure.source, [again])
    return Part(procedure.name, procedure.title, [], pictures, tables, [call])


def _held(procedure: Procedure, quantities: Quantities) -> str:
    """`inflation 220 kPa, speed 60 km/h`."""
    return ", ".join(_valued(name, value, quantities) for name, value in procedure.held.items())


def _valued(name: str, value: float, quantities: Quantities) -> str:
    quantity = quantities[name]
    if value == 0.0 and quantity.zero:
        return quantity.zero
    return f"{quantity.words} {quantity.factor * value:.4g} {quantity.shown or quantity.unit}".rstrip()


def _curves(tested: Tested, sheet: Sheet, curves: Sequence[Curve], quantities: Quantities) -> Picture:
    """A panel a curve; a colour for each combination of what is varied, dashed what a file states."""
    procedure, cols = tested.procedure, min(2, len(curves))
    down = math.ceil(len(curves) / cols)
    drawn = {
        (curve, subject): _lines(tested, sheet, curve, subject, quantities)
        for curve in curves
        for subject in tested.subjects
    }
    labels = {label: LINES[place % len(LINES)] for place, label in enumerate(dict.fromkeys(chain(*drawn.values())))}
    lines = math.ceil((len(labels) + (len(tested.subjects) if len(tested.subjects) > 1 else 0)) / COLUMNS)
    room = ROOM._replace(top=0.3 + 0.19 * lines)
    figure, axes = new_figure(room.top + room.bottom + 1.65 * down + room.down * (down - 1), down, cols, room)
    for place, curve in enumerate(curves):
        for number, subject in enumerate(tested.subjects):
            for label, rows in drawn[curve, subject].items():
                _draw(axes[place], rows, curve, quantities, labels[label], dashed=number > 0)
        axes[place].set_xlabel(quantities[curve.across].label)
        axes[place].set_ylabel(textwrap.fill(quantities[curve.up].label, LETTERS))
    for unused in axes[len(curves) :]:
        unused.set_visible(False)
    handles = [axes[0].plot([], [], color=colour, label=label)[0] for label, colour in labels.items() if label]
    handles += [
        axes[0].plot([], [], color=INK, linestyle="-" if number == 0 else (0, (4, 2)), label=subject)[0]
        for number, subject in enumerate(tested.subjects) if len(tested.subjects) > 1
    ]  # fmt: skip
    if handles:
        figure.legend(handles=handles, loc="upper left", ncols=min(COLUMNS, len(handles)), borderaxespad=0.3)
    held = "; ".join(
        filter(None, (procedure.title, _held(procedure, quantities), _middle_of(procedure, curves[0], quantities)))
    )
    caption = f"{held}. {_whose(tested)}"
    return picture(f"{procedure.name}-{sheet.name or 'curves'}", figure, procedure.title, caption.strip())


def _whose(tested: Tested) -> str:
    files = tested.subjects[1:]
    return f"Dashed: {', '.join(files)} by the Magic Formula." if files else ""


def _shown(procedure: Procedure, curve: Curve) -> tuple[list[str], dict[str, float]]:
    """Quantities that tell the lines of a curve apart; of too many all but the first are held at a middle value."""
    along = curve.along or curve.across
    named = [name for name, values in procedure.varied.items() if len(values) > 1 and name != along]
    if math.prod(len(procedure.varied[name]) for name in named) <= len(LINES):
        return named, {}
    return named[:1], {name: sorted(procedure.varied[name])[len(procedure.varied[name]) // 2] for name in named[1:]}


def _middle_of(procedure: Procedure, curve: Curve, quantities: Quantities) -> str:
    held = _shown(procedure, curve)[1]
    return f"shown at {', '.join(_valued(name, value, quantities) for name, value in held.items())}" if held else ""


def _lines(tested: Tested, sheet: Sheet, curve: Curve, subject: str, quantities: Quantities) -> dict[str, Rows]:
    """Rows of each line by its label."""
    named, held = _shown(tested.procedure, curve)
    found: dict[str, Rows] = {}
    for row in tested.rows(sheet, subject):
        if all(row[name] == value for name, value in held.items()):
            found.setdefault(", ".join(_valued(name, row[name], quantities) for name in named), []).append(row)
    return found


def _draw(axes: Axes, rows: Rows, curve: Curve, quantities: Quantities, colour: str, *, dashed: bool) -> None:
    across, up = (
        numpy.array([row.get(name, math.nan) for row in rows]) * quantities[name].factor
        for name in (curve.across, curve.up)
    )
    few = len(rows) <= 20 and not dashed
    axes.plot(
        across, up, color=colour, linestyle=(0, (4, 2)) if dashed else "-", marker="o" if few else "", markersize=2.6
    )  # fmt: skip


def _maps(tested: Tested, sheet: Sheet, each: Map, quantities: Quantities) -> Picture:
    """A map a case, with one colour scale."""
    procedure, subject = tested.procedure, tested.subjects[0]
    x, y, value = (quantities[name] for name in (each.across, each.up, each.value))
    cases: dict[tuple[float, ...], Rows] = {}
    for row in tested.rows(sheet, subject):
        cases.setdefault(tuple(row[name] for name in procedure.varied), []).append(row)
    cols = len([*procedure.varied.values()][-1])
    down = math.ceil(len(cases) / cols)
    figure, axes = new_figure(0.6 + 1.9 * down, down, cols, MAPS, sharex=True, sharey=True)
    most = max((row[each.value] for rows in cases.values() for row in rows), default=1.0) * value.factor
    for axis, (values, rows) in zip(axes, cases.items(), strict=False):
        places = [numpy.array(sorted({round(row[name], 6) for row in rows})) for name in (each.across, each.up)]
        grid = numpy.full((len(places[1]), len(places[0])), numpy.nan)
        for row in rows:
            i, j = (
                numpy.searchsorted(own, round(row[name], 6))
                for own, name in zip(places, (each.across, each.up), strict=True)
            )
            grid[j, i] = row[each.value] * value.factor
        mesh = axis.pcolormesh(
            places[0] * x.factor, places[1] * y.factor, grid, cmap=PRESSURE_COLOURS, vmin=0.0, vmax=most, shading="nearest",
            rasterized=True,
        )  # fmt: skip
        axis.set_aspect("equal")
        axis.set_title(", ".join(
            f"{quantities[name].factor * each_value:.4g} {quantities[name].shown or quantities[name].unit}"
            for name, each_value in zip(procedure.varied, values, strict=True)
        ))  # fmt: skip
    if cases:
        bar = figure.colorbar(mesh, ax=axes, cax=figure.add_axes((0.885, 0.2, 0.014, 0.6)))
        bar.set_label(value.label)
    figure.supxlabel(x.label, fontsize="medium")
    figure.supylabel(y.label, fontsize="medium")
    titles = " and ".join(quantities[name].words for name in procedure.varied)
    return picture(
        f"{procedure.name}-{sheet.name}", figure, f"{value.words} by {titles}", f"{value.words.capitalize()} by {titles}."
    )  # fmt: skip


def _table(tested: Tested, sheet: Sheet, quantities: Quantities) -> Table:
    names = (*tested.procedure.varied, *(each for each in sheet.columns if each not in tested.procedure.varied))
    rows = [
        (subject, *(_cell(row.get(name, math.nan), quantities[name]) for name in names))
        for subject in tested.subjects for row in tested.rows(sheet, subject)
    ]  # fmt: skip
    shown = rows[:MOST_ROWS]
    count = f"The first {len(shown)} of {len(rows)} rows" if len(shown) < len(rows) else f"All {len(rows)} rows"
    title = f"{tested.procedure.name} {sheet.name}".rstrip()
    return Table(f"{count} of {title}", ("tire", *(quantities[name].label for name in names)), shown)


def _cell(value: float, quantity: Quantity) -> str:
    return f"{quantity.factor * value:.4g}" if math.isfinite(value) else NONE
