"""`bench goals`: goals of the bench, and what this machine reaches."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("goals")
@click.option("--start", is_flag=True, help="The first block of every scene instead, cold and warm: some minutes.")
@click.option(
    "--latency", type=click.FloatRange(min=5.0), metavar="S",
    help="Only the latency of the full bench at real time, over a run of S seconds (the table: 60 s).",
)  # fmt: skip
@json_option
def command(start: bool, latency: float | None, as_json: bool) -> None:
    """Start-up, speed, latency, report and error against their goals, measured in one run; a missed goal is
    shown only.
    """
    from contact_sim_pkg.studies.goals import goals, starts

    def notify(line: str) -> None:
        click.echo(line, err=True)

    rows = starts.study(notify) if start else goals.study(notify, latency)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(starts.sections(rows) if start else goals.sections(rows))
