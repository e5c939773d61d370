"""The scene: every key with its type, unit, range, default and meaning.

Rules that tie several keys together are in `scene/schema/rules.py` and `scene/schema/effect_rules.py`; `docs/scenes.md` is made
from here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

from pydantic import Field, PrivateAttr

from contact_sim_pkg.records.registry import rig_names
from contact_sim_pkg.rigs.backrest.schema import Backrest
from contact_sim_pkg.rigs.body.schema import Block
from contact_sim_pkg.rigs.impact.schema import Impact
from contact_sim_pkg.rigs.roller.schema import RollerRig
from contact_sim_pkg.rigs.vehicle.schema import Seat, Tire
from contact_sim_pkg.scene.schema.effects import Effects
from contact_sim_pkg.scene.schema.fields import Section, choice, number, text
from contact_sim_pkg.scene.schema.road import Road, Slip, Travel
from contact_sim_pkg.scene.schema.vibration import Vibration

if TYPE_CHECKING:
    RigName: TypeAlias = str
else:
    RigName = Literal[rig_names()]

Accuracy: TypeAlias = Annotated[float, Field(ge=1e-8, le=0.1)] | Literal["realtime"]
Pace: TypeAlias = Annotated[float, Field(ge=0.001, le=1000.0)] | Literal["realtime", "max"]


class Outputs(Section):
    """How often each kind of output is written; each rate gives a whole number of samples a block."""

    force_rate: float = number(1.0, 1e6, "Hz", "forces and motions, one message a block", default=1000.0)
    display_rate: float = number(1.0, 1e4, "Hz", "wrenches and scalars for plotters", default=100.0)
    field_rate: float = number(1.0, 1e4, "Hz", "pressure fields", default=100.0)


class Integrator(Section):
    """Time integration."""

    relative_tolerance: float | None = number(
        1e-13, 1e-2, "", "local error of a step relative to the state; taken from accuracy when absent", default=None
    )
    coupling_tolerance: float | None = number(
        1e-8,
        1.0,
        "",
        "error of a contact force between two solutions of its pressure field, relative to the standing load: it sets how often"
        " the fields are solved; less than the field's own tolerance counts as that; taken from accuracy when absent",
        default=None,
    )


class Limits(Section):
    """Caps that a scene may raise for itself."""

    memory: float = number(
        0.001, 1024.0, "GiB", "most memory that grids, roads and signals may need together", default=1.0
    )


class Scene(Section):
    """One scene: rig, excitation, effects, accuracy, outputs. Made by `load_scene`; valid as it stands."""

    name: str = text(
        "name of the scene and of its bags; the name of the file by default",
        pattern=r"^[A-Za-z0-9_][A-Za-z0-9._-]*$",
        longest=100,
        example="scene",
    )
    description: str = text("one line of description", default="")
    rig: RigName = choice(
        "tire on a road, occupant on a seat, both as a car, occupant against a backrest, on a seat and against its back, "
        "sphere that strikes a sample, rigid body on the ground, or roller on a shaft",
        example="seat",
    )
    duration: float = number(0.0, 3600.0, "s", "simulated time, a whole number of blocks", above=True, example=1.0)
    seed: int = number(0, 2**53 - 1, "", "seed of all random numbers; the same seed gives the same bits", default=1)
    pace: Pace = choice(
        "rate of the blocks: real time, a factor of it, or as fast as possible; acts on nodes",
        default="realtime",
    )
    block_length: float = number(
        0.001, 0.1, "s", "simulated time of a block, a whole number of nanoseconds", default=0.01
    )
    accuracy: Accuracy = choice(
        "requested relative error of forces and pressures, or the best in real time", default=0.01
    )
    travel: Travel | None = choice("speed programme (rigs tire and car)", default=None, example={"speed": 10.0})
    road: Road | None = choice(
        "road under the tire (rigs tire and car), or added to the track of the roller (roller)",
        default=None,
        example={"kind": "flat"},
    )
    slip: Slip | None = choice("slip programme of the tire, for the effect brush (rigs tire and car)", default=None)
    vibration: Vibration | None = choice(
        "acceleration of the floor (rig seat), of the seat back (backrest), or added to the floor of the car (car)",
        default=None,
    )
    tire: Tire | None = choice("quarter car and tire (rigs tire and car); defaults where absent", default=None)
    seat: Seat | None = choice("occupant and cushion (rigs seat and car); defaults where absent", default=None)
    backrest: Backrest | None = choice(
        "occupant against a seat back (rig backrest); defaults where absent", default=None
    )
    impact: Impact | None = choice("impact of a sphere on a sample (rig impact); defaults where absent", default=None)
    block: Block | None = choice("rigid body over the ground (rig block); defaults where absent", default=None)
    roller: RollerRig | None = choice("roller on a rotating shaft (rig roller); defaults where absent", default=None)
    effects: Effects = choice("contact → effect → its parameters", example={"seat": {"normal_elastic": {}}})
    outputs: Outputs = Field(default_factory=Outputs, description="rates of the outputs")
    integrator: Integrator = Field(default_factory=Integrator, description="tolerance of the time integration")
    limits: Limits = Field(default_factory=Limits, description="limits of memory")

    _file: str = PrivateAttr(default="scene")

    @property
    def file(self) -> str:
        """Path of the file that the scene was read from; its folder is where relative file names start."""
        return self._file
