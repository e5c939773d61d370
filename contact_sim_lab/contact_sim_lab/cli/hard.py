"""`bench hard`: the hard cases."""

from __future__ import annotations

from typing import Any

import click

from contact_sim_pkg.cli.output.say import say, tell
from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections

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
    hard; exit code 1 if one fails or is not hard.

    With --accuracy fifteen hard scenes at four requests, a line each as it comes; exit code 1 if one errs
    by more than it requests in force or motion, and nothing names that, or if it is not hard. With
    --effects forty effects of scenes that mislead a rule, a line each as it comes; exit code 1 if more
    than six verdicts are not the expected ones. With --regimes the regime that each shipped scene
    expects, measured in a whole run; exit code 1 if one is missed.
    """
    if accuracy + effects + regimes > 1:
        raise click.UsageError("--accuracy, --effects and --regimes are three tables; give one of them")
    if accuracy:
        from contact_sim_lab.hard import accuracy_table

        rows = _told_at_once(accuracy_table, as_json)
        failed = accuracy_table.failed(rows)
    elif effects:
        from contact_sim_lab.hard import effect_table

        rows = _told_at_once(effect_table, as_json)
        failed = effect_table.failed(rows)
    elif regimes:
        from contact_sim_lab.hard import regime_table

        rows = _told_at_once(regime_table, as_json)
        failed = regime_table.failed(rows)
    else:
        from contact_sim_lab.hard import hard_cases

        rows = hard_cases.study(None, tell)
        failed = hard_cases.failed(rows)
        if not as_json:
            show_sections(hard_cases.sections(rows))
    if as_json:
        print_json_rows(rows)
    context.exit(1 if failed else 0)


def _told_at_once(table: Any, as_json: bool) -> list[dict[str, Any]]:
    """Rows of a table that takes minutes, each case a line as it comes, in columns of `WIDTHS`, and a summary."""
    rows: list[dict[str, Any]] = []
    for found in table.study(tell):
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
