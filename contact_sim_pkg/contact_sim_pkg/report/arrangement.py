"""Which pictures the page shows at once, and which it folds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.page import CONTACT, FREQUENCY, PUBLISHED, TRUST, Section
from contact_sim_pkg.report.tables import Table

__all__ = ["Entry", "Part", "arranged", "first_folds", "folds_of", "leading"]

MOST_SHOWN = 6
"""Pictures that are shown at once, those of the first screen among them."""
TITLES = {FREQUENCY: "Frequency", CONTACT: "Contact", PUBLISHED: "Against published", TRUST: "Trust"}


class Entry(NamedTuple):
    """One line of the contents."""

    key: str
    title: str


class Part(NamedTuple):
    """One part of the page below its first screen."""

    key: str
    title: str
    shown: list[Picture]
    folded: list[Picture]
    tables: list[Table]
    folded_tables: list[tuple[str, Table]]
    """with the key of the fold"""


def leading(names: Sequence[str], drawn: list[Section]) -> list[Picture]:
    """The pictures whose names begin so, else the first of all, taken out of their sections."""
    found = []
    for name in names or ("",):
        for section in drawn:
            chosen = [each for each in section.pictures if each.name.startswith(name)][:1]
            found += chosen
            section.pictures[:] = [each for each in section.pictures if each not in chosen]
            if chosen:
                break
    return found or (leading((), drawn) if names else [])


def arranged(sections: Sequence[Section], shown: int, tables: dict[str, list[Table]]) -> list[Part]:
    """Parts of the page with the first picture of each section open as long as there is room, the rest folded; what is
    published has its room.

    Args:
        sections: those that were drawn.
        shown: pictures that stand on the first screen.
        tables: further tables of a part, which stand open.
    """
    parts = []
    room = MOST_SHOWN - sum(each.part == PUBLISHED for each in sections)
    for key, title in TITLES.items():
        room = MOST_SHOWN if key == PUBLISHED else room
        inside = [each for each in sections if each.part == key]
        part = Part(key, title, [], [], tables.get(key, []), [])
        for section in inside:
            first = 1 if shown < room and key != TRUST else 0
            shown += min(first, len(section.pictures))
            part.shown.extend(section.pictures[:first])
            part.folded.extend(section.pictures[first:])
            part.folded_tables.extend((f"{section.key}-{place}", each) for place, each in enumerate(section.tables))
        if any(part[2:]):
            parts.append(part)
    return parts


def first_folds(more: Sequence[str]) -> list[Entry]:
    """Folds of the first screen; ``more``: what is folded behind the answer."""
    return [*([Entry("fold-answer", "All of the answer")] if more else []), Entry("fold-metrics", "All metrics")]


def folds_of(parts: Sequence[Part]) -> list[Entry]:
    """Every fold of the parts, by what it opens on."""
    return [
        entry for part in parts
        for entry in (
            *(Entry(each.name, each.description) for each in (*part.shown, *part.folded)),
            *(Entry(f"fold-{key}", f"Table: {each.title or each.header[0] or part.title}") for key, each in part.folded_tables),
        )
    ]  # fmt: skip
