"""What a rig weighs on its contacts: the scales that errors of its outputs are held against."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

__all__ = ["Standing", "TouchedBody"]


class TouchedBody(NamedTuple):
    """A coordinate of a body that a contact acts on."""

    contact: str
    mass: float  # [kg]


class Standing(NamedTuple):
    """Loads and masses of a scene.

    Attributes:
        loads: [N] of each contact at rest, by its name; those that rest on none are left out.
        bodies: by coordinate of `bench/motion`; bodies that no contact touches are left out.
    """

    loads: Mapping[str, float]
    bodies: Mapping[str, TouchedBody]
