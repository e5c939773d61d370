"""Loads of a run over the load of the tire at rest."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.records.report import LedgerScope
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.vehicle.tire.lattice import plain_load
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import shear_of

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


OUTSIDE = {
    "brush": "friction of the bristles",
    "tread_viscoelasticity": "rolling resistance of the tread",
    "rolling_loss": "rolling resistance",
}
"""By effect: what turns energy over beside the vertical motion, where no belt moves in the plane of the road."""


def ledger_scope(recording: Recording) -> LedgerScope | None:
    """The ledger of a tire whose belt moves on its sidewalls, or by the Magic Formula, is of the whole rig: None.
    Another is that of the vertical motion; what the scene's effects turn over beside it, the work of friction with its figure.
    """
    effects = (recording.scene.get("effects") or {}).get(TIRE) or {}
    if any(effects.get(name) is not None for name in ("sidewall_compliance", "magic_formula")):
        return None
    outside = {name: text for name, text in OUTSIDE.items() if effects.get(name) is not None}
    shear = shear_of(recording)
    if shear is not None and "brush" in outside:
        outside["brush"] += f" ({number(float(shear.dissipated.sum()))} J in tire/shear)"
    return LedgerScope("vertical motion", tuple(outside.values()))
