"""Roller on a rotating shaft: rolling vibro-impact, tilt and yaw, damage, corrugation.

Rig roller.
"""

from typing import Any

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.regime import LIFTS_OFF, STAYS, Regime
from contact_sim_pkg.records.rig import Rig, Standing, TouchedBody
from contact_sim_pkg.records.topic import BLOCK, FORCE, ContactTopic
from contact_sim_pkg.rigs.roller.effects import ROLLER_EFFECTS

__all__ = ["RIGS"]

ROLLER = Contact(
    name="roller",
    help="contact between roller and shaft",
    section=f"{__name__}.schema:RollerRig",
    section_help="roller on a rotating shaft (rig roller); defaults where absent",
    effects=ROLLER_EFFECTS,
    rules=(f"{__name__}.schema_rules:roller_breaches",),
    topics=(
        FORCE,
        ContactTopic(
            "stability",
            "contact_msgs_defs/msg/RollerStability",
            "the first block, and each in which the load changed",
        ),
        ContactTopic("contact", "contact_msgs_defs/msg/RollerContact"),
        ContactTopic("track", "contact_msgs_defs/msg/RollerTrack", BLOCK),
        ContactTopic("volumes", "contact_msgs_defs/msg/RollerVolumes", "`effects.roller.subsurface.instants`"),
    ),
)


def standing(scene: dict[str, Any]) -> Standing:
    """Mass of the roller of a resolved scene's plain data; its load is a programme."""
    return Standing({}, {"roller_z": TouchedBody("roller", scene["roller"]["mass"])})


_MEASURES = f"{__name__}.report.regimes"
REGIMES = (
    Regime(name="grows", measure=f"{_MEASURES}:growth", unit="1/s", at_least=1e-3, help="growth rate of tilt and yaw"),
    Regime(
        name="corrugates", measure=f"{_MEASURES}:waves", at_least=2.0,
        help="height of the waves of the track at the end over that at the start",
    ),
    Regime(
        name="alternates", measure=f"{_MEASURES}:alternation", at_least=1.0,
        help="changes of the long axis of the ellipse from one direction to the other",
    ),
    Regime(
        name="yields", measure=f"{_MEASURES}:first_yield", unit="s", at_least=0.0,
        help="instant from which the pressure is above first yield",
    ),
    Regime(
        name="agrees", measure=f"{_MEASURES}:acceleration", at_most=0.1,
        help="error of the time acceleration, beside intervals ridden turn by turn",
    ),
    STAYS,
    LIFTS_OFF,
)  # fmt: skip

RIGS = (
    Rig(
        name="roller",
        kernels=40,
        help="roller on a shaft",
        contacts=(ROLLER,),
        takes=("road",),
        scenes={
            "roller_flutter": 7,
            "roller_steady": 8,
            "roller_corrugation": 9,
            "roller_hour": 10,
            "roller_programme": 11,
        },
        simulation=f"{__name__}.simulation:RollerSimulation",
        standing=f"{__name__}:standing",
        work=f"{__name__}.work:work_of_roller",
        report=(f"{__name__}.report:ROLLER_REPORT",),
        regimes=REGIMES,
        forecast=f"{__name__}.forecast",
    ),
)
