"""The work of a run, estimated from its scene before anything starts: steps, cells and turns times what each costs.

The costs are those of one core of a usual machine (2 GHz), so that a scene is refused or not wherever it runs. Steps follow from
the fastest motion: the pair of order 5 passes about 1.2 rad of an undamped swing in a step, and 3.3 time constants of a damper
(Hairer and Wanner, Solving Ordinary Differential Equations II, IV.2). What depends on the motion itself is left out: the estimate
is the least that is sure.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.lattice import GRAVITY, effects_at, occupant_mass
from contact_sim_pkg.scene.timing import make_timing

__all__ = ["BOUND", "Work", "estimated_work", "refuse_long"]

BOUND = 600.0
"""[s] of computing that a run may take unasked, or its duration where that is longer."""
LONG = 30.0
"""[s] from which on the estimate is reported."""
SWING, DAMPED = 1.2, 3.3  # [rad], [time constants] of a step
SPEED = 0.5  # [m/s] at which a loss is taken
BLOCK_COST = 1e-3  # [s] of the outputs of a block
STEP_COST, POINT_COST = 1.5e-6, 2e-8  # [s] of a step, and of a mode of a point in it
FIELD_COST, CELL_COST = 1e-6, 3e-6  # [s] of a cell of a pressure field, and of the volume below a contact
PIECE_COST, STEPPED_COST = 6e-6, 5e-5  # [s] of a piece of a rigid body's flight; of a step of the scheme stepping
TURN_COST, TRACK_COST, HEAVE_COST = 6e-5, 3e-8, 2e-7  # [s] of an interval of a track, a cell of it, a step of the heave
PLANAR_TURN, SPATIAL_TURN = 0.2, 0.02  # [rad] of a piece
HEAVE_PHASE = 0.06  # [rad] of a step


class Work(NamedTuple):
    """A part of the work."""

    what: str  # counted, in the plural, and its cause
    number: float
    cost: float  # [s] of one

    @property
    def seconds(self) -> float:
        """Of computing."""
        return self.number * self.cost

    def sentence(self, total: float) -> str:
        """For a person; ``total`` [s] of all parts."""
        return f"about {self.number:.2g} {self.what}, {_time(total)} of computing"


def estimated_work(scene: dict[str, Any]) -> list[Work]:
    """Parts of the work of a resolved scene, the largest first."""
    blocks = scene["duration"] / scene["block_length"]
    parts = [Work("blocks", blocks, BLOCK_COST), *_steps(scene), *_fields(scene)]
    if scene["rig"] == "block":
        parts += _rigid_pieces(scene)
    if scene["rig"] == "roller":
        parts += _roller_parts(scene)
    return sorted(parts, key=lambda part: part.seconds, reverse=True)


def refuse_long(scene: dict[str, Any], *, allowed: bool) -> str:
    """Report of the work before the run; empty where it is short. SceneError beyond the bound, unless ``allowed``."""
    parts = estimated_work(scene)
    total, bound = sum(part.seconds for part in parts), max(BOUND, float(scene["duration"]))
    report = parts[0].sentence(total)
    if total > bound and not allowed:
        cure = f"more than {_time(bound)}; --allow-long lifts the bound, a shorter duration takes less"
        raise SceneError([Fault(str(scene["name"]), 0, 0, "", f"{report}, {cure}")])
    return report if total > LONG else ""


def _time(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.2g} {unit}"
    return f"{seconds:.2g} s"


def _steps(scene: dict[str, Any]) -> Iterator[Work]:
    """Steps of the integrator: the fastest motion of every mass, and at least one a segment."""
    rig, duration = scene["rig"], float(scene["duration"])
    if rig in ("roller", "impact") or (rig == "block" and effects_at(scene, "block").get("compliant_contact") is None):
        return
    timing = make_timing(scene, True)
    yield Work("segments between two samples of drive or output", duration / timing.segment_length, STEP_COST)
    for contact in rigs()[rig].contacts:
        effects, cost = effects_at(scene, contact), STEP_COST
        shell = effects.get("shell_modes")
        if shell is not None:
            cost += POINT_COST * shell["modes"] * shell["points_up"] * shell["points_across"]
        mass, load, links = _masses(scene, contact, effects)
        for name, on, stiffness, damping in (*links, *_laws(effects, mass, load)):
            rate = max(math.sqrt(stiffness / on) / SWING, damping / on / DAMPED)
            yield Work(f"steps of the integrator for {contact}.{name}", rate * duration, cost)


Link = tuple[str, float, float, float]  # name, mass [kg] that it moves, stiffness [N/m], damping [N s/m]


def _masses(scene: dict[str, Any], contact: str, effects: dict[str, Any]) -> tuple[float, float, list[Link]]:
    """Mass that touches in [kg], load at rest in [N], and the springs behind it."""
    if contact == "seat":
        occupant = scene["seat"]["occupant"]
        rows = zip(occupant["masses"], occupant["stiffness"], occupant["damping"], strict=True)
        links = [("occupant", min(mass, occupant["frame_mass"]), k, c) for mass, k, c in rows]
        return float(occupant["frame_mass"]), occupant_mass(scene) * GRAVITY, links
    if contact == "tire":
        tire, ring = scene["tire"], effects.get("carcass")
        mass = least = min(float(tire["wheel_mass"]), float(tire["body_mass"]))
        links = [("suspension", least, float(tire["suspension_stiffness"]), float(tire["suspension_damping"]))]
        if ring is not None:
            mass = float(ring["belt_mass"])
            links.append(("carcass", min(mass, least), float(ring["stiffness"]), float(ring["damping"])))
        return mass, (tire["wheel_mass"] + tire["body_mass"]) * GRAVITY, links
    if contact == "backrest":
        return float(scene["backrest"]["mass"]), float(scene["backrest"]["preload"]), []
    block = scene["block"]
    return float(block["mass"]), block["mass"] * block["gravity"], []


def _laws(effects: dict[str, Any], mass: float, load: float) -> Iterator[Link]:
    """The laws of a contact at its depth under the load at rest."""
    elastic = effects.get("normal_elastic") or {}
    compliant = effects.get("compliant_contact") or {}
    coefficient = elastic.get("coefficient", compliant.get("stiffness"))
    if coefficient is not None and load > 0.0:
        exponent = float(elastic.get("exponent") or compliant["exponent"])
        depth = (load / float(coefficient)) ** (1.0 / exponent)
        general, loss = effects.get("general_dissipative") or {}, effects.get("normal_dissipative") or {}
        if general.get("coefficient") is not None:
            power, order = float(general["rate_exponent"]), float(general["approach_exponent"])
            slope = general["coefficient"] * depth**order * (max(power, 1.0) * SPEED ** (power - 1.0))
            yield "general_dissipative", mass, 0.0, slope
        yield "normal_dissipative", mass, 0.0, float(loss.get("damping") or 0.0) * load
        yield "normal_elastic" if elastic else "compliant_contact", mass, exponent * load / depth, 0.0
    for name, law in (("friction", effects.get("friction")), ("compliant_contact", _tangential(compliant))):
        if law:
            yield name, mass, float(law["stiffness"]), float(law["damping"])


def _tangential(compliant: dict[str, Any]) -> dict[str, float]:
    if not compliant:
        return {}
    return {
        "stiffness": compliant["tangential_stiffness"],
        "damping": compliant.get("tangential_damping") or 0.0,
    }


def _fields(scene: dict[str, Any]) -> Iterator[Work]:
    """Cells of the pressure fields, solved as often as they are published at least."""
    for contact in rigs()[scene["rig"]].contacts:
        field = effects_at(scene, contact).get("contact_field")
        if field is not None:
            solved = scene["duration"] * scene["outputs"]["field_rate"]
            yield Work(f"cells of {contact}.contact_field", field["rows"] * field["cols"] * solved, FIELD_COST)


def _rigid_pieces(scene: dict[str, Any]) -> Iterator[Work]:
    """Pieces of a body that spins, the faster the longer a known torque turns it; steps of the scheme stepping."""
    block, law, duration = scene["block"], effects_at(scene, "block")["rigid_contact"], float(scene["duration"])
    if law["scheme"] == "stepping":
        yield Work("steps of rigid_contact.step", duration / law["step"], STEPPED_COST)
        return
    plane = block["motion"] == "plane"
    of = block.get("points") if block["shape"] == "points" else [block["sides"], (0.0, 0.0, 0.0)]
    size = 2.0 * block["radius"] if block["shape"] == "sphere" else max(math.dist(of[0], other) for other in of)
    weight = block["mass"] * block["gravity"]
    torque, spin = (
        abs(each[1]) if plane else math.hypot(*each) for each in (block["torque"], block["angular_velocity"])
    )
    if torque <= 0.5 * weight * size:  # it may rest
        torque = 0.0
    angle = spin * duration + 0.5 * torque / (block["mass"] * size**2 / 12.0) * duration**2
    yield Work("pieces of flight of a body that spins", angle / (PLANAR_TURN if plane else SPATIAL_TURN), PIECE_COST)


def _roller_parts(scene: dict[str, Any]) -> Iterator[Work]:
    """Turns of the track, steps of the heave over its cells, tilt and yaw, and the volumes below the contact."""
    rig, effects, duration = scene["roller"], effects_at(scene, "roller"), float(scene["duration"])
    below, damage, waves = effects.get("subsurface"), effects.get("damage"), effects.get("track_waves")
    bodies = 2 if waves is not None and waves["track"] == "both" else 1
    if below is not None:
        cells = below["cells_x"] * below["cells_y"] * below["cells_z"]
        yield Work("cells of subsurface", 2.0 * cells * len(below["instants"]), CELL_COST)
        if damage is not None and waves is not None:
            yield Work("cells of damage.table_rows", float(bodies * cells * damage["table_rows"]), CELL_COST)
    outputs = duration * scene["outputs"]["force_rate"]
    if waves is not None and rig["speed"] > 0.0:
        radii = (rig["shaft_radius"], rig["radius"])
        turned = {"shaft": radii[0], "roller": radii[1]}.get(waves["track"], max(radii))
        cells = waves["cells"] * (round(max(radii) / min(radii)) if bodies == 2 else 1)
        length = turned / (rig["speed"] * rig["radius"])
        intervals = duration / length
        if damage is not None and rig["acceleration"] > 1.0:
            intervals += damage["checks"] * min(4.0 * rig["acceleration"], 1000.0)
        yield Work("turns of the track", intervals, TURN_COST)
        outputs = intervals * cells
        steps = max(1.0, _heave_frequency(rig) * length / cells / HEAVE_PHASE)
        yield Work("cells of the track", outputs, TRACK_COST + steps * HEAVE_COST)
    if effects.get("tilt_yaw") is not None:
        inertia = min(rig["inertia_tilt"], rig["inertia_yaw"])
        spin = (effects.get("gyroscope") or {}).get("inertia_spin", 0.0) * 2.0 * math.pi * rig["speed"]
        rate = math.sqrt(max(rig["stiffness_tilt"], rig["stiffness_yaw"]) / inertia) + spin / inertia
        yield Work("steps of tilt and yaw", max(outputs, rate * duration / 0.15), 4.0 * STEP_COST)


def _heave_frequency(rig: dict[str, Any]) -> float:
    """In [rad/s], of a contact of spheres: kappa^2 = k/m, k = 3 F / 2 d."""
    modulus = 0.5 * rig["young_modulus"] / (1.0 - rig["poisson_ratio"] ** 2)
    radius = 1.0 / (1.0 / rig["radius"] + 1.0 / rig["shaft_radius"])
    depth = (0.75 * rig["load"] / (modulus * math.sqrt(radius))) ** (2.0 / 3.0)
    return float(math.sqrt(1.5 * rig["load"] / (depth * rig["mass"])))
