"""Table of `docs/effects.md`: what `bench effects --write` leaves out of shipped scenes, and saves.

``python -m contact_sim_pkg.studies.effects.savings docs/effects.md [SCENE...]``
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import click

from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.effects_study import Study, study_of
from contact_sim_pkg.studies.effects.reduced import Reduced, all_together, reduced

__all__ = ["SCENES", "main", "table_of", "with_table"]

SCENES = (
    "seat_ride", "impact_rubber_drop", "impact_temperature_sweep", "roller_corrugation", "seat_ride_full", "tire_cleat",
    "car_full_bench", "tire_braking",
)  # fmt: skip
FROM_ALL = ("impact_rubber_drop",)
BEGIN, END = (f"<!-- tables made from contact_sim_pkg.studies.effects.savings: {word} -->" for word in ("begin", "end"))


def table_of(scenes: Sequence[str], notify: Callable[[str], None]) -> list[str]:
    """Lines of the table."""
    lines = ["| scene | at | left out | saves | changes | CPU s |", "|---|---|---|---|---|---|"]
    for name in scenes:
        resolved = load_resolved(name)
        lines += _of_scene(f"`{name}`", resolved, notify, (True, False))
        if name in FROM_ALL:
            lines += _of_scene(f"`{name}` from all", all_together(resolved), notify, (True,), off=False)
    return lines


def _of_scene(
    name: str, scene: ResolvedScene, notify: Callable[[str], None], ways: Sequence[bool], *, off: bool = True
) -> Iterator[str]:
    """Lines of a scene with and without its observers; the second only where that is another scene."""
    began = time.process_time()
    study, before = study_of(scene, notify, off=off), -1
    for observers in ways:
        found = reduced(study, notify, observers=observers)
        if len(found.left_out) != before:
            line = _line(
                f"{name}{'' if observers else ' without observers'}", study, found, time.process_time() - began
            )
            notify(line)
            yield line
        before = len(found.left_out)


def with_table(page: str, lines: Sequence[str]) -> str:
    """A page with the table in the place of the one before."""
    before, _, rest = page.partition(BEGIN)
    return "\n".join([before + BEGIN, "", *lines, "", END + rest.partition(END)[2]])


def main(arguments: list[str]) -> int:
    """Write the table into the given page."""
    path = Path(arguments[0])
    lines = table_of(arguments[1:] or SCENES, partial(click.echo, err=True))
    path.write_text(with_table(path.read_text(encoding="utf-8"), lines), encoding="utf-8")
    return 0


def _line(name: str, study: Study, found: Reduced, seconds: float) -> str:
    most = verdicts.largest(found.changes)
    left_out = ", ".join(row.effect.name for row in found.left_out) or "nothing"
    changed = "nothing" if most is None or most.size == 0.0 else verdicts.shown(most)
    saving = f"{100.0 * found.saving:.0f} %" if found.left_out else "–"
    return f"| {name} | {number_of(study.base.request)} | {left_out} | {saving} | {changed} | {seconds:.0f} |"


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
