"""What the pages have in common: sections, and the templates they are made from."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined

from contact_sim_pkg.files import FileRefusedError, open_regular_file
from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.tables import Table


class Section(NamedTuple):
    """One section of the page."""

    key: str
    title: str
    pictures: list[Picture]
    tables: Sequence[Table] = ()


TITLE = re.compile(rb"<title>[^<]* \xe2\x80\x93 Contact Bench (report|comparison)</title>")  # as in the templates


def is_page(path: Path) -> bool:
    """Whether a file is a page that these templates made, so that it may be made again."""
    try:
        with open_regular_file(path) as file:
            head = file.read(4096)
    except FileRefusedError:
        return False
    return head.lstrip().startswith(b"<!DOCTYPE html>") and TITLE.search(head) is not None


def environment() -> Environment:
    """Templates of the pages. Pictures are the one thing marked as safe markup; all else is
    escaped.
    """
    return Environment(
        loader=PackageLoader(__package__, "templates"), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
