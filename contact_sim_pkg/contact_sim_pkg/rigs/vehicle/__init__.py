"""Quarter car and seat, alone or together: rigs tire, seat and car."""

from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.rigs.vehicle.topics import vehicle_topics

__all__ = ["RIGS"]

_SIMULATION = f"{__name__}.simulation:Simulation"
_TIRE_REPORT, _SEAT_REPORT = f"{__name__}.tire.report:TIRE_REPORT", f"{__name__}.seat.report:SEAT_REPORT"

RIGS = (
    Rig(
        name="tire",
        contacts=("tire",),
        needs=("travel", "road"),
        takes=("slip", "tire"),
        simulation=_SIMULATION,
        topics=lambda scene: vehicle_topics(scene, ("tire",)),
        report=(_TIRE_REPORT,),
    ),
    Rig(
        name="seat",
        contacts=("seat",),
        needs=("vibration",),
        takes=("seat",),
        simulation=_SIMULATION,
        topics=lambda scene: vehicle_topics(scene, ("seat",)),
        report=(_SEAT_REPORT,),
    ),
    Rig(
        name="car",
        contacts=("tire", "seat"),
        needs=("travel", "road"),
        takes=("slip", "vibration", "tire", "seat"),
        simulation=_SIMULATION,
        topics=lambda scene: vehicle_topics(scene, ("tire", "seat")),
        report=(_TIRE_REPORT, _SEAT_REPORT),
    ),
)
