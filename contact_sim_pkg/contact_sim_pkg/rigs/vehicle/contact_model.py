"""What a contact of either kind is built from: its loss, the grids of its field, and the tangent
law between field instants.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.parameters import (
    NormalElastic,
)
from contact_sim_pkg.pressure.settings import FieldSettings, widened
from contact_sim_pkg.rigs.vehicle.contact_field import FieldError, PressureField, fit_tangent
from contact_sim_pkg.scene.errors import Fault, SceneError


@dataclass(frozen=True)
class FieldGrids:
    """The pressure field of one contact, and the wider one that takes over where the contact
    outgrows it.
    """

    usual: PressureField
    wide: PressureField

    def both(self) -> tuple[PressureField, PressureField]:
        """Usual grid first."""
        return (self.usual, self.wide)


def make_grids(settings: FieldSettings, contact: str) -> FieldGrids:
    """Field of a contact on its usual grid and on the wide one."""
    return FieldGrids(PressureField(settings, contact), PressureField(widened(settings), contact))


def tangent_law(
    grids: FieldGrids, gap_on: Callable[[FieldSettings], NDArray[numpy.float64]], load: float, contact: str
) -> tuple[NormalElastic, float]:
    """Tangent law of a contact at its standing ``load`` [N], and the length [m] of the contact
    along the rows.

    gap_on: settings of a grid -> undeformed gap [rows, cols] [m]. On the wide grid where the usual
    one does not hold the contact. Raises SceneError where that does not either.
    """
    for field in grids.both():
        try:
            law = fit_tangent(field, gap_on(field.settings), load)
            return law, int((field.pressure > 0.0).any(axis=1).sum()) * field.settings.cell_x
        except FieldError as error:
            reason = error
    # Neither grid holds the contact: the scene is wrong.
    where = f"effects.{contact}.contact_field"
    sentence = (
        f"the contact does not fit on its grid at the standing load of {load:.6g} N: {reason}; enlarge length and width"
    )
    raise SceneError([Fault("scene", 0, 0, where, sentence)])
