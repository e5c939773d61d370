"""Occupant on a cushion and against a seat back under one body. Rig occupant."""

from contact_sim_pkg.records.regime import LIFTS_OFF, STAYS
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.rigs.backrest import BACKREST
from contact_sim_pkg.rigs.vehicle import SEAT

__all__ = ["RIGS"]

RIGS = (
    Rig(
        name="occupant",
        kernels=110,
        help="on a seat and against its back",
        contacts=(SEAT, BACKREST),
        needs=("vibration",),
        scenes={"seat_ride_full": 18},
        simulation=f"{__name__}.simulation:OccupantSimulation",
        work=f"{__name__}.work:work_of_occupant",
        report=(
            "contact_sim_pkg.rigs.vehicle.seat.report:SEAT_REPORT",
            "contact_sim_pkg.rigs.backrest.report:BACKREST_REPORT",
        ),
        standing="contact_sim_pkg.rigs.vehicle.tire.lattice:standing",
        regimes=(STAYS, LIFTS_OFF),
        rules=(f"{__name__}.schema_rules:leaning_breaches",),
    ),
)
