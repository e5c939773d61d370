"""The pages `docs/papers/*.md`: one a paper, with its figures drawn, and their index."""

from __future__ import annotations

import textwrap
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from contact_sim_lab.papers.drawing import made_here, picture
from contact_sim_lab.records.paper import JUDGED, Equation, Erratum, Figure, Number, Paper, System
from contact_sim_pkg.files import check_output, new_file

__all__ = ["write_pages"]

COMMAND = "bench paper --all"
WIDTH, DOTS = 100, 80
INDEX = "README.md"
SOURCES = "../.."
_HEAD = (
    "| quantity | unit | expected | obtained | difference | allowed | verdict | origin of the expected value |\n"
    "|---|---|---|---|---|---|---|---|"
)


def write_pages(
    papers: Sequence[Paper], folder: Path, *, overwrite: bool = False, progress: Callable[[str], None] | None = None
) -> list[dict[str, Any]]:
    """Compute and draw every figure of the papers and write their pages and the index into ``folder``; one row a figure.

    Pages and pictures of this command are made again; other files only with ``overwrite``. FileRefusedError before anything
    is computed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    places = [folder / paper.page for paper in papers]
    places += [folder / picture_name(paper, figure) for paper in papers for figure in paper.figures]
    for place in [*places, folder / INDEX]:
        check_output(place, overwrite=overwrite, ours=_ours)
    rows = []
    for paper in papers:
        shown = []
        for figure in paper.figures:
            began = time.process_time()
            drawn = figure.compute({each.name: each.default for each in figure.parameters})
            _write(folder / picture_name(paper, figure), picture(drawn.draw, drawn.size, DOTS), overwrite)
            spent = time.process_time() - began
            shown.append((figure, list(drawn.numbers)))
            rows.append(row_of(paper, figure, drawn.numbers, spent))
            if progress is not None:
                progress(f"{paper.short}, figure {figure.number}: {rows[-1]['verdict']}, {spent:.1f} CPU s")
        _write(folder / paper.page, page(paper, shown).encode(), overwrite)
    if len(papers) > 1:
        _write(folder / INDEX, index(papers, rows).encode(), overwrite)
    return rows


def row_of(paper: Paper, figure: Figure, numbers: Sequence[Number], spent: float) -> dict[str, Any]:
    """A figure's verdict: judged and inside where every number with an expected value is, else its kind."""
    outside = [each.what for each in numbers if each.verdict == "OUTSIDE"]
    verdict = "OUTSIDE" if outside else "judged, inside" if figure.kind == JUDGED else figure.kind
    counts = {
        name: sum(each.verdict == name for each in numbers)
        for name in ("inside", "input", "not reached", "no reference")
    }
    return {
        "paper": paper.key, "figure": figure.number, "what": figure.title, "verdict": verdict, "inside": counts["inside"],
        "input": counts["input"], "outside": len(outside), "not reached": counts["not reached"],
        "no reference": counts["no reference"], "cpu_s": round(spent, 2),
    }  # fmt: skip


def picture_name(paper: Paper, figure: Figure) -> str:
    """File name of a figure's picture."""
    return f"{paper.key}_{figure.number}.png"


def _ours(path: Path) -> bool:
    if path.suffix == ".png":
        return made_here(path)
    return COMMAND in path.read_text(encoding="utf-8", errors="replace")[:2000]


def _write(path: Path, content: bytes, overwrite: bool) -> None:
    with new_file(path, overwrite=overwrite, ours=_ours) as file:
        file.write(content)


def page(paper: Paper, shown: Sequence[tuple[Figure, Sequence[Number]]]) -> str:
    """The page of a paper."""
    parts = [
        f"# {paper.short}\n",
        _prose(f'"{paper.title}". Authors: {paper.authors}. Year: {paper.year}.'),
        _prose(f"Page made by `{COMMAND}`."),
        _prose(paper.models),
        _prose("Contents: [systems](#systems), [figures](#figures), [equations](#equations), [errata](#errata)."),
        "## Systems\n",
        _table(
            "| system | equations | command | shown in |\n|---|---|---|---|", (_system(each) for each in paper.systems)
        ),
        "## Figures\n",
        _prose(
            f"Drawn by `bench paper {paper.key} --figure N [--set KEY=VALUE] [--output PNG]`, which prints the same numbers. "
            "The expected values come from elsewhere than the bench. *Not reached*: the bench yields no such number, for the "
            "reason that is given."
        ),
    ]
    for figure, numbers in shown:
        parts.append(_figure(paper, figure, numbers))
    if paper.not_shown:
        parts.append(_prose(paper.not_shown))
    parts += [
        "## Equations\n",
        _prose(
            f"`bench paper {paper.key} --equation N [--set KEY=VALUE]` evaluates one; `bench paper {paper.key}` lists their keys."
        ),
        _table("| eq | what | formula | lives in |\n|---|---|---|---|", (_equation(each) for each in paper.equations)),
        "## Errata\n",
        _prose(
            "Equation, what is printed, what the bench uses, how the error was found, and its reason or effect on a number."
        ),
        *(_erratum(each) for each in paper.errata),
    ]
    if paper.left_open:
        parts += ["\n## Left open\n", *(_item(each) for each in paper.left_open)]
    return "\n".join(parts).rstrip() + "\n"


def index(papers: Sequence[Paper], rows: Sequence[dict[str, Any]]) -> str:
    """The index of the pages."""
    kinds = {
        kind: sum(row["verdict"] == kind for row in rows) for kind in dict.fromkeys(row["verdict"] for row in rows)
    }
    parts = [
        "# The five papers, figure by figure\n",
        _prose(
            f"Made by `{COMMAND}`. {len(rows)} figures are drawn: {', '.join(f'{count} {kind}' for kind, count in kinds.items())}. "
            "`bench paper` lists them."
        ),
        *(_item(f"[{each.short}]({each.page}): {each.models}") for each in papers),
        "",
        _table(
            "| paper | systems | figures | equations | errata |\n|---|---|---|---|---|",
            (
                f"| [{each.short}]({each.page}) | {len(each.systems)} | {len(each.figures)} | {len(each.equations)} "
                f"| {len(each.errata)} |"
                for each in papers
            ),
        ),
        "## Figures\n",
        _table(
            "| figure | what | verdict | inside | outside | not reached | no reference |\n|---|---|---|---|---|---|---|",
            (
                f"| [{paper.short} {row['figure']}]({paper.page}#figure-{row['figure']}) | {_cell(row['what'])} "
                f"| {row['verdict']} | {row['inside']} | {row['outside']} | {row['not reached']} | {row['no reference']} |"
                for paper in papers
                for row in rows
                if row["paper"] == paper.key
            ),
        ),
    ]
    return "\n".join(parts).rstrip() + "\n"


def _system(system: System) -> str:
    places = "; ".join(f"`{_cell(place)}`" for _, place in system.shows)
    return f"| {_cell(system.title)} | {system.equations} | `{_cell(system.command)}` | {places} |"


def _figure(paper: Paper, figure: Figure, numbers: Sequence[Number]) -> str:
    made_by = ", ".join(_link(each, short=True) for each in figure.made_by)
    lines = [
        f"### Figure {figure.number}\n",
        f"![Figure {figure.number}]({picture_name(paper, figure)})\n",
        _prose(
            f"*{figure.title[0].upper()}{figure.title[1:]}.* {figure.kind[0].upper()}{figure.kind[1:]}: {figure.judged_by}. "
            f"{figure.note}".rstrip()
        ),
        _prose(f"Made by {made_by}. `bench paper {paper.key} --figure {figure.number}`"),
        _table(_HEAD, (_number(each) for each in numbers)),
    ]
    return "\n".join(lines)


def _number(number: Number) -> str:
    expected, obtained = ("" if value is None else f"{value:.6g}" for value in (number.expected, number.obtained))
    judged = number.difference is not None
    difference = number.shown_difference(2)
    allowed = f"{number.tolerance:.2g}{' of it' if number.relative else ''}" if judged else ""
    origin = "; ".join(filter(None, (number.origin, number.note)))
    cells = (_cell(number.what), number.unit, expected, obtained, difference, allowed, number.verdict, _cell(origin))
    return f"| {' | '.join(cells)} |"


def _equation(equation: Equation) -> str:
    source = f" ({equation.source})" if equation.source else ""
    return (
        f"| {equation.number} | {_cell(equation.title)}{source} | {_cell(equation.formula)} | {_link(equation.place)} |"
    )


def _link(place: str, *, short: bool = False) -> str:
    """A scene as text, a ``module:name`` as a link to its file."""
    if place.startswith("scene "):
        return f"scene `{place.removeprefix('scene ')}`"
    module, _, name = place.partition(":")
    path = module.replace(".", "/")
    shown = name if short else f"{module.rpartition('.')[2]}.{name}"
    return f"[`{shown}`]({SOURCES}/{module.partition('.')[0]}/{path}.py)"


def _erratum(erratum: Erratum) -> str:
    printed, corrected, effect = (_plain(text) for text in (erratum.printed, erratum.corrected, erratum.effect))
    return _item(f"{erratum.equation}: *printed* {printed}; *corrected* {corrected}. By {erratum.found}: {effect}.")


def _table(head: str, rows: Iterable[str]) -> str:
    """A table that a command makes, marked as such."""
    return "\n".join(
        [f"<!-- tables made from {COMMAND}: begin -->\n", head, *rows, f"\n<!-- tables made from {COMMAND}: end -->\n"]
    )


def _plain(text: str) -> str:
    return text.replace("*", "\\*").replace("_", "\\_").replace("<", "&lt;")


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ").replace("*", "\\*")


def _item(text: str) -> str:
    return textwrap.fill(
        text, WIDTH, initial_indent="* ", subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def _prose(text: str) -> str:
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False) + "\n"
