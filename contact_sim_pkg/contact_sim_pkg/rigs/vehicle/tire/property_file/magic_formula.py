"""Vertical force and contact of a tire as the Magic Formula states them: what the fit aims at.

    F_z = F_0 (1 + p_1 dp) (q_1 r / R_0 + q_2 (r / R_0)^2),  dp = p / p_0 - 1
    a = R_0 (q_ra1 sqrt(e) + q_ra2 e),  b = w (q_rb1 e^(1/3) + q_rb2 e),  e = F_z / (c_z R_0)

A table of load over deflection at p_0 replaces the first, with its loads times ``1 + p_1 dp``; with
the deflection r, the half length a and half width b of the contact, ``c_z = c_z0 (1 + p_1 dp)``
and the stiffness at the nominal load and pressure ``c_z0 = (F_0 / R_0) sqrt(q_1^2 + 4 q_2)``.

Source: Besselink, Schmeitz, Pacejka, An improved Magic Formula/Swift tyre model that can handle
inflation pressure changes, Vehicle System Dynamics 48 (2010), eqs 4, 5, 9, 10.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile

__all__ = ["USUAL_COEFFICIENTS", "StandingTire", "contact_of", "contradiction", "law_tire", "standing_tire"]

CONTRADICTION = 0.1  # relative, of stiffness or deflection


class StandingTire(NamedTuple):
    """A tire under a load at an inflation; None where the file does not say."""

    load: float  # [N]
    stiffness: float  # dF_z / dr [N/m]
    deflection: float  # r [m]
    length: float | None  # 2 a [m]
    width: float | None  # 2 b [m]


def standing_tire(
    tire: PropertyFile, radius: float, pressure: float, nominal: float, load: float | None = None, part: float = 1.0
) -> StandingTire | None:
    """The tire of a file under a ``part`` of its nominal load at an inflation of ``pressure`` [Pa], by its
    table of loads where that reaches the load, else by its coefficients; None without load or
    stiffness.

    radius: R_0 [m]; nominal: p_0 [Pa], at which the coefficients hold; load [N] where the file has no
    FNOMIN. The contact is that of a file with Q_RA1 or Q_RA2, Q_RB1 or Q_RB2.

    Raises PropertyFileError where the coefficients give no positive stiffness or contact.
    """
    load = tire.get("FNOMIN") or load
    by_law = law_tire(tire, radius, pressure, nominal, load, part)
    growth = 1.0 + (tire.get("PFZ1") or 0.0) * (pressure / nominal - 1.0)
    by_curve = (
        None if tire.curve is None or load is None or not growth > 0.0 else tire.curve.under(part * load / growth)
    )
    if load is None or by_curve is None:
        return by_law
    deflection, stiffness = by_curve[0], growth * by_curve[1]
    if by_law is not None:
        return by_law._replace(stiffness=stiffness, deflection=deflection)
    return StandingTire(part * load, stiffness, deflection, None, None)


def contradiction(tire: PropertyFile, by_law: StandingTire, standing: StandingTire) -> str | None:
    """A sentence where table and coefficients of a file differ by more than 10 % under its load."""
    assert tire.curve is not None
    ratios = standing.stiffness / by_law.stiffness, standing.deflection / by_law.deflection
    if all(abs(ratio - 1.0) <= CONTRADICTION for ratio in ratios):
        return None
    stated = "VERTICAL_STIFFNESS" if "VERTICAL_STIFFNESS" in tire.values else "Q_FZ1"
    line = tire.values[stated].line
    return (
        f"the file contradicts itself: under {standing.load:g} N [DEFLECTION_LOAD_CURVE] (line {tire.curve.line}) has "
        f"{standing.stiffness:.4g} N/m and {1e3 * standing.deflection:.3g} mm, {stated} (line {line}) {by_law.stiffness:.4g} "
        f"N/m and {1e3 * by_law.deflection:.3g} mm; the table counts"
    )


def law_tire(
    tire: PropertyFile, radius: float, pressure: float, nominal: float, load: float | None, part: float = 1.0
) -> StandingTire | None:
    """The tire by the coefficients alone, under a ``part`` of the load."""
    stiffness = tire.get("VERTICAL_STIFFNESS")
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
    if not (under_root > 0.0 and growth > 0.0 and under_root + 4.0 * square * part / growth > 0.0):
        raise PropertyFileError(
            f"{tire.file}: stiffness {stiffness:g} N/m at FNOMIN, Q_FZ2 {square:g} and PFZ1 give no tire that "
            f"carries {part * load:g} N at {pressure:g} Pa"
        )
    # At this load and inflation: the deflection solves q_1 x + q_2 x^2 = part / growth.
    slope = math.sqrt(under_root + 4.0 * square * part / growth)
    deflection = radius * 2.0 * part / growth / (math.sqrt(under_root) + slope)
    relative = part * load / (stiffness * growth * radius)
    coefficients = [tire.get(f"Q_R{axis}{place}") or 0.0 for axis in "AB" for place in (1, 2)]
    extents: list[float | None] = list(contact_of(coefficients, radius, tire.get("WIDTH") or 0.0, relative))
    for axis, place in (("A", 0), ("B", 1)):
        extent, (root, straight) = extents[place], coefficients[2 * place : 2 * place + 2]
        if root == 0.0 == straight:
            extents[place] = None
        elif extent is None or not 1e-3 <= extent <= 1.0:
            raise PropertyFileError(
                f"{tire.file}: Q_R{axis}1 {root:g} and Q_R{axis}2 {straight:g} give a contact of {extent:.4g} m; 1e-3 to 1 m "
                "is allowed"
            )
    return StandingTire(part * load, load / radius * growth * slope, deflection, extents[0], extents[1])


USUAL_COEFFICIENTS = (0.671, 0.733, 1.059, -1.1878)
"""Q_RA1, Q_RA2, Q_RB1, Q_RB2 of the published 205/60 R15."""


def contact_of(coefficients: Sequence[float], radius: float, width: float, relative: float) -> tuple[float, float]:
    """Length and width [m] of the contact of Q_RA1, Q_RA2, Q_RB1 and Q_RB2 at e = ``relative``."""
    root, straight, cube_root, linear = coefficients
    return (
        2.0 * radius * (root * math.sqrt(relative) + straight * relative),
        2.0 * width * (cube_root * relative ** (1.0 / 3.0) + linear * relative),
    )
