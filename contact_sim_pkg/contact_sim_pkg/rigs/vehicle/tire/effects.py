"""Effects of the contact between tire and road.

A scene calls for the pressure field by road waves and obstacles shorter than about three patch
lengths, or as sharply curved as the wheel; for the envelopment by those shorter than one; for the
brush by slip; for a loss where none acts. Waves so low that they cannot carry the requested
accuracy call for nothing, nor does an obstacle beyond the end of the run.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from contact_sim_pkg.records.effect import Effect, without_loss

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["TIRE_EFFECTS", "prescribed_events"]

SHORT_WAVE = 0.4  # [m], three patch lengths
FOOTPRINT = 0.13  # [m], one patch length
RADIUS = 0.3  # [m] of a wheel, about
APPROACH = 0.02  # [m] of a tire under its load, about
NOTICED = 0.1
"""Height of waves over `APPROACH`, in requested accuracies, from which on they may carry it."""


def prescribed_events(scene: ResolvedScene) -> Iterator[tuple[str, float]]:
    """Names and instants [s] of the largest slip and the largest slip angle that a scene prescribes,
    and of the largest torque on the rim.
    """
    slip, wheel = scene.slip, scene.data["effects"]["tire"].get("wheel_spin") or {}
    points = [] if slip is None else slip.points or []
    torques = wheel.get("points") or []
    for reason, rows, column in (
        ("largest slip", points, 1), ("largest slip angle", points, 2), ("largest drive", torques, 1),
        ("largest brake", torques, 2),
    ):  # fmt: skip
        largest = max(rows, key=lambda row: abs(row[column]), default=None)
        if largest is not None and largest[column] != 0.0:
            yield reason, float(largest[0])


def _short(scene: ResolvedScene, limit: float, lengths: str) -> str:
    """What the road holds that is shorter than ``limit`` [m], and high enough to be noticed."""
    from contact_sim_pkg.run.sources import make_travel
    from contact_sim_pkg.scene.schema.accuracy import requested

    road, least = scene.road, NOTICED * requested(scene.accuracy) * APPROACH
    if road is None or road.is_even:
        return ""
    first, last = make_travel(scene).extent(0.0, scene.duration)
    wave = road.shortest_wave(limit)
    if first == last or wave is None or wave.height <= least or not road.is_reached(first - RADIUS, last + RADIUS):
        return ""
    if wave.length < limit:
        return f"{wave.words} {lengths}"
    if RADIUS * wave.curvature > 1.0:
        return f"the {road.kind} of {wave.length:g} m is {wave.height:g} m high: it curves more sharply than the wheel"
    return ""


def _brush(scene: ResolvedScene) -> str:
    if scene.data["effects"]["tire"].get("magic_formula") is not None:
        return ""
    if scene.data["effects"]["tire"].get("wheel_spin") is not None:
        return "the bristles hold a wheel that spins"
    slip = scene.slip
    points = [] if slip is None else slip.points or [[0.0, slip.longitudinal or 0.0, slip.angle or 0.0]]
    largest = max((abs(value) for point in points for value in point[1:]), default=0.0)
    return f"the tire slips by up to {largest:g}" if largest > 0.0 else ""


_SCHEMA = f"{__package__}.schema"
_LOSS = without_loss("tire", "normal_dissipative", "tread_viscoelasticity")
_FIELD = partial(_short, limit=SHORT_WAVE, lengths="three footprints")

TIRE_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:HertzElastic", help="elastic force", source="Johnson, Contact Mechanics, 4.2",
        carries=True, feeds=("force", "wrench", "standing"),
    ),
    Effect(
        name="inflation", section=f"{_SCHEMA}:Inflation", help="inflated tire: belt under tension, sidewalls, tread",
        source="Pacejka, Tire and Vehicle Dynamics, 9", carries=True, excludes=("normal_elastic", "envelopment"),
        feeds=("force", "wrench", "patch", "standing"),
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:TireLoss", help="loss", source="Brogliato, Nonsmooth Mechanics, 2",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=_LOSS,
    ),
    Effect(
        name="contact_field", section=f"{_SCHEMA}:TireField", help="pressure field", source="Johnson, Contact Mechanics, 5.4",
        needs=("normal_elastic",), publishes="patch", feeds=("patch", "force", "wrench"), called_for=_FIELD,
    ),
    Effect(
        name="rigid_ring", section=f"{_SCHEMA}:RigidRingSection", help="rigid ring on sidewalls",
        source="Pacejka, Tire and Vehicle Dynamics, 9", needs=("normal_elastic",), feeds=("force", "wrench", "patch", "standing"),
    ),
    Effect(
        name="envelopment", section=f"{_SCHEMA}:Envelopment", help="belt that bends over obstacles",
        source="Pacejka, Tire and Vehicle Dynamics, 10", needs=("contact_field",), feeds=("patch", "force", "wrench", "standing"),
        called_for=partial(_short, limit=FOOTPRINT, lengths="the footprint"),
    ),
    Effect(
        name="tread_viscoelasticity", section=f"{_SCHEMA}:TreadViscoelasticitySection", help="viscoelasticity of the tread rubber",
        source="Tire/Road Contact", needs=("contact_field",), feeds=("patch", "force", "wrench"),
    ),
    Effect(
        name="rolling_loss", section=f"{_SCHEMA}:RollingLossSection", help="rolling resistance under an elastic field",
        source="Johnson, Contact Mechanics, 9.5", needs=("inflation",), excludes=("tread_viscoelasticity",), feeds=("wrench",),
    ),
    Effect(
        name="brush", section=f"{_SCHEMA}:BrushSection", help="brush friction of a rolling tire, stick and slip of each cell",
        source="Pacejka, Tire and Vehicle Dynamics, 3", needs=("contact_field",), publishes="shear",
        feeds=("shear", "force", "wrench"), inputs=("slip",), called_for=_brush, not_below={"force": 1.5e-2},
    ),
    Effect(
        name="sidewall_compliance", section=f"{_SCHEMA}:SidewallComplianceSection",
        help="belt that yields along, across, in rotation and in yaw", source="Pacejka, Tire and Vehicle Dynamics, 9",
        needs=("brush",), publishes="work", feeds=("shear", "force", "wrench", "work"), inputs=("slip",),
    ),
    Effect(
        name="wheel_spin", section=f"{_SCHEMA}:WheelSpinSection", help="rotation of the wheel under drive and brake",
        source="Pacejka, Tire and Vehicle Dynamics, 9", needs=("sidewall_compliance",), feeds=("shear", "force", "wrench"),
    ),
    Effect(
        name="magic_formula", section=f"{__package__}.magic_formula.section:MagicFormulaSection",
        help="forces of a tire property file by the Magic Formula, with relaxation",
        source="Pacejka, Tire and Vehicle Dynamics, 4.3", needs=("normal_elastic",),
        excludes=("brush", "sidewall_compliance", "wheel_spin", "rigid_ring", "tread_viscoelasticity", "rolling_loss"),
        publishes="shear", feeds=("shear", "force", "wrench"), inputs=("slip",),
    ),
    Effect(
        name="asperity_impulses", section=f"{_SCHEMA}:AsperityImpulsesSection", help="impulses of road asperities",
        source="Tire/Road Contact", needs=("normal_elastic",), feeds=("force", "wrench"),
    ),
    Effect(
        name="bump_stop", section="contact_sim_pkg.rigs.vehicle.effects.bump_stop:BumpStopSection",
        help="progressive stops of the wheel's travel against the body", feeds=("force", "wrench"),
        elements="contact_sim_pkg.rigs.vehicle.effects.bump_stop_kernel:bump_stop",
    ),
)  # fmt: skip
