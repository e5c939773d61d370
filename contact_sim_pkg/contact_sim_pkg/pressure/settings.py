"""Grid, accuracy and belt of a pressure field, in SI units."""

from __future__ import annotations

from typing import NamedTuple


class BeltSettings(NamedTuple):
    """A belt under tension on an elastic foundation, rigid across its width: what bends over an
    obstacle.
    """

    tension: float  # [N], > 0
    foundation: float  # [N/m^2] radial stiffness per length of circumference, > 0


class SidewallArc(NamedTuple):
    """Sidewalls of an inflated tire as arcs of fixed length, and the rigid ring that they carry."""

    pressure: float  # [Pa] inflation
    half_angle: float  # [rad] of the unloaded arc
    chord: float  # [m] of it
    ring_compliance: float  # [m/N] of the rigid ring against the rim, also where that is a body of its own


class InflatedBelt(NamedTuple):
    """Belt of an inflated tire, an inextensible ring without its modes 0 and 1, rigid across its
    width (``rigs/vehicle/field/inflated_belt.py``).
    """

    radius: float  # [m]
    tension: float  # [N]
    foundation: float  # [N/m^2] radial, per length of circumference
    tangential: float  # [N/m^2]
    bending: float  # [N m^2]
    ring_compliance: float  # [m/N] of the rigid ring against the rim; 0 where that is a body of its own
    arc: SidewallArc | None = None  # softens the foundation as the belt comes down; None: linear
    rubber: float = 0.0  # [N/m^2] part of the foundation that has the memory of rubber


class FieldSettings(NamedTuple):
    """Grid and accuracy of one pressure field."""

    rows: int
    cols: int
    cell_x: float  # [m]
    cell_y: float  # [m]
    modulus: float  # [Pa], plane-strain contact modulus E*
    tolerance: float  # complementarity residual requested of the solver
    maximum_iterations: int
    corrector_passes: int  # most repetitions of a coupling step with the field found at its end
    belt: BeltSettings | InflatedBelt | None = None  # yields in series with the half-space
    solver: type | None = None  # of a half-space, in place of `RollingField`


def widened(settings: FieldSettings) -> FieldSettings:
    """The same cells on twice the extent: the grid that takes over where the contact outgrows the
    first.
    """
    return settings._replace(
        rows=settings.rows + 2 * (settings.rows // 2), cols=settings.cols + 2 * (settings.cols // 2)
    )
