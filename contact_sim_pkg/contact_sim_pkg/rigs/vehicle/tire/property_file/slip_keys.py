"""From a tire property file to the keys of bristles and sidewall compliance.

    K_x = k A^2 / (2 w) = PKX1 F_0          slip stiffness of bristles k [N/m^3] over a contact of
                                            area A and width w, as long everywhere as its mean chord
    1 / C_y = 1 / C + 1 / (k A)             side stiffness of belt C and bristles in series
    C_t = I_b (2 pi f)^2                    wind-up of the belt on a rim that stands
    K_y = K_0 / (1 + K_0 t / C_p)           cornering, with the yaw stiffness C_p; K_0 = K_x, t = A / (6 w)

Source: Pacejka, Tire and Vehicle Dynamics (2012), 3.2 and 4.3: ``K_y = PKY1 F_0 sin(PKY4
atan(F_z / (PKY2 F_0)))``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.schema import SidewallComplianceSection

SIDEWALLS = ("LATERAL_STIFFNESS", "YAW_STIFFNESS", "BELT_IYY", "FREQ_WINDUP", "DAMP_WINDUP")

__all__ = ["SlipKeys", "slip_keys"]

Keys = dict[str, float]


class SlipKeys(NamedTuple):
    """Keys of the effects, empty where the file gives none."""

    brush: Keys
    compliance: Keys
    cornering: tuple[float, float] | None  # [N/rad] of the file and of the tire


def slip_keys(tire: PropertyFile, contact: tuple[float, float] | None, notes: list[str]) -> SlipKeys:
    """Keys from a file whose fitted tire stands on a ``contact`` of a length and a width [m] under FNOMIN;
    None where the file has no contact.
    """
    stiffness, load = tire.get("PKX1"), tire.get("FNOMIN")
    compliance = _compliance(tire)
    if contact is None or not stiffness or load is None or stiffness < 0.0:
        if stiffness:
            notes.append("PKX1 is not used: it needs FNOMIN, VERTICAL_STIFFNESS, Q_RA and Q_RB for the contact")
        of_sidewalls = [key for key in SIDEWALLS if tire.get(key) is not None]
        if of_sidewalls:
            notes.append(f"{', '.join(of_sidewalls)}: not used without bristles, which need PKX1 and the contact")
        return SlipKeys({}, compliance, None)
    length, width = contact
    area = ROUND * length * width
    bristles = 2.0 * width * stiffness * load / area**2
    lateral = tire.get("LATERAL_STIFFNESS")
    if lateral is not None:
        series = 1.0 / lateral - 1.0 / (bristles * area)
        if series > 0.0:
            compliance["lateral"] = 1.0 / series
        else:
            notes.append(
                f"LATERAL_STIFFNESS {lateral:g} N/m is above that of the bristles alone, {bristles * area:.4g} N/m"
            )
    yaw = compliance.get("yaw", SidewallComplianceSection().yaw)
    own = stiffness * load
    cornering = own / (1.0 + own * area / (6.0 * width) / yaw)
    file = _cornering(tire, load)
    return SlipKeys(
        {"stiffness_x": bristles, "stiffness_y": bristles}, compliance, None if file is None else (file, cornering)
    )  # fmt: skip


ROUND = 0.92
"""Area of the contact of an inflated tire over that of its rectangle."""


def _compliance(tire: PropertyFile) -> Keys:
    """What needs no contact."""
    found: Keys = {}
    inertia, wind_up = tire.get("BELT_IYY"), tire.get("FREQ_WINDUP")
    if inertia is not None:
        found["belt_inertia"] = inertia
    if wind_up is not None:
        found["rotational"] = (inertia or SidewallComplianceSection().belt_inertia) * (2.0 * math.pi * wind_up) ** 2
    for key, name in (("YAW_STIFFNESS", "yaw"), ("DAMP_WINDUP", "damping_ratio")):
        value = tire.get(key)
        if value is not None:
            found[name] = value
    return found


def _cornering(tire: PropertyFile, load: float) -> float | None:
    """Cornering stiffness [N/rad] of the file at its nominal load and pressure."""
    peak, at, shape = tire.get("PKY1"), tire.get("PKY2"), tire.get("PKY4") or 2.0
    if not peak or not at:
        return None
    return abs(peak) * load * math.sin(shape * math.atan(1.0 / at))
