"""A run's state as bytes and back: a header of JSON and the arrays behind it, without pickle.

The header has what the bits hang on (scene, sources, versions, processor), the block, and the tree of all values; the
digest before it is that of all bytes behind it. Loading checks everything before it writes anything, and writes arrays in
place, since compiled code and views hold them.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import importlib
import json
import platform
from collections.abc import Callable, Iterable
from importlib.metadata import version
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.state import State, state_of
from contact_sim_pkg.run.bag_content import kernel_fingerprint
from contact_sim_pkg.run.live_parameters import Change
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["SavedState", "StateError", "carry_state", "load_state", "open_state", "save_state"]

MAGIC = b"contact bench state 1\n"
PACKAGE = __name__.partition(".")[0]
NOT_STATE = ("name", "description", "pace", "duration")
"""Keys of a scene that no state hangs on."""
PLAIN = (bool, int, float, str, type(None))

Node: TypeAlias = Any
Array = NDArray[Any]
Part: TypeAlias = Callable[[State], tuple[str, ...]]
ALL: Part = attrgetter("names")
PHYSICS: Part = attrgetter("physics")
"""Names of a declared state that are written and read."""


class StateError(ValueError):
    """A state that cannot be saved or loaded; the text says why. Nothing was changed."""


class SavedState(NamedTuple):
    """A state that fits scene, bench and processor.

    Attributes:
        block: before which it was saved.
        changes: of parameters in the run until then.
    """

    block: int
    changes: tuple[Change, ...]
    arrays: list[Array]
    tree: Node


def save_state(simulation: object, block: int, scene: ResolvedScene, changes: Iterable[Change] = ()) -> bytes:
    """The state of a ``simulation`` before a ``block``, of a ``scene`` whose parameters had those ``changes``. Raises
    StateError where a part of it declares none.
    """
    if observers := getattr(simulation, "undeclared", ""):
        raise StateError(f"{observers}: what only looks at a run declares no state; leave it out to save one")
    writer = _Writer()
    tree = writer.node(simulation, _name(scene))
    content = b"".join(writer.content)
    known = {"of": _origin(scene), "block": block, "arrays": writer.described, "state": tree}
    header = json.dumps({**known, "changes": [*changes]}).encode()
    body = len(header).to_bytes(8, "little") + header + content
    return MAGIC + hashlib.sha256(body).digest() + body


def open_state(data: bytes, scene: ResolvedScene) -> SavedState:
    """Read a saved state of a ``scene``, as it was at the start of the run.

    Raises StateError where it is damaged, or of another scene, bench, version or processor.
    """
    header, content = _opened(data)
    for name, value in _origin(scene).items():
        if header["of"].get(name) != value:
            raise StateError(f"the state was saved with another {name}: {header['of'].get(name)}, this is {value}")
    changes = tuple(Change(int(block), str(key), float(value)) for block, key, value in header["changes"])
    return SavedState(int(header["block"]), changes, _arrays(header["arrays"], content), header["state"])


def load_state(saved: SavedState, simulation: object, scene: ResolvedScene) -> None:
    """Put a saved state into a ``simulation`` of the same scene. Raises StateError where it does not fit."""
    _put(_Reader(saved.arrays), saved.tree, simulation, _name(scene))


def carry_state(before: object, after: object, where: str) -> None:
    """Copy the physics of an object, and of those in it, into another one of its class: what a motion goes on from
    where warm starts and step control are of no use. Raises StateError where it does not fit.
    """
    writer = _Writer(PHYSICS)
    tree = writer.node(before, where)
    _put(_Reader(_arrays(writer.described, b"".join(writer.content)), PHYSICS), tree, after, where)


def _put(reader: _Reader, tree: Node, into: object, where: str) -> None:
    reader.value(tree, into, where)
    for write in reader.writes:
        write()


def _name(scene: ResolvedScene) -> str:
    return f"the simulation of rig {scene.rig}"


@functools.cache
def _machine() -> dict[str, str]:
    import llvmlite.binding

    processor = f"{platform.machine()} {llvmlite.binding.get_host_cpu_name()}"
    return {"bench": kernel_fingerprint(), "numpy": version("numpy"), "numba": version("numba"), "processor": processor}


def _origin(scene: ResolvedScene) -> dict[str, str]:
    """What the bits of a state hang on."""
    data = {key: value for key, value in scene.data.items() if key not in NOT_STATE}
    text = json.dumps(data, sort_keys=True).encode()
    return {"scene": hashlib.sha256(text).hexdigest()[:20], **_machine()}


def _opened(data: bytes) -> tuple[dict[str, Any], bytes]:
    """Header and arrays; StateError for other bytes than were saved."""
    start = len(MAGIC) + 32
    body = data[start:]
    if data[: len(MAGIC)] != MAGIC or hashlib.sha256(body).digest() != data[len(MAGIC) : start]:
        raise StateError("these bytes are no state of the bench, or were changed")
    length = int.from_bytes(body[:8], "little")
    header: dict[str, Any] = json.loads(body[8 : 8 + length])
    return header, body[8 + length :]


def _arrays(described: list[list[Any]], content: bytes) -> list[Array]:
    found, place = [], 0
    for dtype, shape in described:
        count = int(numpy.prod(shape, dtype=numpy.int64))
        found.append(numpy.frombuffer(content, numpy.dtype(dtype), count, place).reshape(shape).copy())
        place += found[-1].nbytes
    return found


class _Writer:
    """The tree of values, and their arrays. What stands in several places is written once."""

    def __init__(self, part: Part = ALL) -> None:
        self._part = part
        self.described: list[list[Any]] = []
        self.content: list[bytes] = []
        self._known: dict[int, tuple[int, Any]] = {}  # the thing too, so that no other takes its place in memory
        self._objects: dict[int, tuple[int, Any]] = {}

    def node(self, value: Any, where: str) -> Node:
        """One value; ``where`` it is, for a sentence."""
        if type(value) in PLAIN:
            return value
        if isinstance(value, numpy.generic):
            return {"scalar": self._array(numpy.asarray(value))}
        if isinstance(value, numpy.ndarray):
            return {"array": self._array(value)}
        if state_of(value) is not None:
            return self._object(value)
        if hasattr(value, "_asdict"):
            return self._record(value, value._asdict(), where)
        if dataclasses.is_dataclass(value):
            fields = {each.name: getattr(value, each.name) for each in dataclasses.fields(value)}
            return self._record(value, fields, where)
        if isinstance(value, (list, tuple)):
            return {type(value).__name__: [self.node(each, where) for each in value]}
        if isinstance(value, dict):
            return {"dict": [[self.node(key, where), self.node(each, where)] for key, each in value.items()]}
        raise StateError(f"{where} is a {type(value).__name__}, which declares no state")

    def _object(self, value: Any) -> Node:
        """Of one that declares its state."""
        if id(value) in self._objects:
            return {"same": self._objects[id(value)][0]}
        self._objects[id(value)] = len(self._objects), value
        declared = state_of(value)
        assert declared is not None
        name = type(value).__name__
        parts = {path: self.node(attrgetter(path)(value), f"{name}.{path}") for path in self._part(declared)}
        return {"object": _named(value), "parts": parts}

    def _record(self, value: Any, fields: dict[str, Any], where: str) -> Node:
        return {"record": _named(value), "parts": {key: self.node(each, where) for key, each in fields.items()}}

    def _array(self, value: Array) -> int:
        """Number of an array."""
        if id(value) not in self._known:
            self._known[id(value)] = len(self.described), value
            self.described.append([value.dtype.str, [*value.shape]])
            self.content.append(numpy.ascontiguousarray(value).tobytes())
        return self._known[id(value)][0]


class _Reader:
    """Makes values of a tree; what it writes is planned, and done when all is known to fit."""

    def __init__(self, arrays: list[Array], part: Part = ALL) -> None:
        self._part = part
        self._arrays = arrays  # where one takes the place of a buffer, the buffer
        self._objects: list[Any] = []
        self.writes: list[Callable[[], None]] = []

    def value(self, node: Node, before: Any, where: str, *, in_place: bool = False) -> Any:
        """A value that takes the place of ``before``. Objects stay and get new parts; arrays ``in_place``, a record's too, stay
        and are filled. All others are made anew: arrays of a record of the past may be shared with constants.
        """
        if not isinstance(node, dict):
            return node
        kind = next(iter(node))
        content = node[kind]
        if kind == "scalar":
            return self._arrays[content][()]
        if kind == "array":
            return self._filled(content, before) if in_place else self._arrays[content]
        if kind == "same":
            return self._objects[content]
        if kind == "object":
            return self._object(content, node["parts"], before, where)
        if kind == "record":
            return self._record(content, node["parts"], before if in_place else None, where)
        if kind == "dict":
            known = before if isinstance(before, dict) else {}
            pairs = [(self.value(key, None, where), each) for key, each in content]
            return {key: self.value(each, known.get(key), where) for key, each in pairs}
        there = before if isinstance(before, (list, tuple)) and len(before) == len(content) else [None] * len(content)
        values = [self.value(item, each, where) for item, each in zip(content, there, strict=True)]
        return tuple(values) if kind == "tuple" else values

    def _object(self, name: str, parts: dict[str, Node], before: Any, where: str) -> Any:
        """Plan to write the parts of an object that is there."""
        declared = state_of(before)
        if declared is None or name != _named(before):
            raise StateError(f"{where} is no {name.rpartition(':')[2]} here")
        if set(parts) != set(self._part(declared)):
            raise StateError(f"{where} has other parts than the state")
        self._objects.append(before)
        for path in self._part(declared):
            way, _, last = path.rpartition(".")
            holder = attrgetter(way)(before) if way else before
            now, named = getattr(holder, last), f"{type(before).__name__}.{path}"
            fills = isinstance(now, numpy.ndarray) or path in declared.held
            value = self.value(parts[path], now, named, in_place=fills)
            if value is now:
                continue
            if isinstance(holder, tuple) or path in declared.held:
                raise StateError(f"{named} has another shape here")
            self.writes.append(functools.partial(setattr, holder, last, value))
        return before

    def _record(self, name: str, parts: dict[str, Node], held: Any, where: str) -> Any:
        """A named tuple or dataclass; that which is ``held`` where only its buffers are filled."""
        values = {
            key: self.value(each, getattr(held, key, None), where, in_place=held is not None)
            for key, each in parts.items()
        }
        if held is not None and all(_same(each, getattr(held, key, None)) for key, each in values.items()):
            return held
        return _class(name, where)(**values)

    def _filled(self, number: int, before: Any) -> Any:
        """The array that is there, to be filled where the saved one fits, else the saved one."""
        saved = self._arrays[number]
        fits = isinstance(before, numpy.ndarray) and (before.shape, before.dtype.str) == (saved.shape, saved.dtype.str)
        if not fits or not before.flags.writeable or before is saved:
            return saved
        content = saved.view(before.dtype)  # fields of a record have no text
        self.writes.append(functools.partial(numpy.copyto, before, content))
        self._arrays[number] = before
        return before


def _named(value: object) -> str:
    return f"{type(value).__module__}:{type(value).__qualname__}"


def _same(value: Any, other: Any) -> bool:
    """Whether a part of a record is what it was: the same buffer, or an equal number."""
    return value is other or (type(value) in PLAIN and type(value) is type(other) and value == other)


def _class(name: str, where: str) -> Any:
    """A named tuple or dataclass of the bench by its module and name, and no other thing."""
    module, _, kind = name.partition(":")
    found = None
    if module.partition(".")[0] == PACKAGE:
        found = getattr(importlib.import_module(module), kind, None)
    if not isinstance(found, type) or not (dataclasses.is_dataclass(found) or hasattr(found, "_fields")):
        raise StateError(f"{where}: {name!r:.80} is no record of the bench")
    return found
