"""`bench hard`: the hard cases."""

from __future__ import annotations

from typing import Any

import click

from contact_sim_pkg.cli.output.say import announce, say
from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections
from contact_sim_pkg.records.metric import exit_status

USUAL_WIDTH = 15
WIDTHS = {
    "CPU s": 5,
    "mark": 8,
    "scene": 24,
    "met": 6,
    "value": 18,
    "case": 34,
    "effect": 32,
    "verdict": 40,
}  # of the lines that come one by one


@click.command("hard")
@click.option(
    "--accuracy", is_flag=True, help="Hard scenes at 1e-1 to 1e-4 instead: held, named by the run, or missed."
)
@click.option(
    "--effects", is_flag=True, help="Verdicts of `bench effects` instead: forty, beside what was expected of each."
)
@click.option("--regimes", is_flag=True, help="What each shipped scene is there to show instead: jams, slaps, grows, …")
@json_option
@click.pass_context
def command(context: click.Context, accuracy: bool, effects: bool, regimes: bool, as_json: bool) -> None:
    """Value, expectation, margin and verdict of each hard case, and the figure that shows that its run is
    hard; exit code 1 if one fails, 3 if one is not hard.

    With --accuracy fifteen hard scenes at four requests, a line each as it comes; exit code 1 if one errs
    by more than it requests in force or motion, and nothing names that, 3 if it is not hard. With
    --effects forty effects of scenes that mislead a rule, a line each as it comes; exit code 1 if more
    than six verdicts are not the expected ones. With --regimes the regime that each shipped scene
    expects, measured in a whole run; exit code 1 if one is missed, 3 if a scene expects none.
    """
    if accuracy + effects + regimes > 1:
        raise click.UsageError("--accuracy, --effects and --regimes are three tables; give one of them")
    table: Any
    if accuracy:
        from contact_sim_lab.hard import accuracy_table as table
    elif effects:
        from contact_sim_lab.hard import effect_table as table
    elif regimes:
        from contact_sim_lab.hard import regime_table as table
    else:
        from contact_sim_lab.hard import hard_cases as table
    if accuracy or effects or regimes:
        rows = _told_at_once(table, as_json)
    else:
        rows = table.study(None, announce)
        if not as_json:
            show_sections(table.sections(rows))
    if as_json:
        print_json_rows(rows)
    context.exit(exit_status(missed=table.failed(rows), unjudged=table.unjudged(rows)))


def _told_at_once(table: Any, as_json: bool) -> list[dict[str, Any]]:
    """Rows of a table that takes minutes, each case a line as it comes, in columns of `WIDTHS`, and a summary."""
    rows: list[dict[str, Any]] = []
    for found in table.study(announce):
        if not as_json:
            cells = table.cells(found)
            if not rows:
                say(_line({name: name for name in cells}))
            say(_line(cells))
        rows += found
    if not as_json:
        say(table.summary(rows))
    return rows


def _line(cells: dict[str, str]) -> str:
    return "  ".join(text.ljust(WIDTHS.get(name, USUAL_WIDTH)) for name, text in cells.items()).rstrip()
