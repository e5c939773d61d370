"""The file of a pressure mat where a command takes a bag."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from contact_sim_pkg.cli.output.say import say

__all__ = ["bag_of"]


def bag_of(path: Path, kept: Callable[[TemporaryDirectory[str]], str]) -> Path:
    """The bag of a mat's file, in a folder that is ``kept`` for the time of the command; any other path as it is."""
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.standard.imported_mats import import_mat
    from contact_sim_pkg.standard.mat_files import is_mat

    if not is_mat(path):
        return path
    folder = Path(kept(TemporaryDirectory())) / path.stem
    try:
        _, notes = import_mat(path, folder)
    except BagError as error:
        raise BagError(f"{error} (options of `bench import`, whose bag is taken too)") from None
    for note in notes:
        say(f"{path.name}: {note}", err=True)
    return folder
