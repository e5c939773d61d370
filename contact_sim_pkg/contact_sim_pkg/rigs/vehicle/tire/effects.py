"""Effects of the contact between tire and road.

A scene calls for them by rules of thumb of the field: the pressure field for road wavelengths below
about three patch lengths, steps, cleats and stones, or where the pressure is requested; the rigid
ring for content above 30 Hz at the axle; the envelopment for obstacles shorter than the footprint;
the brush for slip.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

from contact_sim_pkg.records.effect import Effect, Observed, Verdict, choice_of_model, needed_where_it_opens

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["TIRE_EFFECTS"]

SHORT_WAVE = 0.4  # [m], three patch lengths
FOOTPRINT = 0.13  # [m], one patch length
AXLE_FREQUENCY, AXLE_SHARE = 30.0, 0.05  # [Hz], and the part of the force's variance above it that counts as content


def _field(scene: ResolvedScene, _observed: Observed) -> Verdict:
    short, why = _short_waves(scene, SHORT_WAVE, "three patch lengths")
    return short, f"{why}, unless the pressure itself is requested" if short is False else why


def _envelopment(scene: ResolvedScene, _observed: Observed) -> Verdict:
    return _short_waves(scene, FOOTPRINT, "one patch length")


def _short_waves(scene: ResolvedScene, limit: float, lengths: str) -> Verdict:
    """Whether the road holds waves or edges shorter than ``limit`` [m]."""
    road = scene.road
    if road is None or road.kind == "flat":
        return False, "the road is flat: the point contact is exact"
    if road.kind == "iso8608":
        shortest = road.shortest_wavelength if road.texture is None else road.texture.shortest_wavelength
        return shortest < limit, f"shortest wave of the road {shortest:g} m, limit {limit:g} m ({lengths})"
    if road.kind == "opencrg":
        return True, f"a measured road holds waves down to its grid, below {lengths}"
    edge = road.edge if road.kind in ("cleat", "pothole") else 0.0
    length = edge or road.length
    sharp = road.kind != "bump" or length < limit
    return sharp, f"{road.kind} with {'edges' if edge else 'a length'} of {length:g} m, limit {limit:g} m ({lengths})"


def _rigid_ring(scene: ResolvedScene, observed: Observed) -> Verdict:
    force = observed.forces["tire"] - observed.forces["tire"].mean()
    power = numpy.abs(numpy.fft.rfft(force)) ** 2
    fast = numpy.fft.rfftfreq(len(force), 1.0 / scene.outputs.force_rate) > AXLE_FREQUENCY
    share = float(power[fast].sum() / power.sum()) if power.sum() > 0.0 else 0.0
    why = f"{100.0 * share:.2g} % of the force's variance above {AXLE_FREQUENCY:g} Hz, limit {100.0 * AXLE_SHARE:g} %"
    return share > AXLE_SHARE, why


def _brush(scene: ResolvedScene, _observed: Observed) -> Verdict:
    if _spin_of(scene) is not None:
        return True, "a wheel that spins is held by the bristles alone"
    slip = scene.slip
    constant = [0.0, 0.0, 0.0] if slip is None else [0.0, slip.longitudinal or 0.0, slip.angle or 0.0]
    points = [constant] if slip is None else slip.points or [constant]
    largest = max(abs(value) for point in points for value in point[1:])
    return largest > 0.0, f"largest slip of the scene: {largest:g}"


def _sidewall_compliance(scene: ResolvedScene, _observed: Observed) -> Verdict:
    slip, spins = scene.slip, _spin_of(scene) is not None
    changes = slip is not None and slip.points is not None and len({tuple(point[1:]) for point in slip.points}) > 1
    short, why = _short_waves(scene, SHORT_WAVE, "three patch lengths")
    if changes or spins:
        return True, "the slip changes: its forces follow over a relaxation length"
    return short, f"{why}; the force along the axle rings behind an obstacle" if short else f"constant slip; {why}"


def _spin_of(scene: ResolvedScene) -> dict[str, Any] | None:
    """Keys of the wheel's spin; None where the scene does not call for it."""
    keys: dict[str, Any] | None = scene.data["effects"]["tire"].get("wheel_spin")
    return keys


def _wheel_spin(scene: ResolvedScene, _observed: Observed) -> Verdict:
    wheel = _spin_of(scene) or {}
    turned = any(wheel.get(key) for key in ("points", "drive", "brake"))
    short, why = _short_waves(scene, SHORT_WAVE, "three patch lengths")
    return turned or short, "the rim is driven or braked" if turned else f"{why}; a free wheel swings at about 33 Hz"


_SCHEMA = f"{__package__}.schema"
_FREE = choice_of_model("whether it acts is a choice of the model")

TIRE_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:HertzElastic", help="elastic force", source="Johnson, Contact Mechanics, 4.2",
        carries=True, feeds=("force", "wrench"), called_for=_FREE,
    ),
    Effect(
        name="inflation", section=f"{_SCHEMA}:Inflation", help="inflated tire: belt under tension, sidewalls, tread",
        source="Pacejka, Tire and Vehicle Dynamics, 9", carries=True, excludes=("normal_elastic", "envelopment"),
        feeds=("force", "wrench", "patch"), called_for=_FREE,
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:TireLoss", help="loss", source="Brogliato, Nonsmooth Mechanics, 2",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=needed_where_it_opens("tire"),
    ),
    Effect(
        name="contact_field", section=f"{_SCHEMA}:TireField", help="pressure field", source="Johnson, Contact Mechanics, 5.4",
        needs=("normal_elastic",), publishes="patch", feeds=("patch", "force", "wrench"), called_for=_field,
    ),
    Effect(
        name="rigid_ring", section=f"{_SCHEMA}:RigidRingSection", help="rigid ring on sidewalls",
        source="Pacejka, Tire and Vehicle Dynamics, 9", needs=("normal_elastic",), feeds=("force", "wrench", "patch"),
        called_for=_rigid_ring,
    ),
    Effect(
        name="envelopment", section=f"{_SCHEMA}:Envelopment", help="belt that bends over obstacles",
        source="Pacejka, Tire and Vehicle Dynamics, 10", needs=("contact_field",), feeds=("patch", "force", "wrench"),
        called_for=_envelopment,
    ),
    Effect(
        name="tread_viscoelasticity", section=f"{_SCHEMA}:TreadViscoelasticitySection", help="viscoelasticity of the tread rubber",
        source="Tire/Road Contact", needs=("contact_field",), feeds=("patch", "force", "wrench"), called_for=_FREE,
    ),
    Effect(
        name="brush", section=f"{_SCHEMA}:BrushSection", help="brush friction of a rolling tire, stick and slip of each cell",
        source="Pacejka, Tire and Vehicle Dynamics, 3", needs=("contact_field",), publishes="shear",
        feeds=("shear", "force", "wrench"), inputs=("slip",), called_for=_brush, not_below={"force": 1.5e-2},
    ),
    Effect(
        name="sidewall_compliance", section=f"{_SCHEMA}:SidewallComplianceSection",
        help="belt that yields along, across, in rotation and in yaw", source="Pacejka, Tire and Vehicle Dynamics, 9",
        needs=("brush",), feeds=("shear", "force", "wrench"), inputs=("slip",), called_for=_sidewall_compliance,
    ),
    Effect(
        name="wheel_spin", section=f"{_SCHEMA}:WheelSpinSection", help="rotation of the wheel under drive and brake",
        source="Pacejka, Tire and Vehicle Dynamics, 9", needs=("sidewall_compliance",), feeds=("shear", "force", "wrench"),
        called_for=_wheel_spin,
    ),
    Effect(
        name="asperity_impulses", section=f"{_SCHEMA}:AsperityImpulsesSection", help="impulses of road asperities",
        source="Tire/Road Contact", needs=("normal_elastic",), feeds=("force", "wrench"), called_for=_FREE,
    ),
)  # fmt: skip
