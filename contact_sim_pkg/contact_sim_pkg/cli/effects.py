"""`bench effects`: which effects a scene calls for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import announce, say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_sections

if TYPE_CHECKING:
    from contact_sim_pkg.studies.effects.effects_study import Study


@click.command("effects")
@click.argument("scene")
@click.option("--parts", is_flag=True, help="Behind the table: every change, reasons, outputs.")
@click.option(
    "--write",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the scene with only what it calls for.",
)
@click.option("--without-observers", is_flag=True, help="With --write: leave out what only observes as well.")
@click.option(
    "--from",
    "start",
    type=click.Choice(["scene", "all"]),
    default="scene",
    show_default=True,
    help="Start from the effects of the scene, or from all that can act together.",
)
@click.option(
    "--metric",
    "metrics",
    multiple=True,
    metavar="NAME",
    help="What this metric needs, over the whole run: key or name as printed, or all; may be repeated.",
)
@overwrite_option
@json_option
def command(
    scene: str,
    parts: bool,
    write: Path | None,
    without_observers: bool,
    start: str,
    metrics: tuple[str, ...],
    overwrite: bool,
    as_json: bool,
) -> int:
    """Which effects SCENE calls for: each left out or added, what that changes and saves; with --metric, what these
    metrics need, whatever else changes. Exit code 1 where one is off
    but needed, 3 where the error of the numbers decides.
    """
    if without_observers and write is None:
        raise click.UsageError("--without-observers is for the scene that --write FILE writes")
    if without_observers and metrics:
        raise click.UsageError("--without-observers: with --metric nothing stays that the metrics do not need")
    from contact_sim_pkg.files import check_output
    from contact_sim_pkg.records.metric import exit_status
    from contact_sim_pkg.scene.load import find_scene
    from contact_sim_pkg.scene.resolve import load_resolved
    from contact_sim_pkg.studies.effects import effects_study, effects_table, reduced, verdicts

    if write is not None:
        check_output(write, [find_scene(scene)], overwrite=overwrite)
        if write.suffix not in (".yaml", ".yml"):
            raise click.UsageError(f"--write {write}: the name of a scene's file ends in .yaml")
    resolved = load_resolved(scene)
    everything = start == "all"  # what is off then replaces what is on: a choice of the model
    studied = reduced.all_together(resolved) if everything else resolved
    found = effects_study.study_of(studied, announce, off=not everything and not metrics, metrics=metrics)
    if not as_json:
        say(effects_table.answer(found))
        say()
        show_sections([*effects_table.table(found), *(effects_table.parts(found) if parts else ())])
    written = {}
    if write is not None:
        written = _write(found, scene, write, observers=not (without_observers or metrics), overwrite=overwrite)
    if as_json:
        print_json(effects_table.facts_of(found) | written)
    elif written:
        say(f"{write}: {written['written']['sentence']}")
    found_ones = [row.verdict for row in found.rows]
    return exit_status(missed=verdicts.OFF_NEEDED in found_ones, unjudged=verdicts.NUMBERS in found_ones)


def _write(study: Study, scene: str, path: Path, *, observers: bool, overwrite: bool) -> dict[str, dict[str, object]]:
    from contact_sim_pkg.files import new_file
    from contact_sim_pkg.studies.effects import effects_table, reduced
    from contact_sim_pkg.studies.effects.of_metrics import MetricBase

    found = reduced.reduced(study, announce, observers=observers)
    with new_file(path, overwrite=overwrite) as stream:
        stream.write(
            reduced.text_of(
                scene, (), found, study.base.request, of_metrics=isinstance(study.base, MetricBase)
            ).encode()
        )
    return {"written": effects_table.facts_of_reduced(found, path)}
