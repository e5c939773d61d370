"""An identification as rows for tables and as one object for scripts."""

from __future__ import annotations

import math
from typing import Any

import numpy

from contact_sim_pkg.identify.contact.contacts import ContactFinding
from contact_sim_pkg.identify.contact.instant import Mode
from contact_sim_pkg.identify.identify import Identification, Parameter

__all__ = ["contact_rows", "derived", "facts", "parameter_rows"]

SIGMAS = 3.0  # a bound of friction below this many standard deviations says nothing


def parameter_rows(found: Identification) -> list[dict[str, Any]]:
    """Name, value, standard deviation, unit and whether it is identified; what follows from the
    parameters comes last.
    """
    return [_row(parameter) for parameter in [*found.parameters, *derived(found)]]


def _row(parameter: Parameter) -> dict[str, Any]:
    known = parameter.identified
    return {
        "parameter": parameter.name, "value": parameter.value if known else None,
        "standard deviation": parameter.deviation if known else None, "unit": parameter.unit, "identified": known,
    }  # fmt: skip


def derived(found: Identification) -> list[Parameter]:
    """m/J in the plane, the principal values of I0/m in space; mass and moments of inertia where
    1/m is identified.
    """
    inertia_known = all(parameter.identified for parameter in found.parameters if parameter.name != "1/m")
    lines = []
    if found.axis is not None:
        lines.append(_propagated(found, "m/J", "1/m^2", inertia_known, lambda p: 1.0 / p[0]))
    else:
        for place, name in enumerate(("smallest", "middle", "largest")):
            title = f"{name} principal I0/m"
            lines.append(_propagated(found, title, "m^2", inertia_known, lambda p, i=place: _principal(found, p)[i]))
    if found.parameters[-1].name == "1/m":
        mass_known = found.parameters[-1].identified
        lines.append(_propagated(found, "m", "kg", mass_known, lambda p: 1.0 / p[-1]))
        for place, parameter in enumerate(found.parameters[:-1]):
            known, name = mass_known and parameter.identified, parameter.name.removesuffix("/m")
            lines.append(_propagated(found, name, "kg m^2", known, lambda p, i=place: p[i] / p[-1]))
    return lines


def _principal(found: Identification, parameters: Any) -> Any:
    return numpy.linalg.eigvalsh(found.problem.model.inertia(parameters))


def _propagated(found: Identification, name: str, unit: str, known: bool, of: Any) -> Parameter:
    """A function of the parameters with its first-order standard deviation."""
    values, spread, scale = found.estimate.parameters, found.estimate.covariance, found.estimate.scale
    if not known:
        return Parameter(name, unit, float("nan"), float("nan"), False)
    slope: Any = numpy.zeros(len(values))
    for place in range(len(values)):
        step = 1e-6 * scale[place]
        ahead, behind = values.copy(), values.copy()
        ahead[place] += step
        behind[place] -= step
        slope[place] = (of(ahead) - of(behind)) / (2.0 * step)
    return Parameter(name, unit, float(of(values)), math.sqrt(max(0.0, float(slope @ spread @ slope))), True)


def contact_rows(found: Identification) -> list[dict[str, Any]]:
    """One row a contact; absolute impulses where the mass is identified."""
    mass = next((row for row in derived(found) if row.name == "m" and row.identified), None)
    return [_contact(contact, None if mass is None else mass.value) for contact in found.contacts]


def _contact(contact: ContactFinding, mass: float | None) -> dict[str, Any]:
    mode = contact.mode
    row: dict[str, Any] = {"time [s]": round(contact.begin, 9), "mode": None if mode is None else mode.mode}
    row["c_n/m [m/s]"] = contact.normal
    row["± c_n/m"] = contact.normal_deviation
    row["c_t/m [m/s]"] = contact.tangential
    row["± c_t/m"] = contact.tangential_deviation
    row["friction"] = None if mode is None else _friction(mode, contact)
    row["± friction"] = contact.friction_deviation
    row["Newton's e"] = None if mode is None else mode.newton_restitution
    if mass is not None:
        row["c_n [N s]"] = None if contact.normal is None else mass * contact.normal
        row["c_t [N s]"] = None if contact.tangential is None else mass * contact.tangential
    row["note"] = contact.note
    return row


def _friction(mode: Mode, contact: ContactFinding) -> float | str | None:
    """mu where the contact slid straight on, else the bound that the impulse leaves, if it says
    anything.
    """
    bound, spread = mode.friction_at_least, contact.friction_deviation or 0.0
    if mode.friction is not None or bound is None or bound <= SIGMAS * spread:
        return mode.friction
    return f">= {bound:.3g}"


def facts(found: Identification) -> dict[str, Any]:
    """Everything, ready for JSON; SI units in the names."""
    return {
        "plane_normal": None if found.axis is None else [float(value) for value in found.axis],
        "flights": found.flights,
        "rank": found.rank,
        "unknowns": found.unknowns,
        "converged": found.converged,
        "parameters": parameter_rows(found),
        "not_identifiable": found.unobservable,
        "consistency_warnings": found.warnings,
        "misfit": found.estimate.misfit,
        "contacts": [_contact_facts(contact) for contact in found.contacts],
        "noise": {
            "position_m": found.noise.position, "rotation_rad": found.noise.rotation,
            "velocity_m_s": found.noise.velocity, "angular_velocity_rad_s": found.noise.angular_velocity,
        },
    }  # fmt: skip


def _contact_facts(contact: ContactFinding) -> dict[str, Any]:
    mode = contact.mode
    return {
        "begin_s": contact.begin,
        "end_s": contact.end,
        "used": mode is not None,
        "mode": None if mode is None else mode.mode,
        "normal_impulse_over_mass_m_s": contact.normal,
        "normal_standard_deviation_m_s": contact.normal_deviation,
        "tangential_impulse_over_mass_m_s": contact.tangential,
        "tangential_standard_deviation_m_s": contact.tangential_deviation,
        "impulse_over_mass_m_s": None if contact.push is None else [float(value) for value in contact.push],
        "arm_m": None if contact.arm is None else [float(value) for value in contact.arm],
        "friction": None if mode is None else mode.friction,
        "friction_at_least": None if mode is None else mode.friction_at_least,
        "friction_standard_deviation": contact.friction_deviation,
        "newton_restitution": None if mode is None else mode.newton_restitution,
        "note": contact.note,
    }
