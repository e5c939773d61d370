"""Resolved scene -> parameters of the tire and of the effects in its contact; what is not called
for is ``None``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.laws.elastic_law import approach_of_force
from contact_sim_pkg.laws.parameters import Contact, ElasticLaw
from contact_sim_pkg.pressure.settings import FieldSettings, InflatedBelt
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldGrids, make_grids, tangent_law
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import coupled_timing, uniform_segments
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import stiffened
from contact_sim_pkg.rigs.vehicle.field.settings import field_settings
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection
from contact_sim_pkg.rigs.vehicle.tire import schema
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, TireForm, body_of
from contact_sim_pkg.rigs.vehicle.tire.footprint import hertz_weights
from contact_sim_pkg.rigs.vehicle.tire.force_table import TireTable, tire_table
from contact_sim_pkg.rigs.vehicle.tire.lattice import standing_load, tire_lattice
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import MagicFormula
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.section import MagicFormulaSection
from contact_sim_pkg.rigs.vehicle.tire.mount import mounted, refuse_beyond_law
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush, LoadFriction, Sidewalls, TreadViscoelasticity, WheelSpin
from contact_sim_pkg.rigs.vehicle.tire.quarter_car import QuarterCar, quarter_car
from contact_sim_pkg.rigs.vehicle.tire.rolling_loss import RollingLoss, rolling_loss
from contact_sim_pkg.rigs.vehicle.tire.standing import (
    TireAtRest,
    crown_of,
    hertz_law,
    hertz_semi_axes,
    of_field,
    of_half_space,
    of_table,
)
from contact_sim_pkg.rigs.vehicle.tire.tread_viscoelasticity import stiffening
from contact_sim_pkg.run.contact_laws import normal_loss
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given

LONGEST_STEP = 5e-4  # [s] of belt and bristles; with the usual values their fastest mode lies near 130 Hz
LEAST_FOOTPRINTS = 2  # kept in a force table, the empty one included
PART_OF_SWING = 0.5  # omega h; the frequency is 1 % off


@dataclass(frozen=True)
class TireGeometry:
    """Tire and road lattice, and the footprint of the standing load."""

    form: TireForm
    footprint_length: float  # [m] along the travel
    half_width: float  # [m] of the footprint
    weights: NDArray[numpy.float64]  # [odd rows, cols] of the road's nodes around the wheel, of sum 1
    lattice: RoadLattice


@dataclass(frozen=True)
class Tread:
    """What a pressure field of a rubber with memory needs beside its grids."""

    viscoelasticity: TreadViscoelasticity
    relaxed: TireBody  # at long times
    belt: TreadViscoelasticity | None  # memory of an inflated belt's rubber; None: elastic
    step: float  # [s] from one solution of the field to the next


@dataclass(frozen=True)
class Asperities:
    """Impulses of the road's asperities; they are laid on the road as it comes."""

    spacing: float  # [m]
    contact_length: float  # [m]
    load: float  # [N] standing
    share: float  # of the load, carried by the sites under the tire
    raised_cosine: bool


@dataclass(frozen=True)
class Programme:
    """Two values over time, straight between the points."""

    times: Vector  # [s]
    first: Vector
    second: Vector

    @classmethod
    def of(cls, points: list[list[float]]) -> Programme:
        """Through triples of a time [s] and the two values."""
        return cls(*numpy.array(points, dtype=numpy.float64).T.copy())

    def at(self, time: float) -> tuple[float, float]:
        """Both values at a ``time`` [s]."""
        return (
            float(numpy.interp(time, self.times, self.first)),
            float(numpy.interp(time, self.times, self.second)),
        )


@dataclass(frozen=True)
class RollingFriction:
    """Bristles of the tire, the belt on its sidewalls, and what turns and steers the wheel."""

    brush: Brush
    by_load: LoadFriction | None  # None: the same friction under any load
    unloaded: float  # [m] radius
    deflection: float  # [m] of the axle at the standing load
    slips: Programme  # longitudinal slip and slip angle [rad]
    sidewalls: Sidewalls | None
    torques: Programme  # drive and brake [N m] on a wheel that spins
    longest_step: float  # [s] of belt and bristles

    def radius_at(self, deflection: float) -> float:
        """Effective rolling radius [m] at a ``deflection`` [m] of the axle: R - d/3 (Pacejka, 8.3)."""
        return self.unloaded - max(deflection, 0.0) / 3.0

    @property
    def radius(self) -> float:
        """That of the standing load [m]."""
        return self.radius_at(self.deflection)


@dataclass(frozen=True)
class FormulaParts:
    """Magic Formula of the tire, where it acts, and what turns and steers the wheel."""

    formula: MagicFormula
    inflation: float  # [Pa]
    unloaded: float  # [m] radius
    slips: Programme  # longitudinal slip and slip angle [rad]


@dataclass(frozen=True)
class TireParts:
    """The tire of a rig, its contact and the effects in it."""

    quarter: QuarterCar
    geometry: TireGeometry
    footprint_length: float  # [m] along the travel under the standing load, by the field where there is one
    field: FieldGrids | None
    tread: Tread | None
    rolling_friction: RollingFriction | None
    magic_formula: FormulaParts | None
    rolling_loss: RollingLoss | None
    asperities: Asperities | None
    standing: TireAtRest | None  # under its standing load; None where no static solution carries that


def build_tire(scene: ResolvedScene, occupant: OccupantSection | None, solver: type | None = None) -> TireParts:
    """Parts of a resolved scene's tire under an ``occupant``, None where it carries none; solver: of a
    half-space, in place of `RollingField`.

    Raises SceneError where a pressure field cannot carry the standing load.
    """
    given_tire, body = scene.section(schema.TireSection), body_of(scene)
    load = standing_load(given_tire, occupant)
    table = None if body.extent is None else tire_table(body, solver)
    if table is not None:
        _refuse_footless(table, load)
    geometry = _geometry(scene, body, table, load)
    tread = _tread(scene, body, geometry)
    law, length, field = _elastic(scene, body, table, load, geometry, tread, solver)
    contact = Contact(law, normal_loss(scene, "tire", law, load / GRAVITY), None)
    asperities = _asperities(scene, geometry, load)
    ring = scene.effect("tire", schema.RigidRingSection)
    machine = mounted(given_tire)
    quarter = quarter_car(given_tire, ring, contact, machine, pushed=asperities is not None)
    sidewalls = quarter.sidewalls
    if machine is not None and table is not None:
        refuse_beyond_law(machine, given_tire, table, sidewalls)
    deflection = float(approach_of_force(law, load)) + (0.0 if sidewalls is None else load / sidewalls.stiffness)
    return TireParts(
        quarter=quarter,
        geometry=geometry,
        footprint_length=length,
        field=field,
        tread=tread,
        rolling_friction=_rolling_friction(scene, deflection, body.form.radius_rolling, geometry),
        magic_formula=_magic_formula(scene, body.form.radius_rolling),
        rolling_loss=_rolling_loss(scene, body),
        asperities=asperities,
        standing=_standing(scene, body, table, sidewalls, load, solver),
    )


def _refuse_footless(table: TireTable, load: float) -> None:
    """SceneError where the sidewalls give way before the first kept footprint: the tire has no law."""
    if len(table.quarters) < LEAST_FOOTPRINTS:
        sentence = (
            f"the tire gives way under {table.force.max():.3g} N, before it has a footprint, and the standing load is"
            f" {load:.5g} N; a higher inflation or a stiffer effects.tire.rigid_ring carries it"
        )
        raise SceneError([Fault("scene", 0, 0, "effects.tire.inflation", sentence)])


def _standing(
    scene: ResolvedScene, body: TireBody, table: TireTable | None, sidewalls: Spring | None, load: float,
    solver: type | None,
) -> TireAtRest | None:  # fmt: skip
    """The tire at rest, a tread with memory relaxed: `body` is that for long, as its table."""
    if table is not None:
        return of_table(table, sidewalls, load)
    settings = _field_settings(scene, body)
    if settings is None or body.belt is None:  # a belt needs a field
        return of_half_space(body, sidewalls, load)
    return of_field(make_grids(settings._replace(solver=solver), "tire"), body.form, sidewalls, load)


def _elastic(
    scene: ResolvedScene, body: TireBody, table: TireTable | None, load: float, geometry: TireGeometry, tread: Tread | None,
    solver: type | None,
) -> tuple[ElasticLaw, float, FieldGrids | None]:  # fmt: skip
    """Normal law, length in [m] of the standing footprint, and the field.

    The law of an inflated tire is its table, that of a half-space Hertz's, or a field's tangent law; a
    tread with memory is stiffer at once than for long, and its footprint, which sets its step, is that
    for long.
    """
    settings = _field_settings(scene, body if tread is None else _at_once(body, tread))
    field = None if settings is None else make_grids(settings._replace(solver=solver), "tire")
    if field is None and table is not None:
        return table.law(), geometry.footprint_length, None
    if field is None:
        return hertz_law(body), geometry.footprint_length, None
    law, length = tangent_law(field, lambda grid: crown_of(body.form, grid), load, "tire")
    if tread is not None:
        return law, geometry.footprint_length, field
    return (law, length, field) if table is None else (table.law(), length, field)


def _field_settings(scene: ResolvedScene, body: TireBody) -> FieldSettings | None:
    return field_settings(scene.effect("tire", schema.TireField), body.modulus, body.belt)


def _tread(scene: ResolvedScene, body: TireBody, geometry: TireGeometry) -> Tread | None:
    memory = scene.effect("tire", schema.TreadViscoelasticitySection)
    if memory is None:
        return None
    rubber = rubber_of(memory)
    timing = coupled_timing(scene, True, geometry.footprint_length)
    step = uniform_segments(scene, geometry.footprint_length, timing) * timing.segment_length
    belt = None
    if isinstance(body.belt, InflatedBelt) and memory.belt > 0.0 and body.belt.bending + body.belt.rubber > 0.0:
        belt = rubber._replace(
            retardation_time=memory.belt * rubber.retardation_time, ratios=memory.belt * rubber.ratios
        )
    return Tread(rubber, body, belt, step)


def rubber_of(memory: schema.TreadViscoelasticitySection | schema.RollingLossSection) -> TreadViscoelasticity:
    ratios, times = numpy.array(given(memory.branches), dtype=numpy.float64).reshape(-1, 2).T.copy()
    return TreadViscoelasticity(memory.retardation_time, ratios, times)


def _rolling_loss(scene: ResolvedScene, body: TireBody) -> RollingLoss | None:
    memory = scene.effect("tire", schema.RollingLossSection)
    return None if memory is None else rolling_loss(body, rubber_of(memory), memory.belt)


def _at_once(body: TireBody, tread: Tread) -> TireBody:
    """The tire as stiff as over one step of its ``tread``."""
    belt = body.belt
    if tread.belt is not None and isinstance(belt, InflatedBelt):
        belt = stiffened(belt, stiffening(tread.belt, tread.step))
    return body._replace(modulus=body.modulus * stiffening(tread.viscoelasticity, tread.step), belt=belt)


def _rolling_friction(
    scene: ResolvedScene, deflection: float, unloaded: float, geometry: TireGeometry
) -> RollingFriction | None:
    """``deflection`` [m] at the axle of the standing load; ``unloaded`` radius [m]."""
    law = scene.effect("tire", schema.BrushSection)
    if law is None:
        return None
    spin = scene.effect("tire", schema.WheelSpinSection)
    torques = [[0.0, 0.0, 0.0]] if spin is None else spin.points or [[0.0, spin.drive or 0.0, spin.brake or 0.0]]
    brush = Brush(
        law.stiffness_x, law.stiffness_y, law.coefficient_static, law.coefficient_kinetic, law.sliding_speed
    )  # fmt: skip
    area = 2.0 * geometry.half_width * geometry.footprint_length
    sidewalls = _sidewalls(scene, None if spin is None else WheelSpin(spin.inertia))
    step = (
        LONGEST_STEP
        if sidewalls is None
        else min(LONGEST_STEP, PART_OF_SWING / fastest(sidewalls, brush, unloaded, area))
    )
    by_load = None
    if law.load_exponent > 0.0 or law.load_exponent_across > 0.0:
        by_load = LoadFriction(law.nominal_load, law.load_exponent, law.load_exponent_across)
    return RollingFriction(brush, by_load, unloaded, deflection, _slips(scene), sidewalls, Programme.of(torques), step)


def _slips(scene: ResolvedScene) -> Programme:
    """Longitudinal slip and slip angle [rad] over time; 0 where the scene gives none."""
    slip = scene.slip
    if slip is None:
        return Programme.of([[0.0, 0.0, 0.0]])
    return Programme.of(slip.points or [[0.0, slip.longitudinal or 0.0, slip.angle or 0.0]])


def _magic_formula(scene: ResolvedScene, unloaded: float) -> FormulaParts | None:
    """``unloaded`` [m] radius. The inflation is that of the scene's tire, of a half-space that of the file."""
    keys, tire = scene.effect("tire", MagicFormulaSection), scene.effect("tire", schema.Inflation)
    if keys is None:
        return None
    formula = keys.formula()
    inflation = formula.inflation if tire is None else tire.pressure
    if not formula.inflation:  # the coefficients count at every one
        inflation = formula.keys["NOMPRES"]
    return FormulaParts(formula, inflation, unloaded, _slips(scene))


def fastest(sidewalls: Sidewalls, brush: Brush, radius: float, area: float) -> float:
    """Highest angular frequency [rad/s] of a belt whose bristles stick over an ``area`` [m^2] at a
    ``radius`` [m], from above.
    """
    rim = math.inf if sidewalls.wheel is None else sidewalls.wheel.inertia
    along, across = brush.stiffness_x * area, brush.stiffness_y * area
    return math.sqrt(
        max(
            (sidewalls.stiffness_x + along) / sidewalls.mass
            + sidewalls.stiffness_twist * (1.0 / sidewalls.inertia + 1.0 / rim)
            + along * radius**2 / sidewalls.inertia,
            (sidewalls.stiffness_y + across) / sidewalls.mass + sidewalls.stiffness_yaw / sidewalls.yaw_inertia,
        )
    )  # fmt: skip


def _sidewalls(scene: ResolvedScene, wheel: WheelSpin | None) -> Sidewalls | None:
    keys = scene.effect("tire", schema.SidewallComplianceSection)
    if keys is None:
        return None
    mass, along, yaw_inertia = given(keys.belt_mass), given(keys.longitudinal), 0.5 * keys.belt_inertia

    def damping(stiffness: float, inertia: float) -> float:
        return 2.0 * keys.damping_ratio * math.sqrt(stiffness * inertia)

    return Sidewalls(
        mass, keys.belt_inertia, yaw_inertia, along, keys.lateral, keys.rotational, keys.yaw,
        damping(along, mass), damping(keys.lateral, mass), damping(keys.rotational, keys.belt_inertia),
        damping(keys.yaw, yaw_inertia), wheel, keys.bending, keys.extension,
    )  # fmt: skip


def _asperities(scene: ResolvedScene, geometry: TireGeometry, load: float) -> Asperities | None:
    law = scene.effect("tire", schema.AsperityImpulsesSection)
    if law is None:
        return None
    return Asperities(law.spacing, geometry.footprint_length, load, law.share, law.window == "raised_cosine")


def _geometry(scene: ResolvedScene, body: TireBody, table: TireTable | None, load: float) -> TireGeometry:
    lattice = tire_lattice(body, _field_settings(scene, body), load)
    cells = lattice.cell_x, lattice.cell_y
    if table is not None:
        length, width, _area = table.contact_at(load)
        return TireGeometry(body.form, length, 0.5 * width, table.weights(load, cells, lattice.road_cols), lattice)
    semi_x, semi_y = hertz_semi_axes(body, load)
    weights = hertz_weights(semi_x, semi_y, *cells, lattice.road_cols)
    return TireGeometry(body.form, 2.0 * semi_x, semi_y, weights, lattice)


def relaxed_grids(grids: FieldGrids, tread: Tread) -> FieldGrids:
    """The same grids for a tread that has stood for long."""
    settings = grids.usual.settings._replace(modulus=tread.relaxed.modulus, belt=tread.relaxed.belt)
    return make_grids(settings, grids.usual.contact)
