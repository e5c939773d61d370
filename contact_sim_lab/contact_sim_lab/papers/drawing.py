"""Pictures of the papers' figures: a canvas without a screen, and bytes of a PNG."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["made_here", "picture"]

MAKER = "bench paper"
HEAD = 400  # bytes of a PNG that hold its maker


def made_here(path: Path) -> bool:
    """Whether a file is a picture of this command."""
    with path.open("rb") as file:
        return MAKER.encode() in file.read(HEAD)


def picture(draw: Callable[[Canvas], None], size: tuple[float, float], dots: int) -> bytes:
    """The PNG of a drawing of ``size`` [inch] at ``dots`` [1/inch]; it names its maker
    and no time, so the same picture has the same bytes.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from contact_sim_pkg.report.drawing import style

    buffer = io.BytesIO()
    with style():
        canvas = Figure(figsize=size, layout="constrained", facecolor="white")
        FigureCanvasAgg(canvas)
        draw(canvas)
        canvas.savefig(buffer, format="png", dpi=dots, facecolor="white", metadata={"Software": MAKER})
    return buffer.getvalue()
