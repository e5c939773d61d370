"""A bag of a tire and a seat in which no two quantities are equal: no symmetric map, no square cell, no first value
that is the last, no time from zero, no largest value at an end.

All numbers are drawn, so whoever takes one for another, or leaves a block out, is far off. What a test expects it
works out from these arrays by numpy or scipy.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records import messages as records

_RANDOM = np.random.default_rng(20)
BLOCKS, SAMPLES = 7, 4
START_NS, BLOCK_NS, PERIOD = 3_730_000_000, 10_000_000, 0.0025
START = START_NS * 1e-9
STAMPS = START_NS + BLOCK_NS * np.arange(BLOCKS)
TIMES = START + PERIOD * np.arange(BLOCKS * SAMPLES)
ROWS, COLS, CELL_X, CELL_Y, ORIGIN_X, ORIGIN_Y = 6, 4, 0.011, 0.007, -0.021, 0.005
BODIES = ("body_z", "seat_frame_z", "occupant1_z", "wheel_z")
WHEEL, BODY = 41.0, 317.0  # [kg]
STANDING = (WHEEL + BODY) * 9.81  # [N]
SCENE = f"""\
name: uneven
rig: tire
accuracy: 0.01
tire: {{wheel_mass: {WHEEL}, body_mass: {BODY}, suspension_stiffness: 21000.0}}
effects:
  tire: {{contact_field: {{}}}}
  seat: {{cushion: {{thickness: 0.09}}}}
seat: {{occupant: {{}}}}
"""


def _drawn(low: float, high: float, *shape: int) -> np.ndarray:
    return _RANDOM.uniform(low, high, shape)


def _forces(weight: float, *lifted: int) -> dict[str, np.ndarray]:
    """Columns of a `ContactForce`, all samples; no load at some of them."""
    count = BLOCKS * SAMPLES
    found = {
        "normal": _drawn(0.6, 1.4, count) * weight, "tangential": _drawn(-300.0, 200.0, count),
        "approach": _drawn(0.011, 0.029, count), "effective_height": _drawn(0.001, 0.004, count),
        "impulses": _drawn(20.0, 90.0, count),
    }  # fmt: skip
    found["normal"][list(lifted)] = 0.0
    return found


FORCES = {"tire": _forces(STANDING, 9, 10, 20), "seat": _forces(560.0, 3, 14, 15, 16, 25)}
_AXLE_FROM = {
    "longitudinal": -410.0,
    "vertical": 10.0,
    "lateral": -70.0,
    "moment_y": 1.0,
    "moment_z": -8.0,
    "spin": 30.0,
}
AXLE = {name: _drawn(low, 90.0, BLOCKS * SAMPLES) for name, low in _AXLE_FROM.items()}
MOTION = {name: _drawn(-3.0, 2.0, len(BODIES), BLOCKS * SAMPLES) for name in ("position", "velocity", "acceleration")}
PRESSURES = {name: _drawn(5e3, 90e3, BLOCKS, ROWS, COLS).astype(np.float32) for name in ("tire", "seat")}
"""[blocks, rows, cols]; loaded from row 1 on over `LENGTHS` cells and from column 0 on over `WIDTHS`, one block nowhere"""
LENGTHS, WIDTHS = (4, 3, 5, 2, 5, 3, 4), (3, 2, 1, 3, 2, 3, 1)
EMPTY = {"tire": 3, "seat": 5}
FIELDS = {
    name: {
        "load": _drawn(0.7, 1.3, BLOCKS) * load, "peak": _drawn(2e5, 4e5, BLOCKS), "mean": _drawn(5e4, 9e4, BLOCKS),
        "area": _drawn(0.011, 0.023, BLOCKS), "centre_x": _drawn(-0.01, 0.03, BLOCKS), "centre_y": _drawn(-0.02, 0.01, BLOCKS),
        "approach": _drawn(0.011, 0.02, BLOCKS), "lame_a": _drawn(0.05, 0.09, BLOCKS), "lame_b": _drawn(0.02, 0.04, BLOCKS),
        "lame_n": _drawn(2.0, 5.0, BLOCKS),
    }
    for name, load in (("tire", STANDING), ("seat", 560.0))
}  # fmt: skip
FIELDS["tire"]["peak"][4], FIELDS["seat"]["peak"][2] = 4.3e5, 4.7e5  # not where the load is largest
for _name, _empty in EMPTY.items():
    for _block, (_length, _width) in enumerate(zip(LENGTHS, WIDTHS, strict=True)):
        PRESSURES[_name][_block, 0] = PRESSURES[_name][_block, 1 + _length :] = PRESSURES[_name][_block, :, _width:] = (
            0.0
        )
    PRESSURES[_name][_empty] = 0.0
    for _column in FIELDS[_name].values():
        _column[_empty] = 0.0
LEDGER = {
    name: _drawn(low, high, BLOCKS)
    for name, low, high in (
        ("kinetic", 11.0, 19.0), ("potential", -230.0, -210.0), ("stored", 21.0, 29.0), ("dissipated", 60.0, 90.0),
        ("supplied", 100.0, 190.0), ("residual", 0.01, 0.09),
    )
}  # fmt: skip
LEDGER["residual"][4] = -0.7
ESTIMATED = ("tire/force.normal", "tire/patch.peak", "seat/force.normal", "tire/patch.area")
ERRORS, LARGEST = _drawn(1.0, 30.0, BLOCKS, 4) * [1.0, 0.3, 1.0, 0.4], _drawn(4000.0, 9000.0, BLOCKS, 4)
COSTS = {
    "wall_time": _drawn(0.002, 0.009, BLOCKS), "real_time_factor": _drawn(1.0, 3.0, BLOCKS),
    "field_residual": _drawn(1e-8, 9e-8, BLOCKS), "field_jump": _drawn(1.0, 7.0, BLOCKS),
    "coupling_error": _drawn(1e-4, 9e-4, BLOCKS),
} | {
    name: 10 * (place + 1) + _RANDOM.permutation(BLOCKS)
    for place, name in enumerate(
        ("steps", "rejected_steps", "events", "field_iterations", "coupling_steps", "coupling_steps_repeated")
    )
}  # fmt: skip
EPISODES = {
    name: _drawn(0.1, 0.9, 5)
    for name in ("start", "end", "compression_work", "restitution_work", "restitution", "peak_force", "largest_approach")
}  # fmt: skip
STANDS = {
    name: float(_drawn(low, 1.2 * low))
    for name, low in (
        ("load", 3400.0), ("deflection", 0.013), ("stiffness", 190e3), ("length", 0.11), ("width", 0.14), ("area", 0.013),
        ("mean_pressure", 210e3),
    )
}  # fmt: skip
ENDED = (2, 0, 3)  # episodes of the first blocks
TOPICS = (
    "bench/scene", "tire/force", "seat/force", "tire/axle", "tire/standing", "tire/patch", "seat/patch", "bench/motion",
    "bench/energy", "bench/cost", "bench/episodes",
)  # fmt: skip


def uneven_bag(directory: Path) -> Bag:
    """The bag."""
    with BagWriter(directory, recorded_topics(TOPICS), {"scene": SCENE}, reserve_bytes=0, background=False) as writer:
        writer.write("bench/scene", START_NS, encode(records.String(data=SCENE)))
        for block in range(BLOCKS):
            for topic, record in _records(block):
                writer.write(topic, int(STAMPS[block]), encode(record, int(STAMPS[block]), f"{topic}_frame"))
    return open_bag(directory)


def _records(block: int) -> list[tuple[str, Any]]:
    part, common = slice(block * SAMPLES, (block + 1) * SAMPLES), {"block": block + 11, "sample_period": PERIOD}

    def samples(columns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values[..., part] for name, values in columns.items()}

    def row(columns: dict[str, np.ndarray]) -> dict[str, Any]:
        return {"block": block + 11} | {name: values[block].item() for name, values in columns.items()}

    grid = {"cell_x": CELL_X, "cell_y": CELL_Y, "origin_x": ORIGIN_X, "origin_y": ORIGIN_Y}
    found: list[tuple[str, Any]] = []
    for name in ("tire", "seat"):
        found += [
            (f"{name}/force", records.ContactForce(**common, **samples(FORCES[name]))),
            (f"{name}/patch", records.ContactPatch(**row(FIELDS[name]), **grid, pressure=PRESSURES[name][block])),
        ]
    estimates = {"estimated": ESTIMATED, "estimated_error": ERRORS[block], "estimated_of": LARGEST[block]}
    found += [
        ("tire/axle", records.AxleForce(**common, **samples(AXLE))),
        ("bench/motion", records.BodyMotion(**common, bodies=BODIES, **samples(MOTION))),
        ("bench/energy", records.EnergyLedger(**row(LEDGER))),
        ("bench/cost", records.SolverCost(**row(COSTS), **estimates)),
    ]
    if block == 0:
        found.append(("tire/standing", records.TireStanding(block=11, **STANDS)))
    if block < len(ENDED) and ENDED[block]:
        first = sum(ENDED[:block])
        ended = {name: values[first : first + ENDED[block]] for name, values in EPISODES.items()}
        kind = {
            "point": np.arange(first, first + ENDED[block], dtype=np.int32),
            "touched": np.ones(ENDED[block], np.uint8),
        }
        found.append(("bench/episodes", records.ContactEpisodes(block=block + 11, **kind, **ended)))
    return found
