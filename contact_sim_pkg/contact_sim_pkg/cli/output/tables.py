"""Rows as a table for a person or as one JSON object for a script."""

from __future__ import annotations

import json
import math
import re
import shutil
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.say import echo
from contact_sim_pkg.files import printable_lines

if TYPE_CHECKING:
    from rich.console import RenderableType

    from contact_sim_pkg.records.table import Section

PIPED_WIDTH = 2_000  # a file or a pipe has no width: every row is one line
GAP = 2  # blanks between columns

json_option = click.option(
    "--json", "as_json", is_flag=True, help="One JSON object on standard output, and nothing else."
)

require_option = click.option(
    "--require", "wanted", multiple=True, metavar="TEXT|FILE",
    help="Limit of your own: 'SEAT < 60 %', or a YAML file; may be repeated.",
)  # fmt: skip

overwrite_option = click.option("--overwrite", is_flag=True, help="Replace files that exist; never an input.")


def print_json(value: Mapping[str, Any]) -> None:
    """One object on standard output; NaN and infinity, which JSON lacks, become null."""
    text = json.dumps(_plain(value), indent=2, ensure_ascii=False, allow_nan=False)
    # Beside ASCII there are only texts, which JSON escapes
    echo(
        re.sub("[^\\x20-\\x7e\\n]", lambda each: each[0] if each[0].isprintable() else json.dumps(each[0])[1:-1], text)
    )


def print_json_rows(rows: Sequence[Mapping[str, Any]]) -> None:
    """`{"rows": […]}` on standard output."""
    print_json({"rows": list(rows)})


def show_rows(rows: Sequence[Mapping[str, Any]], as_json: bool) -> None:
    """The rows as `{"rows": […]}`, or as a table whose columns are the keys of all rows in order of
    appearance.
    """
    if as_json:
        print_json_rows(rows)
    else:
        _print_table(rows)


def show_sections(sections: Sequence[Section]) -> None:
    """Each section as a heading, a table, and its note."""
    from rich.text import Text

    for place, section in enumerate(sections):
        if place:
            echo()
        if section.title:
            _print(Text(printable_lines(section.title), style="bold"))
        _print_table(section.rows)
        if section.note:
            _print(Text(printable_lines(section.note), style="dim"))


def _print(what: RenderableType) -> None:
    """On standard output; no blanks at the ends of lines."""
    from rich.console import Console

    console = Console(width=PIPED_WIDTH)
    with console.capture() as capture:
        console.print(what)
    echo("\n".join(line.rstrip() for line in capture.get().splitlines()))


def _print_table(rows: Sequence[Mapping[str, Any]]) -> None:
    """As wide as the terminal, or `PIPED_WIDTH` where there is none. Texts break at blanks; numbers
    and words never do.
    """
    from rich.markup import escape
    from rich.table import Table

    columns = list(dict.fromkeys(key for row in rows for key in row))
    names = [*map(printable_lines, columns)]
    cells = [[_cell(row.get(column)) for column in columns] for row in rows]
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else PIPED_WIDTH
    texts = [[line[place] for line in cells] for place in range(len(columns))]
    numbers = [all(map(_is_number, column)) for column in texts]
    table = Table(box=None, pad_edge=False, padding=(0, GAP, 0, 0))
    for column, number, share in zip(names, numbers, _widths(names, texts, numbers, width), strict=True):
        table.add_column(escape(column), justify="right" if number else "left", width=share)
    for line in cells:
        table.add_row(*map(escape, line))
    _print(table)


def _widths(columns: list[str], texts: list[list[str]], numbers: list[bool], width: int) -> list[int]:
    """Widths of the columns: the longest word or number; what is left goes to those first that lack
    least.
    """
    least: list[int] = []
    whole: list[int] = []
    for column, cells, number in zip(columns, texts, numbers, strict=True):
        words = cells if number else [word for text in cells for word in text.split()]
        least.append(max(map(len, [*words, *column.split()]), default=1))
        whole.append(max(map(len, [*cells, column]), default=1))
    spare = max(0, width - sum(least) - GAP * (len(columns) - 1))
    for place in sorted(range(len(columns)), key=lambda place: whole[place] - least[place]):
        given = min(spare, whole[place] - least[place])
        least[place] += given
        spare -= given
    return least


def _is_number(text: str) -> bool:
    try:
        float(text.rstrip(" %"))
    except ValueError:
        return text in ("", "-")
    return True


def _cell(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.3g}"
    return printable_lines(", ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value))


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if hasattr(value, "item") and not hasattr(value, "__len__"):
        value = value.item()  # a numpy scalar
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if value is None or isinstance(value, (bool, int, float)) else str(value)
