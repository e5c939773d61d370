"""`bench list` and `bench show`: the shipped scenes, and one with all that it leaves open."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, show_rows
from contact_sim_pkg.cli.scene_options import SceneOptions, scene_options


@click.command("list")
@json_option
def list_command(as_json: bool) -> None:
    """Scenes that come with the package, smallest first."""
    from contact_sim_pkg.scene.load import list_scenes

    rows = [{"scene": entry.name, "rig": entry.rig, "description": entry.description} for entry in list_scenes()]
    show_rows(rows, as_json)


@click.command("show")
@scene_options
def show_command(options: SceneOptions) -> None:
    """The resolved SCENE: every default, grid and tolerance, as stored in a bag."""
    say(options.resolve().to_yaml(), nl=False)
