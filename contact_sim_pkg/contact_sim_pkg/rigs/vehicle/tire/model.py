"""Resolved scene -> parameters of the tire and of the effects in its contact; what is not called
for is ``None``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.laws.parameters import Contact, NormalElastic
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact, power_law
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.contact_field import FieldGrids, make_grids, tangent_law
from contact_sim_pkg.rigs.vehicle.coupling_model import coupled_timing, uniform_segments
from contact_sim_pkg.rigs.vehicle.lattice import (
    contact_modulus,
    field_settings,
    standing_load,
    tire_lattice,
)
from contact_sim_pkg.rigs.vehicle.parameters import RigidRing, Tire
from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection
from contact_sim_pkg.rigs.vehicle.tire import schema
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush, TreadViscoelasticity
from contact_sim_pkg.rigs.vehicle.tire.tread_viscoelasticity import stiffening
from contact_sim_pkg.run.contact_laws import normal_loss
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


@dataclass(frozen=True)
class TireGeometry:
    """Tire and road lattice: radii [m], footprint of the standing load [m], cells [m]."""

    radius_rolling: float
    radius_lateral: float
    semi_axis_x: float
    semi_axis_y: float
    lattice: RoadLattice

    @property
    def footprint_length(self) -> float:
        """Length in [m] along the travel of the footprint of the standing load."""
        return 2.0 * self.semi_axis_x


@dataclass(frozen=True)
class Tread:
    """What a pressure field of a rubber with memory needs beside its grids."""

    viscoelasticity: TreadViscoelasticity
    relaxed_modulus: float  # [Pa] contact modulus at long times
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
class RollingFriction:
    """Brush of the tire and its slip programme, straight between the points."""

    brush: Brush
    times: Vector  # [s]
    longitudinal: Vector
    angles: Vector  # [rad]

    def slips_at(self, time: float) -> tuple[float, float]:
        """Longitudinal slip and slip angle [rad] at a time [s]."""
        return (
            float(numpy.interp(time, self.times, self.longitudinal)),
            float(numpy.interp(time, self.times, self.angles)),
        )


@dataclass(frozen=True)
class TireParts:
    """The tire of a rig, its contact and the effects in it."""

    tire: Tire
    rigid_ring: RigidRing | None
    contact: Contact
    geometry: TireGeometry
    footprint_length: float  # [m] along the travel under the standing load, by the field where there is one
    field: FieldGrids | None
    tread: Tread | None
    rolling_friction: RollingFriction | None
    asperities: Asperities | None


def build_tire(scene: ResolvedScene, occupant: OccupantSection | None) -> TireParts:
    """Parts of a resolved scene's tire under an ``occupant``, None where it carries none.

    Raises SceneError where a pressure field cannot carry the standing load.
    """
    given_tire = scene.section(schema.TireSection)
    load = standing_load(given_tire, occupant)
    rigid_ring, geometry = _rigid_ring(scene), _geometry(scene, given_tire, load)
    tread = _tread(scene, given_tire, geometry)
    tire = Tire(
        given_tire.wheel_mass - (0.0 if rigid_ring is None else rigid_ring.belt_mass), given_tire.body_mass,
        given_tire.suspension_stiffness, given_tire.suspension_damping,
    )  # fmt: skip
    law, length, field = _elastic(scene, given_tire, load, geometry, tread)
    contact = Contact(law, normal_loss(scene, "tire", law, load / GRAVITY), None)
    asperities = _asperities(scene, geometry, load)
    return TireParts(
        tire=tire,
        rigid_ring=rigid_ring,
        contact=contact,
        geometry=geometry,
        footprint_length=length,
        field=field,
        tread=tread,
        rolling_friction=_rolling_friction(scene),
        asperities=asperities,
    )


def _elastic(
    scene: ResolvedScene, tire: schema.TireSection, load: float, geometry: TireGeometry, tread: Tread | None
) -> tuple[NormalElastic, float, FieldGrids | None]:
    """Normal law, length in [m] of the standing footprint, and the field.

    Hertz's law of the point contact, or a field's tangent law; a tread with memory is stiffer at
    once than for long, and its footprint, which sets its step, is Hertz's for long.
    """
    modulus = contact_modulus(tire)
    raised = 1.0 if tread is None else stiffening(tread.viscoelasticity, tread.step)
    settings = _field_settings(scene, modulus * raised)
    if settings is None:
        curvatures = (0.5 / geometry.radius_rolling, 0.5 / geometry.radius_lateral)
        return NormalElastic(float(power_law(*curvatures, modulus)), 1.5), geometry.footprint_length, None
    field = make_grids(settings, "tire")
    law, length = tangent_law(field, lambda grid: _crown(geometry, grid), load, "tire")
    return law, length if tread is None else geometry.footprint_length, field


def _field_settings(scene: ResolvedScene, modulus: float) -> FieldSettings | None:
    return field_settings(scene.effect("tire", schema.TireField), modulus, scene.effect("tire", schema.Envelopment))


def _rigid_ring(scene: ResolvedScene) -> RigidRing | None:
    rigid_ring = scene.effect("tire", schema.RigidRingSection)
    return None if rigid_ring is None else RigidRing(4, rigid_ring.belt_mass, rigid_ring.stiffness, rigid_ring.damping)


def _tread(scene: ResolvedScene, tire: schema.TireSection, geometry: TireGeometry) -> Tread | None:
    memory = scene.effect("tire", schema.TreadViscoelasticitySection)
    if memory is None:
        return None
    pairs = numpy.array(memory.branches, dtype=numpy.float64).reshape(-1, 2)
    tread = TreadViscoelasticity(memory.retardation_time, pairs[:, 0].copy(), pairs[:, 1].copy())
    timing = coupled_timing(scene, True, geometry.footprint_length)
    step = uniform_segments(scene, geometry.footprint_length, timing) * timing.segment_length
    return Tread(tread, contact_modulus(tire), step)


def _rolling_friction(scene: ResolvedScene) -> RollingFriction | None:
    law, slip = scene.effect("tire", schema.BrushSection), scene.slip
    if law is None:
        return None
    points = [[0.0, 0.0, 0.0]] if slip is None else slip.points or [[0.0, slip.longitudinal or 0.0, slip.angle or 0.0]]
    times, longitudinal, angles = numpy.array(points, dtype=numpy.float64).T.copy()
    brush = Brush(law.stiffness_x, law.stiffness_y, law.coefficient_static, law.coefficient_kinetic)
    return RollingFriction(brush, times, longitudinal, angles)


def _asperities(scene: ResolvedScene, geometry: TireGeometry, load: float) -> Asperities | None:
    law = scene.effect("tire", schema.AsperityImpulsesSection)
    if law is None:
        return None
    return Asperities(law.spacing, geometry.footprint_length, load, law.share, law.window == "raised_cosine")


def _geometry(scene: ResolvedScene, tire: schema.TireSection, load: float) -> TireGeometry:
    radius_x, radius_y, modulus = tire.radius_rolling, tire.radius_lateral, contact_modulus(tire)
    footprint = hertz_contact(0.5 / radius_x, 0.5 / radius_y, modulus, load)
    semi_x, semi_y = (footprint.b, footprint.a) if radius_y >= radius_x else (footprint.a, footprint.b)
    lattice = tire_lattice(tire, _field_settings(scene, modulus), load)
    return TireGeometry(radius_x, radius_y, semi_x, semi_y, lattice)


def _crown(geometry: TireGeometry, grid: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the tire over a flat road in [m], on the cells of a grid."""
    x = (numpy.arange(grid.rows) - grid.rows // 2) * grid.cell_x
    y = (numpy.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    return 0.5 * x[:, None] ** 2 / geometry.radius_rolling + 0.5 * y[None, :] ** 2 / geometry.radius_lateral


def relaxed_grids(grids: FieldGrids, tread: Tread) -> FieldGrids:
    """The same grids for a tread that has stood for long."""
    settings = grids.usual.settings._replace(modulus=tread.relaxed_modulus)
    return make_grids(settings, grids.usual.contact)
