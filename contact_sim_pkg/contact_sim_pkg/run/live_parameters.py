"""Keys of a scene that may change between two blocks of a run: which, why not, and the scene that follows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any, NamedTuple

from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene, leaves_of

__all__ = [
    "STEERING", "Change", "Parameter", "ParameterError", "block_at", "by_block", "changed_scene", "parameters_of", "refuse_changes",
    "refuse_fixed",
]  # fmt: skip

STEERING = "bench/steering"
"""Topic of a run's changes."""
SPEED = "travel.speed"
RAMP = 3.0
"""[m/s^2] with which the speed of a run goes to another one."""

FIXED = {
    "choice": "it chooses what the run is made of", "flag": "it chooses what the run is made of",
    "text": "it names what the run is made of", "list": "a list holds for the whole run",
    "number": "the state of the run was made for it", "integer": "the state of the run was made for it",
}  # fmt: skip
"""Why a key of a kind holds for the whole run, where neither it nor its section says so."""


class ParameterError(ValueError):
    """A change that is refused; the text says why. Nothing was changed."""


class Change(NamedTuple):
    """A key of the scene that has another value from a block on."""

    block: int
    key: str
    value: float


class Parameter(NamedTuple):
    """A key of a scene, and whether it may change in a run.

    Attributes:
        value: at present; of a key that is fixed as the scene has it.
        unit: of a number; empty: none.
        low, high: range of a number; None of others.
        live: ``excitation`` or ``law``, what it acts on; empty: it is fixed.
        reason: why it is fixed, a sentence; empty where it is live.
    """

    value: Any
    unit: str
    low: float | None
    high: float | None
    live: str
    reason: str


def parameters_of(scene: ResolvedScene, changes: Iterable[Change] = ()) -> dict[str, Parameter]:
    """Every key of a resolved scene, dotted, with the values that ``changes`` have left."""
    from contact_sim_pkg.scene.schema.catalog import Entry, catalog  # a run without changes needs no schema

    table = catalog()

    def entry_at(where: tuple[str, ...]) -> Entry | None:
        location: tuple[str, ...] = ()
        for key in where:
            location = (*location, key)
            found = table.get(location)
            if found is not None and found.kind == "kinds":  # the kind of a section stands between it and its keys
                location = (*location, scene.data[key]["kind"])
        return table.get(location)

    now = {each.key: each.value for each in changes}
    found = {}
    for where, value in leaves_of(scene.data):
        key, entry = ".".join(where), entry_at(where)
        if entry is None:
            continue
        live = _live(scene, where, entry.live)
        reason = "" if live else f"{key} is fixed in a run: {_reason(scene, where, entry)}"
        found[key] = Parameter(now.get(key, value), entry.unit, entry.low, entry.high, live, reason)
    return found


def _live(scene: ResolvedScene, where: tuple[str, ...], live: str) -> str:
    return "" if where[0] == "road" and scene.data.get("travel") is None else live


def _reason(scene: ResolvedScene, where: tuple[str, ...], entry: Any) -> str:
    """Why a key of a scene is fixed."""
    if entry.live:
        return "the rig reads its road at the start"
    return str(entry.fixed or FIXED.get(entry.kind, FIXED["text"]))


def refuse_fixed(known: Mapping[str, Parameter], values: Mapping[str, float]) -> None:
    """Raise ParameterError for the first of some values whose key cannot change."""
    for key, value in values.items():
        if key not in known:
            live = ", ".join(name for name, each in known.items() if each.live)
            raise ParameterError(f"the scene has no key {key!r}; live are {live or 'none'}")
        if known[key].reason:
            raise ParameterError(known[key].reason)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise ParameterError(f"{key} is {value!r}, a number is needed")


def block_at(scene: ResolvedScene, time: float) -> int:
    """The block of a scene that starts at a ``time`` [s]. Raises ParameterError within a block."""
    block = round(time / scene.block_length)
    if abs(time - block * scene.block_length) > 1e-9 * max(time, scene.block_length):
        raise ParameterError(
            f"parameters change between blocks of {scene.block_length:g} s, {time:g} s lies within one"
        )
    return block


def refuse_changes(scene: ResolvedScene, changes: Iterable[Change]) -> None:
    """Raise ParameterError where a run of the scene cannot make some changes, as far as that is known before it."""
    known = parameters_of(scene)  # of the start: a speed that changes becomes a programme
    for block, values in by_block(changes):
        if not 0 <= block < scene.blocks:
            raise ParameterError(f"parameters change before block {block}; the scene has {scene.blocks} blocks, from 0")
        refuse_fixed(known, values)
        scene = changed_scene(scene, block, values)


def changed_scene(scene: ResolvedScene, block: int, values: Mapping[str, float]) -> ResolvedScene:
    """The scene with other ``values`` from a ``block`` on; all other keys stay, those too that once followed from them.

    A speed becomes a programme: from the present speed with `RAMP` to the new one; from block 0 on it is the scene's.
    Raises ParameterError where a value is outside its range, or a rule between keys does not hold.
    """
    from contact_sim_pkg.scene.overrides import set_value
    from contact_sim_pkg.scene.resolve import read_explicit

    overrides = []
    for key, value in values.items():
        if key == SPEED and block > 0:
            points = _programme(scene, block * scene.block_length, float(value))
            overrides += [set_value("travel.points=" + repr(points), "")]
            if "speed" in scene.data["travel"]:
                overrides += [set_value("travel.speed=null", "")]
        else:
            overrides.append(set_value(f"{key}={float(value)!r}", ""))
    try:
        return ResolvedScene(read_explicit(scene.to_yaml(), scene.name, overrides), scene.files)
    except SceneError as error:
        raise ParameterError(str(error)) from None


def _programme(scene: ResolvedScene, now: float, speed: float) -> list[list[float]]:
    """Points of the travel so far, and the ramp from ``now`` [s] on to a ``speed`` [m/s]."""
    travel = scene.data["travel"]
    points = travel.get("points") or [[0.0, travel.get("speed", 0.0)]]
    present = Travel([(time, value) for time, value in points]).speed(now)
    past = [[time, value] for time, value in points if time < now]
    if present == speed:
        return [*past, [now, speed]]
    return [*past, [now, present], [now + abs(speed - present) / RAMP, speed]]


def by_block(changes: Iterable[Change]) -> list[tuple[int, dict[str, float]]]:
    """Changes block by block, in the order of the blocks."""
    ordered = sorted(changes, key=lambda each: each.block)
    return [
        (block, {each.key: each.value for each in group})
        for block, group in groupby(ordered, key=lambda each: each.block)
    ]
