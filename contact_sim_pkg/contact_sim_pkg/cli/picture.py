"""The option `--plot`: a file that a picture can be written to, known before the work for it starts."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click


class PictureFile(click.Path):
    """A path whose ending names a format that can be drawn, in a directory that is there and can be written to."""

    def __init__(self) -> None:
        """A file, which need not exist."""
        super().__init__(path_type=Path, dir_okay=False, writable=True)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """The path. Refused where no picture can be written there."""
        path = Path(os.fsdecode(super().convert(value, param, ctx)))
        formats = sorted(_formats())
        if path.suffix.removeprefix(".").lower() not in formats:
            self.fail(f"{path}: the name of a picture ends in one of .{', .'.join(formats)}", param, ctx)
        if not path.parent.is_dir():
            self.fail(f"{path}: the directory {path.parent} does not exist; make it first", param, ctx)
        if not os.access(path.parent, os.W_OK | os.X_OK):
            self.fail(f"{path}: the directory {path.parent} cannot be written to; choose another", param, ctx)
        return path


def _formats() -> list[str]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    return list(FigureCanvasAgg.get_supported_filetypes())
