"""The part of the page on impacts of a sphere; what the run lacks is absent."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.impact.report.figures import (
    bounces,
    force_over_depth,
    force_over_time,
    front_over_time,
    position_over_time,
)
from contact_sim_pkg.rigs.impact.report.figures_maps import stress_over_radius, wave_in_space_and_time
from contact_sim_pkg.rigs.impact.report.figures_material import material_picture
from contact_sim_pkg.rigs.impact.report.material import material_of_run
from contact_sim_pkg.rigs.impact.report.series import impacts_of


def impact_sections(_number: int, recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; empty where no impact ended."""
    impacts = impacts_of(recording)
    if impacts is None:
        return []
    material = material_picture(impacts, material_of_run(impacts, recording.scene))
    first = _made([bounces(impacts, recording.motion), force_over_time(impacts), force_over_depth(impacts)])
    around = _made([
        stress_over_radius(impacts), wave_in_space_and_time(impacts), front_over_time(impacts), position_over_time(impacts),
    ])  # fmt: skip
    return [
        Section("impact", "Impacts", first),
        Section("around", "In and around the contact", around),
        Section("material", "Material from the impacts", _made([material])),
    ]


def _made(pictures: Sequence[Picture | None]) -> list[Picture]:
    return [each for each in pictures if each is not None]
