"""`bench goals`: goals of the bench, and what this machine reaches."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("goals")
@json_option
def command(as_json: bool) -> None:
    """Start-up, speed and error against their goals, measured in one run; a missed goal is shown
    only.
    """
    from contact_sim_pkg.studies.goals import goals as benchmark

    rows = benchmark.study(lambda line: click.echo(line, err=True))
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(benchmark.sections(rows))
