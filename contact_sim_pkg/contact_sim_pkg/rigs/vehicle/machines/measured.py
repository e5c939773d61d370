"""What the test machines measure of a tire in one case: rows of a procedure's sheets, in SI units.

A case is a dict of conditions, see `QUANTITIES` in `procedures.py`. Signs as of the bench (ISO 8855, forces on the
tire): positive slip angle, negative side force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.records.procedure import Rows
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import ring_stiffness
from contact_sim_pkg.rigs.vehicle.machines.flat_track import Track, track_of
from contact_sim_pkg.rigs.vehicle.machines.held_axle import CLEAT, duration_of, held_over
from contact_sim_pkg.rigs.vehicle.machines.specimen import Effects, body_at, scene_on, table_at
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.tire import schema
from contact_sim_pkg.rigs.vehicle.tire.model import rubber_of
from contact_sim_pkg.rigs.vehicle.tire.rolling_loss import rolling_loss, whole_footprint

__all__ = ["cleat", "modes", "relaxation", "rolling", "standing", "steady_slip"]

Conditions = Mapping[str, float]
Sheets = dict[str, Rows]
TRACK = ("inflation", "contact_field", "brush", "sidewall_compliance")
HELD = ("inflation", "normal_dissipative", "contact_field", "rigid_ring", "brush", "sidewall_compliance", "wheel_spin")
WAY = 10.0  # [m] rolled until a slip is steady: thirty relaxation lengths
STEADY = 200  # samples that a steady value is the mean of
FALLEN = 1.0 - math.exp(-1.0)
LOWEST = 15.0  # [Hz] of a line behind the cleat
HEARD = 0.35  # [s] behind it
EDGE = 0.005  # [m]


def standing(effects: Effects, conditions: Conditions) -> Sheets:
    """Deflection, stiffness and footprint on a plate, or on a drum, of the force table; the pressure map of the nearest
    kept footprint.
    """
    load, table = conditions["load"], table_at(effects, conditions)
    law = table.law()
    deflection = float(approach_of_force(law, load))
    length, width, area = table.footprint_at(load)
    row = {
        "deflection": deflection, "stiffness": float(elastic_stiffness(law, deflection)), "length": length, "width": width,
        "area": area, "mean_pressure": load / area,
    }  # fmt: skip
    pressure = whole_footprint(table.quarter_at(load))
    (rows, cols), (cell_x, cell_y) = pressure.shape, table.cell
    x, y = (numpy.arange(rows) - rows // 2) * cell_x, (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y
    cells = [
        {"x": float(x[i]), "y": float(y[j]), "pressure": float(pressure[i, j])}
        for i, j in zip(*numpy.nonzero(pressure), strict=True)
    ]
    return {"": [row], "map": cells}


def steady_slip(effects: Effects, conditions: Conditions) -> Sheets:
    """Forces at a slip and a slip angle that are held on the flat track, mean of the last 50 ms."""
    track = _track(effects, conditions, conditions.get("slip", 0.0), conditions.get("slip_angle", 0.0))
    along, across, moment = track.force[-STEADY:].mean(axis=0).tolist()
    return {"": [slip_row(conditions["load"], along, across, moment)]}


def slip_row(load: float, along: float, across: float, moment: float) -> dict[str, float]:
    """Columns of steady slip: forces [N], aligning moment [N m], trail [m] and forces over the ``load`` [N]."""
    trail = -moment / across if abs(across) > 1e-3 * load else math.nan
    return {
        "longitudinal_force": along, "lateral_force": across, "aligning_moment": moment, "trail": trail,
        "longitudinal_coefficient": along / load, "lateral_coefficient": across / load,
    }  # fmt: skip


def relaxation(effects: Effects, conditions: Conditions) -> Sheets:
    """Way to 63 % of the axle's force after a step of slip angle and of braking slip of the same size; and the
    responses.
    """
    step, speed = conditions["slip_step"], conditions["speed"]
    tracks = _track(effects, conditions, 0.0, step), _track(effects, conditions, -step, 0.0)
    lengths, parts = [], []
    for track, axis in zip(tracks, (1, 0), strict=True):
        force = track.axle[:, axis]
        parts.append(force / force[-STEADY:].mean())
        lengths.append(speed * float(track.time[int(numpy.argmax(parts[-1] > FALLEN))]))
    every = max(1, round(0.01 / (speed * float(tracks[0].time[1]))))  # [m]
    end = int(2.0 / (speed * float(tracks[0].time[1])))
    response = [
        {"distance": float(place), "lateral_part": float(side), "longitudinal_part": float(along)}
        for place, side, along in zip(
            speed * tracks[0].time[:end:every], parts[0][:end:every], parts[1][:end:every], strict=True
        )
    ]
    return {"": [{"relaxation_side": lengths[0], "relaxation_along": lengths[1]}], "response": response}


def rolling(effects: Effects, conditions: Conditions) -> Sheets:
    """Rolling resistance by what tread and belt lose under the standing footprint, see `rolling_loss.py`; on a drum
    with its curvature, beside the usual factor sqrt(1 + r / R) of ISO 28580.
    """
    load, speed, drum = conditions["load"], conditions["speed"], conditions["drum_diameter"]
    memory = effects.get("rolling_loss", effects.get("tread_viscoelasticity", {}))
    section = scene_on({**effects, "rolling_loss": memory}, conditions, ("inflation", "rolling_loss")).effect(
        "tire", schema.RollingLossSection
    )
    assert section is not None

    def resistance(diameter: float) -> float:
        body = body_at(effects, conditions["inflation"], diameter)
        return float(rolling_loss(body, rubber_of(section), section.belt).along(numpy.array([load]), speed)[0])

    found, radius = resistance(drum), body_at(effects, conditions["inflation"]).form.radius_rolling
    usual = math.sqrt(1.0 + 2.0 * radius / drum) if drum > 0.0 else 1.0
    return {"": [{
        "resistance": found, "resistance_coefficient": found / load, "drum_factor": found / resistance(0.0),
        "usual_factor": usual,
    }]}  # fmt: skip


def cleat(effects: Effects, conditions: Conditions) -> Sheets:
    """Forces on the held axle over a cleat of the height, 50 mm long: largest rise and fall, largest force along, lines
    behind it; and the forces over the place.
    """
    speed, height = conditions["speed"], conditions["cleat_height"]
    scene = scene_on(
        effects, conditions, HELD, {"kind": "held"}, duration=duration_of(speed), block_length=0.1, outputs={"force_rate": 2000.0},
        road={"kind": "cleat", "position": CLEAT, "height": height, "length": conditions["cleat_length"], "edge": EDGE},
    )  # fmt: skip
    found = held_over(scene)
    rise = found.vertical - found.vertical[0]
    row = {
        "largest_rise": float(rise.max()), "largest_fall": float(-rise.min()),
        "largest_along": float(abs(found.longitudinal).max()),
        "line_vertical": _line(found.time, found.place, found.vertical),
        "line_along": _line(found.time, found.place, found.longitudinal),
    }  # fmt: skip
    near = (found.place > CLEAT - 0.5) & (found.place < CLEAT + 2.5)
    samples = [
        {"place": float(place - CLEAT), "vertical_force": float(up), "axle_force": float(along)}
        for place, up, along in zip(found.place[near], found.vertical[near], found.longitudinal[near], strict=True)
    ]
    return {"": [row], "force": samples}


def modes(effects: Effects, conditions: Conditions) -> Sheets:
    """Undamped frequencies: of the wheel between tire and suspension, of the belt on a held rim, free and with its
    bristles stuck to the road.
    """
    scene = scene_on(effects, conditions, HELD)
    model, table = build(scene), table_at(effects, conditions)
    friction, load = model.rolling_friction, conditions["load"]
    assert friction is not None
    belt = friction.sidewalls
    assert belt is not None
    footprint, brush = table.footprint_at(load), friction.brush
    law = table.law()
    tire = float(elastic_stiffness(law, approach_of_force(law, load)))
    ring = ring_stiffness(schema.Inflation(**effects["inflation"]).ring_stiffness, conditions["inflation"])
    beside = 1.0 / max(1.0 / tire - 1.0 / ring, 1e-12)  # what the ring stands on
    spring = conditions["suspension_stiffness"]
    hop = _frequencies(
        numpy.array([[tire + spring, -spring], [-spring, spring]]),
        numpy.array([conditions["wheel_mass"], conditions["body_mass"]]),
    )
    along, across = brush.stiffness_x * footprint.area, brush.stiffness_y * footprint.area
    lever, twist = friction.radius, brush.stiffness_y * footprint.area * footprint.length**2 / 12.0

    def in_plane(contact: float) -> list[float]:
        stiffness = numpy.array([
            [belt.stiffness_x + contact, contact * lever],
            [contact * lever, belt.stiffness_twist + contact * lever**2],
        ])  # fmt: skip
        return _frequencies(stiffness, numpy.array([belt.mass, belt.inertia]))

    stuck = sorted(in_plane(along))
    single = (
        (belt.stiffness_y, belt.mass), (belt.stiffness_yaw, belt.yaw_inertia), (belt.stiffness_y + across, belt.mass),
        (belt.stiffness_yaw + twist, belt.yaw_inertia), (ring + beside, belt.mass),
    )  # fmt: skip
    side, yaw, side_stuck, yaw_stuck, vertical = (math.sqrt(k / m) / (2.0 * math.pi) for k, m in single)
    return {"": [{
        "wheel_hop": max(hop), "belt_vertical": vertical,
        "belt_along": math.sqrt(belt.stiffness_x / belt.mass) / (2.0 * math.pi),
        "belt_windup": math.sqrt(belt.stiffness_twist / belt.inertia) / (2.0 * math.pi), "belt_side": side, "belt_yaw": yaw,
        "road_low": stuck[0], "road_high": stuck[1], "road_side": side_stuck, "road_yaw": yaw_stuck,
    }]}  # fmt: skip


def _track(effects: Effects, conditions: Conditions, slip: float, angle: float) -> Track:
    speed = conditions["speed"]
    scene = scene_on(effects, conditions, TRACK, slip={"longitudinal": slip, "angle": angle})
    return track_of(scene, speed, WAY / speed)


def _frequencies(stiffness: NDArray[numpy.float64], masses: NDArray[numpy.float64]) -> list[float]:
    """[Hz] of masses [n] on a stiffness [n, n]."""
    root = numpy.sqrt(masses)
    squares = numpy.linalg.eigvalsh(stiffness / numpy.outer(root, root))
    return [math.sqrt(max(float(each), 0.0)) / (2.0 * math.pi) for each in squares]


def _line(time: NDArray[numpy.float64], place: NDArray[numpy.float64], force: NDArray[numpy.float64]) -> float:
    """Frequency [Hz] of the highest line of a force behind the cleat, from `LOWEST` on."""
    heard = force[place > CLEAT + 0.3][: round(HEARD / float(time[1]))]
    power = abs(numpy.fft.rfft((heard - heard.mean()) * numpy.hanning(len(heard)), 16384))
    lines = numpy.fft.rfftfreq(16384, float(time[1]))
    power[lines <= LOWEST] = 0.0
    return float(lines[power.argmax()])
