"""`bench effects`: which effects a scene calls for."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json, show_sections


@click.command("effects")
@click.argument("scene")
@click.option("--parts", is_flag=True, help="Behind the table: every change, reasons, outputs.")
@json_option
def command(scene: str, parts: bool, as_json: bool) -> None:
    """Which effects SCENE calls for: each left out or added, what that changes and saves."""
    from contact_sim_pkg.studies.effects import effects_study, effects_table

    found = effects_study.study(scene, _report)
    if as_json:
        print_json(effects_table.facts_of(found))
        return
    click.echo(effects_table.answer(found))
    click.echo()
    show_sections([*effects_table.table(found), *(effects_table.parts(found) if parts else ())])


def _report(line: str) -> None:
    click.echo(line, err=True)
