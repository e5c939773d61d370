"""Effects of the contact between sphere and sample.

An impact needs a loss to have a restitution; the shift acts where the sample's temperature changes.
The others add outputs of the same impact and change no force.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.records.effect import Effect, Observed, Verdict, choice_of_model

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["IMPACT_EFFECTS"]


def _loss(_scene: ResolvedScene, _observed: Observed) -> Verdict:
    return True, "the contact opens: an impact needs a loss to have a restitution"


def _shift(scene: ResolvedScene, _observed: Observed) -> Verdict:
    from contact_sim_pkg.rigs.impact.schema import ImpactSection

    temperatures = scene.section(ImpactSection).temperatures
    coldest, warmest = min(temperatures), max(temperatures)
    return coldest < warmest, f"the sample is {coldest:g} to {warmest:g} K warm"


_SCHEMA = f"{__package__}.schema_effects"
_MORE = choice_of_model("adds outputs of the same impact, and changes no force")

IMPACT_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:SphereElastic", help="elastic force", source="Contact Area",
        carries=True, feeds=("force", "wrench"), called_for=_MORE,
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:SphereLoss", help="viscous force", source="Contact Area",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=_loss,
    ),
    Effect(
        name="shift", section=f"{_SCHEMA}:Shift", help="time-temperature shift of the material", source="Contact Area",
        needs=("normal_elastic",), feeds=("force", "wrench", "events"), called_for=_shift,
    ),
    Effect(
        name="contact_stress", section=f"{_SCHEMA}:ContactStress", help="stress over the contact", source="Contact Area",
        needs=("normal_elastic",), publishes="stress", feeds=("stress",), called_for=_MORE,
    ),
    Effect(
        name="surface_waves", section=f"{_SCHEMA}:SurfaceWaves", help="circular surface wave", source="Contact Area",
        needs=("normal_elastic", "normal_dissipative"), publishes="wave", feeds=("wave",), called_for=_MORE,
    ),
    Effect(
        name="micro_front", section=f"{_SCHEMA}:MicroFront", help="front of the micro-impact", source="Contact Area",
        needs=("normal_elastic",), publishes="front", feeds=("front",), called_for=_MORE,
    ),
    Effect(
        name="thermal_volume", section=f"{_SCHEMA}:ThermalVolume", help="position and volumes of the contact",
        source="Contact Area", needs=("normal_elastic",), publishes="position", feeds=("position",), called_for=_MORE,
    ),
    Effect(
        name="history", section=f"{_SCHEMA}:History", help="depth by the hereditary integral",
        source="Johnson, Contact Mechanics, 6.5", needs=("normal_elastic", "normal_dissipative"), publishes="history",
        feeds=("history",), called_for=_MORE,
    ),
    Effect(
        name="gauge_noise", section=f"{_SCHEMA}:GaugeNoise", help="noise of the measured values", needs=("normal_elastic",),
        feeds=("events",), called_for=choice_of_model("whether the gauges are noisy is a choice of the scene"),
    ),
)  # fmt: skip
