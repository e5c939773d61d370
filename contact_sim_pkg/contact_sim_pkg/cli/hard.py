"""`bench hard`: the hard cases."""

from __future__ import annotations

import click

from .tables import json_option, show_rows

PASSED = "pass"


@click.command("hard")
@json_option
@click.pass_context
def command(context: click.Context, as_json: bool) -> None:
    """Value, expectation, margin and verdict of each hard case; ends 1 if one fails."""
    from contact_sim_pkg.studies import hard_cases

    rows = hard_cases.study(None, lambda line: click.echo(line, err=True))
    show_rows(rows, as_json)
    context.exit(0 if all(row["verdict"] == PASSED for row in rows) else 1)
