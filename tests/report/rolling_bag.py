"""A bag of a tire that rolls on a flat road with one step: Hertz fields, forces and heights in closed form."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.special

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, ContactShear, RoadPatch, String

BLOCK_NS, BLOCK_LENGTH, SAMPLES = 10_000_000, 0.01, 10
SPEED = 10.0  # [m/s]
RADIUS_X, RADIUS_Y = 0.3, 1.0  # [m]
YOUNG, POISSON = 3e6, 0.5
MODULUS = YOUNG / (1.0 - POISSON**2)
MASS = 340.0  # [kg] wheel and body
STANDING = MASS * 9.81  # [N]
HEAVY_BLOCK, HEAVY = 60, 8.0  # eight times the standing load: twice the pressure
LIFTED_BLOCKS = range(70, 73)
STEP_AT, STEP = 5.0, 0.01  # [m]
ROWS, COLS, CELL_X, CELL_Y = 64, 96, 0.004, 0.005  # [m]
FRICTION = 0.6
WHEEL_AMPLITUDE, WHEEL_FREQUENCY = 50.0, 10.0  # [m/s^2], [Hz]

SCENE = f"""\
name: synthetic_rolling
rig: tire
block_length: 0.01
road: {{kind: cleat}}
tire:
  wheel_mass: 40.0
  body_mass: {MASS - 40.0}
effects:
  tire:
    normal_elastic:
      radius_rolling: {RADIUS_X}
      radius_lateral: {RADIUS_Y}
      young_modulus: {YOUNG}
      poisson_ratio: {POISSON}
    contact_field: {{rows: {ROWS}, cols: {COLS}}}
"""
TOPICS = ("bench/scene", "road/patch", "tire/force", "tire/patch", "bench/motion")


def ellipse(load: float) -> tuple[float, float, float, float]:
    """Semi-axes along x and y, peak pressure and approach of the Hertz contact; m by bisection on Johnson's relation."""
    a, b = 0.5 / RADIUS_Y, 0.5 / RADIUS_X  # smaller and larger curvature
    low, high = 1e-9, 1.0 - 1e-9
    for _ in range(200):
        m = 0.5 * (low + high)
        k, e = scipy.special.ellipk(m), scipy.special.ellipe(m)
        ratio = (1.0 - m) * (k - e) / (e - (1.0 - m) * k)  # A / B, falls with m
        low, high = (m, high) if ratio > a / b else (low, m)
    mean = a + b
    peak = np.cbrt(3.0 * load * MODULUS**2 * mean**2 / (2.0 * np.pi)) * e ** (-2.0 / 3.0) * (1.0 - m) ** (1.0 / 6.0)
    short = peak * e / (MODULUS * mean)
    return short, short / np.sqrt(1.0 - m), float(peak), float(peak * short * k / MODULUS)


def cells() -> tuple[np.ndarray, np.ndarray]:
    """Centres of the cells, [rows, 1] and [1, cols]; one cell lies in the middle along x, none across."""
    x = (np.arange(ROWS) - ROWS // 2) * CELL_X
    y = (np.arange(COLS) - 0.5 * (COLS - 1)) * CELL_Y
    return x[:, None], y[None, :]


def pressure(load: float) -> np.ndarray:
    """Hertz pressure at the centres of the cells, zeros without load."""
    if load <= 0.0:
        return np.zeros((ROWS, COLS))
    along, across, peak, _ = ellipse(load)
    x, y = cells()
    return peak * np.sqrt(np.maximum(1.0 - (x / along) ** 2 - (y / across) ** 2, 0.0))


def load_of(block: int) -> float:
    """[N] of one block."""
    if block in LIFTED_BLOCKS:
        return 0.0
    return STANDING * (HEAVY if block == HEAVY_BLOCK else 1.0)


def rolling_bag(directory: Path, blocks: int = 100, topics: tuple[str, ...] = TOPICS) -> Bag:
    """One second of the rolling tire."""
    with BagWriter(directory, recorded_topics(topics), {"scene": SCENE}, reserve_bytes=0, background=False) as writer:
        for block in range(blocks):
            stamp = block * BLOCK_NS
            if block == 0:
                writer.write("bench/scene", 0, encode(String(data=SCENE)))
            for topic in topics:
                if topic in _ENCODERS:
                    writer.write(topic, stamp, _ENCODERS[topic](block, stamp))
    return open_bag(directory)


def road(block: int) -> RoadPatch:
    """Height 0 up to the step; neighbouring blocks overlap by half a metre."""
    start = block * BLOCK_LENGTH * SPEED
    first = int(np.floor((start - 0.2) / CELL_X))
    x = (first + np.arange(150)) * CELL_X
    height = np.where(x >= STEP_AT, STEP, 0.0)[:, None] * np.ones(COLS)
    return RoadPatch(
        block=block,
        travel_start=start,
        travel_end=start + BLOCK_LENGTH * SPEED,
        first_row=first,
        cell_x=CELL_X,
        cell_y=CELL_Y,
        height=height.astype(np.float32),
    )


def _road(block: int, stamp: int) -> bytes:
    return encode(road(block), stamp)


def _force(block: int, stamp: int) -> bytes:
    normal, zeros = np.full(SAMPLES, load_of(block)), np.zeros(SAMPLES)
    force = ContactForce(
        block=block,
        sample_period=BLOCK_LENGTH / SAMPLES,
        normal=normal,
        tangential=zeros,
        approach=zeros + 0.01,
        effective_height=zeros,
    )
    return encode(force, stamp, "tire_contact")


def _patch(block: int, stamp: int) -> bytes:
    field = pressure(load_of(block)).astype(np.float32)
    load, area = float(field.sum()) * CELL_X * CELL_Y, float((field > 0.0).sum()) * CELL_X * CELL_Y
    along, across, _, approach = ellipse(load) if load > 0.0 else (0.0, 0.0, 0.0, 0.0)
    x, y = cells()
    value = ContactPatch(
        block=block, cell_x=CELL_X, cell_y=CELL_Y, origin_x=float(x[0, 0]), origin_y=float(y[0, 0]), load=load,
        peak=float(field.max()), mean=load / area if area else 0.0, area=area, centre_x=0.0, centre_y=0.0,
        approach=approach, lame_a=along, lame_b=across, lame_n=2.0, pressure=field,
    )  # fmt: skip
    return encode(value, stamp, "tire_contact")


def slip_of(block: int) -> float:
    """Braking that grows to a locked wheel at block 80."""
    return -min(block / 80, 1.0)


def _shear(block: int, stamp: int) -> bytes:
    """Shear of FRICTION times the pressure, backward; the rear half slips, from block 50 on all of it."""
    field = pressure(load_of(block))
    x, y = cells()
    state = np.where(field > 0.0, np.where((x < 0.0) | (block >= 50), 2, 1), 0).astype(np.uint8)
    shear_x = -FRICTION * field
    force = float(shear_x.sum()) * CELL_X * CELL_Y
    share = float((state == 2).sum() / max((state > 0).sum(), 1))
    value = ContactShear(
        block=block, cell_x=CELL_X, cell_y=CELL_Y, origin_x=float(x[0, 0]), origin_y=float(y[0, 0]),
        slip=slip_of(block), slip_angle=0.0, force_x=force, force_y=0.0, moment_z=0.0, sliding_share=share,
        dissipated=2.0, shear_x=shear_x.astype(np.float32), shear_y=np.zeros((ROWS, COLS), dtype=np.float32),
        state=state,
    )  # fmt: skip
    return encode(value, stamp, "tire_contact")


def _motion(block: int, stamp: int) -> bytes:
    times = block * BLOCK_LENGTH + np.arange(SAMPLES) * BLOCK_LENGTH / SAMPLES
    wheel = WHEEL_AMPLITUDE * np.sin(2.0 * np.pi * WHEEL_FREQUENCY * times)
    rows = np.stack([wheel, np.zeros(SAMPLES), np.zeros(SAMPLES)])
    motion = BodyMotion(
        block=block,
        sample_period=BLOCK_LENGTH / SAMPLES,
        bodies=("wheel_z", "body_z", "belt_z"),
        position=rows,
        velocity=rows,
        acceleration=rows,
    )
    return encode(motion, stamp)


_ENCODERS = {
    "road/patch": _road,
    "tire/force": _force,
    "tire/patch": _patch,
    "tire/shear": _shear,
    "bench/motion": _motion,
}
