"""Resolved scene -> parameters, grids and timing: the only place where an effect that is not called for becomes ``None``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.effects.contact_field import FieldError, PressureField, fit_tangent
from contact_sim_pkg.core.effects.normal_elastic import approach_of_force
from contact_sim_pkg.core.effects.seat_shape import SeatShape, seat_gap
from contact_sim_pkg.core.hertz import hertz_contact, power_law
from contact_sim_pkg.core.parameters import (
    Contact,
    FieldSettings,
    Friction,
    NormalDissipative,
    NormalElastic,
    Seat,
    Tire,
    Vector,
    Vehicle,
    widened,
)
from contact_sim_pkg.core.restitution import damping_of_restitution
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.lattice import (
    GRAVITY,
    RoadLattice,
    contact_modulus,
    effects_at,
    field_settings,
    occupant_mass,
    standing_load,
    tire_lattice,
)
from contact_sim_pkg.scene.timing import Timing, make_timing

POSITION_SCALE = 0.01  # [m], size of the approaches; the integrator's tolerance is relative to it
VELOCITY_SCALE = 0.5  # [m/s], size of the velocities on a rough road
DEFAULT_DAMPING = {"tire": 0.06, "seat": 1.0}  # [s/m], see scene/schema_effects.py


@dataclass(frozen=True)
class TireGeometry:
    """Tire and road lattice: radii [m], footprint of the standing load [m], cells [m]."""

    radius_rolling: float
    radius_lateral: float
    semi_axis_x: float
    semi_axis_y: float
    lattice: RoadLattice


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
    tire, tire_contact, geometry, tire_field = _tire_part(scene) if with_tire else (None, None, None, None)
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
            (field.usual.settings.corrector_passes for field in (tire_field, seat_field) if field is not None),
            default=0,
        ),
    )


def _dissipative(scene: dict[str, Any], contact: str) -> NormalDissipative | None:
    loss = effects_at(scene, contact).get("normal_dissipative")
    if loss is None:
        return None
    if loss.get("restitution") is not None:
        return NormalDissipative(damping_of_restitution(float(loss["restitution"]), float(loss["reference_speed"])))
    damping = loss.get("damping")
    return NormalDissipative(DEFAULT_DAMPING[contact] if damping is None else float(damping))


def _tire_part(scene: dict[str, Any]) -> tuple[Tire, Contact, TireGeometry, FieldGrids | None]:
    given = scene["tire"]
    tire = Tire(
        *(float(given[key]) for key in ("wheel_mass", "body_mass", "suspension_stiffness", "suspension_damping"))
    )
    modulus, load = contact_modulus(given), standing_load(scene)
    geometry = _tire_geometry(scene)
    settings = field_settings(scene, "tire", modulus)
    curvatures = (0.5 / geometry.radius_rolling, 0.5 / geometry.radius_lateral)
    if settings is None:
        law, field = NormalElastic(float(power_law(*curvatures, modulus)), 1.5), None
    else:
        field = _grids(settings, "tire")
        law = _tangent(field, lambda grid: _crown(geometry, grid), load, "tire")
    return tire, Contact(law, _dissipative(scene, "tire"), None), geometry, field


def _tire_geometry(scene: dict[str, Any]) -> TireGeometry:
    given = scene["tire"]
    radius_x, radius_y = float(given["radius_rolling"]), float(given["radius_lateral"])
    footprint = hertz_contact(0.5 / radius_x, 0.5 / radius_y, contact_modulus(given), standing_load(scene))
    semi_x, semi_y = (footprint.b, footprint.a) if radius_y >= radius_x else (footprint.a, footprint.b)
    return TireGeometry(radius_x, radius_y, semi_x, semi_y, tire_lattice(scene))


def _tangent(
    grids: FieldGrids, gap_on: Callable[[FieldSettings], NDArray[numpy.float64]], load: float, contact: str
) -> NormalElastic:
    """Tangent law at the standing load; on the wide grid where the usual one does not hold the contact."""
    for field in grids.both():
        try:
            return fit_tangent(field, gap_on(field.settings), load)
        except FieldError as error:
            reason = error
    where = f"effects.{contact}.contact_field"
    sentence = (
        f"the contact does not fit on its grid at the standing load of {load:.6g} N: {reason}; enlarge length and width"
    )
    raise SceneError([Fault("scene", 0, 0, where, sentence)])


def _crown(geometry: TireGeometry, grid: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the tire over a flat road in [m], on the cells of a grid."""
    x = (numpy.arange(grid.rows) - grid.rows // 2) * grid.cell_x
    y = (numpy.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    return 0.5 * x[:, None] ** 2 / geometry.radius_rolling + 0.5 * y[None, :] ** 2 / geometry.radius_lateral


def _seat(scene: dict[str, Any], offset: int) -> Seat:
    occupant = scene["seat"]["occupant"]
    arrays = (numpy.array(occupant[key], dtype=numpy.float64) for key in ("masses", "stiffness", "damping"))
    return Seat(offset, float(occupant["frame_mass"]), *arrays)


def _grids(settings: FieldSettings, contact: str) -> FieldGrids:
    return FieldGrids(PressureField(settings, contact), PressureField(widened(settings), contact))


def _seat_field(scene: dict[str, Any]) -> tuple[FieldGrids | None, SeatShape | None]:
    seat = scene["seat"]
    settings = field_settings(scene, "seat", seat["cushion_modulus"] / (1.0 - seat["cushion_poisson"] ** 2))
    if settings is None:
        return None, None
    return _grids(settings, "seat"), SeatShape(*(float(seat["body"][key]) for key in SeatShape._fields))


def seat_gap_on(shape: SeatShape, settings: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the occupant over the flat cushion on the cells of a grid, in [m]."""
    return seat_gap(shape, *seat_cells(settings))


def seat_cells(settings: FieldSettings) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Cell centres of the seat's grid in [m]; x counts forward from the tuberosities, which lie 0.3 of the length from its back."""
    rows, cols = numpy.arange(settings.rows, dtype=float), numpy.arange(settings.cols, dtype=float)
    x = (rows + 0.5) * settings.cell_x - 0.3 * settings.rows * settings.cell_x
    y = (cols - 0.5 * (settings.cols - 1)) * settings.cell_y
    return x, y


def _seat_contact(scene: dict[str, Any], field: FieldGrids | None, shape: SeatShape | None) -> Contact:
    elastic = effects_at(scene, "seat")["normal_elastic"]
    if field is not None and shape is not None:
        law = _tangent(field, lambda grid: seat_gap_on(shape, grid), occupant_mass(scene) * GRAVITY, "seat")
    else:
        law = NormalElastic(float(elastic["coefficient"]), float(elastic["exponent"]))
    friction = effects_at(scene, "seat").get("friction")
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
