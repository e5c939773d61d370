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
RIDE, LOADS = ("dynamic load coefficient", "load, mean"), ("load, largest", "load, smallest")
ASKED = (
    ("tire_rough_road", (), RIDE), ("tire_belgian_block", (), RIDE), ("tire_braking", (), ("load, largest", "vertical stiffness")),
    ("tire_cleat", (), LOADS), ("car_ride", (), ("SEAT", "a_w, Wk", "dynamic load coefficient")),
    ("car_full_bench", (), ("SEAT", "T(f) at its peak")), ("seat_ride_full", ("accuracy=1e-2",), ("SEAT",)),
    ("impact_rubber_drop", (), ("all",)),
    ("impact_temperature_sweep", ("duration=18",), ("restitution e of the first", "peak force of the first")),
    ("roller_flutter", (), ("growth rate of tilt and yaw",)), ("tire_irregular_road", (), ("load, mean",)),
)  # fmt: skip
"""Scenes, values of `--set` and metrics that somebody wants of them."""
BEGIN, END = (f"<!-- tables made from contact_sim_pkg.studies.effects.savings: {word} -->" for word in ("begin", "end"))
ASKED_BEGIN, ASKED_END = (each.replace("tables made", "tables of metrics made") for each in (BEGIN, END))


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


def table_of_metrics(notify: Callable[[str], None]) -> list[str]:
    """Lines of the table of what metrics need: the scene as it stands, and the lean one that has the same metrics."""
    lines = ["| scene | for | left out | ms/s | lean | times cheaper | changes |", "|---|---|---|---|---|---|---|"]
    for name, values, metrics in ASKED:
        study = study_of(load_resolved(name, *values), notify, off=False, metrics=metrics)
        found = reduced(study, notify, observers=False)
        shown = " ".join((f"`{name}`", *(f"`{each}`" for each in values)))
        left_out = ", ".join(f"{row.contact.name} {row.effect.name}" for row in found.left_out) or "nothing"
        lines.append(
            f"| {shown} | {', '.join(metrics)} | {left_out} | {study.cost:.3g} | {found.cost:.3g} | "
            f"{study.cost / found.cost:.2g} | {_changed(found)} |"
        )
        notify(lines[-1])
    return lines


def with_table(page: str, lines: Sequence[str], begin: str = BEGIN, end: str = END) -> str:
    """A page with the table in the place of the one before."""
    before, _, rest = page.partition(begin)
    return "\n".join([before + begin, "", *lines, "", end + rest.partition(end)[2]])


def main(arguments: list[str]) -> int:
    """Write the table into the given page; `--metrics`: that of metrics."""
    path, notify = Path(arguments[0]), partial(click.echo, err=True)
    if arguments[1:] == ["--metrics"]:
        lines, begin, end = table_of_metrics(notify), ASKED_BEGIN, ASKED_END
    else:
        lines, begin, end = table_of(arguments[1:] or SCENES, notify), BEGIN, END
    path.write_text(with_table(path.read_text(encoding="utf-8"), lines, begin, end), encoding="utf-8")
    return 0


def _changed(found: Reduced) -> str:
    most = verdicts.largest(found.changes)
    return "nothing" if most is None or most.size == 0.0 else verdicts.shown(most)


def _line(name: str, study: Study, found: Reduced, seconds: float) -> str:
    left_out = ", ".join(row.effect.name for row in found.left_out) or "nothing"
    changed = _changed(found)
    saving = f"{100.0 * found.saving:.0f} %" if found.left_out else "–"
    return f"| {name} | {number_of(study.base.request)} | {left_out} | {saving} | {changed} | {seconds:.0f} |"


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
