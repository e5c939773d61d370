"""`bench metrics`: the list of metrics of a bag, or mean and spread of repeated runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import announce, say
from contact_sim_pkg.cli.output.tables import print_json, require_option

if TYPE_CHECKING:
    from contact_sim_pkg.records.metric import Metric


@click.command("metrics")
@click.argument("bags", nargs=-1, required=True, metavar="BAG...", type=click.Path(path_type=Path))
@click.option("--json", "form", flag_value="json", help="One JSON object on standard output.")
@click.option("--csv", "form", flag_value="csv", help="A row a metric.")
@click.option(
    "--junit", "form", flag_value="junit", help="JUnit XML: outside its band is a failure, doubtful an error."
)
@click.option(
    "--all", "whole", is_flag=True, help="Whole lists of all contacts, and the pressure mats with their zones."
)
@click.option(
    "--loaded",
    type=click.FloatRange(min=0.0),
    metavar="PA",
    help="Pressure above which a cell of a mat counts; with --all.  [default: outputs.loaded_pressure of the scene, 1]",
)
@click.option(
    "--axis", metavar="x|y|z|Wk|Wd|...", help="Of a bag without our topics: axis, or weighting, or both as y:Wd."
)
@click.option("--topic", metavar="NAME", help="Of a bag without our topics: the one to weight.")
@click.option(
    "--unit", type=click.Choice(["m/s^2", "g", "mg"]), help="Of a bag without our topics: unit of its accelerations."
)
@click.option(
    "--up",
    type=click.Choice(["x", "y", "z", "-x", "-y", "-z"]),
    help="Of a bag without our topics: axis that points up; else by gravity.",
)
@require_option
@click.option(
    "--error",
    "pair",
    is_flag=True,
    help="Of a run of the bench: numerical error of every metric, by two more runs on half the cells.",
)
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
def command(
    bags: tuple[Path, ...],
    form: str | None,
    whole: bool,
    loaded: float | None,
    axis: str | None,
    topic: str | None,
    unit: str | None,
    up: str | None,
    wanted: tuple[str, ...],
    pair: bool,
    skip_bad: bool,
) -> int:
    """Print the metrics of BAG with their bands and verdicts.

    Of several bags, repeated runs of one scene, mean and spread; by ISO 10326-1 a SEAT needs runs within 5 % of
    their mean. `bench compare` has two seats side by side. Exit code 1 where a metric lies outside its band, 3
    where what --require asks for cannot be judged.
    """
    from contact_sim_pkg.report.metrics.foreign import ForeignOptions
    from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags, suite_name
    from contact_sim_pkg.report.metrics.requirements import bands_of, exit_code, read_requirements, required
    from contact_sim_pkg.report.metrics.views import csv_of, junit_of, lines_of, rows_of, verdict_line

    given = ForeignOptions(axis, topic, unit, up)
    for_foreign = None if given == ForeignOptions() else given
    requirements = read_requirements(wanted)
    found = metrics_of_bags(
        bags, whole=whole, loaded=loaded, chosen=for_foreign, skip_bad=skip_bad, bands=bands_of(requirements)
    )
    _notes([*found.warnings, *found.notes])
    if pair and (for_foreign is not None or loaded is not None):
        raise click.UsageError(
            "--error is for the usual list, --all too: leave --axis, --topic, --unit, --up and --loaded out"
        )
    made = _with_errors(bags, found.metrics, found.warnings) if pair else found.metrics
    metrics = required(made, requirements)
    rows = rows_of(metrics)
    if form == "json":
        print_json({"bags": [str(each) for each in bags], "warnings": found.warnings, "metrics": rows})
    elif form == "csv":
        say(csv_of(metrics), nl=False)
    elif form == "junit":
        say(junit_of(suite_name(bags), metrics, found.warnings), nl=False)
    else:
        for line in (*lines_of(rows), verdict_line(rows, found.above)):
            say(line)
    return exit_code(metrics)


def _with_errors(bags: Sequence[Path], metrics: list[Metric], warnings: list[str]) -> list[Metric]:
    """The metrics with their errors by a pair of runs of the scene of the one bag."""
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.compare.recorded import scene_of_bag
    from contact_sim_pkg.studies.pair import with_errors_of_pair

    if len(bags) > 1:
        raise click.UsageError("--error is for one bag; repeated runs have their spread")
    if warnings:
        raise BagError(f"--error: the scene of {bags[0]} does not make this run again: {warnings[0]}")
    return with_errors_of_pair(scene_of_bag(bags[0]), metrics, announce)


def _notes(notes: Sequence[str]) -> None:
    for note in notes:
        say(note, err=True)
