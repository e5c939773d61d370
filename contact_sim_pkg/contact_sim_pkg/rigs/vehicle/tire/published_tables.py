"""Published curves of standing tires, for the page and for the laboratory: tables of the folder `published`, and how sure
their numbers are.
"""

from __future__ import annotations

from pathlib import Path

from contact_sim_pkg.records.published_curve import PublishedTable, read_published

__all__ = ["FOLDER", "FORMULA_ERROR", "OWN", "PRINT_ERROR", "STANDING", "published_tire"]

FOLDER = Path(__file__).parent / "published"
STANDING = ("deflection", "length", "width")
"""Columns over load, at an inflation."""
FORMULA_ERROR = (0.0, 0.05)
"""Of a formula's standing tire; none is published: such fits leave about so much."""
PRINT_ERROR = {
    "deflection": (0.3, 0.02), "stiffness": (0.0, 0.02), "length": (0.0, 0.04), "width": (0.0, 0.02), "area": (0.0, 0.03),
}  # fmt: skip
"""Of the measured 255/40 R17, in the unit of the column and as part: where the parabola begins, and twice what a smooth
surface over load and inflation leaves of the points.
"""
OWN = {
    "deflection": 0.035, "stiffness": 0.035, "length": 0.06, "width": 0.14, "area": 0.06, "braking stiffness": 0.06,
    "cornering stiffness": 0.06, "trail": 0.12, "rolling resistance": 0.1,
}  # fmt: skip
"""Relative, of a tire of the bench: twice the standard deviations that it is fitted with (`property_file/fit.py`)."""


def published_tire(name: str) -> PublishedTable:
    """The table `NAME.csv` of the folder."""
    return read_published(FOLDER / f"{name}.csv")
