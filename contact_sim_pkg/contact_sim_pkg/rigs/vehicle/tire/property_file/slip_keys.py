"""From what is known of the rolling tire to the keys of bristles and sidewall compliance.

    1 / C_y = 1 / C + 1 / (k A)    side stiffness of belt C and bristles in series, on a contact of area A
    C_t = I_b (2 pi f)^2           wind-up of the belt on a rim that stands

Bristles, yaw stiffness, bending and extension are fitted (`fit.py`); friction is that of the peaks:
``mu = PD1 + PD2 df``, df = F_z / F_0 - 1.

Source: Pacejka, Tire and Vehicle Dynamics (2012), 4.3.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import Lines, Target, fitted_slip, rolling_on
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.schema import BrushSection, SidewallComplianceSection

SIDEWALLS = ("LATERAL_STIFFNESS", "YAW_STIFFNESS", "BELT_IYY", "FREQ_WINDUP", "DAMP_WINDUP")
OF_PEAK = 1.15 / 0.955
"""Static friction over the largest braking force over the load, of the usual tire at 60 km/h."""

__all__ = ["SlipKeys", "slip_keys"]

Keys = dict[str, float]


class SlipKeys(NamedTuple):
    """Keys of the effects, empty where nothing is known; and what the tire then has at each target."""

    brush: Keys
    compliance: Keys
    have: tuple[Target, ...]


def slip_keys(tire: PropertyFile, targets: Sequence[Target], lines: Sequence[Lines], notes: list[str]) -> SlipKeys:
    """Keys from the targets that say how the tire rolls, on the ``lines`` of the contacts that it has there; none for
    bristles and belt without targets.
    """
    compliance, usual = _compliance(tire), SidewallComplianceSection()
    if not targets:
        of_sidewalls = [key for key in SIDEWALLS if tire.get(key) is not None]
        if of_sidewalls:
            notes.append(f"{', '.join(of_sidewalls)}: not used without bristles, which need PKX1 and the contact")
        return SlipKeys({}, compliance, ())
    start = {
        "stiffness": BrushSection().stiffness_x, "yaw": compliance.get("yaw", usual.yaw), "bending": usual.bending,
        "extension": usual.extension,
    }  # fmt: skip
    found = fitted_slip(lines, targets, start, "yaw" if "yaw" in compliance else "")
    bristles = found.pop("stiffness")
    lateral = tire.get("LATERAL_STIFFNESS")
    if lateral is not None:
        area = min(zip(targets, lines, strict=True), key=lambda each: abs(each[0].load - (tire.get("FNOMIN") or 0.0)))[
            1
        ].area
        series = 1.0 / lateral - 1.0 / (bristles * area)
        if series > 0.0:
            compliance["lateral"] = 1.0 / series
        else:
            notes.append(
                f"LATERAL_STIFFNESS {lateral:g} N/m is above that of the bristles alone, {bristles * area:.4g} N/m"
            )
    return SlipKeys(
        {"stiffness_x": bristles, "stiffness_y": bristles, **_friction(tire)}, {**compliance, **found},
        tuple(rolling_on(each, bristles, **found) for each in lines),
    )  # fmt: skip


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


def _friction(tire: PropertyFile) -> Keys:
    """Friction whose peak along is that of the file at FNOMIN, and its fall with the load either way."""
    peak, load, usual = abs(tire.get("PDX1") or 0.0), tire.get("FNOMIN"), BrushSection()
    if not peak or load is None:
        return {}
    static = min(peak * OF_PEAK, 5.0)
    found = {
        "coefficient_static": static, "coefficient_kinetic": static * usual.coefficient_kinetic / usual.coefficient_static,
        "nominal_load": load,
    }  # fmt: skip
    for axis, key in (("X", "load_exponent"), ("Y", "load_exponent_across")):
        at_load, change = tire.get(f"PD{axis}1"), tire.get(f"PD{axis}2")
        if at_load and change is not None:
            found[key] = min(max(-change / at_load, 0.0), 1.0)
    return found
