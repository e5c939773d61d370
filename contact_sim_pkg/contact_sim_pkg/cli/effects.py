"""`bench effects`: cost and outputs of each effect."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("effects")
@click.argument("scene")
@json_option
def command(scene: str, as_json: bool) -> None:
    """Each effect of SCENE, on and off: its measured cost and its influence on the outputs."""
    from contact_sim_pkg.studies.effects import ablation

    rows = ablation.study(scene, lambda line: click.echo(line, err=True))
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(ablation.sections(rows))
