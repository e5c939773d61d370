"""Sphere that strikes a viscoelastic sample: drop tower and pendulum. Rig impact."""

from typing import Any

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.regime import LIFTS_OFF, Regime
from contact_sim_pkg.records.rig import Rig, Standing, TouchedBody
from contact_sim_pkg.records.topic import FORCE, WRENCH, ContactTopic
from contact_sim_pkg.rigs.impact.effects import IMPACT_EFFECTS

__all__ = ["RIGS"]

AN_IMPACT = "an impact"  # when a message comes

IMPACT = Contact(
    name="impact",
    help="contact between sphere and sample",
    section=f"{__name__}.schema:ImpactSection",
    section_help="impact of a sphere on a sample (rig impact); defaults where absent",
    effects=IMPACT_EFFECTS,
    rules=(f"{__name__}.schema_rules:impact_breaches",),
    topics=(
        FORCE,
        WRENCH,
        ContactTopic("events", "contact_msgs_defs/msg/ImpactEvents", "a block in which an impact ended"),
        ContactTopic("course", "contact_msgs_defs/msg/ImpactCourse", AN_IMPACT, key="course_samples"),
        ContactTopic("stress", "contact_msgs_defs/msg/ImpactStress", AN_IMPACT),
        ContactTopic("wave", "contact_msgs_defs/msg/ImpactWave", AN_IMPACT),
        ContactTopic("front", "contact_msgs_defs/msg/ImpactFront", AN_IMPACT),
        ContactTopic("position", "contact_msgs_defs/msg/ImpactPosition", AN_IMPACT),
        ContactTopic("history", "contact_msgs_defs/msg/ImpactHistory", AN_IMPACT),
    ),
)


def standing(scene: dict[str, Any]) -> Standing:
    """Weight and mass of the sphere of a resolved scene's plain data."""
    sphere = scene["impact"]
    load = sphere["mass"] * sphere["gravity"]
    return Standing({"impact": load}, {"sphere_z": TouchedBody("impact", sphere["mass"])})


_MEASURES = f"{__name__}.report.regimes"
REGIMES = (
    Regime(name="strikes", measure=f"{_MEASURES}:blows", at_least=2.0, help="impacts"),
    Regime(
        name="comes_to_rest", measure=f"{_MEASURES}:decay", at_most=1e-3,
        help="largest speed in the last tenth of the run over that of the first impact",
    ),
    Regime(
        name="rebounds", measure=f"{_MEASURES}:brief_contacts", at_most=1e-3,
        help="longest contact over the flight behind it",
    ),
    Regime(
        name="softens", measure=f"{_MEASURES}:softening", at_least=1.1,
        help="contact time at the highest over that at the lowest temperature",
    ),
    LIFTS_OFF,
)  # fmt: skip

RIGS = (
    Rig(
        name="impact",
        help="sphere that strikes a sample",
        contacts=(IMPACT,),
        scenes={"impact_rubber_drop": 19, "impact_pendulum": 20, "impact_steel": 21, "impact_temperature_sweep": 22},
        simulation=f"{__name__}.simulation:ImpactSimulation",
        standing=f"{__name__}:standing",
        report=(f"{__name__}.report:IMPACT_REPORT",),
        regimes=REGIMES,
    ),
)
