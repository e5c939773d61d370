"""`bench plan`: the cases of a file, and whether they hold what it requires."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_rows
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.sweep.plan import Judged


@click.command("plan")
@click.argument("plan", required=False)
@click.option(
    "--out", type=click.Path(path_type=Path), default=None, metavar="DIR", help="Folder: a sweep each in its own."
)
@click.option(
    "--jobs", type=click.IntRange(1, 1024), default=None, metavar="N", help="Processes.  [default: processors]"
)
@click.option(
    "--scheduler", default="", metavar="tcp://HOST:PORT", help="Workers of a Dask scheduler in place of processes here."
)
@click.option(
    "--keep-bags", default="none", show_default=True, metavar="none|all|worst:N:METRIC", help="As of `bench sweep`."
)
@click.option("--junit", "junit_file", type=click.Path(path_type=Path), default=None, metavar="FILE", help="JUnit XML.")
@overwrite_option
@json_option
def command(
    plan: str | None,
    out: Path | None,
    jobs: int | None,
    scheduler: str,
    keep_bags: str,
    junit_file: Path | None,
    overwrite: bool,
    as_json: bool,
) -> int:
    """Run the cases of PLAN, a shipped one or a file, and say for each requirement whether they hold it, by how much, and
    what the worst case is. Without PLAN, list the shipped ones.

    Cases that have run do not run again. Exit code 1 on a miss or a run that failed, 3 where something could not be
    judged, which says what would decide it.
    """
    from contact_sim_pkg.files import FileRefusedError, check_output, new_file, wrong_name
    from contact_sim_pkg.sweep import plan as plans
    from contact_sim_pkg.sweep.page import PAGES, write_plan_page

    if plan is None:
        shipped = [plans.read_plan(name) for name in plans.shipped_plans()]
        show_rows(
            [
                {
                    "plan": each.name,
                    "cases": sum(len(part.values) for part in each.sweeps),
                    "description": each.description,
                }
                for each in shipped
            ],
            as_json,
        )
        return 0
    if out is None:
        raise click.UsageError("--out DIR is where the cases go")
    if reason := wrong_name(out):
        raise FileRefusedError(out, reason)
    if out.exists() and not out.is_dir():
        raise FileRefusedError(out, "exists already and is no folder; give another name")
    if junit_file is not None:
        check_output(junit_file, overwrite=overwrite)
    found = plans.read_plan(plan)
    try:
        outcomes, tables = plans.run_plan(found, out, jobs=jobs, scheduler=scheduler, keep_bags=keep_bags, notify=doing)
    except KeyboardInterrupt:
        say(f"interrupted; what has ended is in {out}, the same command goes on", err=True)
        return 1
    if junit_file is not None:
        with new_file(junit_file, overwrite=overwrite) as file:
            file.write(plans.junit(found, outcomes).encode())
    doing("drawing the page")
    page = write_plan_page(out / PAGES["plan"], found, outcomes, tables)
    rows, failed = plans.judged_rows(outcomes), [each for each in outcomes if each.failure]
    if as_json:
        print_json({
            "plan": found.name, "page": str(page), "requirements": [each._asdict() for each in rows],
            "failed": [{"sweep": each.sweep, "values": each.values, "sentence": each.failure} for each in failed],
        })  # fmt: skip
        return plans.status_of(outcomes)
    show_rows([each._asdict() for each in rows], False)
    for outcome in failed:
        say(f"{outcome.sweep} {plans.set_by(outcome.values)} did not finish: {outcome.failure}", err=True)
    say(f"{_sentence(rows, len(outcomes), len(failed))}; {page} shows them")
    return plans.status_of(outcomes)


def _sentence(rows: list[Judged], cases: int, failed: int) -> str:
    """`3 requirements over 12 cases: 2 pass, 1 MISS`."""
    verdicts = [each.verdict for each in rows]
    counts = ", ".join(f"{verdicts.count(each)} {each}" for each in dict.fromkeys(verdicts)) or "nothing required"
    return f"{len(rows)} requirements over {cases} cases: {counts}" + (f"; {failed} did not finish" if failed else "")
