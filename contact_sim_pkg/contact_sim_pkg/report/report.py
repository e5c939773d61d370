"""The report of a bag: one HTML page with every picture, its style and its scripts inside, which loads nothing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.records.registry import contact_reports
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report import facts, rig_reports
from contact_sim_pkg.report.answer import answer_of, first_metrics
from contact_sim_pkg.report.arrangement import Entry, arranged, first_folds, folds_of, leading
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.figures.bench import energy_balance, real_time_factor
from contact_sim_pkg.report.figures.contact import contact_section
from contact_sim_pkg.report.metrics.curve_bands import beyond_bands
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.metrics.requirements import Requirement, bands_of, required
from contact_sim_pkg.report.metrics.tiles import doubts_of, metric_table, published_table, tiles_of
from contact_sim_pkg.report.page import PUBLISHED, TRUST, Section, rendered
from contact_sim_pkg.report.place import free_place, new_page
from contact_sim_pkg.report.reading import OnRead, read_recording
from contact_sim_pkg.report.rows import scene_rows
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.sketch import Part, conditions_of, drawing_of
from contact_sim_pkg.report.timeline import map_views, page_data
from contact_sim_pkg.report.trust import commands_of, topic_table, trust_tables

if TYPE_CHECKING:
    from contact_sim_pkg.compare.delivered import Check

TEMPLATE = "report.html.j2"

OnSection = Callable[[int, int, str], object]
"""Called before a section is drawn: its number from 0, the number of sections, its name."""


def write_report(
    bag: Bag,
    out: Path | None = None,
    *,
    overwrite: bool = False,
    requirements: Sequence[Requirement] = (),
    check: Check | None = None,
    on_section: OnSection = lambda *_: None,
    on_read: OnRead = lambda _: None,
) -> Path:
    """Write the report of a bag.

    Args:
        bag: opened with `open_bag`; unfinished bags give a report of what they hold.
        out: file to write; a page of this command is made again, another
            file only by `overwrite`; `report.html` in the bag's directory where it is None.
        requirements: limits of one's own, which the tiles are judged by.
        check: what accuracy the run delivered, of `check_bag`.
        on_section: called before each section.
        on_read: called while the bag is read, with the share that has been.

    Returns:
        Where the page is.

    Raises:
        BagError: the bag cannot be read.
        FileRefusedError: `out` is another file, or part of a bag that is read.
    """
    path = free_place([bag], out, overwrite=overwrite)
    # Everything is read before the file is touched
    page = render(read_recording(bag, on_read), on_section, requirements, check)
    with new_page(path, [bag], overwrite=overwrite) as file:
        file.write(page.encode())
    return path


def render(
    recording: Recording,
    on_section: OnSection = lambda *_: None,
    requirements: Sequence[Requirement] = (),
    check: Check | None = None,
) -> str:
    """The page as text. Everything that comes from the bag is escaped."""
    metrics = required([*metrics_of(recording), *beyond_bands(recording, bands_of(requirements))], requirements)
    drawn = sections(recording, on_section)
    lead = leading(_lead_names(recording), drawn)
    published = published_table(metrics)
    parts = arranged(drawn, len(lead), {
        PUBLISHED: [] if published is None else [published], TRUST: trust_tables(recording, metrics, check),
    })  # fmt: skip
    of_rig = rig_reports.parts_of(recording)
    conditions = conditions_of([Part("", f"{recording.duration:.4g} s"), *of_rig])
    title = recording.scene.get("name") or recording.name
    numbers, scene, answer = metric_table(metrics), scene_rows(recording.scene), answer_of(recording, metrics)
    # The template has the layout; every text is escaped there
    return rendered(TEMPLATE, {
        "title": title, "description": recording.scene.get("description") or "", "bag_name": recording.name,
        "date": recording.date, "answer": answer, "conditions": conditions,
        "largest": " · ".join(filter(None, (facts.largest_values(recording), facts.without_error(metrics)))),
        "drawing": drawing_of(of_rig, str(title)), "warnings": [*facts.warnings(recording), *doubts_of(metrics)],
        "tiles": tiles_of(first_metrics(recording, metrics)), "numbers": numbers, "maps": map_views(recording), "lead": lead,
        "drawn": parts, "contents": [Entry("result", "Result"), Entry("time", "Time and maps"),
                                     *(Entry(each.key, each.title) for each in parts),
                                     Entry("setup", "Set-up"), Entry("files", "Files")],
        "folds": [*first_folds(answer.more), *folds_of(parts), Entry("fold-scene", "Scene, effects and software"),
                  *([Entry("fold-resolved", "The whole resolved scene")] if scene else []),
                  Entry("fold-topics", "Topics of the bag")],
        "run": facts.run_rows(recording), "effects": facts.effect_rows(recording),
        "excitations": facts.excitation_facts(recording), "versions": facts.version_rows(recording), "scene": scene,
        "topics": topic_table(recording), "commands": commands_of(recording), "data": Markup(page_data(recording)),  # noqa: S704
    }, scripts=True)  # fmt: skip


def sections(recording: Recording, on_section: OnSection = lambda *_: None) -> list[Section]:
    """Sections with pictures, in the order of the page; what the scene lacks has none."""
    drawn: list[tuple[str, Callable[[], list[Section]]]] = [
        (name, partial(_contact_sections, number, name, recording)) for number, name in enumerate(recording.contacts)
    ]
    for report in rig_reports.reports_of(recording):
        if report.closing_sections:
            drawn.append((report.contact, partial(load(report.closing_sections), recording)))
    ledger, cost = recording.ledger, recording.cost
    if ledger is not None:
        scope = rig_reports.ledger_scope(recording)
        drawn.append(("energy", lambda: [Section("energy", "Energy", [energy_balance(ledger, scope)], part=TRUST)]))
    if cost is not None:
        drawn.append(("cost", lambda: [Section("cost", "Cost", [real_time_factor(cost)], part=TRUST)]))
    found: list[Section] = []
    with style():
        for number, (name, draw) in enumerate(drawn):
            on_section(number, len(drawn), name)
            found += draw()
    return [section for section in found if section.pictures]


def _lead_names(recording: Recording) -> list[str]:
    """Beginnings of the names of the pictures on the first screen: those of `ContactReport.lead`."""
    number = {name: f"contact-{place}" for place, name in enumerate(recording.contacts)}
    names = [
        name.format(contact=number.get(each.contact, ""))
        for each in rig_reports.reports_of(recording)
        for name in each.lead
    ]
    return list(dict.fromkeys(names))


def _contact_sections(number: int, name: str, recording: Recording) -> list[Section]:
    """Sections of a contact: those of its rig, or the general one."""
    report = contact_reports().get(name)
    if report is None or not report.sections:
        return [contact_section(number, name, recording)]
    found: list[Section] = load(report.sections)(number, recording)
    return found
