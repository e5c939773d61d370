"""`bench hard`: the hard cases."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("hard")
@json_option
@click.pass_context
def command(context: click.Context, as_json: bool) -> None:
    """Value, expectation, margin and verdict of each hard case; exit code 1 if one fails."""
    from contact_sim_pkg.studies.hard import hard_cases

    rows = hard_cases.study(None, lambda line: click.echo(line, err=True))
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(hard_cases.sections(rows))
    context.exit(1 if hard_cases.failed(rows) else 0)
