"""Back against a seat back: one mass or a shell with contact points. Rig backrest."""

from typing import Any

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.regime import LIFTS_OFF, STAYS, Regime
from contact_sim_pkg.records.rig import Rig, Standing, TouchedBody
from contact_sim_pkg.records.topic import FORCE, PATCH, POINTS, WRENCH
from contact_sim_pkg.rigs.backrest.effects import BACKREST_EFFECTS

__all__ = ["BACKREST", "RIGS"]

BACKREST = Contact(
    name="backrest",
    help="contact between back and seat back",
    section=f"{__name__}.schema:BackrestSection",
    section_help="occupant against a seat back (rig backrest); defaults where absent",
    effects=BACKREST_EFFECTS,
    rules=(f"{__name__}.schema_rules:backrest_breaches",),
    topics=(FORCE, WRENCH, PATCH, POINTS),
)


def standing(scene: dict[str, Any]) -> Standing:
    """Preload and mass of the back of a resolved scene's plain data; a shell has modes."""
    back = scene["backrest"]
    shell = scene["effects"]["backrest"].get("shell_modes") is not None
    return Standing(
        {"backrest": back["preload"]}, {} if shell else {"occupant_x": TouchedBody("backrest", back["mass"])}
    )


_MEASURES = f"{__name__}.report.regimes"
REGIMES = (
    Regime(name="slaps", measure=f"{_MEASURES}:slaps", at_least=1.0, help="contacts that began with a touch"),
    Regime(
        name="slips", measure=f"{_MEASURES}:slipping", unit="%", at_least=1.0,
        help="time in which the back slips while it keeps contact",
    ),
    Regime(name="is_struck", measure=f"{_MEASURES}:struck", at_least=2.0, help="largest load over that at the start"),
    STAYS,
    LIFTS_OFF,
)  # fmt: skip

RIGS = (
    Rig(
        name="backrest",
        help="occupant against a backrest",
        contacts=(BACKREST,),
        bench_topics=("bench/episodes",),
        needs=("vibration",),
        scenes={"seat_slap": 12, "seat_slip": 13, "seat_shock": 14, "seat_general": 15, "seat_shell": 16},
        simulation=f"{__name__}.simulation:BackrestSimulation",
        standing=f"{__name__}:standing",
        work=f"{__name__}.work:work_of_backrest",
        report=(f"{__name__}.report:BACKREST_REPORT",),
        regimes=REGIMES,
        unused_axes=lambda _effects: "z",
    ),
)
