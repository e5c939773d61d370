"""Bag -> `Recording`. Topics are found by message type, so a rig may call its contacts as it likes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from rosbags.serde import SerdeError
from rosbags.typesys.store import Typestore
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from contact_sim_pkg.bag.columns import stacked
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.bag.typestore import store_of_definition

from .series import (
    ContactSeries,
    CostSeries,
    FieldSeries,
    FloatArray,
    LedgerSeries,
    MotionSeries,
    PressureMap,
    Recording,
    TopicCount,
)

FORCE = "contact_msgs_defs/msg/ContactForce"
PATCH = "contact_msgs_defs/msg/ContactPatch"
MOTION = "contact_msgs_defs/msg/BodyMotion"
ENERGY = "contact_msgs_defs/msg/EnergyLedger"
COST = "contact_msgs_defs/msg/SolverCost"
SERIES_TYPES = (FORCE, MOTION, ENERGY, COST)
CONTACT_COLUMNS = ("time", "sample_period", "normal", "tangential", "approach")
MOTION_COLUMNS = ("time", "sample_period", "samples", "bodies", "position", "acceleration")
SCENE_KEY = "scene"


def read_recording(bag: Bag) -> Recording:
    """Read every series, in one pass over the bag.

    Raises:
        BagError: a message does not fit its definition, or a chunk is damaged and bad chunks are not skipped.
    """
    kinds = {row.type: row.definition for row in bag.topics.values() if row.type in (*SERIES_TYPES, PATCH)}
    stores = {kind: store_of_definition(kind, definition) for kind, definition in kinds.items()}
    decoded, fields = _decode(bag, stores)

    def columns(topic: str, names: tuple[str, ...]) -> dict[str, Any]:
        kind = bag.topics[topic].type
        return stacked(decoded[topic], stores[kind], kind, names)

    topics = {kind: [name for name in decoded if bag.topics[name].type == kind] for kind in SERIES_TYPES}
    contacts = {contact_name(name): _contact(columns(name, CONTACT_COLUMNS)) for name in topics[FORCE]}
    motion = next((_motion(columns(name, MOTION_COLUMNS)) for name in topics[MOTION]), None)
    ledger = next((LedgerSeries(**columns(name, LedgerSeries._fields)) for name in topics[ENERGY]), None)
    cost = next((_cost(columns(name, CostSeries._fields)) for name in topics[COST]), None)
    scene = parse_mapping(bag.scene or "")
    return Recording(
        name=bag.path.parent.name,
        scene=scene,
        notes=list(bag.notes),
        metadata={key: text for key, text in bag.metadata.items() if key != SCENE_KEY},
        topics=[TopicCount(name, row.type, bag.count(name)) for name, row in bag.topics.items()],
        contacts=contacts,
        fields={contact_name(name): field.finish() for name, field in fields.items()},
        motion=motion,
        ledger=ledger,
        cost=cost,
        duration=_duration([*contacts.values(), *([motion] if motion else [])], scene, bag),
    )


def _decode(bag: Bag, stores: dict[str, Typestore]) -> tuple[dict[str, list[tuple[int, Any]]], dict[str, FieldPass]]:
    """Messages of the series by topic, and the fields by topic; fields are taken in one by one, for they are large."""
    decoded: dict[str, list[tuple[int, Any]]] = {}
    fields: dict[str, FieldPass] = {}
    for message in bag.messages():
        if message.type not in stores:
            continue
        seconds = message.log_time * 1e-9
        try:
            value = stores[message.type].deserialize_cdr(message.data, message.type)
        except (SerdeError, AssertionError) as error:
            where = f"{bag.path}: the message of {message.topic} at {seconds:.6f} s"
            raise BagError(f"{where} does not fit the definition in the bag: {error}") from None
        if message.type == PATCH:
            fields.setdefault(message.topic, FieldPass()).take(seconds, value)
        else:
            decoded.setdefault(message.topic, []).append((message.log_time, value))
    return decoded, fields


def contact_name(topic: str) -> str:
    """`/rig2/tire/force` -> `tire`: the part of a topic's name before its last one."""
    parts = topic.strip("/").split("/")
    return parts[-2] if len(parts) > 1 else parts[-1]


def parse_mapping(text: str) -> dict[str, Any]:
    """The mapping that a YAML or JSON text holds; empty where it is none."""
    try:
        value = YAML(typ="safe").load(text)
    except (YAMLError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


class FieldPass:
    """The fields of one topic, taken in one by one: a minute of them would not fit into a small memory.

    A contact that outgrows its grid is solved on a wider one of the same cells, so fields of two sizes may come. The mean is
    taken over the widest, cells laid over each other by their place in the contact's frame.
    """

    def __init__(self) -> None:
        """Nothing taken in yet."""
        self._scalars: list[tuple[float, float, float, float]] = []
        self._total: FloatArray = np.zeros((0, 0))
        self._widest: Any = None
        self._highest: Any = None
        self._highest_time = 0.0

    def take(self, time: float, message: Any) -> None:
        """Take in the field at `time` [s]. BagError for a field that does not fill its grid, or on cells of another size."""
        if len(message.pressure) != message.rows * message.cols:
            raise BagError(
                f"the field at {time:.6f} s has {len(message.pressure)} values for {message.rows} x {message.cols} cells"
            )
        self._widen(time, message)
        row, col = _place(message, self._widest)
        pressure = np.reshape(message.pressure, (message.rows, message.cols))
        self._total[row : row + message.rows, col : col + message.cols] += pressure
        self._scalars.append((time, message.load, message.peak, message.area))
        if self._highest is None or message.peak > self._highest.peak:
            self._highest, self._highest_time = message, time

    def _widen(self, time: float, message: Any) -> None:
        """Make room for a grid that is wider than all before."""
        before, shape = self._widest, (message.rows, message.cols)
        if before is None:
            self._widest, self._total = message, np.zeros(shape)
            return
        same_cells = math.isclose(message.cell_x, before.cell_x) and math.isclose(message.cell_y, before.cell_y)
        wider = message.rows >= before.rows and message.cols >= before.cols
        if not same_cells or not (wider or (message.rows <= before.rows and message.cols <= before.cols)):
            raise BagError(
                f"the field at {time:.6f} s lies on {message.rows} x {message.cols} cells of {message.cell_x} x "
                f"{message.cell_y} m, another one on {before.rows} x {before.cols} of {before.cell_x} x {before.cell_y} m; "
                "one grid must hold the other, with the same cells"
            )
        if wider and shape != (before.rows, before.cols):
            row, col = _place(before, message)
            total = np.zeros(shape)
            total[row : row + before.rows, col : col + before.cols] = self._total
            self._widest, self._total = message, total

    def finish(self) -> FieldSeries:
        """The series of all fields taken in; at least one."""
        if self._widest is None:
            raise BagError("no field was taken in")
        time, load, peak, area = np.array(self._scalars).T
        highest = _pressure_map(self._highest, self._highest.pressure)
        average = _pressure_map(self._widest, self._total / time.size)
        return FieldSeries(time, load, peak, area, highest, self._highest_time, average)


def _place(inner: Any, outer: Any) -> tuple[int, int]:
    """Row and column of `outer` on which cell (0, 0) of `inner` lies, the nearest ones."""
    row = round((inner.origin_x - outer.origin_x) / outer.cell_x)
    col = round((inner.origin_y - outer.origin_y) / outer.cell_y)
    return min(max(row, 0), outer.rows - inner.rows), min(max(col, 0), outer.cols - inner.cols)


def _duration(series: list[ContactSeries | MotionSeries], scene: dict[str, Any], bag: Bag) -> float:
    """End of the last sample; without samples the end of the last block, as far as the scene tells its length."""
    if series:
        return max(float(each.time[-1]) + each.sample_period for each in series)
    block_length = scene.get("block_length")
    if isinstance(block_length, (int, float)) and bag.count():
        return float((math.floor(bag.end * 1e-9 / block_length + 1e-9) + 1) * block_length)
    return bag.end * 1e-9


def _sample_times(columns: dict[str, Any], counts: list[int]) -> FloatArray:
    """[s] of every sample, from the stamp of each message."""
    period = float(columns["sample_period"][0])
    starts = zip(columns["time"], counts, strict=True)
    times: FloatArray = np.concatenate([start + period * np.arange(count) for start, count in starts])
    return times


def _contact(columns: dict[str, Any]) -> ContactSeries:
    time = _sample_times(columns, [len(row) for row in columns["normal"]])
    joined = (np.concatenate([*columns[name]]).astype(np.float64) for name in ("normal", "tangential", "approach"))
    return ContactSeries(time, float(columns["sample_period"][0]), *joined)


def _motion(columns: dict[str, Any]) -> MotionSeries:
    counts = [int(count) for count in columns["samples"]]
    bodies = [str(name) for name in columns["bodies"][0]]
    position, acceleration = (
        np.concatenate([np.reshape(row, (len(bodies), -1)) for row in columns[name]], axis=1)
        for name in ("position", "acceleration")
    )
    return MotionSeries(
        _sample_times(columns, counts),
        float(columns["sample_period"][0]),
        dict(zip(bodies, position, strict=True)),
        dict(zip(bodies, acceleration, strict=True)),
    )


def _cost(columns: dict[str, Any]) -> CostSeries:
    return CostSeries(**{name: np.asarray(column, dtype=np.float64) for name, column in columns.items()})


def _pressure_map(message: Any, pressure: Any) -> PressureMap:
    grid = np.array(pressure, dtype=np.float64).reshape(message.rows, message.cols)
    return PressureMap(grid, message.cell_x, message.cell_y, message.origin_x, message.origin_y)
