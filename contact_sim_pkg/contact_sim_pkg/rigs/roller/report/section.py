"""The part of the page on a roller on its shaft; what the run lacks is absent."""

from __future__ import annotations

from contact_sim_pkg.report.figures.contact import contact_section
from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.report.figures import (
    contact_over_time,
    load_spectrogram,
    motion_over_time,
    pressure_and_volume,
    stability_map,
)
from contact_sim_pkg.rigs.roller.report.figures_programme import programme_over_time
from contact_sim_pkg.rigs.roller.report.figures_stress import stress_pictures
from contact_sim_pkg.rigs.roller.report.figures_track import track_pictures
from contact_sim_pkg.rigs.roller.report.series import roller_of
from contact_sim_pkg.rigs.roller.report.tables import stability_table, volume_tables


def roller_sections(number: int, recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; the general section where the bag holds no state of the
    roller.
    """
    roller = roller_of(recording)
    if roller is None:
        return [contact_section(number, "roller", recording)]
    scene = recording.scene
    first = [
        programme_over_time(roller, scene), pressure_and_volume(roller), contact_over_time(roller), motion_over_time(roller),
        load_spectrogram(roller),
    ]  # fmt: skip
    stable, table = stability_map(roller, scene), stability_table(roller.stability, float(scene["block_length"]))
    return [
        Section("roller", "Rolling contact", [each for each in first if each is not None], []),
        Section("stability", "Stability of tilt and yaw", [stable] if stable else [], [table] if table else []),
        Section("track", "Track", track_pictures(roller, scene), []),
        Section(
            "stress", "Stress and dangerous volumes", stress_pictures(roller, scene), volume_tables(roller.volumes)
        ),
    ]
