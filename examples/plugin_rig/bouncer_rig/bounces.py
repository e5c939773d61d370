"""`bench bounces BAG`: how often the mass of a recorded run has struck the pad."""

from pathlib import Path

import click
import numpy

from contact_sim_pkg.bag.reader import open_bag


@click.command("bounces")
@click.argument("bag", type=click.Path(path_type=Path))
def command(bag: Path) -> None:
    """Count the impacts in BAG."""
    normal = open_bag(bag).columns("foot/force", ("normal",))["normal"]  # [messages, samples] N
    pressed = numpy.concatenate(list(normal)) > 0.0
    click.echo(f"{int((pressed[1:] & ~pressed[:-1]).sum())} impacts")
