"""Shapes that a person hands to an identification."""

from __future__ import annotations

from pathlib import Path

import numpy

from contact_sim_pkg.files import read_regular_file
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.geometry import Shape, hull

__all__ = ["hull_of_file"]

LARGEST = 1_000_000  # bytes


def hull_of_file(path: Path) -> Shape:
    """The hull of the points in a CSV file of three columns x, y, z in [m], body axes from the
    centre of mass.

    Raises:
        IdentificationError: a line that is not three finite numbers, or no line at all.
        FileRefusedError: no regular file that can be read, or too large.
    """
    text = read_regular_file(path, LARGEST).decode("utf-8", "replace")
    points = []
    for number, line in enumerate(text.splitlines(), start=1):
        # Commas or blanks; # begins a comment
        words = line.split("#")[0].replace(",", " ").split()
        if not words:
            continue
        try:
            point = [float(word) for word in words]
        except ValueError:
            raise IdentificationError(
                f"{path}, line {number}: {line.strip()!r} is not three numbers x, y, z in m"
            ) from None
        if len(point) != 3 or not numpy.isfinite(point).all():
            raise IdentificationError(
                f"{path}, line {number}: {line.strip()!r} is not three finite numbers x, y, z in m"
            )
        points.append(point)
    if not points:
        raise IdentificationError(f"{path} holds no point; give one corner a line: x, y, z in m")
    return hull(numpy.array(points))
