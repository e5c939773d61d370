"""Rigid body on the ground with friction. Rig block."""

from typing import Any

from contact_sim_pkg.records.contact import LOOSEST_INTEGRATION, Contact
from contact_sim_pkg.records.regime import LIFTS_OFF, STAYS, Regime
from contact_sim_pkg.records.rig import Rig, Standing, TouchedBody
from contact_sim_pkg.records.topic import FORCE, POINTS, WRENCH
from contact_sim_pkg.rigs.body.effects import BLOCK_EFFECTS

__all__ = ["RIGS"]

RIGID_INTEGRATION = 1e-8
"""Loosest for a rigid body that turns on sticking points: the impacts that follow multiply its
errors.
"""

BLOCK = Contact(
    name="block",
    help="contact between a rigid body and the ground",
    section=f"{__name__}.schema:Block",
    section_help="rigid body over the ground (rig block); defaults where absent",
    effects=BLOCK_EFFECTS,
    rules=(f"{__name__}.schema_rules:block_breaches",),
    topics=(FORCE, WRENCH, POINTS),
    loosest_integration=lambda effects: (
        RIGID_INTEGRATION if effects.get("compliant_contact") is None else LOOSEST_INTEGRATION
    ),
)


def standing(scene: dict[str, Any]) -> Standing:
    """Weight and mass of the body of a resolved scene's plain data."""
    block = scene["block"]
    touched = TouchedBody("block", block["mass"])
    return Standing(
        {"block": block["mass"] * block["gravity"]}, dict.fromkeys(("block_x", "block_y", "block_z"), touched)
    )


_MEASURES = f"{__name__}.report.regimes"
REGIMES = (
    Regime(
        name="jams", measure=f"{_MEASURES}:jam", at_most=0.01,
        help="slip behind the first contact over that before, where no sliding motion exists",
    ),
    Regime(
        name="sticks", measure=f"{_MEASURES}:sticking", unit="s", at_least=0.0,
        help="instant from which friction holds the body at rest",
    ),
    Regime(
        name="rests", measure=f"{_MEASURES}:rest", unit="s", at_least=0.0, help="instant from which the body rests"
    ),
    Regime(
        name="bounces", measure=f"{_MEASURES}:bounces", at_least=2.0, help="contacts, with flights between them"
    ),
    Regime(
        name="tumbles", measure=f"{_MEASURES}:tumbling", unit="rad", at_least=1.5707963267948966,
        help="angle turned through from the first contact to rest",
    ),
    STAYS,
    LIFTS_OFF,
)  # fmt: skip

RIGS = (
    Rig(
        name="block",
        kernels=290,
        help="rigid body on the ground",
        contacts=(BLOCK,),
        scenes={
            "block_fall": 1,
            "block_slope": 2,
            "block_zeno": 3,
            "block_painleve": 4,
            "block_identify": 5,
            "box_3d_tumble": 6,
        },
        simulation=f"{__name__}.simulation:BlockBodySimulation",
        standing=f"{__name__}:standing",
        other_half=f"{__name__}.simulation:warm_up_solvers",
        work=f"{__name__}.work:work_of_block",
        report=(f"{__name__}.report:BLOCK_REPORT",),
        regimes=REGIMES,
    ),
)
