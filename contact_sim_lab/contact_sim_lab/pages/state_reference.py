"""The list of `docs/library.md`: what each class of a run declares as its state.

`python -m contact_sim_lab.pages.state_reference docs/library.md` writes it between the two marks of that file.
"""

from __future__ import annotations

import importlib
import pkgutil
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import contact_sim_pkg.rigid
import contact_sim_pkg.rigs
from contact_sim_pkg import pressure
from contact_sim_pkg.records.state import State
from contact_sim_pkg.report import signal

BEGIN, END = "<!-- states made from the code: begin -->", "<!-- states made from the code: end -->"
WIDTH = 100
ROOMS = (contact_sim_pkg.rigs, contact_sim_pkg.rigid, pressure, signal)


def with_list(document: str) -> str:
    """The document with its list made anew. Raises ValueError where one of the two marks is missing."""
    before, begin, rest = document.partition(BEGIN)
    _old, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"{BEGIN} and {END} must stand in the document")
    lines = [
        line for name, state in sorted(_declared())
        for line in textwrap.wrap(f"* **{name}**: {_said(state)}", WIDTH, subsequent_indent="  ", break_on_hyphens=False)
    ]  # fmt: skip
    return "\n".join([f"{before}{begin}", "", *lines, "", f"{end}{after}"])


def _declared() -> Iterator[tuple[str, State]]:
    """Name below the package, and state, of each class."""
    for room in ROOMS:
        for module in pkgutil.walk_packages(room.__path__, f"{room.__name__}."):
            if ".report" in module.name and room is not signal:
                continue
            for kind in vars(importlib.import_module(module.name)).values():
                state = vars(kind).get("STATE") if isinstance(kind, type) else None
                if isinstance(state, State) and kind.__module__ == module.name:
                    yield f"{module.name.partition('.')[2]}.{kind.__name__}", state


def _said(state: State) -> str:
    """`physics state, mode; solver step`."""
    return "; ".join(
        f"{kind} {', '.join(names)}" for kind, names in state._asdict().items() if names and kind != "held"
    )


if __name__ == "__main__":
    page = Path(sys.argv[1])
    page.write_text(with_list(page.read_text(encoding="utf-8")), encoding="utf-8")
