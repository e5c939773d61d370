"""`bench recover`: a whole bag from a cut one."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import say


@click.command("recover")
@click.argument("bag", type=click.Path(path_type=Path))
@click.argument("target", type=click.Path(path_type=Path))
@click.pass_context
def command(context: click.Context, bag: Path, target: Path) -> None:
    """Write what can be read of BAG into the new bag TARGET; exit code 3 where messages are lost."""
    from contact_sim_pkg.bag.recover import recover

    recovery = recover(bag, target)
    say(f"{recovery.path}: {recovery.messages} messages{f'; {recovery.sentence}' if recovery.sentence else ''}")
    context.exit(0 if recovery.lossless else 3)
