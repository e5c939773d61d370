"""Work of the rig backrest, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.fields import given
from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.rigs.backrest.cushion import build_back_cushion
from contact_sim_pkg.rigs.backrest.model import shallow_shell
from contact_sim_pkg.rigs.backrest.schema import BackrestSection, ShellModesSection
from contact_sim_pkg.rigs.backrest.shell import natural_frequencies
from contact_sim_pkg.run.integrator_work import Link, integrator_steps, segments
from contact_sim_pkg.run.linear_laws import links_of_laws
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["back_steps", "work_of_backrest"]

POINT_COST, MODE_COST = 1.2e-7, 1.8e-9
"""[s] of a point of a shell in a step, and of each mode at a point: measured within a quarter with 9
and 25 modes at 320 and 4096 points.
"""


def work_of_backrest(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of a back against a seat back."""
    shell = scene.effect("backrest", ShellModesSection)
    yield segments(scene, STEP_COST + _cost_of_points(shell))
    yield from back_steps(scene)


def back_steps(scene: ResolvedScene) -> Iterator[Work]:
    """Steps of the contact, and of the fastest mode of a shell; each takes the longer, the more points
    and modes a shell has.
    """
    backrest, shell = scene.section(BackrestSection), scene.effect("backrest", ShellModesSection)
    load = float(backrest.preload or 0.0)
    links = [*links_of_laws(scene, "backrest", given(backrest.mass), load, build_back_cushion)]
    if shell is not None:
        links.append(_fastest_mode(backrest, shell))
    yield from integrator_steps(scene, "backrest", links, STEP_COST + _cost_of_points(shell))


def _cost_of_points(shell: ShellModesSection | None) -> float:
    """Cost [s] of the points of a shell in a step."""
    return 0.0 if shell is None else shell.points_up * shell.points_across * (POINT_COST + MODE_COST * shell.modes)


def _fastest_mode(backrest: BackrestSection, shell: ShellModesSection) -> Link:
    """The mode of a shell with the highest frequency. It hardly moves: its steps are as long as is
    stable, 3.3 over the magnitude of its eigenvalue, as those of a damper of that rate.
    """
    highest = float(natural_frequencies(shallow_shell(backrest, shell), shell.modes).max())
    return Link("shell_modes", 1.0, 0.0, max(1.0, 2.0 * shell.damping_ratio) * highest)
