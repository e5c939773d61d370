"""`bench sweep`: many cases of one scene over the processors, and their table."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, print_json, show_rows
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.sweep.cost import Cost
    from contact_sim_pkg.sweep.table import SweepTable
    from contact_sim_pkg.sweep.variation import Values

MOST_FAULTS = 5
"""Sentences of failed cases that are printed; all are in the table."""


@click.command("sweep")
@click.argument("scene")
@click.option(
    "--vary", "varied", multiple=True, metavar="KEY=LOW:HIGH:N|A,B,C",
    help="What varies: a range with its number of points, :log behind it for equal ratios, or a list; may be repeated.",
)  # fmt: skip
@click.option(
    "--seeds", type=click.IntRange(1), default=None, metavar="N", help="Each case N times, with seeds 1 to N."
)
@click.option(
    "--sample", default="grid", show_default=True, metavar="grid|lhs:N|sobol:N|saltelli:N|FILE.csv",
    help="All combinations, N drawn ones, N (keys + 2) for Sobol indices, or the rows of a file whose header names keys.",
)  # fmt: skip
@click.option("--sample-seed", type=click.IntRange(0), default=1, show_default=True, help="Of what is drawn.")
@click.option(
    "--jobs", type=click.IntRange(1, 1024), default=None, metavar="N", help="Processes.  [default: processors]"
)
@click.option(
    "--scheduler", default="", metavar="tcp://HOST:PORT", help="Workers of a Dask scheduler in place of processes here."
)
@click.option(
    "--keep-bags", default="none", show_default=True, metavar="none|all|worst:N:METRIC",
    help="In DIR/bags; the N cases of its largest values, or 'worst:N:METRIC > LIMIT' those that hold a limit least.",
)  # fmt: skip
@click.option(
    "--out", type=click.Path(path_type=Path), default=None, metavar="DIR", help="Folder: table.csv, cases, bags."
)
@click.option("--dry-run", is_flag=True, help="Check the cases, say how many and what they cost; run none.")
@json_option
def command(
    scene: str,
    varied: tuple[str, ...],
    seeds: int | None,
    sample: str,
    sample_seed: int,
    jobs: int | None,
    scheduler: str,
    keep_bags: str,
    out: Path | None,
    dry_run: bool,
    as_json: bool,
) -> int:
    """Run SCENE once for each combination of what varies, without ROS, and write the metrics of all to table.csv in DIR.

    A case is known by its resolved scene, its files and the version of the bench: the same command goes on where it was
    interrupted, and one with more values runs only what is new. The metrics are those of `bench metrics`. Exit code 1
    where a case failed.
    """
    from contact_sim_pkg.sweep.cost import cost_of
    from contact_sim_pkg.sweep.kept import read_kept
    from contact_sim_pkg.sweep.page import PAGES, Swept, write_page
    from contact_sim_pkg.sweep.sensitivity import drawn_points
    from contact_sim_pkg.sweep.sweep import check_folder, sweep, texts_of, try_ends
    from contact_sim_pkg.sweep.variation import read_variation, samples_of

    if out is None and not dry_run:
        raise click.UsageError("--out DIR is where the table goes; or --dry-run")
    if out is not None:
        check_folder(out)
    kept = read_kept(keep_bags)
    variations = [read_variation(each) for each in varied]
    values = samples_of(variations, sample, seeds or 0, sample_seed)
    doing(f"checking {len(values)} cases")
    try_ends(scene, variations, values)
    if dry_run:
        _say_plan(values, cost_of(scene, values, texts_of(values[0]), kept, out), as_json=as_json)
        return 0
    assert out is not None
    try:
        table = sweep(scene, values, out, jobs=jobs, scheduler=scheduler, keep_bags=keep_bags, notify=doing)
    except KeyboardInterrupt:
        say(f"interrupted; what has ended is in {out}, the same command goes on", err=True)
        return 1
    doing("drawing the page")
    page = write_page(
        out / PAGES["sweep"], "sweep", Path(scene).stem, [Swept(scene, scene, table, out, points=drawn_points(sample))]
    )
    _say_table(table, out, page, as_json=as_json)
    return 1 if table.failed else 0


def _say_plan(values: list[Values], cost: Cost, *, as_json: bool) -> None:
    """How many cases, of what, and what they cost."""
    keys = {key: len({each[key] for each in values}) for key in values[0]}
    if as_json:
        print_json({
            "cases": len(values), "keys": keys, "cpu_s": cost.cpu, "bytes": cost.disk if math.isfinite(cost.disk) else None,
            "measured_cases": cost.measured,
        })  # fmt: skip
    else:
        say(f"{len(values)} cases: " + ", ".join(f"{count} values of {key}" for key, count in keys.items()))
        if cost.measured:
            basis = f"as the {cost.measured} that have run" if cost.measured > 1 else "as the one that has run"
            disk = f"{1e-6 * cost.disk:.3g} MB" if math.isfinite(cost.disk) else "disk not known until a bag is kept"
            say(f"about {cost.cpu / 3600.0:.2g} CPU hours, {disk}, {basis}")
        else:
            say(f"at least {cost.cpu / 3600.0:.2g} CPU hours by the scene; disk not known until one case has run")


def _say_table(table: SweepTable, out: Path, page: Path, *, as_json: bool) -> None:
    """What the metrics do over the cases, the cases that failed, and where all of it is."""
    ranges = table.ranges()
    if as_json:
        print_json({
            "cases": len(table), "failed": [dict(each) for each in table.failed], "table": str(out / "table.csv"),
            "page": str(page), "metrics": [each._asdict() for each in ranges],
        })  # fmt: skip
        return
    if ranges:
        show_rows(
            [
                {"metric": each.metric, "smallest": each.smallest, "largest": each.largest, "unit": each.unit,
                 "in cases": f"{each.smallest_in}, {each.largest_in}", "moves with": each.moved_by}
                for each in ranges
            ],
            False,
        )  # fmt: skip
    for row in table.failed[:MOST_FAULTS]:
        values = ", ".join(f"{key}={row[key]}" for key in table.keys)
        say(f"case {row['number']} ({values}) {row['outcome']}: {row['sentence']}", err=True)
    if len(table.failed) > MOST_FAULTS:
        say(f"and {len(table.failed) - MOST_FAULTS} more", err=True)
    say(f"{len(table)} cases, {len(table.failed)} failed; {out / 'table.csv'} has a row each, {page} shows them")
