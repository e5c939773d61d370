"""What the pages have in common: sections, and the shell of style, scripts and policy that they are made in."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any, NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.tables import Table

__all__ = [
    "CONTACT",
    "FREQUENCY",
    "LIVE_SCRIPTS",
    "PUBLISHED",
    "SCRIPTS",
    "TRUST",
    "Section",
    "Shell",
    "rendered",
    "shell_of",
]

FREQUENCY, CONTACT, PUBLISHED, TRUST = "frequency", "contact", "published", "trust"
"""Parts of the page that pictures stand in."""
STYLES = ("page.css", "uplot/uPlot.min.css")
SCRIPTS = ("uplot/uPlot.iife.min.js", "plots.js", "page.js")
LIVE_SCRIPTS = (*SCRIPTS[:-1], "live.js")


class Section(NamedTuple):
    """Pictures and tables of one thing."""

    key: str
    title: str
    pictures: list[Picture]
    tables: Sequence[Table] = ()
    part: str = CONTACT
    """of the page that they stand in"""


class Shell(NamedTuple):
    """Style and scripts of a page, and the policy that allows these alone, by their hashes."""

    style: Markup
    scripts: list[Markup]
    policy: str


def rendered(template: str, content: Mapping[str, Any], *, scripts: bool = False, shell: Shell | None = None) -> str:
    """A page, with the scripts of a report or in a ``shell`` of its own.

    Our own drawings, style and scripts are marked as safe markup; all else is escaped.
    """
    environment = Environment(
        loader=PackageLoader(__package__, "templates"), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    return environment.get_template(template).render(content, shell=shell or shell_of(SCRIPTS if scripts else ()))


def shell_of(scripts: Sequence[str], more: str = "") -> Shell:
    """Of a page with these scripts of the templates; ``more``: directives that its policy has beside the hashes."""
    style = "\n".join(map(_text, STYLES))
    code = [_text(each) for each in scripts]
    # matplotlib writes the style of its shapes as attributes
    policy = f"default-src 'none'; style-src {_hash(style)}; style-src-attr 'unsafe-inline'; img-src data:"
    if code:
        policy += f"; script-src {' '.join(map(_hash, code))}"
    return Shell(Markup(style), [Markup(each) for each in code], policy + more)  # noqa: S704 - files of this package


def _text(name: str) -> str:
    return (files(__package__) / "templates" / name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
