"""The page that compares several runs of one rig, in the form of the report of one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.compare.side_by_side import side_by_side
from contact_sim_pkg.records.registry import contact_reports
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.comparison.curves import compared
from contact_sim_pkg.report.comparison.figures import (
    Run,
    area_comparison,
    force_comparison,
    loop_comparison,
    make_runs,
    slap_comparison,
)
from contact_sim_pkg.report.comparison.maps import map_comparison
from contact_sim_pkg.report.comparison.scene_differences import differences
from contact_sim_pkg.report.comparison.tables import difference_table, metric_table
from contact_sim_pkg.report.drawing import Picture, style
from contact_sim_pkg.report.metrics.requirements import Requirement
from contact_sim_pkg.report.page import Section, rendered
from contact_sim_pkg.report.place import free_place, new_page
from contact_sim_pkg.report.reading import read_recording, refuse_other_rigs, rig_of_bag, rig_of_recording
from contact_sim_pkg.report.series import Recording

TEMPLATE = "comparison.html.j2"


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
    refuse_other_rigs([rig_of_bag(bag) for bag in bags])
    # Everything is read before the file is touched
    page = render_comparison([read_recording(bag) for bag in bags], requirements)
    with new_page(path, bags, overwrite=overwrite) as file:
        file.write(page.encode())
    return path


def render_comparison(recordings: Sequence[Recording], requirements: Sequence[Requirement] = ()) -> str:
    """The page as text. Raises BagError for runs of different rigs, or fewer than two."""
    refuse_other_rigs([rig_of_recording(each) for each in recordings])
    names = distinct_names(recordings)
    runs = make_runs(names, recordings)
    sides = side_by_side([compared(name, each, requirements) for name, each in zip(names, recordings, strict=True)])
    title = " and ".join(dict.fromkeys(str(each.scene.get("name") or each.name) for each in recordings))
    return rendered(TEMPLATE, {
        "title": title, "warnings": [f"{each.name}: {text}" for each in recordings for text in facts.warnings(each)],
        "count": len(recordings), "differences": difference_table(names, differences([each.scene for each in recordings])),
        "numbers": metric_table(names, sides), "sections": _sections(runs, "run"),
    })  # fmt: skip


def distinct_names(recordings: Sequence[Recording]) -> list[str]:
    """Names of the bags, of two runs with A and B before them; equal names with their number."""
    names = [each.name for each in recordings]
    if len(set(names)) < len(names):
        names = [f"{name} ({place})" for place, name in enumerate(names, start=1)]
    return [f"{letter}: {name}" for letter, name in zip("AB", names, strict=True)] if len(names) == 2 else names


def _sections(runs: list[Run], title: str) -> list[Section]:
    with style():
        found = []
        for number, name in enumerate(runs[0].recording.contacts):
            key = f"contact-{number}"
            made: list[Picture | None] = [
                force_comparison(key, name, runs, title),
                map_comparison(key, name, runs),
                *_rig_pictures(key, name, runs),
                loop_comparison(key, name, runs, title),
            ]
            made += [area_comparison(key, name, runs, title), slap_comparison(key, name, runs, title)]
            found.append(Section(key, f"{name.capitalize()} contact", [each for each in made if each is not None]))
    return found


def _rig_pictures(key: str, name: str, runs: list[Run]) -> list[Picture]:
    """Pictures that the rig of a contact adds."""
    report = contact_reports().get(name)
    found: list[Picture] = [] if report is None or not report.comparison else load(report.comparison)(key, name, runs)
    return found
