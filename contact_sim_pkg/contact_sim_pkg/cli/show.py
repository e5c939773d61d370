"""`bench show`: a scene with every default, grid and tolerance written out."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.scene_options import SceneOptions, scene_options


@click.command("show")
@scene_options
def command(options: SceneOptions) -> None:
    """The resolved SCENE: every default, grid and tolerance, as stored in a bag."""
    click.echo(options.resolve().to_yaml(), nl=False)
