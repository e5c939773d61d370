"""Sections of the laws that several contacts share -> parameters of the kernels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws import parameters
from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.laws.foam_columns import columns_of
from contact_sim_pkg.laws.general_dissipative import SMOOTHING
from contact_sim_pkg.laws.parameters import (
    ElasticLaw,
    GeneralDissipative,
    NormalDissipation,
    NormalDissipative,
    NormalElastic,
    TabulatedElastic,
)
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.laws.restitution_law import NEVER_PULLS, PULLS, coefficient_of_restitution
from contact_sim_pkg.pressure.cushion import REACH, valid_strain
from contact_sim_pkg.pressure.cushion.foam_layer import CushionError, FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.force_table import (
    BELOW,
    SPARSE,
    ForceTable,
    kept_table,
    make_table,
    smoothed,
    without_maps,
)
from contact_sim_pkg.pressure.cushion.tissue import PlateUnderTissue, Tissue, TissueOnFoam
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.run.compilation import note_computation
from contact_sim_pkg.run.tables_between import table_between
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.foam_points import elastic_of
from contact_sim_pkg.scene.schema.laws import (
    STIFFEST,
    THICKEST,
    CushionSection,
    Foam,
    FoamHysteresisSection,
    FrictionSection,
    GeneralDissipation,
    HuntCrossley,
    PowerLaw,
)

__all__ = [
    "Cushion",
    "PressingBody",
    "build_cushion",
    "elastic_law",
    "foam_of",
    "formula_foam",
    "friction",
    "hysteresis",
    "layer_under",
    "normal_loss",
]

Field = NDArray[numpy.float64]
HARDNESS_STRAIN = 0.4
MOST_SPACING, LEAST_NODES = 5e-4, 160  # [m] between the approaches of a table, nodes over the thickness
TISSUE_NODES = 20  # over the depth of tissue


def elastic_law(scene: ResolvedScene, contact: str) -> ElasticLaw:
    """Elastic law of a contact without pressure field: its foam where the scene names one, its
    power law otherwise.
    """
    foam, power = scene.effect(contact, Foam), given(scene.effect(contact, PowerLaw))
    if foam is None:
        return NormalElastic(power.coefficient, power.exponent)
    return parameters.FoamElastic(
        foam.area, foam.thickness, foam.modulus, foam.plateau, foam.densification, foam.densification_exponent
    )


def normal_loss(scene: ResolvedScene, contact: str, elastic: ElasticLaw, mass: float) -> NormalDissipation | None:
    """Loss of a contact, from its damping or its restitution; None where the scene calls for none.

    ``mass`` [kg] is what a free impact with the requested restitution moves. Raises SceneError
    where the law does not reach it.
    """
    general, loss = scene.effect(contact, GeneralDissipation), scene.effect(contact, HuntCrossley)
    if general is not None:
        return _general_loss(general, contact, elastic, mass)
    if loss is None:
        return None
    if loss.restitution is not None:
        return NormalDissipative(damping_of_restitution(loss.restitution, given(loss.reference_speed)))
    return NormalDissipative(given(loss.damping))


def _general_loss(loss: GeneralDissipation, contact: str, elastic: ElasticLaw, mass: float) -> GeneralDissipative:
    p, q = loss.approach_exponent, loss.rate_exponent
    lowest = NEVER_PULLS if loss.end == "force" else PULLS
    smoothing = SMOOTHING * given(loss.reference_speed) if q < 1.0 else 0.0
    if loss.restitution is None:
        return GeneralDissipative(given(loss.coefficient), p, q, smoothing, lowest)
    assert isinstance(elastic, NormalElastic)
    try:
        coefficient = coefficient_of_restitution(
            loss.restitution, given(loss.reference_speed), mass, elastic, p, q, lowest
        )
    except ValueError as reason:
        where = f"effects.{contact}.general_dissipative.restitution"
        raise SceneError([Fault("scene", 0, 0, where, str(reason))]) from None
    return GeneralDissipative(coefficient, p, q, smoothing, lowest)


def friction(scene: ResolvedScene, contact: str) -> parameters.Friction | None:
    """Friction of a contact; None where the scene calls for none."""
    law = scene.effect(contact, FrictionSection)
    if law is None:
        return None
    return parameters.Friction(law.stiffness, law.damping, law.coefficient_static, law.coefficient_kinetic)


def hysteresis(scene: ResolvedScene, contact: str, offset: int) -> parameters.FoamHysteresis | None:
    """Hysteresis of a contact, its internal variable at ``offset`` of the state; None where the
    scene calls for none.
    """
    law = scene.effect(contact, FoamHysteresisSection)
    return None if law is None else parameters.FoamHysteresis(offset, given(law.share), given(law.energy))


class Cushion(NamedTuple):
    """A cushion under one body."""

    table: ForceTable
    law: TabulatedElastic
    cells: tuple[float, float, float, float]  # [m] sizes of a cell along x and y, centre of cell (0, 0)

    def pressure(self, approach: float, force: float) -> Field:
        """Map [Pa] [rows, cols] at ``approach`` [m] that adds up to ``force`` [N]."""
        return self.table.map_at(approach, force)


class PressingBody(NamedTuple):
    """A body over the cells of a cushion."""

    x: Vector  # [rows] [m] centres of the cells
    y: Vector  # [cols] [m]
    sizes: tuple[Any, ...]  # everything that the gap follows from
    gap: Callable[[Vector, Vector], Field]  # x, y -> [rows, cols] [m] over the cells
    tissue: Tissue | None = None  # of the body, whose gap then is that without load
    on_plate: bool = False  # a rigid plate carries the body, not foam; it has tissue


def foam_of(keys: CushionSection) -> parameters.LayerFoam:
    """Foam of a cushion: its measured curve, or that of the formula."""
    if keys.curve is None:
        return formula_foam(keys)
    return parameters.FoamCurve(keys.thickness, *elastic_of(given(keys.curve.points)))


def formula_foam(keys: CushionSection) -> parameters.FoamElastic:
    """Foam of a cushion by the formula, its area 1 m^2; a hardness scales its stresses."""
    foam = parameters.FoamElastic(
        1.0, keys.thickness, keys.modulus, keys.plateau, keys.densification, keys.densification_exponent
    )
    if keys.hardness is None:
        return foam
    ratio = keys.hardness / elastic_force(foam, HARDNESS_STRAIN * keys.thickness)
    return foam._replace(
        modulus=ratio * foam.modulus, plateau=ratio * foam.plateau, densification=ratio * foam.densification
    )


def layer_under(keys: CushionSection, body: PressingBody, below: int = 1) -> FoamLayer | PlateUnderTissue:
    """Foam layer of a cushion, or the plate in its place, under a body, each cell of the map cut into ``below`` along
    either side.
    """
    side = given(keys.cell) / below
    parts = side * (numpy.arange(below) - 0.5 * (below - 1))
    x, y = ((centres[:, None] + parts).ravel() for centres in (body.x, body.y))
    grid, gap, inextensible = FoamGrid(len(x), len(y), side, side), body.gap(x, y), keys.cover == "inextensible"
    if body.tissue is None:
        return FoamLayer(grid, foam_of(keys), gap, keys.shear_share, inextensible=inextensible)
    if body.on_plate:
        return PlateUnderTissue(grid, gap, body.tissue)
    return TissueOnFoam(grid, foam_of(keys), gap, body.tissue, keys.shear_share, inextensible=inextensible)


def build_cushion(contact: str, keys: CushionSection, load: float, body: PressingBody) -> Cushion:
    """Table of the cushion of a contact, kept from an earlier run or computed.

    load: [N] at rest. Raises SceneError where the cushion does not carry it within its range, or its
    hardness scales the modulus beyond STIFFEST.
    """
    _refuse_modulus(contact, keys)

    def make(keys: CushionSection, *, is_alone: bool) -> ForceTable:
        return _table_of(contact, keys, body, has_maps=is_alone or body.tissue is not None)

    table = table_between(contact, keys, repr(body.sizes), make)
    _refuse_load(contact, keys, table, load)
    cell = given(keys.cell)
    return Cushion(table, table.law(), (cell, cell, float(body.x[0]), float(body.y[0])))


def _table_of(contact: str, keys: CushionSection, body: PressingBody, *, has_maps: bool) -> ForceTable:
    """Kept from an earlier run or computed. Raises SceneError where the cells or the foam have no room for three nodes."""
    spacing = min(MOST_SPACING, keys.thickness / LEAST_NODES)
    if body.tissue is not None:
        spacing = min(spacing, body.tissue.depth / TISSUE_NODES)
    place, cell = (float(body.x[0]), float(body.y[0])), given(keys.cell)
    grid = len(body.x), len(body.y), cell, place
    description = repr((foam_of(keys), grid, keys.shear_share, keys.cover, spacing, REACH, body.sizes))
    if body.tissue is not None:
        description += repr((body.tissue, body.on_plate))
    if not has_maps:
        description += " without maps"

    def compute() -> ForceTable:
        def note(part: float) -> None:
            note_computation(f"computing the force table of the {contact}'s cushion, once: {100.0 * part:.0f} %")

        try:
            if body.tissue is not None:  # whose pressure rises from nothing: a cell that enters bends no force
                return make_table(layer_under(keys, body), spacing, on_progress=note)
            if not has_maps:
                below = layer_under(keys, body, BELOW)
                return without_maps(make_table(below, SPARSE * spacing, on_progress=note), spacing)
            maps = make_table(layer_under(keys, body), spacing, on_progress=lambda part: note(0.5 * part))
            below = layer_under(keys, body, BELOW)
            return smoothed(maps, make_table(below, SPARSE * spacing, on_progress=lambda part: note(0.5 + 0.5 * part)))
        except CushionError as error:
            raise SceneError([Fault("scene", 0, 0, f"effects.{contact}.cushion", str(error))]) from None
        finally:
            note_computation("")

    return kept_table(description, compute)


def _refuse_modulus(contact: str, keys: CushionSection) -> None:
    """A modulus that the hardness has scaled beyond its range, or that the curve begins with."""
    foam = foam_of(keys)
    modulus = foam.modulus if isinstance(foam, parameters.FoamElastic) else columns_of(foam).first_modulus
    if modulus > STIFFEST:
        key, begins = (
            ("hardness", "scales the modulus to") if keys.curve is None else ("curve", "begins with a modulus of")
        )
        sentence = f"{begins} {modulus:.4g} Pa, {STIFFEST:g} Pa at most is allowed; take a softer cushion"
        raise SceneError([Fault("scene", 0, 0, f"effects.{contact}.cushion.{key}", sentence)])


def _refuse_load(contact: str, keys: CushionSection, table: ForceTable, load: float) -> None:
    """A load at rest beyond the range of the foam's law, or of the cells."""
    valid = valid_strain(None if keys.curve is None else keys.curve.points)
    most = table.most_force(valid)
    if load <= most:
        return
    if not table.largest_strain.any():
        reason = f"the plate carries {most:.4g} N at most by the tissue, the load at rest is {load:.4g} N; take a lighter body"
        raise SceneError([Fault("scene", 0, 0, f"effects.{contact}.cushion", reason)])
    if table.largest_strain.max() > valid:
        end = "" if keys.curve is None else ", where its curve ends"
        reason, thicker = f"its strain reaches {valid:.4g}{end}", keys.thickness < THICKEST
    else:
        reason, thicker = "under more the contact reaches its edge", False
    cure = f"a harder cushion, one thicker than {keys.thickness:g} m," if thicker else "a harder cushion"
    sentence = (
        f"carries {most:.4g} N at most, the load at rest is {load:.4g} N: {reason}; take {cure} or a lighter body"
    )
    raise SceneError([Fault("scene", 0, 0, f"effects.{contact}.cushion", sentence)])
