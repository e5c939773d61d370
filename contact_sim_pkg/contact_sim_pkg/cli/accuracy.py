"""`bench accuracy`: what accuracy costs in time, on this machine."""

from __future__ import annotations

from pathlib import Path

import click

from .tables import json_option, print_json_rows, show_sections


@click.command("accuracy")
@click.argument("scene")
@click.option(
    "--plot", type=click.Path(path_type=Path), metavar="FILE", help="Error over time, both logarithmic, as a picture."
)
@json_option
def command(scene: str, plot: Path | None, as_json: bool) -> None:
    """For each rung, tolerance and grid of SCENE: error against a reference, time per simulated second, first call."""
    from contact_sim_pkg.studies import accuracy_cost

    rows = accuracy_cost.study(scene, lambda line: click.echo(line, err=True))
    if plot is not None:
        accuracy_cost.write_plot(rows, plot)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(accuracy_cost.sections(rows))
