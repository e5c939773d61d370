"""Back against a seat back: one mass or a shell with contact points. Rig backrest."""

from typing import Any

from contact_sim_pkg.records.rig import Rig

__all__ = ["RIGS", "backrest_topics"]


def backrest_topics(_scene: dict[str, Any]) -> list[str]:
    """Topics of the contact of the back."""
    return [*(f"backrest/{name}" for name in ("force", "wrench", "patch", "points")), "bench/episodes"]


RIGS = (
    Rig(
        name="backrest",
        contacts=("backrest",),
        needs=("vibration",),
        takes=("backrest",),
        simulation=f"{__name__}.simulation:BackrestSimulation",
        topics=backrest_topics,
        report=(f"{__name__}.report:BACKREST_REPORT",),
    ),
)
