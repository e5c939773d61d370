"""What the pages have in common: sections, and the templates they are made from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.tables import Table


class Section(NamedTuple):
    """One section of the page."""

    key: str
    title: str
    pictures: list[Picture]
    tables: Sequence[Table] = ()


def environment() -> Environment:
    """Templates of the pages. Pictures are the one thing marked as safe markup; all else is
    escaped.
    """
    return Environment(
        loader=PackageLoader(__package__, "templates"), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
