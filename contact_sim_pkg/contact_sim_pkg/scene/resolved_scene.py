"""A scene with nothing left open, as it goes to the nodes and into the bag. Knows no schema."""

from __future__ import annotations

import copy
import hashlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from io import StringIO
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeVar

from ruamel.yaml import YAML

from contact_sim_pkg.files import open_regular_file
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import contacts, rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.errors import Fault, SceneError

if TYPE_CHECKING:
    from contact_sim_pkg.excitation.kinds import RoadKind, VibrationKind
    from contact_sim_pkg.records.fields import Section
    from contact_sim_pkg.scene.schema.general import Integrator, Outputs
    from contact_sim_pkg.scene.schema.travel import Slip, TravelSection

Kind = TypeVar("Kind", bound="Section")


MAY_BE_LEFT_OUT = frozenset({
    "angle", "at_least", "at_most", "belt_width", "cols", "control", "corrector_passes", "coupling_length",
    "coupling_tolerance", "deflection", "load", "longitudinal", "mount", "points", "programme", "radius",
    "relative_tolerance", "rows", "sidewall_chord", "slide_damping", "speed", "tolerance",
})  # fmt: skip
"""Keys without a value of their own in sections outside the effects, of a tire and its mount, a pressure field and an inflated
tire.
"""


class _Plain(SimpleNamespace):
    """Keys of a section as attributes; one that may be left out is None where it is."""

    def __getattr__(self, name: str) -> Any:
        if name not in MAY_BE_LEFT_OUT:
            raise AttributeError(f"the section has no key {name!r}, and none that may be left out has this name")
        return None


def plain(data: Mapping[str, Any] | None) -> Any:
    """Plain data of a section with its keys as attributes, None where they are left out.

    It stands for a section of the schema where a node starts without the schema; the data were
    checked before.
    """
    if data is None:
        return None
    return _Plain(**{key: plain(value) if isinstance(value, dict) else value for key, value in data.items()})


@dataclass(frozen=True)
class ResolvedScene:
    """A scene with nothing left open.

    Attributes:
        data: plain dict of dicts, lists, texts and numbers, in the keys of the scene schema.
        files: where each input file was found, by the dotted path of its key; not part of the data
            and not compared.
    """

    data: dict[str, Any]
    files: Mapping[str, Path] = field(default_factory=dict, compare=False)

    @property
    def name(self) -> str:
        """Name of the scene and of its bags."""
        return str(self.data["name"])

    @property
    def rig(self) -> str:
        """Name of the rig."""
        return str(self.data["rig"])

    @property
    def duration(self) -> float:
        """Simulated time in [s]."""
        return float(self.data["duration"])

    @property
    def block_length(self) -> float:
        """Simulated time in [s] of a block."""
        return float(self.data["block_length"])

    @property
    def block_length_ns(self) -> int:
        """Simulated time in [ns] of a block."""
        return round(self.block_length * 1e9)

    @property
    def blocks(self) -> int:
        """Number of blocks of the whole run."""
        return round(self.duration / self.block_length)

    @property
    def accuracy(self) -> float | str:
        """Requested relative error, or `realtime`."""
        accuracy: float | str = self.data["accuracy"]
        return accuracy

    @property
    def seed(self) -> int:
        """Seed of all random numbers."""
        return int(self.data["seed"])

    @property
    def outputs(self) -> Outputs:
        """Rates of the outputs."""
        outputs: Outputs = plain(self.data["outputs"])
        return outputs

    @property
    def integrator(self) -> Integrator:
        """Tolerances of the time integration."""
        integrator: Integrator = plain(self.data["integrator"])
        return integrator

    @property
    def travel(self) -> TravelSection | None:
        """Speed programme."""
        travel: TravelSection | None = plain(self.data.get("travel"))
        return travel

    @property
    def slip(self) -> Slip | None:
        """Slip programme of a tire."""
        slip: Slip | None = plain(self.data.get("slip"))
        return slip

    @property
    def road(self) -> RoadKind | None:
        """Road under the rig."""
        from contact_sim_pkg.excitation.kinds import kind_of

        road: RoadKind | None = kind_of("road", self.data.get("road"))
        return road

    @property
    def vibration(self) -> VibrationKind | None:
        """Vibration of the floor."""
        from contact_sim_pkg.excitation.kinds import kind_of

        vibration: VibrationKind | None = kind_of("vibration", self.data.get("vibration"))
        return vibration

    def section(self, kind: type[Kind]) -> Kind:
        """The section of a contact of the rig by its class. Raises KeyError where the rig has
        none.
        """
        for contact in rigs()[self.rig].contacts:
            if load(contact.section) is kind:
                return kind.model_validate(self.data[contact.name])
        raise KeyError(f"the rig {self.rig} has no section {kind.__name__}")

    def effect(self, contact: str, kind: type[Kind]) -> Kind | None:
        """The effect of a contact by the class of its keys, or one below it; None where the scene
        calls for none.
        """
        return next((keys for _record, keys in self.effects_at(contact) if isinstance(keys, kind)), None)

    def effects_at(self, contact: str) -> Iterator[tuple[Effect, Section]]:
        """Effects that the scene calls for at a contact with their keys, in the order of the
        records.
        """
        named = self.data["effects"].get(contact) or {}
        for record in contacts()[contact].effects:
            if named.get(record.name) is not None:
                yield record, load(record.section).model_validate(named[record.name])

    def without(self, *effects: Effect) -> ResolvedScene:
        """The scene less some effects, those that need them, and the inputs that no other effect
        names.
        """
        data = copy.deepcopy(self.data)
        gone: list[Effect] = []
        for contact in rigs()[self.rig].contacts:
            left_out = [record for record in contact.effects if record in effects]
            while left_out:
                record = left_out.pop()
                (data["effects"].get(contact.name) or {}).pop(record.name, None)
                gone.append(record)
                left_out += [other for other in contact.effects if record.name in other.needs]
        drop_inputs(data, gone)
        return ResolvedScene(data, self.files)

    def to_yaml(self) -> str:
        """The data as YAML 1.2; `resolve.read_resolved` reads the same data from it, to the bit."""
        writer = YAML(typ="safe", pure=True)
        writer.default_flow_style = False
        writer.sort_base_mapping_type_on_output = False  # type: ignore[assignment]
        writer.allow_unicode = True
        writer.width = 120
        stream = StringIO()
        writer.dump(self.data, stream)
        return stream.getvalue()

    def _repr_html_(self) -> str:
        effects = [f"{at}.{name}" for at, named in self.data["effects"].items() for name in named or {} if named[name]]
        said = f"{self.name}: rig {self.rig}, {self.duration:g} s, accuracy {self.accuracy}, effects {', '.join(effects) or 'none'}"
        return (
            f"<p>{escape(said)}</p><details><summary>every key</summary><pre>{escape(self.to_yaml())}</pre></details>"
        )

    @classmethod
    def from_own_yaml(cls, text: str, files: Mapping[str, str | Path]) -> ResolvedScene:
        """Read what `to_yaml` wrote in this very run, without checking it again: a node starts
        without the schema.
        """
        return cls(YAML(typ="safe", pure=True).load(text), {where: Path(path) for where, path in files.items()})

    def file_path(self, where: str) -> Path:
        """The input file of a key (`road.file`, `vibration.file`), its content checked against the
        checksum.

        Raises:
            SceneError: not found, or its content differs from the one that the scene was resolved
                with.
        """
        section = where.split(".")[0]
        name, stated = self.data[section]["file"], self.data[section]["sha256"]
        path = self.files.get(where)
        if path is None or not path.is_file():
            raise SceneError([Fault("resolved scene", 0, 0, where, f"the file {name!r} is not there; give its path")])
        found = sha256_of(path)
        if found != stated:
            sentence = f"{path} has another content than the scene was resolved with: sha256 {found}, stated {stated}"
            raise SceneError([Fault("resolved scene", 0, 0, where, sentence)])
        return path


def drop_inputs(data: dict[str, Any], gone: Iterable[Effect]) -> None:
    """Take out of plain data of a scene the inputs of effects that are ``gone`` from it, but for those that
    an effect names which the scene still has.
    """
    stay = {
        where
        for contact in rigs()[data["rig"]].contacts
        for effect in contact.effects
        if (data["effects"].get(contact.name) or {}).get(effect.name) is not None
        for where in effect.inputs
    }
    for where in {where for effect in gone for where in effect.inputs} - stay:
        *sections, key = where.split(".")
        found = data
        for section in sections:
            found = found.get(section) or {}
        found.pop(key, None)


def leaves_of(data: Mapping[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Path and value of each key of a scene's plain data that is no section, or an empty one."""
    for key, value in data.items():
        if isinstance(value, dict) and value:
            yield from leaves_of(value, (*above, str(key)))
        else:
            yield (*above, str(key)), value


def sha256_of(path: Path) -> str:
    """Checksum of the content, as 64 hexadecimal digits."""
    digest = hashlib.sha256()
    with open_regular_file(path) as stream:
        while chunk := stream.read(1 << 20):
            digest.update(chunk)
    return digest.hexdigest()
