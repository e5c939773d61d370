"""`bench replay`: publishes a bag again."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.progress import RunDisplay

if TYPE_CHECKING:
    from contact_sim_pkg.bag.reader import Bag


class Number(click.FloatRange):
    """A float in a range; anything else is refused."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number."""
        number = super().convert(value, param, ctx)
        if number != number:
            self.fail(f"{value} is not in the range {self._describe_range()}.", param, ctx)
        return number


@click.command("replay")
@click.argument("bag", type=click.Path(path_type=Path))
@click.option("--rate", type=Number(0.001, 1000.0), default=1.0, show_default=True, help="Recorded seconds per second.")
@click.option(
    "--start-offset",
    type=Number(0.0, 1e9),
    default=0.0,
    show_default=True,
    metavar="S",
    help="Recorded time to begin at, since the first message.",
)
@click.option(
    "--start-message",
    type=click.IntRange(0),
    default=0,
    show_default=True,
    metavar="N",
    help="Number of the message to begin at, from 0, among those replayed.",
)
@click.option(
    "--delay",
    type=Number(0.0, 3600.0),
    default=0.5,
    show_default=True,
    metavar="S",
    help="Least time before the first message; matched subscribers are waited for in any case.",
)
@click.option("--topics", multiple=True, metavar="NAME", help="Replay only this topic; may be given several times.")
@click.option(
    "--remap",
    "remapped",
    multiple=True,
    metavar="OLD:=NEW",
    help="Publish a topic under another name; may be given several times.",
)
@click.option("--loop", is_flag=True, help="Begin again after the end.")
@click.option("--clock", is_flag=True, help="Publish the recorded time on /clock.")
@click.pass_context
def command(
    context: click.Context,
    bag: Path,
    rate: float,
    start_offset: float,
    start_message: int,
    delay: float,
    topics: tuple[str, ...],
    remapped: tuple[str, ...],
    loop: bool,
    clock: bool,
) -> None:
    """Publish the messages of BAG as they were recorded: bytes, spacing, quality of service. The
    space key pauses.
    """
    from contact_sim_pkg.nodes.processes.environment import node_arguments, set_default_environment

    set_default_environment()
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.nodes.bag_replay import main

    recorded = open_bag(bag)
    parameters = parameters_of(
        bag=bag, rate=rate, start_offset=start_offset, start_message=start_message, delay=delay, loop=loop, clock=clock,
        topics=topics,
    )  # fmt: skip
    rules = [part for rule in rules_of(remapped, recorded) for part in ("-r", ":=".join(rule))]
    with RunDisplay((recorded.end - recorded.begin) * 1e-9, "waiting for the subscribers", "message") as display:
        status = main(
            ["bench", *node_arguments(parameters), *rules],
            lambda progress: display.update(progress.simulated, progress.describe()),
        )
    context.exit(status)


def parameters_of(*, bag: Path, topics: tuple[str, ...], **others: float | bool) -> dict[str, str | float | bool]:
    """Parameters of the node for these options of the command."""
    return {"bag": str(bag.absolute()), "topics": ",".join(topics), **others}


def rules_of(remapped: tuple[str, ...], bag: Bag) -> list[tuple[str, str]]:
    """Remappings by the topics' full names; BagError where the bag has no such topic."""
    return [_rule(text, bag) for text in remapped]


def _rule(text: str, bag: Bag) -> tuple[str, str]:
    old, sign, new = text.partition(":=")
    if not (sign and old and new):
        raise click.BadParameter(f"{text!r} is not OLD:=NEW, such as tire/force:=left/force", param_hint="--remap")
    return bag.topic(old).name, new
