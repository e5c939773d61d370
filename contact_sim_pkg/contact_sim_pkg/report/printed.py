"""One figure of the report of a bag, for print."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path
from typing import IO

from matplotlib import rc_context
from matplotlib.figure import Figure

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.place import free_figure, new_figure_file
from contact_sim_pkg.report.reading import OnRead, read_recording
from contact_sim_pkg.report.report import OnSection, sections
from contact_sim_pkg.report.series import Recording

__all__ = ["figure_named", "figures_of", "save_figure", "write_figure"]

DOTS_PER_INCH = 300
UNDATED: dict[str, dict[str, None]] = {"png": {"Software": None}, "svg": {"Date": None, "Creator": None}}
"""Metadata by the format: nothing in a file changes from one day to the next."""
OUTLINES = {"svg.fonttype": "path"}
"""A letter is drawn, so that it looks the same where its font is missing."""


def write_figure(
    bag: Bag,
    kind: str,
    name: str,
    out: Path | None = None,
    *,
    overwrite: bool = False,
    on_section: OnSection = lambda *_: None,
    on_read: OnRead = lambda _: None,
) -> Path:
    """Write one figure of the report of a bag, on white.

    Args:
        bag: opened with `open_bag`.
        kind: `png`, of 300 dpi, or `svg`.
        name: of the figure, one of `figures_of`, or its first words: `rolling-road` for `rolling-road-0-10`.
        out: file to write, which ends in the format; `NAME.KIND` in the bag's directory where it is None.
        overwrite: whether an existing file is replaced.
        on_section: called before each section is drawn.
        on_read: called while the bag is read, with the share that has been.

    Returns:
        Where the figure is.

    Raises:
        BagError: the bag cannot be read, or its report has no such figure; names the nearest and all.
        FileRefusedError: the file exists, is read, or ends in another format.
    """
    path = free_figure(bag, kind, name, out, overwrite=overwrite)
    figure = figure_named(name, read_recording(bag, on_read), on_section)
    with new_figure_file(path, bag, overwrite=overwrite) as file:
        save_figure(file, figure, kind)
    return path


def save_figure(file: IO[bytes], figure: Figure, kind: str, dots_per_inch: float = DOTS_PER_INCH) -> None:
    """Write a figure into a file, on white; `dots_per_inch` is that of a PNG, and of maps within an SVG."""
    with style(), rc_context(OUTLINES):
        figure.savefig(file, format=kind, dpi=dots_per_inch, facecolor="white", metadata=UNDATED[kind])


def figure_named(name: str, recording: Recording, on_section: OnSection = lambda *_: None) -> Figure:
    """The figure of a report with this name, or the first that begins with its words.

    Raises BagError with the nearest name and all of them.
    """
    found = figures_of(recording, on_section)
    for each, figure in found.items():
        if each == name or each.startswith(f"{name}-"):
            return figure
    near = get_close_matches(name, found, 1, 0.0)
    nearest = f"; nearest is {near[0]}" if near else ""
    raise BagError(f"{recording.name}: its report has no figure {name!r}{nearest}; it has {', '.join(found) or 'none'}")


def figures_of(recording: Recording, on_section: OnSection = lambda *_: None) -> dict[str, Figure]:
    """The figures of a report by their names, in the order of its page; those of a contact are called after it."""
    contacts = {f"contact-{number}": name for number, name in enumerate(recording.contacts)}
    found = {}
    for each in (picture for section in sections(recording, on_section) for picture in section.pictures):
        # contact-0-map -> tire-map
        place = next((place for place in contacts if each.name.startswith(f"{place}-")), "")
        name = contacts[place] + each.name.removeprefix(place) if place else each.name
        if each.figure is not None:
            found[name] = each.figure
    return found
