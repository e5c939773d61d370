"""The gallery of the README: six figures of reports. `make pictures` draws them anew in `docs/images`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.library import load_scene, run
from contact_sim_pkg.report.printed import figure_named, save_figure
from contact_sim_pkg.report.reading import read_recording

__all__ = ["GALLERY", "Shown", "write_gallery"]

DOTS_PER_INCH = 110
"""about 800 pixels: twice the width of a picture in the README"""


class Shown(NamedTuple):
    """One picture of the gallery."""

    scene: str
    figure: str
    """of the report of its run"""
    caption: str
    """what is seen, in a phrase; what is before the colon stands for the picture where it cannot be seen"""

    @property
    def file(self) -> str:
        """Its name in `docs/images`."""
        return f"gallery_{self.scene}.png"

    @property
    def commands(self) -> tuple[str, str]:
        """What makes the same figure for print."""
        bag = f"bags/{self.scene}"
        return f"bench run {self.scene} --offline --out {bag}", f"bench report {bag} --format png {self.figure}"


GALLERY = (
    Shown("tire_cleat", "rolling-road", "Over a cleat: force, force along the road, footprint over distance"),
    Shown("tire_braking", "friction-map", "A braked, then steered tire: shear, where it sticks and slips"),
    Shown("seat_drop", "seat-map", "Landing on a cushion: pressure under buttocks and thighs"),
    Shown("seat_slap", "backrest-loops", "Slaps on a seat back: normal force and friction as loops"),
    Shown("impact_rubber_drop", "impact-wave", "A ball on rubber: the wave that runs over the surface"),
    Shown("car_full_bench", "rolling-stress", "The full bench on a rough road: stress below the footprint"),
)


def write_gallery(folder: Path) -> list[Path]:
    """Run the scenes and draw the pictures into a folder, over those that are there; returns their paths.

    Raises:
        BagError: a report has no such figure.
    """
    made = []
    for each in GALLERY:
        figure = figure_named(each.figure, read_recording(run(load_scene(each.scene))))
        path = folder / each.file
        with path.open("wb") as file:
            save_figure(file, figure, "png", DOTS_PER_INCH)
        made.append(path)
    return made


if __name__ == "__main__":
    write_gallery(Path(sys.argv[1]))
