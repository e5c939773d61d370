"""The one place where a command prints texts: what a stranger's file brought in cannot move the cursor."""

from __future__ import annotations

import click

from contact_sim_pkg.files import printable_lines


def say(text: object = "", *, err: bool = False, nl: bool = True) -> None:
    """Print one or several lines; `click.echo` for texts from anywhere."""
    click.echo(printable_lines(str(text)), err=err, nl=nl)
