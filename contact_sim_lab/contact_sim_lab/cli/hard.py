"""`bench hard`: the hard cases."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections

if TYPE_CHECKING:
    from contact_sim_pkg.records.table import Section


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
    """Value, expectation, margin and verdict of each hard case; exit code 1 if one fails.

    With --accuracy fifteen hard scenes at four requests; exit code 1 if one errs by more than it
    requests in force or motion, and nothing names that. With --effects forty effects of scenes that
    mislead a rule; exit code 1 if more than six verdicts are not the expected ones. With --regimes the
    regime that each shipped scene expects, measured in a whole run; exit code 1 if one is missed.
    """
    if accuracy + effects + regimes > 1:
        raise click.UsageError("--accuracy, --effects and --regimes are three tables; give one of them")
    found: Callable[[list[dict[str, Any]]], list[Section]]
    if accuracy:
        from contact_sim_lab.hard import accuracy_table

        rows = accuracy_table.study(_tell)
        found, failed = accuracy_table.sections, accuracy_table.failed(rows)
    elif effects:
        from contact_sim_lab.hard import effect_table

        rows = effect_table.study(_tell)
        found, failed = effect_table.sections, effect_table.failed(rows)
    elif regimes:
        from contact_sim_lab.hard import regime_table

        rows = regime_table.study(_tell)
        found, failed = regime_table.sections, regime_table.failed(rows)
    else:
        from contact_sim_lab.hard import hard_cases

        rows = hard_cases.study(None, _tell)
        found, failed = hard_cases.sections, hard_cases.failed(rows)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(found(rows))
    context.exit(1 if failed else 0)


def _tell(line: str) -> None:
    say(line, err=True)
