"""The occupant's back and the seat back it leans on (Driver and Seat)."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from contact_sim_pkg.scene.lattice import GRAVITY
from contact_sim_pkg.scene.schema.fields import Section, number

SHELL_PRELOAD = 20.0  # [N]; the weight of the mass would bend the default shell by 0.24 m


class Back(Section):
    """Form of the back: a doubly curved surface over a flat seat back, which it touches first in its middle."""

    width: float = number(0.05, 5.0, "m", "width of the back", default=0.40)
    height: float = number(0.05, 5.0, "m", "height of the back", default=0.50)
    radius_across: float = number(0.05, 1000.0, "m", "radius of curvature across", default=0.6)
    radius_up: float = number(0.05, 1000.0, "m", "radius of curvature up", default=1.5)


class Sliding(Section):
    """Rigid sliding of the back along the seat back, up and down: amplitude · sin(2π frequency t); acts in friction."""

    amplitude: float = number(0.0, 1.0, "m", "amplitude of the displacement; 0: none", default=0.0)
    frequency: float = number(0.0, 1000.0, "Hz", "frequency of the sliding", above=True, default=5.25)


class Mat(Section):
    """Pressure mat on the seat back: the cells of `backrest/patch`; a shell has the cells of its points instead."""

    rows: int = number(4, 256, "", "cells up the back", default=40)
    cols: int = number(4, 256, "", "cells across the back", default=32)


class Backrest(Section):
    """Occupant against a seat back that is shaken along its normal (x, forward)."""

    mass: float = number(0.1, 1000.0, "kg", "moving mass of the occupant; replaced by a shell", default=45.6)
    preload: float | None = number(
        0.0,
        1e6,
        "N",
        "constant force on the seat back; by default mass · 9.81 m/s², 20 N for a shell",
        default=None,
    )
    back: Back = Field(default_factory=Back, description="shape of the back")
    sliding: Sliding = Field(default_factory=Sliding, description="rigid sliding along the seat back")
    mat: Mat = Field(default_factory=Mat, description="cells of the pressure map")


def complete_backrest(data: dict[str, Any]) -> None:
    """Write out the preload of a backrest scene's plain data where none is given."""
    backrest = data["backrest"]
    if "preload" not in backrest:
        mass = backrest.get("mass", Backrest().mass)
        shell = data["effects"]["backrest"].get("shell_modes")
        backrest["preload"] = mass * GRAVITY if shell is None else SHELL_PRELOAD
