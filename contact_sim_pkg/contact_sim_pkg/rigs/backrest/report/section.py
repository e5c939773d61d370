"""The part of the page on a backrest: contact, contact domain, slaps and slips; what the run lacks
is absent.
"""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.figures.contact import footprint_over_time, pressure_maps
from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.episodes import slaps_of
from contact_sim_pkg.rigs.backrest.report.figures_domain import AT_BACKREST, area_over_time, contact_domain, slap_stages
from contact_sim_pkg.rigs.backrest.report.figures_loops import force_loops
from contact_sim_pkg.rigs.backrest.report.figures_slaps import force_with_slaps, restitution_over_time, share_over_time
from contact_sim_pkg.rigs.backrest.report.numbers import BACKREST


def backrest_sections(_number: int, recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; the recording has a contact of this name."""
    contact, field, name = recording.contacts[BACKREST], recording.fields.get(BACKREST), BACKREST
    slaps = slaps_of(recording.episodes)
    first: list[Picture | None] = [
        force_with_slaps("backrest", name, contact, slaps),
        force_loops("backrest", name, recording),
    ]
    first += [share_over_time("backrest", name, recording)]
    # The domain needs a recorded pressure map.
    domain: list[Picture | None] = []
    if field is not None:
        domain = [contact_domain("domain", name, field, recording.points)]
        domain += [slap_stages("domain", name, field)] if field.heaviest.load > 0.0 else []
        domain += [area_over_time("domain", name, field, slaps), pressure_maps("domain", name, field, AT_BACKREST)]
        domain += [footprint_over_time("domain", name, field)] if field.time.size > 1 else []
    return [
        Section("backrest", "Backrest contact", _made(first)),
        Section("domain", "Contact domain", _made(domain)),
        Section("slaps", "Slaps", _made([restitution_over_time("slaps", name, slaps)])),
    ]


def _made(pictures: Sequence[Picture | None]) -> list[Picture]:
    return [each for each in pictures if each is not None]
