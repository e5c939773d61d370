"""Quarter car and seat, alone or together: rigs tire, seat and car."""

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.records.topic import FIELD, FORCE, PATCH, WRENCH, ContactTopic
from contact_sim_pkg.rigs.vehicle.seat.effects import SEAT_EFFECTS
from contact_sim_pkg.rigs.vehicle.tire.effects import TIRE_EFFECTS

__all__ = ["RIGS", "SEAT", "TIRE"]

RESPONSE = "every half of `seat.response_segment`, from its second segment on"

TIRE = Contact(
    name="tire",
    help="contact between tire and road",
    section=f"{__name__}.tire.schema:TireSection",
    section_help="quarter car and tire (rigs tire and car); defaults where absent",
    effects=TIRE_EFFECTS,
    rules=tuple(f"{__name__}.tire.schema_rules:{name}" for name in ("slip_breaches", "tire_effect_breaches")),
    topics=(
        FORCE,
        WRENCH,
        PATCH,
        ContactTopic("shear", "contact_msgs_defs/msg/ContactShear", FIELD),
        ContactTopic("axle", "contact_msgs_defs/msg/AxleForce"),
    ),
)
SEAT = Contact(
    name="seat",
    help="contact between occupant and cushion",
    section=f"{__name__}.seat.schema:SeatSection",
    section_help="occupant and cushion (rigs seat and car); defaults where absent",
    effects=SEAT_EFFECTS,
    rules=tuple(
        f"{__name__}.seat.schema_rules:{name}"
        for name in ("occupant_breaches", "cushion_breaches", "response_breaches")
    ),
    topics=(
        FORCE,
        WRENCH,
        PATCH,
        ContactTopic("response", "contact_msgs_defs/msg/SeatResponse", RESPONSE, "response_segment"),
    ),
)
_SIMULATION = f"{__name__}.simulation:Simulation"
_OTHER_HALF = f"{__name__}.other_half:compile_all_but_fields"
_TIRE_REPORT, _SEAT_REPORT = f"{__name__}.tire.report:TIRE_REPORT", f"{__name__}.seat.report:SEAT_REPORT"
_ROAD_STRIP = f"{__name__}.lattice:road_strip"
_STANDING = f"{__name__}.lattice:standing"
_EVENTS = f"{__name__}.tire.effects:prescribed_events"

RIGS = (
    Rig(
        name="tire",
        kernels=190,
        help="tire on a road",
        contacts=(TIRE,),
        needs=("travel", "road"),
        takes=("slip",),
        scenes={
            "tire_bump": 23,
            "tire_cleat": 24,
            "tire_braking": 25,
            "tire_rough_road": 26,
            "tire_belgian_block": 27,
            "tire_texture": 28,
            "tire_half_space": 29,
            "tire_irregular_road": 30,
        },
        simulation=_SIMULATION,
        other_half=_OTHER_HALF,
        work=f"{__name__}.work:work_of_tire",
        report=(_TIRE_REPORT,),
        road_strip=_ROAD_STRIP,
        standing=_STANDING,
        events=_EVENTS,
    ),
    Rig(
        name="seat",
        kernels=110,
        help="occupant on a seat",
        contacts=(SEAT,),
        needs=("vibration",),
        scenes={"seat_ride": 0, "seat_drop": 17},
        simulation=_SIMULATION,
        other_half=_OTHER_HALF,
        work=f"{__name__}.work:work_of_seat",
        report=(_SEAT_REPORT,),
        unused_axes=lambda effects: "x" if effects["seat"].get("friction") is None else "",
        standing=_STANDING,
    ),
    Rig(
        name="car",
        kernels=190,
        help="both as a car",
        contacts=(TIRE, SEAT),
        needs=("travel", "road"),
        takes=("slip", "vibration"),
        scenes={"car_full_bench": 31},
        simulation=_SIMULATION,
        other_half=_OTHER_HALF,
        work=f"{__name__}.work:work_of_car",
        report=(_TIRE_REPORT, _SEAT_REPORT),
        road_strip=_ROAD_STRIP,
        standing=_STANDING,
        events=_EVENTS,
    ),
)
