"""`bench goals`: what the bench is asked to reach, and what it reaches on this machine."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("goals")
@json_option
def command(as_json: bool) -> None:
    """Start-up, speed and error against their goals, measured in one run; a goal that is missed is shown, no more."""
    from contact_sim_pkg.studies.goals import goals as benchmark

    rows = benchmark.study(lambda line: click.echo(line, err=True))
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(benchmark.sections(rows))
