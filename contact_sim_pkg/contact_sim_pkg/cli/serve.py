"""`bench serve`: step an exported unit; its library starts this."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click


@click.command("serve", hidden=True)
@click.argument("folder", type=click.Path(path_type=Path))
def command(folder: Path) -> None:
    """Step the FMU whose resources are in FOLDER, by messages on standard input and output.

    The library of an FMU starts it; docs/steering.md.
    """
    from contact_sim_pkg.steering.fmu.serve import serve

    # nothing that is printed, and no process that is started, may come between the messages
    questions, answers = os.dup(0), os.dup(1)
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    with open(questions, "rb") as read, open(answers, "wb") as written:
        serve(folder, read, written)
    sys.stderr.flush()
    os._exit(0)  # the host waits
