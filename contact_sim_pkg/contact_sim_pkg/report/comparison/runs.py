"""The page that compares several runs of one rig, in the form of the report of one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from string import ascii_uppercase

from markupsafe import Markup

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.compare.side_by_side import Compared, side_by_side
from contact_sim_pkg.records.registry import contact_reports
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.answer import answer_of
from contact_sim_pkg.report.arrangement import Entry, arranged, first_folds, folds_of
from contact_sim_pkg.report.arrangement import leading as leading_pictures
from contact_sim_pkg.report.comparison.aligned import MapPair, compare_maps, is_mat
from contact_sim_pkg.report.comparison.curves import compared
from contact_sim_pkg.report.comparison.figures import (
    Run,
    area_comparison,
    force_comparison,
    loop_comparison,
    make_runs,
    slap_comparison,
)
from contact_sim_pkg.report.comparison.films import data_of_runs, films_of_runs
from contact_sim_pkg.report.comparison.instants import at_common_instants
from contact_sim_pkg.report.comparison.maps import figure_of_maps, map_comparison
from contact_sim_pkg.report.comparison.scene_differences import differences
from contact_sim_pkg.report.comparison.tables import difference_table, metric_table
from contact_sim_pkg.report.comparison.verdict import answer_of_runs, letters_of, moved_tiles
from contact_sim_pkg.report.drawing import Picture, picture, style
from contact_sim_pkg.report.facts import ended_early, warnings
from contact_sim_pkg.report.metrics.mat import LOADED
from contact_sim_pkg.report.metrics.requirements import Requirement, required
from contact_sim_pkg.report.page import Section, rendered
from contact_sim_pkg.report.place import free_place, new_page
from contact_sim_pkg.report.reading import read_recording, refuse_incomparable, refuse_other_rigs, rig_of_recording
from contact_sim_pkg.report.rig_reports import answered, parts_of
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.sketch import Part, conditions_of
from contact_sim_pkg.report.tables import Table

TEMPLATE = "comparison.html.j2"
MOST_NAMED = 3
"""Tiles of what the answer names and a limit judges, whether it moved most or not."""


def write_comparison(
    bags: Sequence[Bag], out: Path | None = None, *, overwrite: bool = False, requirements: Sequence[Requirement] = ()
) -> Path:
    """Write one page on several bags of one rig.

    Args:
        bags: opened with `open_bag`, at least two.
        out: file to write; a page of this command is made again, another
            file only by `overwrite`; `comparison.html` in the working directory where it is None.
        requirements: limits of one's own, of each run.

    Returns:
        Where the page is.

    Raises:
        BagError: a bag cannot be read, or the rigs differ.
        FileRefusedError: `out` is another file, or part of a bag that is read.
    """
    path = free_place(bags, out, overwrite=overwrite)
    refuse_incomparable(bags)
    # Everything is read before the file is touched
    page = render_comparison(at_common_instants(bags, [read_recording(bag) for bag in bags]), requirements)
    with new_page(path, bags, overwrite=overwrite) as file:
        file.write(page.encode())
    return path


def render_comparison(recordings: Sequence[Recording], requirements: Sequence[Requirement] = ()) -> str:
    """The page as text. Raises BagError for runs of different rigs, or fewer than two."""
    mats = any(map(is_mat, recordings))
    if not mats:
        refuse_other_rigs([rig_of_recording(each) for each in recordings])
    names = distinct_names(recordings)
    letters = letters_of(names)
    pair = compare_maps(names, recordings, LOADED) if mats else None
    if pair is None:
        sides = [compared(name, each, requirements) for name, each in zip(names, recordings, strict=True)]
        table = difference_table(names, differences([each.scene for each in recordings]))
        films = films_of_runs(letters, recordings)
        drawn, first = _sections(make_runs(names, recordings), "run")
    else:
        sides = [
            Compared(name, required(each, requirements), {}) for name, each in zip(names, pair.metrics, strict=True)
        ]
        table = Table("A mat has no scene.", ("how they lie on each other",), [(text,) for text in pair.sentences])
        films, drawn, first = films_of_runs(letters, recordings, pair.moved, pair.alignment), [_maps_of(pair)], []
    moved, named = side_by_side(sides), answered(recordings[0])
    # what its rigs want shown, and what the answer is judged by
    leading = {key for each in sides for key in each.leading}
    leading |= {
        each.key for each in [each for each in moved if each.key in named and each.limit and each.moved][:MOST_NAMED]
    }
    lead = leading_pictures(first, drawn)
    parts = arranged(drawn, len(lead), {})
    unfinished = [
        f"{letter}: {text}" for letter, each in zip(letters, recordings, strict=True) for text in ended_early(each)
    ]
    numbers, answer = metric_table(names, moved), answer_of_runs(names, moved, named, unfinished)
    return rendered(TEMPLATE, {
        "title": " and ".join(dict.fromkeys(str(each.scene.get("name") or each.name) for each in recordings)),
        "count": len(recordings), "answer": answer,
        "conditions": conditions_of([
            Part("", "; ".join(map(_of_run, sides, recordings))),
            *_common_parts(recordings),
        ]),
        "warnings": [f"{each.name}: {text}" for each in recordings for text in warnings(each)],
        "tiles": moved_tiles(names, moved, leading), "numbers": numbers,
        "differences": table,
        "maps": films.views, "notes": films.notes, "lead": lead, "drawn": parts,
        "contents": [Entry("result", "Result"), Entry("time", "Time and maps"),
                     *(Entry(each.key, each.title) for each in parts), Entry("files", "Files")],
        "folds": [*first_folds(answer.more), *folds_of(parts)],
        "commands": _commands([each.name for each in recordings]),
        "data": Markup(data_of_runs(letters, recordings, films)),  # noqa: S704 - made by json
    }, scripts=True)  # fmt: skip


def _of_run(side: Compared, recording: Recording) -> str:
    """`A: seat_soft of 20 s, good`: a mat, and a bag without its scene, have no verdict."""
    verdict = f", {answer_of(recording, side.metrics).word.lower()}" if recording.scene and side.metrics else ""
    return f"{side.name} of {recording.duration:.4g} s{verdict}"


def _common_parts(recordings: Sequence[Recording]) -> list[Part]:
    """Parts that all runs have, of the same values; a mat, and a bag without its scene, have none."""
    of_runs = [parts_of(each) for each in recordings if each.scene]
    if not of_runs:
        return []
    first, *others = of_runs
    named = [{(part.name, part.value) for part in parts} for parts in others]
    return [part for part in first if all((part.name, part.value) in each for each in named)]


def _maps_of(pair: MapPair) -> Section:
    """Both mean maps, one moved onto the other, and their difference."""
    with style():
        figure, text = figure_of_maps(pair.names, pair.maps, pair.difference)
        caption = f"Mean pressure, one scale, {pair.names[pair.moved]} moved onto the other.{text}"
        drawn = picture("laid-over", figure, "Mean pressure maps laid over each other", caption)
    return Section("maps", "Maps", [drawn])


def _commands(names: Sequence[str]) -> list[tuple[str, str]]:
    """Command and what it does, to be called beside the bags."""
    bags = " ".join(names)
    return [
        (f"bench report {bags}", "makes this page"),
        (f"bench compare {bags} --csv", "prints the metrics"),
        (f"bench compare {bags} --tolerances FILE", "judges what moved; exit code 1 beyond a tolerance"),
        (f"bench report {names[0]}", "makes the page of one run"),
    ]


def distinct_names(recordings: Sequence[Recording]) -> list[str]:
    """Names of the bags with A, B and so on before them."""
    return [f"{letter}: {each.name}" for letter, each in zip(ascii_uppercase, recordings, strict=False)]


def _sections(runs: list[Run], title: str) -> tuple[list[Section], list[str]]:
    """Sections, and the name of the first picture that a rig adds, where one does: of a seat T(f)."""
    with style():
        found, of_rigs = [], []
        for number, name in enumerate(runs[0].recording.contacts):
            key = f"contact-{number}"
            own = _rig_pictures(key, name, runs)
            of_rigs += [each.name for each in own]
            made: list[Picture | None] = [
                *own,
                force_comparison(key, name, runs, title),
                map_comparison(key, name, runs),
                loop_comparison(key, name, runs, title),
            ]
            made += [area_comparison(key, name, runs, title), slap_comparison(key, name, runs, title)]
            found.append(Section(key, f"{name.capitalize()} contact", [each for each in made if each is not None]))
    return found, of_rigs[:1]


def _rig_pictures(key: str, name: str, runs: list[Run]) -> list[Picture]:
    """Pictures that the rig of a contact adds."""
    report = contact_reports().get(name)
    found: list[Picture] = [] if report is None or not report.comparison else load(report.comparison)(key, name, runs)
    return found
