"""`bench effects`: what each effect costs and feeds."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_sections


@click.command("effects")
@click.argument("scene")
@json_option
def command(scene: str, as_json: bool) -> None:
    """Each effect of SCENE, on or off: its measured cost and the outputs that it feeds."""
    from contact_sim_pkg.studies.effects import ablation

    rows = ablation.study(scene, lambda line: click.echo(line, err=True))
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(ablation.sections(rows))
