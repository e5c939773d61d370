"""Seated occupants of the literature: lumped masses on a seat interface, with their links.

Every model is linear and vertical. Node 0 is the seat interface, which moves with the surface of
the cushion; it may be massless. The others hang on it, or on each other, by springs and dampers:
side by side, as a chain, or with closed loops. Constants are those of the cited source as reviews
quote them, not read in the source itself. They were fitted to people on a rigid seat without
backrest; between subjects they scatter by about 15 %.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["H_POINT", "OCCUPANTS", "SEATED_MASS", "Link", "OccupantModel", "scaled", "softened", "stiffened"]

H_POINT = 0.098
"""[m] of the H-point over the loaded surface of the cushion, of the manikin of SAE J826 (50th
percentile man)."""

SEATED_MASS = {5: 36.5, 50: 57.0, 95: 74.5}
"""Percentile -> mass [kg] on the cushion: 73 % of a body of 50 kg (woman), 78 kg and 102 kg (men);
feet, hands and backrest carry the rest."""


class Link(NamedTuple):
    """A spring and a damper, side by side between two nodes."""

    lower: int  # number of a node
    upper: int
    stiffness: float  # [N/m]
    damping: float  # [N s/m]


class OccupantModel(NamedTuple):
    """Masses and their links."""

    masses: tuple[float, ...]  # [kg]; the first is the seat interface, 0: massless
    links: tuple[Link, ...]
    head: int | None  # node of the head, None where the model has none
    source: str

    @property
    def mass(self) -> float:
        """In [kg]."""
        return sum(self.masses)


OCCUPANTS = {
    "wei_griffin_1": OccupantModel(
        masses=(7.8, 43.4),
        links=(Link(0, 1, 44115.0, 1485.0),),
        head=None,
        source="Wei and Griffin 1998, one mass",
    ),
    "wei_griffin_2": OccupantModel(
        masses=(6.7, 33.4, 10.7),
        links=(Link(0, 1, 35776.0, 761.0), Link(0, 2, 38374.0, 458.0)),
        head=None,
        source="Wei and Griffin 1998, two masses",
    ),
    "iso_5982": OccupantModel(
        masses=(2.0, 6.0, 2.0, 45.0),
        links=(Link(0, 1, 9990.0, 387.0), Link(1, 2, 34400.0, 234.0), Link(0, 3, 36200.0, 1390.0)),
        head=2,
        source="ISO 5982:2001, annex",
    ),
    # From the seat up: thighs and pelvis, lower torso, chest, head.
    "boileau_rakheja": OccupantModel(
        masses=(0.0, 12.78, 8.62, 28.49, 5.31),
        links=(
            Link(0, 1, 90000.0, 2064.0), Link(1, 2, 162800.0, 4585.0), Link(2, 3, 183000.0, 4750.0),
            Link(3, 4, 310000.0, 400.0),
        ),
        head=4,
        source="Boileau and Rakheja 1998",
    ),
    # Pelvis, viscera, upper torso, head; viscera and spine both lead from the pelvis to the torso.
    "wan_schimmels": OccupantModel(
        masses=(0.0, 36.0, 5.5, 15.0, 4.17),
        links=(
            Link(0, 1, 49340.0, 2475.0), Link(1, 2, 20000.0, 330.0), Link(2, 3, 10000.0, 200.0),
            Link(1, 3, 192000.0, 909.1), Link(3, 4, 134400.0, 250.0),
        ),
        head=4,
        source="Wan and Schimmels 1995",
    ),
    "inert_75": OccupantModel(masses=(75.0,), links=(), head=None, source="ISO 10326-1, inert mass"),
}  # fmt: skip
"""Name -> model."""


def scaled(model: OccupantModel, mass: float) -> OccupantModel:
    """The model of a body of another ``mass`` [kg] on the seat: masses, springs and dampers by one
    factor.

    Natural frequencies, damping ratios and transmissibilities stay; the apparent mass grows with
    the body.
    """
    factor = mass / model.mass
    return model._replace(
        masses=tuple(factor * each for each in model.masses),
        links=tuple(
            link._replace(stiffness=factor * link.stiffness, damping=factor * link.damping) for link in model.links
        ),
    )


def stiffened(model: OccupantModel, factor: float) -> OccupantModel:
    """The model in another posture: springs by a ``factor`` [1], dampers by its root.

    Damping ratios stay and natural frequencies grow by the root; an erect or tense posture has
    about 1.1 to 1.25.
    """
    root = math.sqrt(factor)
    return model._replace(
        links=tuple(
            link._replace(stiffness=factor * link.stiffness, damping=root * link.damping) for link in model.links
        )
    )


def softened(model: OccupantModel, rms: float, exponent: float) -> OccupantModel:
    """The model under vibration of an ``rms`` [m/s^2] of the seat: springs by r^(-2 exponent),
    dampers by r^(-exponent), r the rms over 1 m/s^2. Damping ratios stay.
    """
    return stiffened(model, rms ** (-2.0 * exponent))
