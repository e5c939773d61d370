"""The one place where a command prints texts: what a stranger's file brought in cannot move the cursor."""

from __future__ import annotations

import click

from contact_sim_pkg.cli.output.working import doing, hush
from contact_sim_pkg.files import printable_lines


def say(text: object = "", *, err: bool = False, nl: bool = True) -> None:
    """Print one or several lines; `click.echo` for texts from anywhere."""
    echo(printable_lines(str(text)), err=err, nl=nl)


def announce(line: str) -> None:
    """Print on standard error what is done now; it is said again while it lasts."""
    say(line, err=True)
    doing(line, printed=True)


def echo(text: str = "", *, err: bool = False, nl: bool = True) -> None:
    """Print a text that is ours, or safe already."""
    hush()
    click.echo(text, err=err, nl=nl)
