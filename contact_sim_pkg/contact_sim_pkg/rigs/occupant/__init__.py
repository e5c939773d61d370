"""Occupant on a cushion and against a seat back under one body. Rig occupant."""

from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.rigs.backrest import backrest_topics
from contact_sim_pkg.rigs.vehicle.topics import vehicle_topics

__all__ = ["RIGS"]

RIGS = (
    Rig(
        name="occupant",
        contacts=("seat", "backrest"),
        needs=("vibration",),
        takes=("seat", "backrest"),
        simulation=f"{__name__}.simulation:OccupantSimulation",
        topics=lambda scene: [*vehicle_topics(scene, ("seat",)), *backrest_topics(scene)],
        report=(
            "contact_sim_pkg.rigs.vehicle.seat.report:SEAT_REPORT",
            "contact_sim_pkg.rigs.backrest.report:BACKREST_REPORT",
        ),
    ),
)
