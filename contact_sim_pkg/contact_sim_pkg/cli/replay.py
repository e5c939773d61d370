"""`bench replay`: publishes a bag again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


class Number(click.FloatRange):
    """A float in a range; what is no number is refused too."""

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
    help="Recorded time to begin at.",
)
@click.option(
    "--delay",
    type=Number(0.0, 3600.0),
    default=0.5,
    show_default=True,
    metavar="S",
    help="Time before the first message.",
)
@click.option("--topics", multiple=True, metavar="NAME", help="Replay only this topic; may be given several times.")
@click.option("--clock", is_flag=True, help="Publish the recorded time on /clock.")
@click.pass_context
def command(
    context: click.Context,
    bag: Path,
    rate: float,
    start_offset: float,
    delay: float,
    topics: tuple[str, ...],
    clock: bool,
) -> None:
    """Publish the messages of BAG as they were recorded: bytes, spacing, quality of service."""
    from contact_sim_pkg.nodes.supervisor import node_arguments, set_default_environment

    set_default_environment()
    from contact_sim_pkg.nodes.bag_replay import main

    parameters: dict[str, str | float | bool] = {
        "bag": str(bag), "rate": rate, "start_offset": start_offset, "delay": delay, "clock": clock,
        "topics": ",".join(topics),
    }  # fmt: skip
    context.exit(main(["bench", *node_arguments(parameters)]))
