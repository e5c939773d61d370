"""`bench list`: the shipped scenes, one line each."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.tables import json_option, show_rows


@click.command("list")
@json_option
def command(as_json: bool) -> None:
    """Scenes that come with the package, smallest first."""
    from contact_sim_pkg.scene.load import list_scenes

    rows = [{"scene": entry.name, "rig": entry.rig, "description": entry.description} for entry in list_scenes()]
    show_rows(rows, as_json)
