"""`bench compare`: the metrics of several bags side by side, against tolerances."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import print_json, show_rows


@click.command("compare")
@click.argument("bags", nargs=-1, required=True, metavar="A B...", type=click.Path(path_type=Path))
@click.option(
    "--tolerances", type=click.Path(path_type=Path), metavar="FILE",
    help="YAML: metric or curve, absolute, relative; exit code 1 where a bag misses one against A.",
)  # fmt: skip
@click.option("--json", "form", flag_value="json", help="One JSON object on standard output.")
@click.option("--csv", "form", flag_value="csv", help="A row a metric.")
@click.option("--junit", "form", flag_value="junit", help="JUnit XML: a test case a tolerance.")
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
def command(bags: tuple[Path, ...], tolerances: Path | None, form: str | None, skip_bad: bool) -> int:
    """Print the metrics of bags of one rig side by side, what moved most first.

    `bench report A B` draws the page. With tolerances a bag is a regression test of another.
    """
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.compare.side_by_side import misses, read_tolerances, side_by_side
    from contact_sim_pkg.report.comparison.curves import compared
    from contact_sim_pkg.report.comparison.rows import csv_text, junit_text_of, rows_of, table_rows
    from contact_sim_pkg.report.comparison.runs import distinct_names
    from contact_sim_pkg.report.metrics.of_bag import recording_of
    from contact_sim_pkg.report.reading import refuse_other_rigs, rig_of_bag

    if form == "junit" and tolerances is None:
        raise click.UsageError("--junit needs --tolerances FILE: a test case is a tolerance.")
    wanted = [] if tolerances is None else read_tolerances(tolerances)
    opened = [open_bag(each, skip_bad=skip_bad) for each in bags]
    refuse_other_rigs([rig_of_bag(bag) for bag in opened])
    recordings = [recording_of(bag) for bag in opened]
    runs = [compared(name, each) for name, each in zip(distinct_names(recordings), recordings, strict=True)]
    names, sides, missed = [each.name for each in runs], side_by_side(runs), misses(runs, wanted)
    if not sides:
        raise BagError(f"{', '.join(names)} have no metrics: there is nothing to compare")
    failed = [miss for _, found in missed for miss in found]
    if form == "json":
        print_json({"bags": [str(each) for each in bags], "metrics": rows_of(names, sides),
                    "misses": [miss._asdict() for miss in failed]})  # fmt: skip
    elif form == "csv":
        say(csv_text(names, sides), nl=False)
    elif form == "junit":
        say(junit_text_of(names, missed), nl=False)
    else:
        show_rows(table_rows(names, sides), as_json=False)
        for miss in failed:
            say(f"MISSED {miss.run}: {miss.sentence}")
        if wanted and not failed:
            say(f"all {len(wanted)} tolerances hold")
    return 1 if failed else 0
