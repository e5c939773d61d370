"""What the launch files take from the commands: their options as launch arguments, read and refused by the same parser,
and the end of a run. Without launch, so that it can be tested anywhere.

An option keeps its name, with underscores: `--from-bag BAG` is `from_bag:=BAG`, a flag is `true` or `false`, and one
that may be given several times takes several values, quoted as in a shell.
"""

from __future__ import annotations

import shlex
import signal
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import click

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.unfinished import leave_metadata
from contact_sim_pkg.nodes.misspelt import misspelt
from contact_sim_pkg.nodes.processes.children import how_ended
from contact_sim_pkg.nodes.processes.scene_file import read_reason, write_reason

__all__ = ["Argument", "LaunchedRun", "arguments_of", "options_of", "refuse_misspelt"]

SWITCH = ("true", "false", "True", "False")
TEXTS = {  # of what a command is called with, which has no help of its own
    "scene": "Name of a shipped scene, or path of a scene file. Empty: that of from_bag, or car_full_bench.",
    "bag": "Directory of the bag.",
}
OF_NODES = {
    "namespace": ("", "Namespace of all nodes and topics."),
    "use_sim_time": ("false", "Clock of the nodes; stamps are simulated time, pacing is the steady clock in any case."),
}


class Argument(NamedTuple):
    """One argument of a launch file."""

    default: str
    text: str
    choices: tuple[str, ...] | None = None


def arguments_of(command: click.Command, without: Iterable[str] = ()) -> dict[str, Argument]:
    """The launch arguments of a command, by name: its own, less those named, and those of any
    node.
    """
    found = {_name(each): _argument(each) for each in command.params if _name(each) not in without}
    own = {name: Argument(*each, SWITCH if each[0] in SWITCH else None) for name, each in OF_NODES.items()}
    return found | own


def options_of(command: click.Command, given: Mapping[str, str]) -> dict[str, Any]:
    """The values that a command gets for these launch arguments, by the names of its parameters.

    Raises:
        ValueError: as the command line refuses it, in its words.
    """
    words = [word for each in command.params if _name(each) in given for word in _words(each, given[_name(each)])]
    try:
        with command.make_context(command.name, words) as context:
            return dict(context.params)
    except click.ClickException as error:
        raise ValueError(error.format_message()) from None


def refuse_misspelt(given: Iterable[str], known: Iterable[str]) -> None:
    """Raise ValueError for a launch argument that no one declares and that resembles one of ours. Any other one may
    belong to the launch file that includes ours.
    """
    for name, meant in misspelt(given, known).items():
        raise ValueError(f"{name}:= is no argument of this launch file; did you mean {meant}:=?")


def _name(option: click.Parameter) -> str:
    return option.opts[0].lstrip("-").replace("-", "_")


def _argument(option: click.Parameter) -> Argument:
    if not isinstance(option, click.Option):
        return Argument("", TEXTS[str(option.name)])
    text = option.help or ""
    if option.is_flag:
        return Argument("true" if option.default is True else "false", text, SWITCH)
    if option.multiple:
        return Argument("", f"{text} Several: separated by blanks, quoted as in a shell.")
    return Argument(str(option.default) if isinstance(option.default, (int, float)) else "", text)


def _words(option: click.Parameter, value: str) -> list[str]:
    """The words of a command line that stand for one launch argument."""
    if not isinstance(option, click.Option):
        return [value] if value else []
    if option.is_flag:
        is_on = value.lower() == "true"
        return [option.opts[0]] if is_on else option.secondary_opts[:1]
    values = shlex.split(value) if option.multiple else [value] if value else []
    return [word for each in values for word in (option.opts[0], each)]


class LaunchedRun:
    """End of a run whose nodes launch has started; the bag keeps which of them failed."""

    def __init__(self, scene: Path, bag: Path | None, nodes: Iterable[str]) -> None:
        """``scene``: as `write_scene` returned it. ``bag``: None where nothing is recorded."""
        self._scene, self._bag = scene, bag
        self._left, self._interrupted = set(nodes), False

    @property
    def finished(self) -> bool:
        """Whether all nodes have ended by themselves, and none badly."""
        return not self._left and not self._interrupted

    def on_end(self, node: str, status: int, *, is_shutdown: bool) -> str:
        """A node has ended; returns the sentence on a bag that it could not finish, or nothing.

        ``status``: negative for a signal. ``is_shutdown``: launch ends the nodes, by SIGINT, SIGTERM, SIGKILL. A node
        may get the first two before it has learnt to catch them. One that is killed because it does not end is the
        logger's failure alone: nothing is lost with the others.
        Raises RuntimeError, by which launch ends with status 1, where the node has failed.
        """
        sentence = how_ended(node, status)
        of_launch = (-signal.SIGINT, -signal.SIGTERM, *((-signal.SIGKILL,) if node != "bag_logger" else ()))
        failed = status != 0 and not (is_shutdown and status in of_launch)
        self._left.discard(node)
        self._interrupted |= failed or is_shutdown
        if failed:
            write_reason(self._scene, sentence)  # the logger, which ends last, keeps it
        hint = ""
        if node == "bag_logger" and self._bag is not None:
            hint = leave_metadata(self._bag, {"ended": "failed", "failure": read_reason(str(self._scene)) or sentence})
        if failed:
            raise RuntimeError("; ".join(filter(None, [sentence, "the run has failed", hint])))
        return hint

    def refuse_inaccurate(self) -> None:
        """Raise RuntimeError where an error is estimated above the requested accuracy, or the scene
        expects another regime, as `--strict` does.
        """
        from contact_sim_pkg.cli.output.outcome import misses
        from contact_sim_pkg.report.summary import summarise

        found = [] if self._bag is None else misses(summarise(open_bag(self._bag)))
        if found:
            raise RuntimeError("; ".join(found))
