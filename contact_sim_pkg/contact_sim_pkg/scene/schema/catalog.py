"""Every key of the scene schema as a flat table: for fault sentences, suggestions and
`docs/scenes.md`.
"""

from __future__ import annotations

import math
import types
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from contact_sim_pkg.records.breach import show
from contact_sim_pkg.scene.schema.scene import Scene

__all__ = [
    "Entry", "Location", "catalog", "entry_of", "key_of_word", "place_of", "show", "show_below", "without_kinds",
]  # fmt: skip

Kind = Literal["number", "integer", "choice", "flag", "text", "list", "section", "kinds"]
Location = tuple[str, ...]
SHOWN_PLACES = 3  # of a key that stands elsewhere


@dataclass(frozen=True)
class Entry:
    """One key of the schema.

    Attributes:
        location: keys from the root; below a section that has kinds, the kind stands in between.
        kind: "kinds" is a section whose keys depend on its key `kind`.
        low, high: bounds of a number; `above` if low itself is not allowed.
        words: allowed words of a choice, or beside a number; the names of the kinds.
        keys: keys of a section.
        live: what it acts on where it may change between two blocks of a run; empty: it holds for the whole run.
        fixed: why it does, where its section or it says so.
    """

    location: Location
    kind: Kind
    unit: str
    help: str
    required: bool
    default: Any
    example: Any
    low: float | None = None
    high: float | None = None
    above: bool = False
    words: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()
    allowed_text: str = ""
    live: str = ""
    fixed: str = ""

    @property
    def allowed(self) -> str:
        """What the key may hold, in words; empty for sections and free text."""
        if self.allowed_text:
            return self.allowed_text
        words = ", ".join(self.words)
        if self.kind in ("number", "integer"):
            span = f"{'above ' if self.above else ''}{show(self.low)} to {show(self.high)} {self.unit}".rstrip()
            return f"{span} or {' or '.join(self.words)}" if words else span
        return "true, false" if self.kind == "flag" else words


def show_below(value: float, digits: int) -> str:
    """A number above 0, rounded towards 0: what is suggested below a bound lies below it."""
    step = 10.0 ** (math.floor(math.log10(value)) - digits + 1)
    return f"{math.floor(value / step * (1.0 - 1e-12)) * step:.{digits}g}"


@cache
def catalog() -> dict[Location, Entry]:
    """Every key of a scene, in the order of the schema."""
    return {entry.location: entry for entry in _entries(Scene, ())}


def entry_of(location: tuple[str | int, ...]) -> Entry | None:
    """The key that a pydantic error location lies in; items of lists and members of unions belong
    to their key.
    """
    table, names = catalog(), tuple(part for part in location if isinstance(part, str))
    for length in range(len(names), 0, -1):
        if names[:length] in table:
            return table[names[:length]]
    return None


def without_kinds(location: tuple[str | int, ...]) -> tuple[str | int, ...]:
    """The location as a path in the document: pydantic puts the kind of a section behind its
    name.
    """
    entry = catalog().get((str(location[0]),)) if location else None
    if entry is not None and entry.kind == "kinds" and len(location) > 1 and location[1] in entry.words:
        return (location[0], *location[2:])
    return location


def place_of(key: str, parent: Location) -> str:
    """Sentence on the place of a key that the section at `parent` does not have: another kind of
    it, the top of the scene, or other sections, three at most; empty where none has it.
    """
    table = catalog()
    section = table.get(parent[:1])
    if section is not None and section.kind == "kinds" and len(parent) == 2:
        kinds = [kind for kind in section.words if (parent[0], kind, key) in table]
        if kinds:
            return f"it belongs to a {parent[0]} of kind {' or '.join(kinds)}, this one is {parent[1]}"
    if parent and (key,) in table:
        return f"it stands at the top of the scene: {key}"
    places = dict.fromkeys(".".join(map(str, without_kinds(each))) for each in table if each[-1] == key)
    first = ", ".join([*places][:SHOWN_PLACES])
    more = f" and {len(places) - SHOWN_PLACES} more" if len(places) > SHOWN_PLACES else ""
    return f"it is {first}{more}" if places else ""


def key_of_word(entry: Entry, node: Any) -> str:
    """`; did you mean 'x: word'?` where the value of a number is a word of a choice beside it."""
    raw = getattr(node, "raw", "")
    beside = (each for each in catalog().values() if each.location[:-1] == entry.location[:-1] and each is not entry)
    if entry.kind not in ("number", "integer") or not raw:
        return ""
    found = [
        f"{each.location[-1]}: {word}" for each in beside for word in each.words if word.lower() == str(raw).lower()
    ]
    return f"; did you mean '{found[0]}'?" if found else ""


def _entries(model: type[BaseModel], prefix: Location) -> Iterator[Entry]:
    for name, info in model.model_fields.items():
        location = (*prefix, name)
        annotation = _without_none(info.annotation)
        members = _models_of(annotation)
        if len(members) > 1:
            kinds = {_kind_of(member): member for member in members}
            yield _entry(location, "kinds", info, "", words=tuple(kinds))
            for kind, member in kinds.items():
                yield from _entries(member, (*location, kind))
        elif members:
            yield _entry(location, "section", info, "", keys=tuple(members[0].model_fields))
            yield from _entries(members[0], location)
        else:
            yield _leaf(location, annotation, info, getattr(model, "fixed", ""))


def _entry(location: Location, kind: Kind, info: FieldInfo, fixed: str, **more: Any) -> Entry:
    extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
    default = None if info.is_required() else info.get_default(call_default_factory=True)
    return Entry(
        location,
        kind,
        str(extra.get("unit", "")),
        info.description or "",
        info.is_required(),
        default,
        extra.get("example"),
        allowed_text=str(extra.get("allowed", "")),
        live=str(extra.get("live", "")),
        fixed=str(extra.get("fixed", "")) or fixed,
        **more,
    )


def _leaf(location: Location, annotation: Any, info: FieldInfo, fixed: str) -> Entry:
    metadata, words, kind = [*info.metadata], [], "text"
    for part in _parts(annotation):
        if isinstance(part, FieldInfo):
            metadata += part.metadata
        elif get_origin(part) is Literal:
            words += [str(word) for word in get_args(part)]
            kind = "choice" if kind == "text" else kind
        elif part in (float, int, bool):
            kind = {float: "number", int: "integer", bool: "flag"}[part]
        elif get_origin(part) is list:
            kind = "list"
    low, high, above = _bounds(metadata) if kind in ("number", "integer") else (None, None, False)
    return _entry(location, kind, info, fixed, low=low, high=high, above=above, words=tuple(words))  # type: ignore[arg-type]


def _bounds(metadata: list[Any]) -> tuple[float | None, float | None, bool]:
    low: Any = None
    high: Any = None
    above = False
    for item in metadata:
        if isinstance(item, annotated_types.Ge):
            low = item.ge
        elif isinstance(item, annotated_types.Gt):
            low, above = item.gt, True
        elif isinstance(item, annotated_types.Le):
            high = item.le
    return low, high, above


def _without_none(annotation: Any) -> Any:
    if get_origin(annotation) in (Union, types.UnionType):
        rest = tuple(part for part in get_args(annotation) if part is not type(None))
        return rest[0] if len(rest) == 1 else Union[rest]  # noqa: UP007  built from a tuple
    return annotation


def _parts(annotation: Any) -> list[Any]:
    """The members of unions and annotations, flat; a list stays whole."""
    if get_origin(annotation) in (Union, types.UnionType, Annotated):
        return [part for member in get_args(annotation) for part in _parts(member)]
    return [annotation]


def _models_of(annotation: Any) -> list[type[BaseModel]]:
    return [part for part in _parts(annotation) if isinstance(part, type) and issubclass(part, BaseModel)]


def _kind_of(model: type[BaseModel]) -> str:
    return str(get_args(model.model_fields["kind"].annotation)[0])
