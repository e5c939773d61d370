"""Resolved scene -> parameters, grids and timing: the only place where an effect that is not called for becomes ``None``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.effects.contact_field import FieldSettings, PressureField, fit_tangent, widened
from contact_sim_pkg.core.effects.normal_elastic import approach_of_force
from contact_sim_pkg.core.effects.seat_shape import SeatShape, seat_gap
from contact_sim_pkg.core.hertz import HertzContact, hertz_contact, power_law
from contact_sim_pkg.core.parameters import Contact, Friction, NormalDissipative, NormalElastic, Seat, Tire, Vector, Vehicle
from contact_sim_pkg.core.restitution import damping_of_restitution

GRAVITY = 9.81  # [m/s^2]
POSITION_SCALE = 0.01  # [m], size of the approaches; the integrator's tolerance is relative to it
VELOCITY_SCALE = 0.5  # [m/s], size of the velocities on a rough road
DEFAULT_DAMPING = {"tire": 0.06, "seat": 1.0}  # [s/m], see scene/schema_effects.py
FIELD_ITERATIONS = 400
FALLBACK_GRID = (64, 48)  # road lattice of a tire without pressure field


@dataclass(frozen=True)
class Timing:
    """How a block is cut: blocks into intervals (field instants), intervals into segments (linear drive) and samples."""

    block_length: float  # [s]
    blocks: int
    intervals: int  # a block
    segments: int  # an interval
    sample_every: int  # segments a sample of the forces
    vibration_stride: int  # segments a sample of the vibration
    displays: int  # wrenches a block

    @property
    def segment_length(self) -> float:
        """Length of a segment in [s]."""
        return self.block_length / (self.intervals * self.segments)

    @property
    def samples(self) -> int:
        """Samples of the forces in a block."""
        return self.intervals * self.segments // self.sample_every


@dataclass(frozen=True)
class TireGeometry:
    """Tire and road lattice: radii [m], footprint of the standing load [m], cells [m]."""

    radius_rolling: float
    radius_lateral: float
    semi_axis_x: float
    semi_axis_y: float
    rows: int
    cols: int
    cell_x: float
    cell_y: float
    road_rows: int  # along, what a field instant may need of the road
    road_cols: int


@dataclass(frozen=True)
class FieldGrids:
    """The pressure field of one contact, and the wider one that takes over where the contact outgrows it."""

    usual: PressureField
    wide: PressureField

    def both(self) -> tuple[PressureField, PressureField]:
        """Usual grid first."""
        return (self.usual, self.wide)


@dataclass(frozen=True)
class Model:
    """Everything that the simulation of one scene needs."""

    rig: Vehicle
    timing: Timing
    scale: Vector  # [states] error allowed per step
    bodies: tuple[str, ...]
    tire_geometry: TireGeometry | None
    tire_field: FieldGrids | None
    seat_field: FieldGrids | None
    seat_shape: SeatShape | None
    corrector_passes: int

    @property
    def states(self) -> int:
        """Number of state variables."""
        return int(self.scale.shape[0])


def build(scene: dict[str, Any]) -> Model:
    """Parameters of a resolved scene. Raises FieldError where a pressure field cannot carry the standing load."""
    rig_name = scene["rig"]
    with_tire, with_seat = rig_name in ("tire", "car"), rig_name in ("seat", "car")
    seat_field, shape = _seat_field(scene) if with_seat else (None, None)
    tire, tire_contact, geometry, tire_field = (
        _tire_part(scene, _occupant_mass(scene) if with_seat else 0.0) if with_tire else (None, None, None, None)
    )
    seat = _seat(scene, offset=4 if with_tire else 0) if with_seat else None
    seat_contact = _seat_contact(scene, seat_field, shape) if with_seat else None
    rig = Vehicle(GRAVITY, tire, tire_contact, seat, seat_contact)
    return Model(
        rig=rig,
        timing=make_timing(scene, tire_field is not None or seat_field is not None),
        scale=_scale(rig, float(scene["integrator"]["relative_tolerance"])),
        bodies=_bodies(rig),
        tire_geometry=geometry,
        tire_field=tire_field,
        seat_field=seat_field,
        seat_shape=shape,
        corrector_passes=max(
            (field.usual.settings.corrector_passes for field in (tire_field, seat_field) if field is not None), default=0
        ),
    )


def make_timing(scene: dict[str, Any], with_field: bool) -> Timing:
    """Cut of a block; the loader has checked that every rate fits it."""
    length = float(scene["block_length"])
    samples = round(length * scene["outputs"]["force_rate"])
    intervals = round(length * scene["outputs"]["field_rate"]) if with_field else 1
    vibration = round(length * scene["vibration"]["sample_rate"]) if scene.get("vibration") else 1
    segments = math.lcm(samples, intervals, vibration)
    return Timing(
        length, round(scene["duration"] / length), intervals, segments // intervals, segments // samples, segments // vibration,
        round(length * scene["outputs"]["display_rate"]),
    )


def _effects(scene: dict[str, Any], contact: str) -> dict[str, Any]:
    return scene["effects"].get(contact) or {}


def _field_settings(scene: dict[str, Any], contact: str, modulus: float) -> FieldSettings | None:
    field = _effects(scene, contact).get("contact_field")
    if field is None:
        return None
    rows, cols = int(field["rows"]), int(field["cols"])
    return FieldSettings(
        rows, cols, float(field["length"]) / rows, float(field["width"]) / cols, modulus, float(field["tolerance"]),
        FIELD_ITERATIONS, int(field["corrector_passes"]),
    )  # fmt: skip


def _dissipative(scene: dict[str, Any], contact: str) -> NormalDissipative | None:
    loss = _effects(scene, contact).get("normal_dissipative")
    if loss is None:
        return None
    if loss.get("restitution") is not None:
        return NormalDissipative(damping_of_restitution(float(loss["restitution"]), float(loss["reference_speed"])))
    damping = loss.get("damping")
    return NormalDissipative(DEFAULT_DAMPING[contact] if damping is None else float(damping))


def _tire_part(
    scene: dict[str, Any], carried_mass: float
) -> tuple[Tire, Contact, TireGeometry, FieldGrids | None]:
    given = scene["tire"]
    tire = Tire(*(float(given[key]) for key in ("wheel_mass", "body_mass", "suspension_stiffness", "suspension_damping")))
    modulus = given["young_modulus"] / (1.0 - given["poisson_ratio"] ** 2)
    load = (tire.wheel_mass + tire.body_mass + carried_mass) * GRAVITY
    geometry = tire_lattice(scene)
    settings = _field_settings(scene, "tire", modulus)
    curvatures = (0.5 / geometry.radius_rolling, 0.5 / geometry.radius_lateral)
    if settings is None:
        law, field = NormalElastic(float(power_law(*curvatures, modulus)), 1.5), None
    else:
        field = _grids(settings, "tire")
        law = fit_tangent(field.usual, _crown(geometry), load)
    return tire, Contact(law, _dissipative(scene, "tire"), None), geometry, field


def _tire_geometry(
    footprint: HertzContact, radius_x: float, radius_y: float, settings: FieldSettings | None
) -> TireGeometry:
    """Lattice of the field, or one that holds the standing footprint with a margin where there is none."""
    long_along_y = radius_y >= radius_x
    semi_x, semi_y = (footprint.b, footprint.a)
    if not long_along_y:
        semi_x, semi_y = semi_y, semi_x
    if settings is not None:
        wide = widened(settings)
        grid = (settings.rows, settings.cols, settings.cell_x, settings.cell_y, wide.rows, wide.cols)
    else:
        rows, cols = FALLBACK_GRID
        grid = (rows, cols, 3.0 * semi_x / rows, 3.0 * semi_y / cols, rows, cols)
    return TireGeometry(radius_x, radius_y, semi_x, semi_y, *grid)


def tire_lattice(scene: dict[str, Any]) -> TireGeometry:
    """Road lattice and footprint of a resolved scene's tire, without making its field."""
    given = scene["tire"]
    mass = given["wheel_mass"] + given["body_mass"] + (_occupant_mass(scene) if scene["rig"] == "car" else 0.0)
    modulus = given["young_modulus"] / (1.0 - given["poisson_ratio"] ** 2)
    radius_x, radius_y = float(given["radius_rolling"]), float(given["radius_lateral"])
    curvatures = (0.5 / radius_x, 0.5 / radius_y)
    footprint = hertz_contact(*curvatures, modulus, mass * GRAVITY)
    return _tire_geometry(footprint, radius_x, radius_y, _field_settings(scene, "tire", modulus))


def _crown(geometry: TireGeometry) -> NDArray[numpy.float64]:
    """Gap of the tire over a flat road in [m], [rows, cols]."""
    x = (numpy.arange(geometry.rows) - geometry.rows // 2) * geometry.cell_x
    y = (numpy.arange(geometry.cols) - 0.5 * (geometry.cols - 1)) * geometry.cell_y
    return 0.5 * x[:, None] ** 2 / geometry.radius_rolling + 0.5 * y[None, :] ** 2 / geometry.radius_lateral


def _occupant_mass(scene: dict[str, Any]) -> float:
    occupant = scene["seat"]["occupant"]
    return float(occupant["frame_mass"] + sum(occupant["masses"]))


def _seat(scene: dict[str, Any], offset: int) -> Seat:
    occupant = scene["seat"]["occupant"]
    arrays = (numpy.array(occupant[key], dtype=numpy.float64) for key in ("masses", "stiffness", "damping"))
    return Seat(offset, float(occupant["frame_mass"]), *arrays)


def _grids(settings: FieldSettings, contact: str) -> FieldGrids:
    return FieldGrids(PressureField(settings, contact), PressureField(widened(settings), contact))


def _seat_field(scene: dict[str, Any]) -> tuple[FieldGrids | None, SeatShape | None]:
    seat = scene["seat"]
    settings = _field_settings(scene, "seat", seat["cushion_modulus"] / (1.0 - seat["cushion_poisson"] ** 2))
    if settings is None:
        return None, None
    return _grids(settings, "seat"), SeatShape(*(float(seat["body"][key]) for key in SeatShape._fields))


def seat_gap_on(shape: SeatShape, settings: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the occupant over the flat cushion on the cells of a grid, in [m]."""
    return seat_gap(shape, *seat_cells(settings))


def seat_cells(settings: FieldSettings) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Cell centres of the seat's grid in [m]; x counts forward from the tuberosities, which lie 0.3 of the length from its back."""
    x = (numpy.arange(settings.rows) + 0.5) * settings.cell_x - 0.3 * settings.rows * settings.cell_x
    y = (numpy.arange(settings.cols) - 0.5 * (settings.cols - 1)) * settings.cell_y
    return x, y


def _seat_contact(
    scene: dict[str, Any], field: FieldGrids | None, shape: SeatShape | None
) -> Contact:
    elastic = _effects(scene, "seat")["normal_elastic"]
    if field is not None and shape is not None:
        law = fit_tangent(field.usual, seat_gap_on(shape, field.usual.settings), _occupant_mass(scene) * GRAVITY)
    else:
        law = NormalElastic(float(elastic["coefficient"]), float(elastic["exponent"]))
    friction = _effects(scene, "seat").get("friction")
    rubbing = (
        None
        if friction is None
        else Friction(
            *(float(friction[key]) for key in ("stiffness", "damping", "coefficient_static", "coefficient_kinetic"))
        )
    )
    return Contact(law, _dissipative(scene, "seat"), rubbing)


def _scale(rig: Vehicle, tolerance: float) -> Vector:
    """Error allowed per step and state; the two works at the end are not controlled."""
    position, velocity = POSITION_SCALE * tolerance, VELOCITY_SCALE * tolerance
    scale: list[float] = []
    if rig.tire is not None:
        scale += [position, position, velocity, velocity]
    if rig.seat is not None:
        count = 1 + len(rig.seat.masses)
        scale += [position] * count + [velocity] * count
        if rig.seat_contact is not None and rig.seat_contact.friction is not None:
            scale += [position, velocity, position]
    return numpy.array([*scale, numpy.inf, numpy.inf])


def _bodies(rig: Vehicle) -> tuple[str, ...]:
    """Names of the coordinates that ``bench/motion`` carries, in order."""
    names: list[str] = ["wheel_z", "body_z"] if rig.tire is not None else ["floor_z"]
    if rig.seat is not None:
        names += ["seat_frame_z", *(f"occupant{i + 1}_z" for i in range(len(rig.seat.masses)))]
        if rig.seat_contact is not None and rig.seat_contact.friction is not None:
            names.append("occupant_x")
    return tuple(names)


def standing_state(model: Model, height: float) -> Vector:
    """State at rest in [m, m/s] under gravity on a road of effective ``height`` [m]: every force in balance."""
    rig = model.rig
    state = numpy.zeros(model.states)
    floor = 0.0
    occupant = 0.0 if rig.seat is None else rig.seat.frame_mass + float(rig.seat.masses.sum())
    if rig.tire is not None and rig.tire_contact is not None:
        carried = (rig.tire.body_mass + occupant) * rig.gravity
        approach = approach_of_force(rig.tire_contact.elastic, carried + rig.tire.wheel_mass * rig.gravity)
        state[0] = height - approach
        floor = state[1] = state[0] - carried / rig.tire.suspension_stiffness
    if rig.seat is not None and rig.seat_contact is not None:
        first = rig.seat.offset
        state[first] = floor - approach_of_force(rig.seat_contact.elastic, occupant * rig.gravity)
        for i, mass in enumerate(rig.seat.masses):
            state[first + 1 + i] = state[first] - mass * rig.gravity / rig.seat.stiffness[i]
    return state
