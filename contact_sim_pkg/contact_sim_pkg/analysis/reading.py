"""Bag -> `Recording`. Topics are found by message type, so a rig may call its contacts as it likes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag

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

PACKAGE = "contact_msgs_defs/msg"
SCENE_KEY = "scene"


def read_recording(bag: Bag) -> Recording:
    """Read every series once.

    Raises:
        BagError: a message does not fit its definition, or a chunk is damaged and bad chunks are not skipped.
    """
    topics = [TopicCount(name, row.type, bag.count(name)) for name, row in bag.topics.items()]
    recorded = [topic for topic in topics if topic.messages]
    motion = [_read_motion(bag, topic.name) for topic in recorded if topic.type == f"{PACKAGE}/BodyMotion"]
    ledger = [_read_ledger(bag, topic.name) for topic in recorded if topic.type == f"{PACKAGE}/EnergyLedger"]
    cost = [_read_cost(bag, topic.name) for topic in recorded if topic.type == f"{PACKAGE}/SolverCost"]
    contacts = {
        contact_name(topic.name): _read_contact(bag, topic.name)
        for topic in recorded
        if topic.type == f"{PACKAGE}/ContactForce"
    }
    scene = parse_mapping(bag.scene or "")
    return Recording(
        name=bag.path.parent.name,
        scene=scene,
        notes=list(bag.notes),
        metadata={key: text for key, text in bag.metadata.items() if key != SCENE_KEY},
        topics=topics,
        contacts=contacts,
        fields={
            contact_name(topic.name): _read_field(bag, topic.name)
            for topic in recorded
            if topic.type == f"{PACKAGE}/ContactPatch"
        },
        motion=motion[0] if motion else None,
        ledger=ledger[0] if ledger else None,
        cost=cost[0] if cost else None,
        duration=_duration(contacts, motion, scene, bag),
    )


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


def _duration(contacts: dict[str, ContactSeries], motion: list[MotionSeries], scene: dict[str, Any], bag: Bag) -> float:
    """End of the last sample; without samples the end of the last block, as far as the scene tells its length."""
    ends = [float(series.time[-1]) + series.sample_period for series in contacts.values()]
    ends += [float(series.time[-1]) + series.sample_period for series in motion]
    block_length = scene.get("block_length")
    if not ends and isinstance(block_length, (int, float)):
        last_block = math.floor(bag.end * 1e-9 / block_length + 1e-9)
        ends = [(last_block + 1) * block_length if bag.count() else 0.0]
    return max(ends, default=bag.end * 1e-9)


def _sample_times(stamps: FloatArray, period: float, samples: int) -> FloatArray:
    times: FloatArray = (stamps[:, None] + period * np.arange(samples)).ravel()
    return times


def _flat(rows: Any) -> FloatArray:
    """[messages, samples], or a list of arrays of different lengths, as one series."""
    joined: FloatArray = np.concatenate([np.asarray(row, dtype=np.float64) for row in rows])
    return joined


def _read_contact(bag: Bag, topic: str) -> ContactSeries:
    fields = ("time", "sample_period", "normal", "tangential", "approach")
    columns = bag.columns(topic, fields)
    period = float(columns["sample_period"][0])
    counts = [len(row) for row in columns["normal"]]
    time = np.concatenate([start + period * np.arange(n) for start, n in zip(columns["time"], counts, strict=True)])
    return ContactSeries(time, period, *(_flat(columns[name]) for name in fields[2:]))


def _read_motion(bag: Bag, topic: str) -> MotionSeries:
    columns = bag.columns(topic, ("time", "sample_period", "bodies", "samples", "position", "acceleration"))
    period, samples = float(columns["sample_period"][0]), int(columns["samples"][0])
    bodies = [str(name) for name in columns["bodies"][0]]
    shape = (-1, len(bodies), samples)
    position, acceleration = (
        np.asarray(columns[name], dtype=np.float64).reshape(shape).swapaxes(0, 1).reshape(len(bodies), -1)
        for name in ("position", "acceleration")
    )
    return MotionSeries(
        _sample_times(columns["time"], period, samples),
        period,
        dict(zip(bodies, position, strict=True)),
        dict(zip(bodies, acceleration, strict=True)),
    )


def _read_ledger(bag: Bag, topic: str) -> LedgerSeries:
    columns = bag.columns(topic, LedgerSeries._fields)
    return LedgerSeries(*(columns[name] for name in LedgerSeries._fields))


def _read_cost(bag: Bag, topic: str) -> CostSeries:
    columns = bag.columns(topic, CostSeries._fields)
    return CostSeries(*(np.asarray(columns[name], dtype=np.float64) for name in CostSeries._fields))


def _read_field(bag: Bag, topic: str) -> FieldSeries:
    """One pass over the fields: a minute of them would not fit into memory on a small machine."""
    scalars: list[tuple[float, float, float, float]] = []
    total: FloatArray | None = None
    highest: Any = None
    for log_time, message in bag.decoded(topic):
        scalars.append((log_time * 1e-9, message.load, message.peak, message.area))
        if highest is None or message.peak > highest[1].peak:
            highest = (log_time * 1e-9, message)
        if total is None:
            total = np.zeros(len(message.pressure))
        total += message.pressure
    if total is None:
        raise BagError(f"{topic} holds no pressure field")
    time, load, peak, area = np.array(scalars).T
    grid = highest[1]
    average = _pressure_map(grid, total / len(scalars))
    return FieldSeries(time, load, peak, area, _pressure_map(grid, grid.pressure), highest[0], average)


def _pressure_map(message: Any, pressure: Any) -> PressureMap:
    grid = np.array(pressure, dtype=np.float64).reshape(message.rows, message.cols)
    return PressureMap(grid, message.cell_x, message.cell_y, message.origin_x, message.origin_y)
