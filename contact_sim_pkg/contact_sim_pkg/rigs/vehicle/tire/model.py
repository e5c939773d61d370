"""Resolved scene -> parameters of the tire and of the effects in its contact; what is not called for is ``None``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.excitation.blocks import RoadLattice
from contact_sim_pkg.laws.parameters import Contact, NormalElastic
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact, power_law
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.contact_model import FieldGrids, loss_of, make_grids, tangent_law
from contact_sim_pkg.rigs.vehicle.coupling_model import coupled_timing, uniform_segments
from contact_sim_pkg.rigs.vehicle.lattice import (
    contact_modulus,
    field_settings,
    standing_load,
    tire_lattice,
)
from contact_sim_pkg.rigs.vehicle.parameters import Carcass, Tire
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush, TreadViscoelasticity
from contact_sim_pkg.rigs.vehicle.tire.tread_viscoelasticity import stiffening
from contact_sim_pkg.scene.resolved_scene import effects_at


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
    carcass: Carcass | None
    contact: Contact
    geometry: TireGeometry
    footprint_length: float  # [m] along the travel under the standing load, by the field where there is one
    field: FieldGrids | None
    tread: Tread | None
    rolling_friction: RollingFriction | None
    asperities: Asperities | None


def build_tire(scene: dict[str, Any]) -> TireParts:
    """Parts of a resolved scene's tire. Raises SceneError where a pressure field cannot carry the standing load."""
    given = scene["tire"]
    carcass, geometry = _carcass(scene), _geometry(scene)
    tread = _tread(scene, geometry)
    tire = Tire(
        float(given["wheel_mass"]) - (0.0 if carcass is None else carcass.belt_mass),
        *(float(given[key]) for key in ("body_mass", "suspension_stiffness", "suspension_damping")),
    )
    law, length, field = _elastic(scene, geometry, tread)
    contact = Contact(law, loss_of(scene, "tire", law, standing_load(scene) / GRAVITY), None)
    asperities = _asperities(scene, geometry)
    return TireParts(tire, carcass, contact, geometry, length, field, tread, _rolling_friction(scene), asperities)


def _elastic(
    scene: dict[str, Any], geometry: TireGeometry, tread: Tread | None
) -> tuple[NormalElastic, float, FieldGrids | None]:
    """Normal law, length in [m] of the standing footprint, and the field.

    Hertz's law of the point contact, or a field's tangent law; a tread with memory is stiffer at once than for long, and its
    footprint, which sets its step, is Hertz's for long.
    """
    modulus = contact_modulus(scene["tire"])
    raised = 1.0 if tread is None else stiffening(tread.viscoelasticity, tread.step)
    settings = field_settings(scene, "tire", modulus * raised)
    if settings is None:
        curvatures = (0.5 / geometry.radius_rolling, 0.5 / geometry.radius_lateral)
        return NormalElastic(float(power_law(*curvatures, modulus)), 1.5), geometry.footprint_length, None
    field = make_grids(settings, "tire")
    law, length = tangent_law(field, lambda grid: _crown(geometry, grid), standing_load(scene), "tire")
    return law, length if tread is None else geometry.footprint_length, field


def _carcass(scene: dict[str, Any]) -> Carcass | None:
    carcass = effects_at(scene, "tire").get("carcass")
    if carcass is None:
        return None
    return Carcass(4, *(float(carcass[key]) for key in ("belt_mass", "stiffness", "damping")))


def _tread(scene: dict[str, Any], geometry: TireGeometry) -> Tread | None:
    memory = effects_at(scene, "tire").get("tread_viscoelasticity")
    if memory is None:
        return None
    pairs = numpy.array(memory["branches"], dtype=numpy.float64).reshape(-1, 2)
    tread = TreadViscoelasticity(float(memory["retardation_time"]), pairs[:, 0].copy(), pairs[:, 1].copy())
    timing = coupled_timing(scene, True, geometry.footprint_length)
    step = uniform_segments(scene, geometry.footprint_length, timing) * timing.segment_length
    return Tread(tread, contact_modulus(scene["tire"]), step)


def _rolling_friction(scene: dict[str, Any]) -> RollingFriction | None:
    given = effects_at(scene, "tire").get("brush")
    if given is None:
        return None
    keys = ("stiffness_x", "stiffness_y", "coefficient_static", "coefficient_kinetic")
    slip = scene.get("slip") or {}
    points = slip.get("points") or [[0.0, slip.get("longitudinal", 0.0), slip.get("angle", 0.0)]]
    times, longitudinal, angles = numpy.array(points, dtype=numpy.float64).T.copy()
    return RollingFriction(Brush(*(float(given[key]) for key in keys)), times, longitudinal, angles)


def _asperities(scene: dict[str, Any], geometry: TireGeometry) -> Asperities | None:
    given = effects_at(scene, "tire").get("asperity_impulses")
    if given is None:
        return None
    return Asperities(
        float(given["spacing"]), geometry.footprint_length, standing_load(scene), float(given["share"]),
        given["window"] == "raised_cosine",
    )  # fmt: skip


def _geometry(scene: dict[str, Any]) -> TireGeometry:
    given = scene["tire"]
    radius_x, radius_y = float(given["radius_rolling"]), float(given["radius_lateral"])
    footprint = hertz_contact(0.5 / radius_x, 0.5 / radius_y, contact_modulus(given), standing_load(scene))
    semi_x, semi_y = (footprint.b, footprint.a) if radius_y >= radius_x else (footprint.a, footprint.b)
    return TireGeometry(radius_x, radius_y, semi_x, semi_y, tire_lattice(scene))


def _crown(geometry: TireGeometry, grid: FieldSettings) -> NDArray[numpy.float64]:
    """Gap of the tire over a flat road in [m], on the cells of a grid."""
    x = (numpy.arange(grid.rows) - grid.rows // 2) * grid.cell_x
    y = (numpy.arange(grid.cols) - 0.5 * (grid.cols - 1)) * grid.cell_y
    return 0.5 * x[:, None] ** 2 / geometry.radius_rolling + 0.5 * y[None, :] ** 2 / geometry.radius_lateral


def relaxed_grids(grids: FieldGrids, tread: Tread) -> FieldGrids:
    """The same grids for a tread that has stood for long."""
    settings = grids.usual.settings._replace(modulus=tread.relaxed_modulus)
    return make_grids(settings, grids.usual.contact)
