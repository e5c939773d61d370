"""What the first comment of a scene file offers to try."""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["Trial", "things_to_try"]

HEADING = "# Things to try:"


class Trial(NamedTuple):
    """A command, and what it shows; empty where the file leaves that open."""

    command: str
    shows: str


def things_to_try(text: str) -> list[Trial]:
    """The trials of a scene file's ``text``, in its order; none where its first comment has none.

    They stand below the line "Things to try:", a command a line, and what it shows two blanks behind it or
    on the lines below, indented further.
    """
    lines = iter(text.splitlines())
    if HEADING not in (line.rstrip() for line in lines):  # leaves the lines below
        return []
    found: list[Trial] = []
    for line in lines:
        if not line.startswith("#"):
            break
        indent, said = len(line) - len(line[1:].lstrip()), line[1:].strip()
        if said.startswith("bench "):
            command, _, shows = re.sub(" {2,}", "\n", said, count=1).partition("\n")
            found.append(Trial(command, shows))
        elif found and indent > len("#   "):
            command, shows = found[-1]
            found[-1] = Trial(command, f"{shows} {said}".strip())
    return found
