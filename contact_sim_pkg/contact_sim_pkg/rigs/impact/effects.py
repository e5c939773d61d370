"""Effects of the contact between sphere and sample.

An impact needs a loss to have a restitution, and the shift where the sample is not as warm as a room.
The others add outputs of the same impact and change no force.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.records.effect import Effect, without_loss

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["IMPACT_EFFECTS"]

ROOM, NEAR = 293.15, 1.0  # [K] of the values of a sample, and a difference that changes them by little


def _shift(scene: ResolvedScene) -> str:
    from contact_sim_pkg.rigs.impact.schema import ImpactSection

    furthest = max(scene.section(ImpactSection).temperatures, key=lambda each: abs(each - ROOM))
    if abs(furthest - ROOM) <= NEAR:
        return ""
    return f"the sample has {furthest:g} K, and its values are those of a room, {ROOM:g} K"


_SCHEMA = f"{__package__}.schema_effects"

IMPACT_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:SphereElastic", help="elastic force", source="Contact Area",
        carries=True, feeds=("force", "wrench"),
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:SphereLoss", help="viscous force", source="Contact Area",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=without_loss("impact", "normal_dissipative"),
    ),
    Effect(
        name="shift", section=f"{_SCHEMA}:Shift", help="time-temperature shift of the material", source="Contact Area",
        needs=("normal_elastic",), feeds=("force", "wrench", "events"), called_for=_shift,
    ),
    Effect(
        name="contact_stress", section=f"{_SCHEMA}:ContactStress", help="stress over the contact", source="Contact Area",
        needs=("normal_elastic",), publishes="stress", feeds=("stress",),
    ),
    Effect(
        name="surface_waves", section=f"{_SCHEMA}:SurfaceWaves", help="circular surface wave", source="Contact Area",
        needs=("normal_elastic", "normal_dissipative"), publishes="wave", feeds=("wave",),
    ),
    Effect(
        name="micro_front", section=f"{_SCHEMA}:MicroFront", help="front of the micro-impact", source="Contact Area",
        needs=("normal_elastic",), publishes="front", feeds=("front",),
    ),
    Effect(
        name="thermal_volume", section=f"{_SCHEMA}:ThermalVolume", help="position and volumes of the contact",
        source="Contact Area", needs=("normal_elastic",), publishes="position", feeds=("position",),
    ),
    Effect(
        name="history", section=f"{_SCHEMA}:History", help="depth by the hereditary integral",
        source="Johnson, Contact Mechanics, 6.5", needs=("normal_elastic", "normal_dissipative"), publishes="history",
        feeds=("history",),
    ),
    Effect(
        name="gauge_noise", section=f"{_SCHEMA}:GaugeNoise", help="noise of the measured values", needs=("normal_elastic",),
        feeds=("events",),
    ),
)  # fmt: skip
