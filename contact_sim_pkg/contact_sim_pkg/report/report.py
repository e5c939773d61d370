"""The report of a bag: one HTML page with every picture inside, without scripts and without
anything to load.
"""

from __future__ import annotations

from pathlib import Path

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.files import check_output, new_file
from contact_sim_pkg.records.registry import contact_reports
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report import facts, rig_reports
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.figures.bench import energy_balance, real_time_factor
from contact_sim_pkg.report.figures.contact import contact_section
from contact_sim_pkg.report.page import Section, environment, is_page
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rows import scene_rows
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.report.tiles import tiles

TEMPLATE = "report.html.j2"
FILE_NAME = "report.html"


def write_report(bag: Bag, out: Path | None = None, *, overwrite: bool = False) -> Path:
    """Write the report of a bag.

    Args:
        bag: opened with `open_bag`; unfinished bags give a report of what they hold.
        out: file to write; a page of this command is made again, another
            file only by `overwrite`; `report.html` in the bag's directory where it is None.

    Returns:
        Where the page is.

    Raises:
        BagError: the bag cannot be read.
        FileRefusedError: `out` is another file, or part of a bag that is read.
    """
    path = bag.path.parent / FILE_NAME if out is None else out
    read = (bag.path, bag.path.parent)
    check_output(path, read, overwrite=overwrite, ours=is_page)
    # Everything is read before the file is touched
    page = render(read_recording(bag))
    with new_file(path, read, overwrite=overwrite, ours=is_page) as file:
        file.write(page.encode())
    return path


def render(recording: Recording) -> str:
    """The page as text. Everything that comes from the bag is escaped."""
    summary = summarise_recording(recording)
    page: str = (
        environment()
        .get_template(TEMPLATE)
        # The template has the layout; every text is escaped there
        .render(
            title=recording.scene.get("name") or recording.name,
            description=recording.scene.get("description") or "",
            bag_name=recording.name,
            warnings=facts.warnings(recording),
            tiles=tiles(summary, rig_reports.rig_tiles(recording, summary)),
            run=facts.run_rows(recording),
            effects=facts.effect_rows(recording),
            excitations=facts.excitation_facts(recording),
            versions=facts.version_rows(recording),
            scene=scene_rows(recording.scene),
            sections=sections(recording),
            topics=recording.topics,
            duration=recording.duration,
        )
    )
    return page


def sections(recording: Recording) -> list[Section]:
    """Sections with pictures, in the order of the page; what the scene lacks has none."""
    with style():
        found: list[Section] = []
        for number, name in enumerate(recording.contacts):
            found += _contact_sections(number, name, recording)
        for report in rig_reports.reports_of(recording):
            found += load(report.closing_sections)(recording) if report.closing_sections else []
        if recording.ledger is not None:
            found.append(Section("energy", "Energy", [energy_balance(recording.ledger)]))
        if recording.cost is not None:
            found.append(Section("cost", "Cost", [real_time_factor(recording.cost)]))
    return [section for section in found if section.pictures]


def _contact_sections(number: int, name: str, recording: Recording) -> list[Section]:
    """Sections of a contact: those of its rig, or the general one."""
    report = contact_reports().get(name)
    if report is None or not report.sections:
        return [contact_section(number, name, recording)]
    found: list[Section] = load(report.sections)(number, recording)
    return found
