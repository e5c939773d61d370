"""The report of a bag: one HTML page with every picture inside, without scripts and without anything to load."""

from __future__ import annotations

from pathlib import Path

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.files import check_output, new_file
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.drawing import Picture, style
from contact_sim_pkg.report.figures.bench import energy_balance, real_time_factor
from contact_sim_pkg.report.figures.contact import (
    footprint_over_time,
    load_over_approach,
    load_over_time,
    pressure_maps,
)
from contact_sim_pkg.report.page import Section, environment, is_page
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rows import scene_rows
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.report.tiles import tiles
from contact_sim_pkg.rigs.backrest.report.numbers import BACKREST
from contact_sim_pkg.rigs.backrest.report.section import backrest_parts
from contact_sim_pkg.rigs.body.report.numbers import BLOCK
from contact_sim_pkg.rigs.body.report.section import block_parts
from contact_sim_pkg.rigs.impact.report.section import IMPACT, impact_parts
from contact_sim_pkg.rigs.roller.report.section import ROLLER, roller_parts
from contact_sim_pkg.rigs.roller.report.warnings import roller_warnings
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import seat_spectrum, seat_transmissibility
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import TIRE
from contact_sim_pkg.rigs.vehicle.tire.report.section import FRICTION_KEY, KEY, friction_pictures, tire_part

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
        .render(
            title=recording.scene.get("name") or recording.name,
            description=recording.scene.get("description") or "",
            bag_name=recording.name,
            warnings=facts.warnings(recording) + roller_warnings(recording.roller),
            tiles=tiles(summary),
            run=facts.run_rows(recording),
            effects=facts.effect_rows(recording),
            excitations=facts.excitation_facts(recording),
            versions=facts.version_rows(recording),
            scene=scene_rows(recording.scene),
            sections=sections(recording),
            vibration=summary.get("seat_vibration"),
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
            if name == ROLLER and recording.roller is not None:
                found += [Section(*part) for part in roller_parts(recording)]
                continue
            if name == BLOCK and recording.motion is not None:
                found += [Section(*part) for part in block_parts(number, recording)]
                continue
            if name == IMPACT:
                found += [Section(*part) for part in impact_parts(recording)]
                continue
            if name == BACKREST:
                found += [Section(*part) for part in backrest_parts(recording)]
                continue
            found.append(_contact_section(number, name, recording))
            if name == TIRE:
                rolling = tire_part(recording)
                found.append(Section(KEY, "Rolling tire", rolling.pictures, rolling.tables))
                found.append(Section(FRICTION_KEY, "Friction of the tire", friction_pictures(recording)))
        found.append(Section("ride", "Seat vibration", _ride_pictures(recording)))
        if recording.ledger is not None:
            found.append(Section("energy", "Energy", [energy_balance(recording.ledger)]))
        if recording.cost is not None:
            found.append(Section("cost", "Cost", [real_time_factor(recording.cost)]))
    return [section for section in found if section.pictures]


def _contact_section(number: int, name: str, recording: Recording) -> Section:
    contact, field = recording.contacts[name], recording.fields.get(name)
    key = f"contact-{number}"
    pictures = [load_over_time(key, name, contact)]
    if field is not None:
        pictures.append(pressure_maps(key, name, field))
    if field is not None and field.time.size > 1:
        pictures.append(footprint_over_time(key, name, field))
    curve = load_over_approach(key, name, contact)
    pictures += [] if curve is None else [curve]
    return Section(key, f"{name.capitalize()} contact", pictures)


def _ride_pictures(recording: Recording) -> list[Picture]:
    signals = ride_signals(recording.motion)
    if signals is None:
        return []
    found = [seat_spectrum(signals), seat_transmissibility(signals)]
    return [each for each in found if each is not None]
