"""The standard procedures of a tire's test bench, each one record.

Conditions and names after ISO 28580 (rolling resistance: drum of 1.7 m or more, 80 km/h, 210 kPa), Pacejka, Tire and
Vehicle Dynamics, ch. 4 (cornering, braking, combined slip), ch. 9 (modes, relaxation) and ch. 10 (cleats).
"""

from __future__ import annotations

import math

from contact_sim_pkg.records.procedure import Curve, Map, Procedure, Quantity, Sheet
from contact_sim_pkg.rigs.vehicle.machines.specimen import Specimen

__all__ = ["QUANTITIES", "procedures_of"]

QUANTITIES: dict[str, Quantity] = {
    # conditions
    "load": Quantity("load", "N", "kN", 1e-3, 450.0, 2e5),
    "inflation": Quantity("inflation", "Pa", "kPa", 1e-3, 1e5, 4e5),
    "speed": Quantity("speed", "m/s", "km/h", 3.6, 0.5, 100.0),
    "slip": Quantity("slip", "", least=-1.0, most=1.0),
    "slip_angle": Quantity("slip angle", "rad", "deg", 180.0 / math.pi, -0.5, 0.5),
    "slip_step": Quantity("step of slip", "", least=1e-4, most=0.3),
    "drum_diameter": Quantity("drum diameter", "m", least=0.0, most=20.0, zero="flat ground"),
    "cleat_height": Quantity("cleat height", "m", "mm", 1e3, 1e-3, 0.03),
    "cleat_length": Quantity("cleat length", "m", "mm", 1e3, 0.012, 0.5),
    "wheel_mass": Quantity("wheel mass", "kg", least=0.1, most=2e3),
    "body_mass": Quantity("body mass", "kg", least=1.0, most=2e4),
    "suspension_stiffness": Quantity("suspension stiffness", "N/m", "kN/m", 1e-3, 100.0, 1e7),
    # results
    "deflection": Quantity("deflection", "m", "mm", 1e3),
    "stiffness": Quantity("stiffness", "N/m", "kN/m", 1e-3),
    "length": Quantity("footprint length", "m", "mm", 1e3),
    "width": Quantity("footprint width", "m", "mm", 1e3),
    "area": Quantity("footprint area", "m^2", "cm²", 1e4),
    "mean_pressure": Quantity("mean pressure", "Pa", "kPa", 1e-3),
    "x": Quantity("x, along", "m", "mm", 1e3),
    "y": Quantity("y, across", "m", "mm", 1e3),
    "pressure": Quantity("pressure", "Pa", "kPa", 1e-3),
    "longitudinal_force": Quantity("longitudinal force", "N", "kN", 1e-3),
    "lateral_force": Quantity("side force", "N", "kN", 1e-3),
    "aligning_moment": Quantity("aligning moment", "N m"),
    "trail": Quantity("pneumatic trail", "m", "mm", 1e3),
    "longitudinal_coefficient": Quantity("longitudinal force over load", ""),
    "lateral_coefficient": Quantity("side force over load", ""),
    "relaxation_side": Quantity("relaxation length, side", "m"),
    "relaxation_along": Quantity("relaxation length, along", "m"),
    "distance": Quantity("distance", "m"),
    "lateral_part": Quantity("side force over its end", ""),
    "longitudinal_part": Quantity("braking force over its end", ""),
    "resistance": Quantity("rolling resistance", "N"),
    "resistance_coefficient": Quantity("rolling resistance over load", "", "N/kN", 1e3),
    "drum_factor": Quantity("resistance over that on flat ground", ""),
    "usual_factor": Quantity("usual factor √(1 + r/R)", ""),
    "largest_rise": Quantity("largest rise of the vertical force", "N", "kN", 1e-3),
    "largest_fall": Quantity("largest fall of the vertical force", "N", "kN", 1e-3),
    "largest_along": Quantity("largest force along", "N", "kN", 1e-3),
    "line_vertical": Quantity("highest line, vertical", "Hz"),
    "line_along": Quantity("highest line, along", "Hz"),
    "place": Quantity("axle behind the cleat's edge", "m"),
    "vertical_force": Quantity("vertical force", "N", "kN", 1e-3),
    "axle_force": Quantity("force along", "N", "kN", 1e-3),
    "wheel_hop": Quantity("wheel on tire and suspension", "Hz"),
    "belt_vertical": Quantity("belt, vertical, on the road", "Hz"),
    "belt_along": Quantity("belt along, free", "Hz"),
    "belt_windup": Quantity("belt in rotation, free", "Hz"),
    "belt_side": Quantity("belt sideways, free", "Hz"),
    "belt_yaw": Quantity("belt in yaw, free", "Hz"),
    "road_low": Quantity("along and rotation, on the road, low", "Hz"),
    "road_high": Quantity("along and rotation, on the road, high", "Hz"),
    "road_side": Quantity("sideways, on the road", "Hz"),
    "road_yaw": Quantity("yaw, on the road", "Hz"),
}
"""Conditions of a case and columns of its result."""

_HERE = f"{__package__}.measured"
_FILE = f"{__package__}.of_file"
DEGREE = math.pi / 180.0
KMH = 1.0 / 3.6
ANGLES = tuple(
    round(angle * DEGREE, 6) for angle in (0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0)
)
SLIPS = (
    0.0,
    -0.0025,
    -0.005,
    -0.01,
    -0.02,
    -0.03,
    -0.045,
    -0.06,
    -0.08,
    -0.1,
    -0.13,
    -0.16,
    -0.2,
    -0.3,
    -0.5,
    -0.75,
    -1.0,
)
COMBINED = (0.1, 0.05, 0.02, 0.01, 0.0, -0.01, -0.02, -0.03, -0.05, -0.08, -0.12, -0.2, -0.4, -1.0)
DRUM = 1.7  # [m], the least of ISO 28580
ISO_PRESSURE, ISO_SPEED = 210e3, 80.0 * KMH
SLIP_COLUMNS = (
    "longitudinal_force", "lateral_force", "aligning_moment", "trail", "longitudinal_coefficient", "lateral_coefficient",
)  # fmt: skip
ROLLING = ("resistance", "resistance_coefficient", "drum_factor", "usual_factor")
_PACEJKA = "Pacejka, Tire and Vehicle Dynamics (2012)"


def procedures_of(tire: Specimen) -> dict[str, Procedure]:
    """The procedures by name, at loads and inflations about those of the scene."""
    found = (*_standing(tire), *_slipping(tire), *_rolling(tire), *_moving(tire))
    return {each.name: each for each in found}


def _standing(tire: Specimen) -> tuple[Procedure, ...]:
    """On a plate."""
    return (
        Procedure(
            "stiffness", "Standing stiffness over load and inflation", f"{_HERE}:standing", f"{_FILE}:standing",
            {"inflation": _inflations(tire), "load": _loads(tire, _steps(0.15, 1.65, 11))},
            {"drum_diameter": 0.0},
            (Sheet("", ("deflection", "stiffness", "length", "width", "area", "mean_pressure"), (
                Curve("deflection", "load", "load"), Curve("load", "stiffness"), Curve("load", "length"), Curve("load", "width"),
                Curve("load", "area"), Curve("load", "mean_pressure"))),),
            f"{_PACEJKA}, 4.3.1; on a plate",
        ),
        Procedure(
            "footprint", "Footprint and its pressure", f"{_HERE}:standing", "",
            {"inflation": _inflations(tire), "load": _loads(tire)}, {"drum_diameter": 0.0},
            (Sheet("", ("length", "width", "area", "mean_pressure"), (Curve("load", "area"), Curve("load", "mean_pressure"))),
             Sheet("map", ("x", "y", "pressure"), (Map("x", "y", "pressure"),))),
            "on a plate, smooth tread",
        ),
    )  # fmt: skip


def _slipping(tire: Specimen) -> tuple[Procedure, ...]:
    """On a flat track, steady and after a step of the slip."""
    track = {"inflation": tire.inflation, "speed": 60.0 * KMH}
    return (
        Procedure(
            "cornering", "Cornering at three loads", f"{_HERE}:steady_slip", f"{_FILE}:steady_slip",
            {"load": _loads(tire), "slip_angle": ANGLES}, {**track, "slip": 0.0},
            (Sheet("", SLIP_COLUMNS, (
                Curve("slip_angle", "lateral_force"), Curve("slip_angle", "aligning_moment"), Curve("slip_angle", "trail"),
                Curve("slip_angle", "lateral_coefficient"))),),
            f"{_PACEJKA}, 4.3.2; flat track",
        ),
        Procedure(
            "braking", "Braking at three loads", f"{_HERE}:steady_slip", f"{_FILE}:steady_slip",
            {"load": _loads(tire), "slip": SLIPS}, {**track, "slip_angle": 0.0},
            (Sheet("", SLIP_COLUMNS, (Curve("slip", "longitudinal_force"), Curve("slip", "longitudinal_coefficient"))),),
            f"{_PACEJKA}, 4.3.2; flat track",
        ),
        Procedure(
            "combined", "Combined slip", f"{_HERE}:steady_slip", f"{_FILE}:steady_slip",
            {"slip_angle": tuple(round(angle * DEGREE, 6) for angle in (1.0, 2.0, 4.0, 8.0)), "slip": COMBINED},
            {**track, "load": round(tire.load, 1)},
            (Sheet("", SLIP_COLUMNS, (
                Curve("longitudinal_force", "lateral_force", "slip"), Curve("slip", "lateral_force"),
                Curve("slip", "longitudinal_force"), Curve("slip", "aligning_moment"))),),
            f"{_PACEJKA}, 4.3.3; flat track",
        ),
        Procedure(
            "relaxation", "Relaxation length", f"{_HERE}:relaxation", f"{_FILE}:relaxation",
            {"slip_step": (0.005, 0.02, 0.05), "load": _loads(tire)}, track,
            (Sheet("", ("relaxation_side", "relaxation_along"), (
                Curve("load", "relaxation_side"), Curve("load", "relaxation_along"))),
             Sheet("response", ("distance", "lateral_part", "longitudinal_part"), (
                Curve("distance", "lateral_part", "distance"), Curve("distance", "longitudinal_part", "distance")))),
            f"{_PACEJKA}, 7.1; step of the slip on the flat track",
        ),
    )  # fmt: skip


def _rolling(tire: Specimen) -> tuple[Procedure, ...]:
    """On flat ground and on a drum."""
    slow = tuple(speed * KMH for speed in (30.0, 60.0, 80.0, 100.0, 120.0, 150.0))
    return (
        Procedure(
            "rolling_speed", "Rolling resistance over speed", f"{_HERE}:rolling", f"{_FILE}:rolling",
            {"load": _loads(tire), "speed": slow}, {"inflation": ISO_PRESSURE, "drum_diameter": 0.0},
            (Sheet("", ROLLING, (Curve("speed", "resistance"), Curve("speed", "resistance_coefficient"))),),
            "ISO 28580 at other speeds; flat ground",
        ),
        Procedure(
            "rolling_load", "Rolling resistance over load", f"{_HERE}:rolling", f"{_FILE}:rolling",
            {"inflation": _inflations(tire), "load": _loads(tire, _steps(0.4, 1.6, 7))},
            {"speed": ISO_SPEED, "drum_diameter": 0.0},
            (Sheet("", ROLLING, (Curve("load", "resistance"), Curve("load", "resistance_coefficient"))),),
            "ISO 28580 at other loads; flat ground",
        ),
        Procedure(
            "rolling_inflation", "Rolling resistance over inflation", f"{_HERE}:rolling", f"{_FILE}:rolling",
            {"load": _loads(tire), "inflation": (160e3, 180e3, ISO_PRESSURE, 240e3, 270e3)},
            {"speed": ISO_SPEED, "drum_diameter": 0.0},
            (Sheet("", ROLLING, (Curve("inflation", "resistance"), Curve("inflation", "resistance_coefficient"))),),
            "ISO 28580 at other inflations; flat ground",
        ),
        Procedure(
            "drum", "Rolling resistance on a drum and on flat ground", f"{_HERE}:rolling", "",
            {"drum_diameter": (0.0, 2.0, DRUM), "speed": slow},
            {"load": round(tire.load, 1), "inflation": ISO_PRESSURE},
            (Sheet("", ROLLING, (Curve("speed", "resistance"), Curve("speed", "drum_factor"), Curve("speed", "usual_factor"))),),
            "ISO 28580; its correction of the drum's curvature",
        ),
    )  # fmt: skip


def _moving(tire: Specimen) -> tuple[Procedure, ...]:
    """On the held axle, and the frequencies of a standing wheel."""
    return (
        Procedure(
            "cleat", "Cleats with the axle held", f"{_HERE}:cleat", "",
            {"cleat_height": (0.010, 0.015, 0.020), "speed": tuple(speed * KMH for speed in (20.0, 40.0, 60.0, 80.0))},
            {"load": round(tire.load, 1), "inflation": tire.inflation, "cleat_length": 0.05},
            (Sheet("", ("largest_rise", "largest_fall", "largest_along", "line_vertical", "line_along"), (
                Curve("speed", "largest_rise"), Curve("speed", "largest_along"), Curve("speed", "line_vertical"),
                Curve("speed", "line_along"))),
             Sheet("force", ("place", "vertical_force", "axle_force"), (
                 Curve("place", "vertical_force", "place"), Curve("place", "axle_force", "place")))),
            f"{_PACEJKA}, 10.4; flat track, axle held in height",
        ),
        Procedure(
            "modes", "Wheel and belt modes", f"{_HERE}:modes", "",
            {"load": _loads(tire), "inflation": _inflations(tire)}, tire.suspension,
            (Sheet("", ("wheel_hop", "belt_vertical", "belt_along", "belt_windup", "belt_side", "belt_yaw", "road_low",
                        "road_high", "road_side", "road_yaw"), (
                Curve("inflation", "wheel_hop"), Curve("inflation", "belt_vertical"), Curve("inflation", "belt_along"),
                Curve("inflation", "road_low"), Curve("inflation", "road_high"), Curve("inflation", "road_side"))),),
            f"{_PACEJKA}, 9.2; undamped, standing",
        ),
    )  # fmt: skip


def _loads(tire: Specimen, parts: tuple[float, ...] = (0.5, 1.0, 1.5)) -> tuple[float, ...]:
    """[N], parts of the standing load."""
    return tuple(float(round(part * round(tire.load, 1), -1)) for part in parts)


def _inflations(tire: Specimen) -> tuple[float, ...]:
    """[Pa] about that of the scene."""
    return tuple(float(round(part * tire.inflation, -3)) for part in (0.8, 1.0, 1.2))


def _steps(low: float, high: float, count: int) -> tuple[float, ...]:
    return tuple(low + (high - low) * place / (count - 1) for place in range(count))
