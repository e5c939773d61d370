"""Work of the rig backrest, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.rigs.backrest.cushion import build_back_cushion
from contact_sim_pkg.rigs.backrest.schema import BackrestSection, ShellModesSection
from contact_sim_pkg.run.integrator_work import integrator_steps, links_of_laws, segments
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["back_steps", "work_of_backrest"]

POINT_COST = 2e-8  # [s] of a mode of a point in a step


def work_of_backrest(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of a back against a seat back."""
    yield segments(scene)
    yield from back_steps(scene)


def back_steps(scene: ResolvedScene) -> Iterator[Work]:
    """Steps of the contact; of a shell each takes the longer, the more points it has."""
    backrest, shell, cost = scene.section(BackrestSection), scene.effect("backrest", ShellModesSection), STEP_COST
    if shell is not None:
        cost += POINT_COST * shell.modes * shell.points_up * shell.points_across
    load = float(backrest.preload or 0.0)
    laws = links_of_laws(scene, "backrest", given(backrest.mass), load, build_back_cushion)
    yield from integrator_steps(scene, "backrest", laws, cost)
