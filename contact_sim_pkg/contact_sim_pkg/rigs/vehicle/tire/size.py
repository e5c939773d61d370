"""Size of a tire as on its sidewall, `205/55 R16` or `315/80 R22.5`, and the lengths that follow from it."""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["PATTERN", "TireSize", "read_size"]

PATTERN = (
    r"^(?:P|LT)?([1-9][0-9]{2})/([1-9][0-9]) ?Z?RF? ?([1-9][0-9](?:\.5)?)C?"
    r"(?: (?:XL|\(?[1-9][0-9]{1,2}(?:/[1-9][0-9]{1,2})?[A-Z][0-9]?\)?)){0,2}$"
)
"""With what else the sidewall says: P or LT before it; C, load index and speed symbol, XL behind it."""
INCH = 0.0254  # [m]
LEAST_HEIGHT = 0.025  # [m] of a section
CHORD = 0.887
"""Of the section height: chord of the sidewall's arc, 0.10 m for 205/55 R16; 0.08 to 0.11 m."""
BELT = 0.683
"""Of the section width: belt under pressure, 0.14 m for 205/55 R16; a choice, 0.13 to 0.16 m."""


class TireSize(NamedTuple):
    """Nominal size: section width [m], height over width [1], diameter of the rim [m]."""

    width: float
    aspect: float
    rim: float

    @property
    def section_height(self) -> float:
        """[m] from rim to tread."""
        return self.aspect * self.width

    @property
    def radius(self) -> float:
        """Free radius [m]."""
        return 0.5 * self.rim + self.section_height

    @property
    def sidewall_chord(self) -> float:
        """[m]"""
        return CHORD * self.section_height

    @property
    def belt_width(self) -> float:
        """[m]"""
        return BELT * self.width

    @property
    def grid(self) -> tuple[float, float]:
        """Extent [m] of a pressure field along and across: 0.27 by 0.18 m for 205/55 R16, which holds
        the contact under two and a half times its usual load; twice it holds all that is lower than
        half the radius.
        """
        return round(0.855 * self.radius, 3), round(0.878 * self.width, 3)


def read_size(text: str, radius: float | None = None) -> TireSize:
    """The size of a text such as `205/55 R16` or `225/45ZR17 94W XL`: width in mm, height in per cent of it, rim in
    inches or half of them; the rest is read past.

    radius: free radius [m]; where given it sets the height in place of the text's.

    Raises ValueError for any other text, and for a radius that leaves less than 25 mm of height.
    """
    found = re.match(PATTERN, text)
    if found is None:
        raise ValueError(f"size {text!r}: width in mm, height in per cent, rim in inches as in 205/55 R16 are needed")
    width, aspect, rim = (float(part) for part in found.groups())
    if radius is None:
        return TireSize(1e-3 * width, 1e-2 * aspect, INCH * rim)
    if not radius >= 0.5 * INCH * rim + LEAST_HEIGHT:
        raise ValueError(
            f"a radius of {radius:g} m is less than {LEAST_HEIGHT:g} m above the rim of {text}, {0.5 * INCH * rim:.4g} m"
        )
    return TireSize(1e-3 * width, (radius - 0.5 * INCH * rim) / (1e-3 * width), INCH * rim)
