"""A picture of several panels side by side, for the plots of the studies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

from contact_sim_pkg.report.drawing import save_picture

__all__ = ["write_panels"]

Rows = list[dict[str, Any]]


def write_panels(
    panels: Mapping[str, Rows], draw: Callable[[Any, Rows], None], path: str | Path, *, columns: int,
    size: tuple[float, float], dpi: int, overwrite: bool,
) -> Path:  # fmt: skip
    """Write a picture with one panel a title.

    Args:
        panels: title -> rows of the panel.
        draw: draws rows on axes.
        path: its ending names the format.
        columns: most panels side by side.
        size: [inch] width and height of a panel.
        dpi: dots per inch.
        overwrite: replace a file that is there.

    Returns:
        Where the picture is.

    Raises:
        FileRefusedError: `path` cannot be written.
    """
    wide = max(1, min(columns, len(panels)))
    high = max(1, -(-len(panels) // wide))
    figure, axes = pyplot.subplots(
        high, wide, figsize=(size[0] * wide, size[1] * high), squeeze=False, layout="constrained"
    )
    # The last row may have empty places
    for axis in axes.flat[len(panels) :]:
        axis.set_visible(False)
    for axis, (title, rows) in zip(axes.flat, panels.items(), strict=False):
        draw(axis, rows)
        axis.set_title(title)
    try:
        return save_picture(figure, path, overwrite=overwrite, dpi=dpi)
    finally:
        pyplot.close(figure)
