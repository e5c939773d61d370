"""`bench hard`: the hard cases."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("hard")
@click.option(
    "--accuracy", is_flag=True, help="Hard scenes at 1e-1 to 1e-4 instead: held, named by the run, or missed."
)
@json_option
@click.pass_context
def command(context: click.Context, accuracy: bool, as_json: bool) -> None:
    """Value, expectation, margin and verdict of each hard case; exit code 1 if one fails.

    With --accuracy fifteen hard scenes at four requests; exit code 1 if one errs by more than it
    requests in force or motion, and nothing names that.
    """
    if accuracy:
        from contact_sim_pkg.studies.hard import accuracy_table

        rows = accuracy_table.study(_tell)
        found, failed = accuracy_table.sections, accuracy_table.failed(rows)
    else:
        from contact_sim_pkg.studies.hard import hard_cases

        rows = hard_cases.study(None, _tell)
        found, failed = hard_cases.sections, hard_cases.failed(rows)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(found(rows))
    context.exit(1 if failed else 0)


def _tell(line: str) -> None:
    click.echo(line, err=True)
