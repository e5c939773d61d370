"""The scene: every key with its type, unit, range, default and meaning.

The sections and effects of the contacts come from the records of the rigs; this module knows none
by name. `docs/scenes.md` is made from here.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeAlias, TypeVar

from pydantic import Field, PrivateAttr, create_model

from contact_sim_pkg.excitation.kinds import RoadKind, VibrationKind
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.fields import Section, choice, number, text
from contact_sim_pkg.records.registry import contacts, kinds, rig_names, rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.schema.general import Expect, Integrator, Limits, Outputs
from contact_sim_pkg.scene.schema.travel import Slip, TravelSection

if TYPE_CHECKING:
    RigName: TypeAlias = str
    Road: TypeAlias = RoadKind
    Vibration: TypeAlias = VibrationKind
else:
    RigName = Literal[rig_names()]
    Road, Vibration = (
        Annotated[reduce(or_, map(load, kinds(section).values())), Field(discriminator="kind")]
        for section in ("road", "vibration")
    )

Kind = TypeVar("Kind", bound=Section)
Accuracy: TypeAlias = Annotated[float, Field(ge=1e-8, le=0.1)] | Literal["realtime"]
Pace: TypeAlias = Annotated[float, Field(ge=0.001, le=1000.0)] | Literal["realtime", "max"]


class _Scene(Section):
    """Keys of every scene up to the excitation, and what a scene answers."""

    fixed: ClassVar[str] = "it is of the whole run"

    name: str = text(
        "name of the scene and of its bags; the name of the file by default",
        pattern=r"^[A-Za-z0-9_][A-Za-z0-9._-]*$",
        longest=100,
        example="scene",
    )
    description: str = text("one line of description", default="")
    rig: RigName = choice(
        "{}, or {}".format(", ".join(each.help for each in [*rigs().values()][:-1]), [*rigs().values()][-1].help),
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
        "bound of the largest numerical error over the run: forces over the largest force of their contact, motion, peak"
        " pressure and contact area over their largest; a number from 1e-8 to 0.1, or realtime",
        default=0.01,
    )
    plugins: str | None = text(
        "packages of others that the scene uses, as NAME VERSION, separated by commas; written where a scene is resolved",
        default=None,
    )
    travel: TravelSection | None = choice("speed programme (rigs tire and car)", default=None, example={"speed": 10.0})
    road: Road | None = choice(
        "road under the tire (rigs tire and car), or added to the track of the roller (roller)",
        default=None,
        example={"kind": "flat"},
    )
    slip: Slip | None = choice(
        "slip programme of the tire, for the effects brush and magic_formula (rigs tire and car)", default=None
    )
    vibration: Vibration | None = choice(
        "acceleration of the floor (rig seat), of the seat back (backrest), or added to the floor of the car (car)",
        default=None,
    )

    _file: str = PrivateAttr(default="scene")

    @property
    def file(self) -> str:
        """Path of the file that the scene was read from; its folder is where relative file names
        start.
        """
        return self._file

    def section(self, kind: type[Kind]) -> Kind:
        """The section of a contact by its class; its defaults where the scene does not give it."""
        found = (getattr(self, contact.name) for contact in rigs()[self.rig].contacts)
        return next((each for each in found if isinstance(each, kind)), None) or kind()

    def effect(self, contact: str, kind: type[Kind]) -> Kind | None:
        """The effect of a contact by the class of its keys; None where the scene does not call for
        it.
        """
        named = getattr(self.effects, contact)  # type: ignore[attr-defined]
        return next((each for _name, each in named or () if isinstance(each, kind)), None)

    def effects_at(self, contact: Contact) -> Iterator[tuple[str, Section]]:
        """Effects that the scene calls for at a contact, by name, in the order of the records."""
        named = getattr(self.effects, contact.name)  # type: ignore[attr-defined]
        return ((name, each) for name, each in named or () if each is not None)


def _effects_of(contact: Contact) -> type[Section]:
    keys = {effect.name: (load(effect.section) | None, choice(effect.help, default=None)) for effect in contact.effects}
    made: type[Section] = create_model(f"{contact.name.title()}Effects", __base__=Section, **keys)  # type: ignore[call-overload]
    made.__doc__ = f"Effects of the {contact.help}."
    return made


def _scene_of(known: dict[str, Contact]) -> type[_Scene]:
    sections = {
        name: (load(contact.section) | None, choice(contact.section_help, default=None))
        for name, contact in known.items()
    }
    effects: Any = create_model(
        "Effects",
        __base__=Section,
        **{name: (_effects_of(contact) | None, choice(contact.help, default=None)) for name, contact in known.items()},
    )  # type: ignore[call-overload]
    made: type[_Scene] = create_model(
        "Scene",
        __base__=_Scene,
        **sections,
        effects=(effects, choice("contact → effect → its parameters", example={"seat": {"normal_elastic": {}}})),
        expect=(Expect | None, choice("what the scene is there to show, measured at the end of a run", default=None)),
        outputs=(Outputs, Field(default_factory=Outputs, description="rates of the outputs")),
        integrator=(Integrator, Field(default_factory=Integrator, description="tolerance of the time integration")),
        limits=(Limits, Field(default_factory=Limits, description="limits of memory")),
    )  # type: ignore[call-overload]
    made.__doc__ = "One scene: rig, excitation, effects, accuracy, outputs. Made by `load_scene`; valid as it stands."
    return made


if TYPE_CHECKING:

    class Scene(_Scene):
        """Keys that stand behind those of the contacts, as `_scene_of` adds them."""

        effects: Section
        expect: Expect | None
        outputs: Outputs
        integrator: Integrator
        limits: Limits
else:
    Scene = _scene_of(contacts())
