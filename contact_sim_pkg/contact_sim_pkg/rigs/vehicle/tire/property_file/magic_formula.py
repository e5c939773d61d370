"""Vertical force and contact of a tire as the Magic Formula states them: what the fit aims at.

    F_z = F_0 (1 + p_1 dp) (q_1 r / R_0 + q_2 (r / R_0)^2),  dp = p / p_0 - 1
    a = R_0 (q_ra1 sqrt(e) + q_ra2 e),  b = w (q_rb1 e^(1/3) + q_rb2 e),  e = F_z / (c_z R_0)

with the deflection r, the half length a and half width b of the contact, ``c_z = c_z0 (1 + p_1 dp)``
and the stiffness at the nominal load and pressure ``c_z0 = (F_0 / R_0) sqrt(q_1^2 + 4 q_2)``.

Source: Besselink, Schmeitz, Pacejka, An improved Magic Formula/Swift tyre model that can handle
inflation pressure changes, Vehicle System Dynamics 48 (2010), eqs 4, 5, 9, 10.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile

__all__ = ["StandingTire", "standing_tire"]


class StandingTire(NamedTuple):
    """A tire under its nominal load at an inflation; None where the file does not say."""

    load: float  # [N]
    stiffness: float  # dF_z / dr [N/m]
    deflection: float  # r [m]
    length: float | None  # 2 a [m]
    width: float | None  # 2 b [m]


def standing_tire(tire: PropertyFile, radius: float, pressure: float, nominal: float) -> StandingTire | None:
    """The tire of a file at an inflation of `pressure` [Pa]; None without load or stiffness.

    radius: R_0 [m]; nominal: p_0 [Pa], at which the coefficients hold. The contact is that of a file
    with Q_RA1 or Q_RA2, Q_RB1 or Q_RB2.

    Raises PropertyFileError where the coefficients give no positive stiffness or contact.
    """
    load, stiffness = tire.get("FNOMIN"), tire.get("VERTICAL_STIFFNESS")
    linear, square = tire.get("Q_FZ1"), tire.get("Q_FZ2") or 0.0
    if load is None or (stiffness is None and not linear):
        return None
    # Stiffness at the nominal load and pressure, and the linear coefficient of the load.
    if stiffness is not None:
        stiffness *= tire.get("LCZ") or 1.0
        under_root = (stiffness * radius / load) ** 2 - 4.0 * square
    else:
        under_root = (linear or 0.0) ** 2
        stiffness = load / radius * math.sqrt(max(under_root + 4.0 * square, 0.0))
    growth = 1.0 + (tire.get("PFZ1") or 0.0) * (pressure / nominal - 1.0)
    if not (under_root > 0.0 and growth > 0.0 and under_root + 4.0 * square / growth > 0.0):
        raise PropertyFileError(
            f"{tire.file}: stiffness {stiffness:g} N/m at FNOMIN, Q_FZ2 {square:g} and PFZ1 give no tire that "
            f"carries {load:g} N at {pressure:g} Pa"
        )
    # At this inflation: the deflection solves q_1 x + q_2 x^2 = 1 / growth.
    slope = math.sqrt(under_root + 4.0 * square / growth)
    deflection = radius * 2.0 / growth / (math.sqrt(under_root) + slope)
    relative = load / (stiffness * growth * radius)
    length = _extent(tire, "Q_RA", radius, relative, 0.5)
    width = _extent(tire, "Q_RB", tire.get("WIDTH") or 0.0, relative, 1.0 / 3.0)
    return StandingTire(load, load / radius * growth * slope, deflection, length, width)


def _extent(tire: PropertyFile, name: str, size: float, relative: float, exponent: float) -> float | None:
    """Extent [m] of the contact of coefficients `name` 1 and 2."""
    root, linear = tire.get(f"{name}1") or 0.0, tire.get(f"{name}2") or 0.0
    if root == 0.0 == linear:
        return None
    extent = 2.0 * size * (root * relative**exponent + linear * relative)
    if not 1e-3 <= extent <= 1.0:
        raise PropertyFileError(
            f"{tire.file}: {name}1 {root:g} and {name}2 {linear:g} give a contact of {extent:.4g} m; 1e-3 to 1 m is allowed"
        )
    return extent
