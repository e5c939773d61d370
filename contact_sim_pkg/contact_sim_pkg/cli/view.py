"""`bench view`: a page on this machine that follows a bag, or the nodes that run."""

from __future__ import annotations

import os
import signal
import time
import webbrowser
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.files import RefusedError

if TYPE_CHECKING:
    from contact_sim_pkg.view.server import ViewServer

LOOK_SECONDS = 0.02  # between two looks at the bag
BEHIND = 10  # of niceness: what shows a bench must not keep it from its time


@click.command("view")
@click.argument("bag", required=False, type=click.Path(path_type=Path))
@click.option("--topics", is_flag=True, help="Follow the topics of running nodes (needs ROS), as without BAG.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="Of 127.0.0.1; else any that is free."
)
@click.option("--open", "opened", is_flag=True, help="Open the page in the browser.")
@click.pass_context
def command(context: click.Context, bag: Path | None, topics: bool, port: int, opened: bool) -> None:
    """Show BAG, or the bench that runs, on a live page: forces, accelerations, pressure maps.

    The page is for this machine alone. It plays a bag at pace 1, pauses, steps and seeks. Ctrl-C ends it.
    """
    if bag is not None and topics:
        raise click.UsageError("--topics follows running nodes; a BAG is played without them.")
    try:
        import_module("websockets")
    except ImportError:
        raise RefusedError(
            "the live page needs websockets, which is not installed; pip install 'contact_sim_pkg[view]'"
        ) from None
    if bag is None:
        context.exit(_follow(port, opened))
    _play(bag, port, opened)


def _play(bag: Path, port: int, opened: bool) -> None:
    """Play a bag until Ctrl-C."""
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.view.recorded import RecordedSource
    from contact_sim_pkg.view.scope import Scope
    from contact_sim_pkg.view.server import ViewServer

    recorded, scope = open_bag(bag), Scope()
    for note in recorded.notes:
        say(note, err=True)
    source = RecordedSource(recorded, scope)
    for each in (signal.SIGINT, signal.SIGTERM):  # one that a script began in the background ignores the first
        signal.signal(each, signal.default_int_handler)
    with ViewServer(scope, bag.name, port) as server:
        _announce(server, opened)
        source.go(time.monotonic())
        while True:
            while not server.wishes.empty():
                source.steer(server.wishes.get(), time.monotonic())
            if source.advance(time.monotonic()):
                time.sleep(LOOK_SECONDS)


def _follow(port: int, opened: bool) -> int:
    """Follow running nodes until Ctrl-C; returns the exit status."""
    from contact_sim_pkg.nodes.processes.environment import node_arguments, set_default_environment

    set_default_environment()
    os.nice(BEHIND)  # before DDS starts its threads
    from contact_sim_pkg.nodes.live_view import main
    from contact_sim_pkg.view.scope import Scope
    from contact_sim_pkg.view.server import ViewServer

    scope = Scope()
    with ViewServer(scope, "running bench", port) as server:
        _announce(server, opened)
        return main(scope, server.wishes, ["bench", *node_arguments({})])


def _announce(server: ViewServer, opened: bool) -> None:
    say(f"view: {server.address}")
    if opened:
        webbrowser.open(server.address)
