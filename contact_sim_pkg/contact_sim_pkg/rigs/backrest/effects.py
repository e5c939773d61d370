"""Effects of the contact between back and seat back.

A scene calls for friction where the back slides along the seat back, for a loss where none acts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.records.effect import Effect, without_loss

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["BACKREST_EFFECTS"]

STILL = 1e-6  # [m] of sliding that no one notices


def _friction(scene: ResolvedScene) -> str:
    from contact_sim_pkg.rigs.backrest.schema import BackrestSection

    slides = scene.section(BackrestSection).sliding.amplitude
    return f"the back slides {1e3 * slides:g} mm along the seat back" if slides > STILL else ""


_SCHEMA, _LAWS = f"{__package__}.schema", "contact_sim_pkg.scene.schema.laws"
_LOSS = without_loss("backrest", "normal_dissipative", "general_dissipative", "foam_hysteresis")

BACKREST_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:BackElastic", help="elastic force", source="Driver and Seat",
        carries=True, feeds=("force", "wrench"),
    ),
    Effect(
        name="cushion", section=f"{_SCHEMA}:BackCushion", help="foam of finite thickness and its pressure map",
        source="Johnson, Contact Mechanics, 5.8", carries=True, excludes=("normal_elastic", "foam", "shell_modes"),
        feeds=("force", "wrench", "patch", "points"),
        not_below={"force": 1e-3, "motion": 3e-3, "peak": 2.6e-3, "area": 2.5e-2},
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:BackLoss", help="loss", source="Driver and Seat",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=_LOSS,
    ),
    Effect(
        name="foam", section=f"{_LAWS}:Foam", help="foam with plateau and densification", source="Driver and Seat",
        needs=("normal_elastic",), feeds=("force", "wrench"),
    ),
    Effect(
        name="foam_hysteresis", section=f"{_LAWS}:FoamHysteresisSection", help="rate-independent loss of foam",
        needs=("normal_elastic",), feeds=("force", "wrench"),
    ),
    Effect(
        name="general_dissipative", section=f"{_SCHEMA}:BackGeneralDissipation", help="loss by the general law",
        source="Driver and Seat", needs=("normal_elastic",), excludes=("normal_dissipative",),
        feeds=("force", "wrench", "patch"), called_for=_LOSS,
    ),
    Effect(
        name="friction", section=f"{_SCHEMA}:BackFriction", help="friction with stick and slip", source="Driver and Seat",
        needs=("normal_elastic",), feeds=("force", "wrench", "points"), inputs=("backrest.sliding",),
        called_for=_friction,
    ),
    Effect(
        name="shell_modes", section=f"{_SCHEMA}:ShellModesSection", help="back as a shell with many contact points",
        source="Driver and Seat", needs=("normal_elastic",), feeds=("force", "wrench", "patch", "points"),
        not_below={"force": 8e-2, "motion": 0.14},
    ),
    Effect(
        name="contact_search", section=f"{_SCHEMA}:ContactSearchSection", help="moving contact point of the shell",
        source="Driver and Seat", needs=("shell_modes",), feeds=("force", "wrench", "patch", "points"),
    ),
)  # fmt: skip
