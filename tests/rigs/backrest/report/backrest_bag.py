"""Bags of a backrest in closed form: a sinusoidal approach on spring and damper, friction of a spring and a damper along it."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactEpisodes,
    ContactForce,
    ContactPatch,
    ContactPoints,
    EnergyLedger,
    SolverCost,
    String,
)

BLOCK_NS, BLOCK_LENGTH, SAMPLES = 10_000_000, 0.01, 10
BLOCKS = 200  # two seconds
REST = 0.01  # [m] approach under the static load
KEPT, SLAPPING = 0.005, 0.03  # [m] amplitude of the approach
STIFFNESS, DAMPING = 40e3, 150.0  # [N/m], [N s/m] of the normal force
SLIDING = 0.008  # [m]
FRICTION_STIFFNESS, FRICTION_DAMPING = 30e3, 600.0
ROWS, COLS, CELL_X, CELL_Y = 10, 8, 0.05, 0.04  # [m]
REST_CELLS, DEEP_CELLS = 2 * 2, 6 * 4  # under load up to the approach at rest, and beyond
WORKS = (-8.0, 2.0)  # [J] of every slap: restitution 1/2
TOPICS = (
    "bench/scene", "backrest/force", "backrest/patch", "backrest/points", "bench/episodes", "bench/motion",
    "bench/energy", "bench/cost",
)  # fmt: skip


def scene(frequency: float) -> str:
    """Resolved scene, as far as the analysis reads it."""
    return f"""\
name: synthetic_backrest
rig: backrest
block_length: 0.01
vibration: {{kind: sine, frequency: {frequency}, amplitude: 10.0}}
backrest: {{sliding: {{amplitude: {SLIDING}, frequency: {frequency}}}}}
effects:
  backrest:
    normal_elastic: {{coefficient: 40000.0, exponent: 1.0}}
"""


def approach(time: np.ndarray, frequency: float, amplitude: float) -> tuple[np.ndarray, np.ndarray]:
    """Approach [m] and its rate [m/s]."""
    omega = 2.0 * math.pi * frequency
    return REST + amplitude * np.sin(omega * time), amplitude * omega * np.cos(omega * time)


def forces(time: np.ndarray, frequency: float, amplitude: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Normal force, friction on the back [N], and displacement of the back [m]."""
    omega = 2.0 * math.pi * frequency
    deep, rate = approach(time, frequency, amplitude)
    normal = np.where(deep > 0.0, np.maximum(STIFFNESS * deep + DAMPING * rate, 0.0), 0.0)
    slid, speed = SLIDING * np.sin(omega * time), SLIDING * omega * np.cos(omega * time)
    return normal, np.where(normal > 0.0, -FRICTION_STIFFNESS * slid - FRICTION_DAMPING * speed, 0.0), slid


def touches(frequency: float) -> np.ndarray:
    """[s] when the slapping approach passes 0 upwards within the run, those whose loss lies within it."""
    omega = 2.0 * math.pi * frequency
    first = (2.0 * math.pi - math.asin(REST / SLAPPING)) / omega
    return first + np.arange(math.floor((BLOCKS * BLOCK_LENGTH - first) * frequency - 0.7)) / frequency


def backrest_bag(directory: Path, frequency: float = 5.0, *, slaps: bool = True, points: int = 1) -> Bag:
    """A run of two seconds; with many points the middle two share the force while it is small, all of them else."""
    amplitude = SLAPPING if slaps else KEPT
    with BagWriter(
        directory, recorded_topics(TOPICS), {"scene": scene(frequency)}, reserve_bytes=0, background=False
    ) as writer:
        writer.write("bench/scene", 0, encode(String(data=scene(frequency))))
        for block in range(BLOCKS):
            _write_block(writer, block, frequency, amplitude, points)
    return open_bag(directory)


def _write_block(writer: BagWriter, block: int, frequency: float, amplitude: float, points: int) -> None:
    stamp = block * BLOCK_NS
    time = block * BLOCK_LENGTH + np.arange(SAMPLES) * BLOCK_LENGTH / SAMPLES
    normal, tangential, slid = forces(time, frequency, amplitude)
    deep, rate = approach(time, frequency, amplitude)
    period = BLOCK_LENGTH / SAMPLES
    force = ContactForce(
        block=block,
        sample_period=period,
        normal=normal,
        tangential=tangential,
        approach=deep,
        effective_height=np.zeros(SAMPLES),
    )
    writer.write("backrest/force", stamp, encode(force, stamp, "backrest_contact"))
    patch = encode(_patch(block, float(normal[0]), float(deep[0])), stamp, "backrest_contact")
    writer.write("backrest/patch", stamp, patch)
    at = (float(normal[0]), float(tangential[0]), float(deep[0]), float(slid[0]))
    point = encode(_points(block, points, *at), stamp, "backrest_contact")
    writer.write("backrest/points", stamp, point)
    ended = touches(frequency) if amplitude == SLAPPING else np.zeros(0)
    ended = ended[(ended + 0.5 / frequency >= time[0]) & (ended + 0.5 / frequency < time[0] + BLOCK_LENGTH)]
    if ended.size:
        writer.write("bench/episodes", stamp, encode(_episodes(block, ended, frequency), stamp))
    motion = BodyMotion(
        block=block,
        sample_period=period,
        bodies=("occupant_x",),
        position=-deep[None],
        velocity=-rate[None],
        acceleration=np.zeros((1, SAMPLES)),
    )
    writer.write("bench/motion", stamp, encode(motion, stamp))
    writer.write(
        "bench/energy",
        stamp,
        encode(
            EnergyLedger(
                block=block, kinetic=0.0, potential=0.0, stored=0.0, dissipated=1.0, supplied=1.0, residual=0.0
            ),
            stamp,
        ),
    )
    cost = SolverCost(
        block=block,
        wall_time=2e-3,
        real_time_factor=5.0,
        steps=12,
        rejected_steps=1,
        events=2,
        field_iterations=0,
        field_residual=0.0,
        field_jump=0.0,
        coupling_steps=0,
        coupling_steps_repeated=0,
        coupling_error=0.0,
    )
    writer.write("bench/cost", stamp, encode(cost, stamp))


def _patch(block: int, load: float, deep: float) -> ContactPatch:
    pressure = np.zeros((ROWS, COLS), dtype=np.float32)
    cells = 0 if load <= 0.0 else REST_CELLS if deep <= REST else DEEP_CELLS
    half_rows, half_cols = {0: (0, 0), REST_CELLS: (1, 1), DEEP_CELLS: (3, 2)}[cells]
    place = (slice(ROWS // 2 - half_rows, ROWS // 2 + half_rows), slice(COLS // 2 - half_cols, COLS // 2 + half_cols))
    if cells:
        pressure[place] = load / (cells * CELL_X * CELL_Y)
    peak = float(pressure.max())
    return ContactPatch(
        block=block, cell_x=CELL_X, cell_y=CELL_Y, origin_x=-(ROWS - 1) / 2 * CELL_X,
        origin_y=-(COLS - 1) / 2 * CELL_Y, load=load, peak=peak, mean=peak, area=cells * CELL_X * CELL_Y, centre_x=0.0,
        centre_y=0.0, approach=deep, lame_a=half_rows * CELL_X, lame_b=half_cols * CELL_Y, lame_n=2.0,
        pressure=pressure,
    )  # fmt: skip


def _points(block: int, count: int, normal: float, tangential: float, deep: float, slid: float) -> ContactPoints:
    share = np.zeros(count)
    inner = slice(max(0, count // 2 - 1), count // 2 + 1)
    share[inner if deep <= REST else slice(0, count)] = 1.0
    share = share / share.sum() * (1.0 + 1e-6 * (np.arange(count) == count // 2))  # one carries a little more
    share = share / share.sum()
    state = np.where((share > 0.0) & (normal > 0.0), 2 if slid > 0.0 else 3, 0).astype(np.uint8)
    line = (np.arange(count) - (count - 1) / 2) * CELL_X
    return ContactPoints(
        block=block,
        x=line,
        y=np.zeros(count),
        approach=np.full(count, deep),
        normal=share * normal,
        tangential=share * tangential,
        displacement=np.full(count, slid),
        state=state,
    )


def _episodes(block: int, start: np.ndarray, frequency: float) -> ContactEpisodes:
    count = start.size
    return ContactEpisodes(
        block=block, point=np.full(count, ContactEpisodes.WHOLE_CONTACT, dtype=np.int32),
        touched=np.ones(count, dtype=np.uint8), start=start, end=start + 0.5 / frequency,
        compression_work=np.full(count, WORKS[0]), restitution_work=np.full(count, WORKS[1]),
        restitution=np.full(count, 0.5), peak_force=np.full(count, 1600.0),
        largest_approach=np.full(count, REST + SLAPPING),
    )  # fmt: skip
