"""Roller on a rotating shaft: rolling vibro-impact, tilt and yaw, damage, corrugation.

Rig roller.
"""

from typing import Any

from contact_sim_pkg.records.contact import Contact
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
        forecast=f"{__name__}.forecast",
    ),
)
