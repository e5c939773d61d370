"""Topics of the contacts of tire, seat and car. Knows no kernels."""

from __future__ import annotations

from typing import Any

__all__ = ["vehicle_topics"]

_FIELD_TOPICS = {"contact_field": "patch", "pressure_mat": "patch", "brush": "shear"}
"""Effects that publish a field, and their topics."""


def vehicle_topics(scene: dict[str, Any], contacts: tuple[str, ...]) -> list[str]:
    """Topics that a resolved scene calls for at these contacts."""
    names = []
    for contact in contacts:
        effects = scene["effects"].get(contact) or {}
        names += [f"{contact}/force", f"{contact}/wrench"]
        names += [f"{contact}/{topic}" for effect, topic in _FIELD_TOPICS.items() if effects.get(effect) is not None]
    return names
