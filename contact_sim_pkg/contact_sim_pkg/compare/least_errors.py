"""Numerical errors that no request makes smaller, by the records of the effects that act."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from contact_sim_pkg.records.registry import rigs

__all__ = ["LeastError", "least_errors"]

MOTION = "motion"


class LeastError(NamedTuple):
    """An error that an effect leaves at every request."""

    error: float  # [1] over the scale of its kind
    effect: str  # with its contact: `tire brush`


def least_errors(scene: Mapping[str, Any]) -> dict[str, dict[str, LeastError]]:
    """Of a resolved scene as plain data, the largest such error by contact, or ``motion``, and kind.

    Empty where the rig is not known.
    """
    rig = rigs().get(str(scene.get("rig")))
    found: dict[str, dict[str, LeastError]] = {}
    for contact in () if rig is None else rig.contacts:
        acting = scene.get("effects", {}).get(contact.name) or {}
        for effect in contact.effects:
            if acting.get(effect.name) is None:
                continue
            for kind, error in effect.not_below.items():
                kinds = found.setdefault(MOTION if kind == MOTION else contact.name, {})
                kinds[kind] = max(
                    kinds.get(kind, LeastError(0.0, "")), LeastError(error, f"{contact.name} {effect.name}")
                )
    return found
