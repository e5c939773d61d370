"""Bag -> `Recording`. Topics are found by message type, so a rig may call its contacts as it
likes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import date
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.bag.columns import Stack
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.memory import refuse_above_limit
from contact_sim_pkg.records.definitions import HEADER, definition_of
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.field_series import FieldReader
from contact_sim_pkg.report.point_reading import PointReader
from contact_sim_pkg.report.rig_reports import series_readers
from contact_sim_pkg.report.series import (
    ContactSeries,
    CostSeries,
    EpisodeSeries,
    FloatArray,
    LedgerSeries,
    MotionSeries,
    Recording,
    TopicCount,
)
from contact_sim_pkg.report.signal.episodes import episode_series
from contact_sim_pkg.run.from_bag import changes_of
from contact_sim_pkg.run.outputs import Estimate
from contact_sim_pkg.scene.errors import SceneError

MOST_RUNS = 6
"""of one comparison"""
FORCE = "contact_msgs_defs/msg/ContactForce"
PATCH = "contact_msgs_defs/msg/ContactPatch"
MOTION = "contact_msgs_defs/msg/BodyMotion"
ENERGY = "contact_msgs_defs/msg/EnergyLedger"
COST = "contact_msgs_defs/msg/SolverCost"
NAMES_OF_COSTS = {"stretches": "coupling_steps", "stretches_repeated": "coupling_steps_repeated"}
"""Of a column of `bench/cost`: what an earlier release called it -> what it is called now."""
EPISODES = "contact_msgs_defs/msg/ContactEpisodes"
POINTS = "contact_msgs_defs/msg/ContactPoints"
CONTACT_COLUMNS = ("time", "sample_period", "normal", "tangential", "approach", "effective_height")
IMPULSES = "impulses"  # absent from older bags
MOTION_COLUMNS = ("time", "sample_period", "samples", "bodies", "position", "acceleration", "velocity")
SCENE_KEY = "scene"
WANTED: dict[str, tuple[str, ...] | None] = {
    FORCE: None, MOTION: MOTION_COLUMNS, ENERGY: LedgerSeries._fields, COST: None, EPISODES: EpisodeSeries._fields,
}  # fmt: skip
"""Columns of each series that are read; None: all"""
NOT_MEASURED = {PATCH: ("approach",)}
"""Fields that a pressure mat leaves open"""
SCALARS_BYTES = 512
"""kept of a field or of contact points, beside a few whole ones"""


SERIES_TYPES = tuple(WANTED)

OnRead = Callable[[float], object]
"""Called while a bag is read, with the share of its messages read: 0 to 1."""
MESSAGES_BETWEEN_CALLS = 10_000


def read_recording(bag: Bag, on_read: OnRead = lambda _: None) -> Recording:
    """Read every series, in one pass over the bag.

    Raises:
        BagError: a message does not fit its definition, or a chunk is damaged and bad chunks are
            not skipped.
        MemoryLimitError: the series are too large.
    """
    stacks, fields, points, of_rigs, unknown = _decode(bag, on_read)
    topics = {kind: [name for name in stacks if bag.topics[name].type == kind] for kind in SERIES_TYPES}
    contact_of = contact_names(bag)
    contacts = {contact_of[name]: _contact(_columns(stacks.pop(name), name, unknown)) for name in topics[FORCE]}
    motion = next((motion_series(_columns(stacks[name], name, unknown)) for name in topics[MOTION]), None)
    ledger = next((LedgerSeries(**_columns(stacks[name], name, unknown)) for name in topics[ENERGY]), None)
    costs = next((stacks[name].columns() for name in topics[COST]), None)
    estimates, of_blocks = _estimates(costs or {})
    listed = [name for name, row in bag.topics.items() if row.type == EPISODES]
    episodes = next((_episodes(stacks.get(name)) for name in listed), None)
    scene = scene_of_text(bag.scene, f"scene of {bag.path}")
    return Recording(
        name=bag.path.parent.name,
        scene=scene,
        notes=list(bag.notes),
        metadata={key: text for key, text in bag.metadata.items() if key != SCENE_KEY},
        topics=[TopicCount(name, row.type, bag.count(name)) for name, row in bag.topics.items()],
        contacts=contacts,
        fields={contact_of[name]: field.finish() for name, field in fields.items()},
        motion=motion,
        ledger=ledger,
        cost=None if costs is None else cost_series(costs),
        duration=_duration([*contacts.values(), *([motion] if motion else [])], scene, bag),
        episodes=episodes,
        points=next((each.finish() for each in points.values()), None),
        series=_rig_series(of_rigs),
        estimates=estimates,
        block_errors=of_blocks,
        unknown={name: each.describe() for name, each in unknown.items()},
        date=date.fromtimestamp(bag.path.stat().st_mtime).isoformat(),
        changes=changes_of(bag),
    )


@contextmanager
def scenes_fit(bags: Sequence[Bag]) -> Iterator[None]:
    """What fails inside on a scene that this version would not run, or on another definition, is a
    BagError that names it.
    """
    try:
        yield
    except (BagError, OSError):
        raise
    except Exception:
        from contact_sim_pkg.scene.resolve import read_explicit

        # First suspect the scenes, then the definitions of messages
        for text, path in [(bag.scene, bag.path) for bag in bags if bag.scene is not None]:
            try:
                read_explicit(text, f"scene of {path}")
            except SceneError as error:
                raise BagError(f"{error.faults[0]}; no report can be made with this scene") from None
        for bag in bags:
            for name in [name for name, row in bag.topics.items() if row.type in _read_types()]:
                bag.refuse_other_definition(name)
        raise


class RigOf(NamedTuple):
    """What runs must have in common to be compared."""

    name: str
    """of the run"""
    rig: str
    contacts: tuple[str, ...]


def rig_of_bag(bag: Bag) -> RigOf:
    """By its scene and topics, before a message is read."""
    names = contact_names(bag)
    forces = [names[name] for name, row in bag.topics.items() if row.type == FORCE and bag.count(name)]
    scene = scene_of_text(bag.scene, f"scene of {bag.path}")
    return RigOf(bag.path.parent.name, str(scene.get("rig") or "unknown"), tuple(forces))


def holds_only_fields(bag: Bag) -> bool:
    """Whether a bag is of a mat, before a message is read."""
    types = {row.type for row in bag.topics.values()}
    return PATCH in types and not types & set(SERIES_TYPES)


def refuse_incomparable(bags: Sequence[Bag]) -> bool:
    """Whether a mat is among the bags, which is laid over a run of any rig; without one BagError as `refuse_other_rigs`."""
    if any(map(holds_only_fields, bags)):
        return True
    refuse_other_rigs([rig_of_bag(each) for each in bags])
    return False


def rig_of_recording(recording: Recording) -> RigOf:
    """The same of a bag that has been read."""
    return RigOf(recording.name, str(recording.scene.get("rig") or "unknown"), tuple(recording.contacts))


def refuse_other_rigs(runs: Sequence[RigOf]) -> None:
    """Raises BagError where the runs are not of one rig, fewer than two, or more than `MOST_RUNS`."""
    if len(runs) < 2:
        raise BagError(f"a comparison needs at least two bags, {len(runs)} given")
    if len(runs) > MOST_RUNS:
        raise BagError(
            f"a comparison takes at most {MOST_RUNS} bags, {len(runs)} given; `bench sweep` puts many cases into one table"
        )
    first, *others = runs
    for each in others:
        if each.rig != first.rig or {*each.contacts} != {*first.contacts}:
            one, two = (f"{run.rig} (contacts: {', '.join(run.contacts) or 'none'})" for run in (first, each))
            raise BagError(
                f"bags of one rig can be compared: {first.name} is of rig {one}, {each.name} of rig {two}; "
                "report them one by one"
            )


class Decoded(NamedTuple):
    """Series by topic; fields, points and what only one rig records are read one by one, for they are
    large.
    """

    series: dict[str, Stack]
    fields: dict[str, FieldReader]
    points: dict[str, PointReader]
    of_rigs: dict[tuple[str, str], Any]
    """readers by the name of their series and the namespace of their topics"""
    unknown: dict[str, Unknown]
    """what is no number in them, by the last two parts of the topic's name"""


class Unknown(NamedTuple):
    """Numbers of a topic that are none."""

    messages: int
    time: float
    """[s] of the first message with one"""
    field: str
    value: float
    """the first of them"""

    def describe(self) -> str:
        """As a warning about what is made of the topic."""
        more = f" and {self.messages - 1} more" if self.messages > 1 else ""
        return f"unknown samples: {self.field} {self.value:g} in the message at {self.time:.6g} s{more}"


def _note_unknown(found: dict[str, Unknown], topic: str, time: float, fields: Iterable[tuple[str, Any]]) -> None:
    """Keep the first number of a message that is none, and how many messages have one."""
    for name, value in fields:
        if not isinstance(value, float) and getattr(getattr(value, "dtype", None), "kind", "") != "f":
            continue
        if not np.isfinite(value).all():
            key = "/".join(topic.strip("/").split("/")[-2:])
            first = float(np.ravel(value)[np.argmin(np.isfinite(np.ravel(value)))])
            before = found.get(key, Unknown(0, time, name, first))
            found[key] = before._replace(messages=before.messages + 1)
            return


def _columns(stack: Stack, topic: str, unknown: dict[str, Unknown]) -> dict[str, Any]:
    """Columns of a topic; what is no number in them goes into ``unknown``."""
    columns = stack.columns()
    for name, rows in columns.items():
        if len(rows) == 0 or _is_known(rows):
            continue
        for time, row in zip(columns["time"], rows, strict=True):
            _note_unknown(unknown, topic, float(time), [(name, np.asarray(row))])
    return columns


def _is_known(rows: Any) -> bool:
    """Whether all numbers of a column are."""
    if isinstance(rows, list):
        return all(getattr(row, "dtype", np.dtype("U")).kind != "f" or bool(np.isfinite(row).all()) for row in rows)
    return rows.dtype.kind != "f" or bool(np.isfinite(rows).all())


def _read_types() -> set[str]:
    return {*SERIES_TYPES, PATCH, POINTS, *series_readers()}


def _rig_series(readers: dict[tuple[str, str], Any]) -> dict[str, Any]:
    """Series by name; of several namespaces the first one that has any."""
    found: dict[str, Any] = {}
    for (name, _), reader in readers.items():
        series = None if name in found else reader.finish()
        if series is not None:
            found[name] = series
    return found


def _decode(bag: Bag, on_read: OnRead) -> Decoded:
    decoded, readers = Decoded({}, {}, {}, {}, {}), series_readers()
    total, kept = bag.count(), 0
    for number, message in enumerate(bag.messages(), start=1):
        if number % MESSAGES_BETWEEN_CALLS == 0:
            on_read(min(1.0, number / max(total, 1)))
        seconds = message.log_time * 1e-9
        if message.type in WANTED:
            if message.topic not in decoded.series:
                decoded.series[message.topic] = bag.stack(message.topic, WANTED[message.type])
            decoded.series[message.topic].add(message.log_time, message.data)
            continue
        if message.type not in (PATCH, POINTS, *readers):
            continue
        content = bag.decode(message)
        may_be_open = (
            readers[message.type].open_fields if message.type in readers else NOT_MEASURED.get(message.type, ())
        )
        given = [(name, value) for name, value in vars(content).items() if name not in may_be_open]
        _note_unknown(decoded.unknown, message.topic, seconds, given)
        # Fields and points are reduced as they are read; they would not fit into memory
        if message.type == PATCH:
            decoded.fields.setdefault(message.topic, FieldReader()).add(seconds, content)
            kept += SCALARS_BYTES
        elif message.type == POINTS:
            decoded.points.setdefault(message.topic, PointReader()).add(seconds, content)
            kept += SCALARS_BYTES
        else:
            reader = readers[message.type]
            place = reader.name, message.topic.rpartition("/")[0]
            if place not in decoded.of_rigs:
                decoded.of_rigs[place] = load(reader.reader)()
            decoded.of_rigs[place].add(seconds, message.type, content)
            kept += SCALARS_BYTES if reader.reduces else 2 * len(message.data)
        refuse_above_limit(kept, f"{bag.path}: the report of its first {number} messages")
    return decoded


def contact_name(topic: str) -> str:
    """`/rig2/tire/force` -> `tire`: the part of a topic's name before its last one."""
    parts = topic.strip("/").split("/")
    return parts[-2] if len(parts) > 1 else parts[-1]


def contact_names(bag: Bag) -> dict[str, str]:
    """Contact of each topic, by its name in the bag; BagError where two topics of a type call
    theirs the same.
    """
    names: dict[str, str] = {}
    seen: dict[tuple[str, str], str] = {}
    for name, row in bag.topics.items():
        names[name] = contact_name(row.relative_name or name)
        other = seen.setdefault((row.type, names[name]), name)
        if other != name and row.type in (FORCE, PATCH):
            raise BagError(
                f"{bag.path} has {other} and {name}, both of a contact {names[name]}; record each bench in a bag of its own"
            )
    return names


def _duration(series: list[ContactSeries | MotionSeries], scene: dict[str, Any], bag: Bag) -> float:
    """End of the last sample; without samples the end of the last block, as far as the scene has it
    its length.
    """
    if series:
        return max(float(each.time[-1]) + each.sample_period for each in series)
    block_length = scene.get("block_length")
    if isinstance(block_length, (int, float)) and bag.count():
        return float((math.floor(bag.end * 1e-9 / block_length + 1e-9) + 1) * block_length)
    return bag.end * 1e-9


def _sample_times(columns: Mapping[str, Any], counts: list[int]) -> FloatArray:
    """[s] of every sample, from the stamp of each message."""
    period = float(columns["sample_period"][0])
    starts = zip(columns["time"], counts, strict=True)
    times: FloatArray = np.concatenate([start + period * np.arange(count) for start, count in starts])
    return times


def _contact(columns: dict[str, Any]) -> ContactSeries:
    time = _sample_times(columns, [len(row) for row in columns["normal"]])
    normal, tangential, approach, height = (
        np.concatenate([*columns[name]]).astype(np.float64) for name in CONTACT_COLUMNS[2:]
    )
    impulses = np.concatenate([*columns[IMPULSES]]).astype(np.float64) if IMPULSES in columns else np.zeros(0)
    return ContactSeries(time, float(columns["sample_period"][0]), normal, tangential, approach, height, impulses)


def motion_series(columns: Mapping[str, Any]) -> MotionSeries:
    """Motion of the rows of `BodyMotion`, a row a block: `MOTION_COLUMNS`, each as long."""
    counts = [int(count) for count in columns["samples"]]
    bodies = [str(name) for name in columns["bodies"][0]]
    position, acceleration, velocity = (
        np.concatenate([np.reshape(row, (len(bodies), -1)) for row in columns[name]], axis=1)
        for name in ("position", "acceleration", "velocity")
    )
    return MotionSeries(
        _sample_times(columns, counts),
        float(columns["sample_period"][0]),
        dict(zip(bodies, position, strict=True)),
        dict(zip(bodies, acceleration, strict=True)),
        dict(zip(bodies, velocity, strict=True)),
    )


def _episodes(stack: Stack | None) -> EpisodeSeries:
    """Episodes of a topic; it carries nothing where none ended."""
    return episode_series({name: [] for name in EpisodeSeries._fields} if stack is None else stack.columns())


def cost_series(columns: dict[str, Any]) -> CostSeries:
    """Of each block; a bag of an earlier release holds some columns under their old names."""
    columns = {NAMES_OF_COSTS.get(name, name): column for name, column in columns.items()}
    names = [field.name for field in definition_of("SolverCost").fields if field.type != HEADER and not field.is_array]
    return {name: np.asarray(columns[name], dtype=np.float64) for name in ("time", *names) if name in columns}


def _estimates(columns: dict[str, Any]) -> tuple[list[Estimate], dict[str, FloatArray]]:
    """Largest of each estimated error, and those of the blocks; none in a bag of an earlier release."""
    found: dict[str, Estimate] = {}
    of_blocks: dict[str, list[float]] = {}
    rows = (columns.get(name, ()) for name in ("estimated", "estimated_error", "estimated_of"))
    for names, errors, largest in zip(*rows, strict=True):
        for column, error, size in zip(names, errors, largest, strict=True):
            before = found.get(str(column), Estimate(str(column), 0.0, 0.0))
            found[before.column] = Estimate(before.column, max(before.error, error), max(before.largest, size))
            of_blocks.setdefault(before.column, []).append(float(error))
    return list(found.values()), {column: np.array(errors) for column, errors in of_blocks.items()}
