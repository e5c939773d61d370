"""Where a page is written, and whether it may be: asked before a bag is read. Loads no drawing of pictures."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.files import FileRefusedError, check_output, new_file, open_regular_file

__all__ = ["free_figure", "free_place", "is_page", "new_figure_file", "new_page"]

OF_ONE, OF_SEVERAL = "report.html", "comparison.html"
TITLE = re.compile(
    rb"<title>[^<]* \xe2\x80\x93 Contact Bench (report|comparison|sweep|plan|fit|test)</title>"
)  # as in the templates


def free_place(bags: Sequence[Bag], out: Path | None = None, *, overwrite: bool = False) -> Path:
    """File of the page on `bags`: `out`, else `report.html` in the directory of the only one, or
    `comparison.html` in the working directory.

    Raises FileRefusedError where a page of this command is not made there: another file exists (but
    by `overwrite`), part of a bag that is read, no such directory.
    """
    path = out or (bags[0].path.parent / OF_ONE if len(bags) == 1 else Path(OF_SEVERAL))
    check_output(path, _files(bags), overwrite=overwrite, ours=is_page)
    return path


def free_figure(bag: Bag, kind: str, name: str, out: Path | None = None, *, overwrite: bool = False) -> Path:
    """File of one figure of the page on a bag: `out`, which ends in `kind`, else NAME.KIND in the directory of the bag.

    Raises FileRefusedError where it ends in anything else or may not be made there, as `free_place`.
    """
    path = out or bag.path.parent / f"{Path(name).name}.{kind}"
    if path.suffix.lower() != f".{kind}":
        raise FileRefusedError(path, f"is to be a picture of --format {kind}: its name ends in .{kind}")
    check_output(path, _files([bag]), overwrite=overwrite)
    return path


@contextmanager
def new_figure_file(path: Path, bag: Bag, *, overwrite: bool = False) -> Iterator[IO[bytes]]:
    """The file to write a figure into; see `files.new_file`."""
    with new_file(path, _files([bag]), overwrite=overwrite) as file:
        yield file


@contextmanager
def new_page(path: Path, bags: Sequence[Bag], *, overwrite: bool = False) -> Iterator[IO[bytes]]:
    """The file to write a page into; see `files.new_file`."""
    with new_file(path, _files(bags), overwrite=overwrite, ours=is_page) as file:
        yield file


def is_page(path: Path) -> bool:
    """Whether a file is a page that these templates made, so that it may be made again."""
    try:
        with open_regular_file(path) as file:
            head = file.read(4096)
    except FileRefusedError:
        return False
    return head.lstrip().startswith(b"<!DOCTYPE html>") and TITLE.search(head) is not None


def _files(bags: Sequence[Bag]) -> list[Path]:
    return [file for each in bags for file in (each.path, each.path.parent)]
