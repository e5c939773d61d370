"""Loads of a run over the load of the tire at rest."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.report.series import ContactSeries, Recording
from contact_sim_pkg.rigs.vehicle.lattice import plain_load

TIRE = "tire"
"""Name of its contact."""


def standing_load_of(scene: dict[str, Any]) -> float | None:
    """Load [N] of the tire at rest; None where the scene has no tire whose masses are known."""
    if not isinstance(scene.get("tire"), dict):
        return None
    try:
        load = plain_load(scene)
    except (KeyError, TypeError):
        return None  # a scene that this version does not know
    return load if load > 0.0 else None


def contact_numbers(recording: Recording) -> dict[str, Any]:
    """Ratios of the load to that at rest; see `load_numbers`."""
    contact = recording.contacts.get(TIRE)
    return {} if contact is None else load_numbers(contact, standing_load_of(recording.scene))


def load_numbers(contact: ContactSeries, standing: float | None) -> dict[str, Any]:
    """Ratios to the standing load [N], ready for JSON; empty without one.

    `dynamic_load_coefficient` is the standard deviation of the normal force over the standing load.
    """
    if standing is None:
        return {}
    return {
        "standing_load_N": standing,
        "load_max_over_standing": float(contact.normal.max()) / standing,
        "dynamic_load_coefficient": float(contact.normal.std()) / standing,
    }
