"""Measure and show; runs in the comparison's own environment (`python -m comparisons.field` makes it)."""

from __future__ import annotations

import json
import os
import platform
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

import click

from comparisons.environment import ONE_THREAD
from comparisons.field.agreement import Agreement, agreements
from comparisons.field.measure import Row, SetUp, measure
from comparisons.field.picture import draw
from comparisons.field.plan import FULL, QUICK, Task
from comparisons.field.readings import Reading, Verdict, readings, verdicts
from comparisons.field.solver import Candidate, candidates
from comparisons.field.table import agreement_lines, reading_lines, row_lines, set_up_lines, verdict_lines
from contact_sim_pkg.files import check_output

__all__ = ["main"]

PICTURE = Path(sys.prefix) / "compare_field.png"


class Result(NamedTuple):
    """Everything that a run found."""

    solvers: list[Candidate]
    missing: dict[str, str]  # solvers that are not installed, with the reason
    rows: list[Row]
    set_ups: list[SetUp]
    refused: list[str]
    readings: list[Reading]
    verdicts: list[Verdict]
    agreements: list[Agreement]


@click.command()
@click.option("--quick", is_flag=True, help="Small grids, few seeds and steps: does it work? Not for conclusions.")
@click.option("--only", default="", help="Problems whose name contains this, as '(d)'.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object on standard output, and nothing else.")
@click.option("--plot", default=PICTURE, show_default=True, type=click.Path(path_type=Path), help="The picture (PNG).")
@click.option("--overwrite", is_flag=True, help="Write over a picture that exists.")
def main(quick: bool, only: str, as_json: bool, plot: Path, overwrite: bool) -> None:
    """Solve the same pressure fields with this project's solver and with others, and compare time at equal error."""
    overwrite = overwrite or plot == PICTURE  # its own, made again each time
    check_output(plot, overwrite=overwrite)
    began = time.perf_counter()
    several = [name for name in ONE_THREAD if os.environ.get(name) != "1"]
    if several:
        raise click.UsageError(
            f"{', '.join(several)} must be 1 for a fair comparison: run `python -m comparisons.field`"
        )
    tasks = [task for task in (QUICK if quick else FULL) if only in task.name]
    if not tasks:
        raise click.UsageError(f"--only {only}: no problem is named so; allowed are parts of {[t.name for t in FULL]}")
    solvers, missing = candidates()
    for name, reason in missing.items():
        _tell(f"{name} is left out: {reason}")
    rows, set_ups, refused = _measure(tasks, solvers)
    read = [one for task in tasks for one in readings(task, rows)]
    result = Result(solvers, missing, rows, set_ups, refused, read, verdicts(read), agreements(solvers))
    seconds = time.perf_counter() - began
    click.echo(json.dumps(_as_json(result, seconds), indent=2) if as_json else _as_text(result, seconds))
    draw(rows, plot, overwrite=overwrite)
    _tell(f"picture: {plot}")


def _measure(tasks: list[Task], solvers: list[Candidate]) -> tuple[list[Row], list[SetUp], list[str]]:
    rows: list[Row] = []
    set_ups: list[SetUp] = []
    refused: list[str] = []
    for task in tasks:
        found = measure(task, solvers, _tell)
        rows += found[0]
        set_ups += found[1]
        refused += found[2]
    return rows, set_ups, list(dict.fromkeys(refused))


def _as_json(result: Result, seconds: float) -> dict[str, Any]:
    return {
        "python": platform.python_version(),
        "seconds": seconds,
        "solvers": [{"name": one.name, "version": one.version, "settings": one.settings} for one in result.solvers],
        "left out": result.missing,
        "not solved": result.refused,
        "at equal error": [one._asdict() for one in result.readings],
        "aims": [{**one._asdict(), "aim": one.aim._asdict()} for one in result.verdicts],
        "agreement": [one._asdict() for one in result.agreements],
        "set-up": [one._asdict() for one in result.set_ups],
        "rows": [one._asdict() for one in result.rows],
    }


def _as_text(result: Result, seconds: float) -> str:
    parts = [f"{one.name} {one.version}: {one.settings}" for one in result.solvers]
    parts += [f"{name} is left out: {reason}" for name, reason in result.missing.items()]
    sections = (
        ("Everything measured", row_lines(result.rows)),
        ("Set-up, not part of the times", set_up_lines(result.set_ups)),
        ("The same discrete problem?", agreement_lines(result.agreements)),
        ("Not solved, by the solver's own word", result.refused),
        ("Time at equal error, medians over seeds", reading_lines(result.readings)),
        ("What was aimed at", verdict_lines(result.verdicts)),
    )
    for title, lines in sections:
        parts += ["", title, "", *lines] if lines else []
    busiest = max(row.wall_ms / row.ms for row in result.rows)
    parts += ["", f"{seconds:.0f} s; wall time was up to {busiest:.2f} times the processor time: 1 on a quiet machine."]
    return "\n".join(parts)


def _tell(text: str) -> None:
    click.echo(text, err=True)


if __name__ == "__main__":
    main()
