"""Quarter car and seat, alone or together: rigs tire, seat and car."""

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.regime import LIFTS_OFF, STAYS, Regime
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.records.topic import BLOCK, FIELD, FORCE, PATCH, WRENCH, ContactTopic
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
    rules=(
        *(f"{__name__}.tire.schema_rules:{name}" for name in ("slip_breaches", "tire_effect_breaches")),
        f"{__name__}.tire.mount_rules:mount_breaches",
        f"{__name__}.tire.mount_rules:programme_breaches",
        f"{__name__}.tire.magic_formula.section:magic_formula_breaches",
        f"{__name__}.effects.bump_stop:bump_stop_breaches",
    ),
    topics=(
        FORCE,
        WRENCH,
        PATCH,
        ContactTopic("shear", "contact_msgs_defs/msg/ContactShear", FIELD),
        ContactTopic("axle", "contact_msgs_defs/msg/AxleForce"),
        ContactTopic("work", "contact_msgs_defs/msg/TireWork", BLOCK),
        ContactTopic("standing", "contact_msgs_defs/msg/TireStanding", "the first block"),
    ),
)
SEAT = Contact(
    name="seat",
    help="contact between occupant and cushion",
    section=f"{__name__}.seat.schema:SeatSection",
    section_help="occupant and cushion (rigs seat and car); defaults where absent",
    effects=SEAT_EFFECTS,
    rules=(
        *(
            f"{__name__}.seat.schema_rules:{name}"
            for name in ("occupant_breaches", "cushion_breaches", "response_breaches")
        ),
        f"{__name__}.effects.suspension:suspension_breaches",
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
_ROAD_STRIP = f"{__name__}.tire.lattice:road_strip"
_STANDING = f"{__name__}.tire.lattice:standing"
_EVENTS = f"{__name__}.tire.effects:prescribed_events"

_MEASURES = f"{__name__}.tire.report.regimes"
TIRE_REGIMES = (
    STAYS,
    LIFTS_OFF,
    Regime(
        name="locks", measure=f"{_MEASURES}:locking", unit="s", at_least=0.05,
        help="time in which the wheel stands still and the whole footprint slides",
    ),
    Regime(
        name="rings", measure=f"{_MEASURES}:ringing", unit="Hz", at_least=15.0,
        help="frequency of the force along the road behind an obstacle",
    ),
    Regime(
        name="shakes", measure=f"{_MEASURES}:shaking", at_least=0.05, help="standard deviation of the load over the load at rest"
    ),
    Regime(
        name="is_elliptic", measure=f"{_MEASURES}:ellipse", at_least=1.9, at_most=2.1,
        help="Lamé exponent of the footprint, 2 for an ellipse",
    ),
    Regime(
        name="bears_on_peaks", measure=f"{_MEASURES}:unevenness", at_least=2.0,
        help="peak over mean pressure about the load at rest",
    ),
    Regime(
        name="is_pushed", measure=f"{_MEASURES}:pushing", at_least=0.01,
        help="largest force of the road's asperities over the load at rest",
    ),
)  # fmt: skip

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
            "tire_magic_formula": 26,
            "tire_plate": 26,
            "tire_drum": 26,
            "tire_flat_track": 26,
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
        regimes=TIRE_REGIMES,
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
        scenes={"seat_ride": 0, "seat_drop": 17, "suspension_seat": 17, "office_chair": 17, "plate": 17},
        simulation=_SIMULATION,
        other_half=_OTHER_HALF,
        work=f"{__name__}.work:work_of_seat",
        report=(_SEAT_REPORT,),
        regimes=(STAYS, LIFTS_OFF),
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
        scenes={"car_ride": 31, "car_full_bench": 32},
        simulation=_SIMULATION,
        other_half=_OTHER_HALF,
        work=f"{__name__}.work:work_of_car",
        report=(_TIRE_REPORT, _SEAT_REPORT),
        regimes=TIRE_REGIMES,
        road_strip=_ROAD_STRIP,
        standing=_STANDING,
        events=_EVENTS,
    ),
)
