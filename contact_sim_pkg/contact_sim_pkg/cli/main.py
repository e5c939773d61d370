"""The `bench` command. Bad input ends here, and only here, as a sentence on standard error and an
exit status.
"""

from __future__ import annotations

import atexit
import errno
import gc
import os
import sys
import time
from difflib import get_close_matches
from importlib import import_module

import click

from contact_sim_pkg.cli.output.working import working
from contact_sim_pkg.python_process import disregard_current_folder

BEGAN = time.monotonic()  # start of the process, near enough: what a run calls its start-up counts from here

COMMANDS = {  # command -> its module, and its name there where that is not `command`
    "list": "scenes:list_command",
    "show": "scenes:show_command",
    "new": "scenes:new_command",
    "run": "run",
    "sweep": "sweep",
    "plan": "plan",
    "fit": "fit",
    "replay": "replay",
    "view": "view",
    "metrics": "bags.metrics",
    "compare": "bags.compare",
    "table": "bags.table",
    "export": "bags.export",
    "import": "bags.import_",
    "report": "report",
    "identify": "identify",
    "accuracy": "accuracy",
    "effects": "effects",
    "material": "material",
    "tire": "tire",
    "recover": "recover",
    "serve": "serve",
}
LABORATORY = {  # the same, in contact_sim_lab.cli
    "hard": "hard",
    "validation": "validation",
    "goals": "goals",
    "growth": "goals:growth_command",
    "paper": "paper",
}
DISPLAY_THEMSELVES = ("run", "replay", "view", "serve")  # from their first second to their last
ONE_THREAD = ("NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS")  # the nodes share the cores; the same bits without nodes


class LazyGroup(click.Group):
    """A group whose commands are imported when they are called: `bench run` needs no plotting
    library.
    """

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names, in the order of use."""
        return [*COMMANDS, *LABORATORY, *_foreign()]

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """The command of this name, imported now; None where there is none."""
        if name in LABORATORY:
            return _of_laboratory(name)
        if name not in COMMANDS:
            foreign = _foreign().get(name)
            return None if foreign is None else _foreign_command(name, foreign)
        module, _, command = COMMANDS[name].partition(":")
        found: click.Command = getattr(import_module(f"contact_sim_pkg.cli.{module}"), command or "command")
        return found

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that the arguments begin with; a name that is none is refused with the nearest one."""
        if args and not args[0].startswith("-") and args[0] not in self.list_commands(ctx):
            near = get_close_matches(args[0].lower(), self.list_commands(ctx), n=1, cutoff=0.5)
            hint = f" Did you mean {near[0]!r}?" if near else ""
            raise click.UsageError(f"No such command {args[0]!r}.{hint}", ctx)
        found = super().resolve_command(ctx, args)
        if found[0] not in DISPLAY_THEMSELVES and not ctx.resilient_parsing:
            ctx.with_resource(working(f"bench {found[0]}: working"))
        return found


def _of_laboratory(name: str) -> click.Command:
    """A command of the laboratory; without it one that names what to install, as its help does."""
    from contact_sim_pkg.cli.laboratory import AbsentError, laboratory

    module, _, command = LABORATORY[name].partition(":")
    try:
        found: click.Command = getattr(laboratory(f"cli.{module}", f"bench {name}"), command or "command")
    except AbsentError as error:
        return _refusing(name, error, f"{error.message}.", "Of the laboratory, which is not installed.")
    return found


def _refusing(name: str, error: Exception, text: str, short: str) -> click.Command:
    """A command that is not there: whatever it is called with, an error."""

    @click.command(
        name,
        help=text,
        short_help=short,
        context_settings={"ignore_unknown_options": True, "allow_extra_args": True},
    )
    def absent() -> None:
        raise error

    return absent


def _foreign() -> dict[str, str]:
    """Commands that plug-ins bring, ``module:name`` by name; ours are never replaced."""
    from contact_sim_pkg.records.registry import announced

    return announced("commands", (*COMMANDS, *LABORATORY))


def _foreign_command(name: str, place: str) -> click.Command:
    """A command of a plug-in; one that does not load refuses with the cause, as its help does."""
    from contact_sim_pkg.records.guests import LONGEST_IMPORT
    from contact_sim_pkg.records.rig import PluginError, load

    try:
        command = load(place, LONGEST_IMPORT)
        if not isinstance(command, click.Command):
            raise PluginError(f"the command {name} of a plug-in, {place}, is no click command")
    except PluginError as error:
        return _refusing(name, error, f"{error}.", "Of a plug-in; it does not load, --help shows why.")
    return command


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="contact_sim_pkg", prog_name="bench")
def bench() -> None:
    """Contact forces and pressure fields of simulated rigs, as ROS 2 topics and bags."""


def main(arguments: list[str] | None = None) -> int:
    """Run `bench`; returns 0 done, 1 fault, 2 refused, 3 done with loss."""
    disregard_current_folder()
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")
    atexit.register(gc.freeze)  # the interpreter ends without looking through every object: 0.5 s after a report
    try:
        status = bench.main(arguments, prog_name="bench", standalone_mode=False)
    except click.exceptions.Abort:
        return 0
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except KeyboardInterrupt:
        return 0
    except BrokenPipeError:
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115  # the reader has gone; nothing may be written at the end
        return 0
    except Exception as error:
        known = refusal(error)
        if known is None:
            raise
        print(_sentences(known[0]), file=sys.stderr)
        return known[1]
    return int(status or 0)


def _sentences(text: str) -> str:
    """One sentence, with the indented lines below it, or one a line, as they are printed: what was
    read from a file cannot move the cursor.
    """
    from contact_sim_pkg.files import printable_lines

    is_one = all(line.startswith("  ") for line in text.split("\n")[1:])
    return "bench: " * is_one + printable_lines(text)


def refusal(error: Exception) -> tuple[str, int] | None:
    """Sentence and exit status of an error for bad input or a named fault; None for any
    other.
    """
    from contact_sim_pkg.requirements import package_sentence

    # first: without its packages even the errors below cannot be imported
    if sentence := package_sentence(error):
        return sentence, 2
    from contact_sim_pkg.files import FileRefusedError, RefusedError, printable
    from contact_sim_pkg.run.errors import RunError

    # status 2: refused before the start; 1: failed while running
    if isinstance(error, RefusedError):
        return str(error), 2
    if isinstance(error, RunError):
        return str(error), 1
    if isinstance(error, MemoryError):
        return f"memory ran out: {error or 'an allocation failed'}; shorten the run or lower limits.memory", 1
    if isinstance(error, OSError):
        sentence = (
            f"{printable(str(error.filename), 500)}: {error.strerror}"
            if error.filename
            else str(error.strerror or error)
        )
        # no file has such a name, whoever asked for it
        return sentence, 2 if isinstance(error, FileRefusedError) or error.errno == errno.ENAMETOOLONG else 1
    return None


if __name__ == "__main__":
    sys.exit(main())
