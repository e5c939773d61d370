"""The tire of a scene, alone: its effects as they are given, put on a test machine under the conditions of a case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.procedure import ProcedureError
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, body_of
from contact_sim_pkg.rigs.vehicle.tire.force_table import TireTable, tire_table
from contact_sim_pkg.rigs.vehicle.tire.lattice import plain_load
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import scene_tire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation, TireSection
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.scene import Scene

__all__ = [
    "USUAL",
    "Specimen",
    "body_at",
    "refuse_beyond_law",
    "scene_on",
    "specimen_of",
    "specimen_of_file",
    "table_at",
]

WHEEL = 40.0  # [kg]
ACCURACY = 1e-2
OWN = ("inflation", "brush", "sidewall_compliance", "rigid_ring", "normal_dissipative", "wheel_spin", "tread_viscoelasticity",
       "rolling_loss")  # fmt: skip
"""Effects that are properties of the tire; its field, and what the road does to it, are those of the machine."""

Effects = dict[str, dict[str, Any]]


class Specimen(NamedTuple):
    """A tire as a scene gives it."""

    effects: Effects  # given keys alone
    load: float  # [N] standing in its scene
    inflation: float  # [Pa]
    suspension: dict[str, float]  # masses [kg] of wheel and body, stiffness [N/m] between them


USUAL = Specimen(
    {"inflation": {}}, 4000.0, Inflation().pressure,
    {"wheel_mass": WHEEL, "body_mass": 300.0, "suspension_stiffness": 20e3},
)  # fmt: skip
"""For lists of the procedures."""


def specimen_of(scene: Scene) -> Specimen:
    """The inflated tire of a scene. Raises ProcedureError for a scene without one."""
    given = scene.model_dump(exclude_none=True)
    effects = (given.get("effects") or {}).get("tire")
    inflation = scene.effect("tire", Inflation) if effects else None
    if not effects:
        raise ProcedureError(
            f"{scene.file}: a scene of the rig {scene.rig}, which has no tire; name one of rig tire or car"
        )
    if inflation is None:
        raise ProcedureError(
            f"{scene.file}: its tire is a half-space; the test machines take an inflated one, effects.tire.inflation: {{}}"
        )
    own = {name: keys for name, keys in effects.items() if name in OWN}
    car = scene.section(TireSection)
    return Specimen(
        own, plain_load(resolve(scene).data), inflation.pressure,
        {"wheel_mass": car.wheel_mass, "body_mass": car.body_mass, "suspension_stiffness": car.suspension_stiffness},
    )  # fmt: skip


def specimen_of_file(tire: PropertyFile) -> Specimen:
    """The tire that is fitted to a property file, under its nominal load.

    Raises ProcedureError where no tire of the bench is near enough; PropertyFileError as `scene_tire`.
    """
    found = scene_tire(tire)
    if not found.usable:
        raise ProcedureError(
            f"{tire.file}: no tire of the bench is near enough to it; bench tire {Path(tire.file).name} says by how much"
        )
    load = tire.get("FNOMIN") or USUAL.load
    own = {name: keys for name, keys in found.effects.items() if name in OWN}
    return Specimen(own, load, float(found.effects["inflation"]["pressure"]), USUAL.suspension)


def scene_on(
    effects: Effects,
    conditions: Mapping[str, float],
    needs: Sequence[str],
    mount: dict[str, Any] | None = None,
    **parts: Any,
) -> ResolvedScene:
    """The tire under the `load` [N] and at the `inflation` [Pa] of the conditions, with the effects that a machine
    ``needs``, each with the tire's keys, else the usual ones; on a ``mount`` (None: the quarter car), ``parts`` of the
    scene.
    """
    own = {**effects, "inflation": {**effects["inflation"], "pressure": conditions["inflation"]}}
    body = conditions["load"] / GRAVITY - WHEEL
    data = {
        "name": "tire_test", "rig": "tire", "duration": 1.0, "accuracy": ACCURACY, "road": {"kind": "flat"},
        "travel": {"speed": conditions.get("speed", 0.0)},
        "tire": {"wheel_mass": WHEEL, "body_mass": body, **({} if mount is None else {"mount": mount})},
        "effects": {"tire": {name: own.get(name, {}) for name in needs}}, **parts,
    }  # fmt: skip
    return resolve(Scene.model_validate(data))


def body_at(effects: Effects, inflation: float, drum_diameter: float = 0.0) -> TireBody:
    """The tire at an ``inflation`` [Pa] on a drum of a diameter [m], 0: on level ground."""
    mount = {"kind": "drum", "radius": 0.5 * drum_diameter} if drum_diameter > 0.0 else None
    return body_of(scene_on(effects, {"inflation": inflation, "load": 4000.0}, ("inflation",), mount))


def table_at(effects: Effects, conditions: Mapping[str, float]) -> TireTable:
    """Its force table under the conditions."""
    return tire_table(body_at(effects, conditions["inflation"], conditions.get("drum_diameter", 0.0)))


def refuse_beyond_law(effects: Effects, conditions: Mapping[str, float]) -> None:
    """Raise ProcedureError where the force table ends below the load."""
    most = float(table_at(effects, conditions).force[-1])
    if conditions["load"] > most:
        raise ProcedureError(
            f"load {conditions['load']:g} N is beyond the law, which ends at {most:.0f} N with an inflation of "
            f"{conditions['inflation']:g} Pa; --at load=... or more inflation"
        )
