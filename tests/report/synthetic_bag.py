"""A bag of a car whose signals are closed forms, so that every number of a report is known beforehand."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger, SolverCost, String

BLOCK_NS = 10_000_000
BLOCK_LENGTH = 0.01  # [s]
SAMPLES = 10  # a block: 1 kHz

TIRE_MEAN, TIRE_AMPLITUDE, TIRE_FREQUENCY = 3000.0, 3600.0, 2.0  # [N], [N], [Hz]; cut off at 0
SEAT_LOAD = 498.0  # [N], steady
TIRE_STIFFNESS = 200e3  # [N/m]
FLOOR_RMS, SEAT_RMS, RIDE_FREQUENCY = 0.8, 1.2, 3.981  # [m/s^2], [m/s^2], [Hz]; |Wk| = 0.9648
PEAK_PRESSURE, PEAK_BLOCK = 450e3, 57  # [Pa]
ROWS, COLS, CELL = 16, 12, 0.01  # [m]
LOADED_CELLS = 6 * 4
WALL_TIME = 0.002  # [s] a block: five times as fast as the clock
SUPPLIED, DISSIPATED, RESIDUAL = 120.0, 100.0, 0.003  # [J], at the end

SCENE = """\
name: synthetic_car
description: closed forms, not a simulation
rig: car
duration: 10.0
block_length: 0.01
accuracy: 0.01
effects:
  tire:
    normal_elastic: {}
    contact_field: {rows: 16, cols: 12, tolerance: 1.0e-06}
  seat:
    normal_elastic: {coefficient: 273000.0, exponent: 1.5}
"""
EXCITATION = {
    "platform/vibration": {"kind": "recorded", "notes": ["17 samples at full scale: clipped", "bias 0.21 m/s^2"]}
}
CAR_TOPICS = (
    "bench/scene", "tire/force", "seat/force", "tire/patch", "bench/motion", "bench/energy", "bench/cost",
)  # fmt: skip


def car_bag(directory: Path, blocks: int = 1000, scene: str = SCENE) -> Bag:
    """A car with a pressure field under the tire and none under the seat."""
    return _write(directory, CAR_TOPICS, blocks, scene)


def seat_bag(directory: Path, blocks: int = 200) -> Bag:
    """A seat alone: no tire, no field."""
    topics = ("seat/force", "bench/motion", "bench/energy", "bench/cost")
    return _write(directory, topics, blocks, "name: synthetic_seat\nrig: seat\n")


def bare_bag(directory: Path) -> Bag:
    """Nothing but force messages: no scene, no cost, no ledger."""
    return _write(directory, ("tire/force",), 20, None)


def _write(directory: Path, topics: tuple[str, ...], blocks: int, scene: str | None) -> Bag:
    kept = {"package_version": "0.0-synthetic", "excitation": json.dumps(EXCITATION)}
    if scene is not None:
        kept["scene"] = scene
    with BagWriter(directory, recorded_topics(topics), kept, reserve_bytes=0, background=False) as writer:
        if scene is not None and "bench/scene" in topics:
            writer.write("bench/scene", 0, encode(String(data=scene)))
        for block in range(blocks):
            stamp = block * BLOCK_NS
            for topic in topics:
                if topic in _ENCODERS:
                    writer.write(topic, stamp, _ENCODERS[topic](block, blocks, stamp))
    return open_bag(directory)


def _times(block: int) -> np.ndarray:
    return block * BLOCK_LENGTH + np.arange(SAMPLES) * BLOCK_LENGTH / SAMPLES


def _tire_force(block: int, _blocks: int, stamp: int) -> bytes:
    wave = TIRE_MEAN + TIRE_AMPLITUDE * np.sin(2.0 * np.pi * TIRE_FREQUENCY * _times(block))
    normal = np.maximum(wave, 0.0)
    zeros = np.zeros(SAMPLES)
    force = ContactForce(
        block=block,
        sample_period=BLOCK_LENGTH / SAMPLES,
        normal=normal,
        tangential=zeros,
        approach=wave / TIRE_STIFFNESS,
        effective_height=zeros,
    )
    return encode(force, stamp, "tire_contact")


def _seat_force(block: int, _blocks: int, stamp: int) -> bytes:
    steady, zeros = np.full(SAMPLES, SEAT_LOAD), np.zeros(SAMPLES)
    force = ContactForce(
        block=block,
        sample_period=BLOCK_LENGTH / SAMPLES,
        normal=steady,
        tangential=zeros,
        approach=np.full(SAMPLES, 0.015),
        effective_height=zeros,
    )
    return encode(force, stamp, "seat_contact")


def _tire_patch(block: int, _blocks: int, stamp: int) -> bytes:
    """Uniform 100 kPa on 6 x 4 cells; one cell is higher in one block."""
    pressure = np.zeros((ROWS, COLS), dtype=np.float32)
    pressure[5:11, 4:8] = 100e3
    if block == PEAK_BLOCK:
        pressure[7, 5] = PEAK_PRESSURE
    load = float(pressure.sum()) * CELL**2
    area = LOADED_CELLS * CELL**2
    centre = (-(ROWS - 1) / 2 * CELL, -(COLS - 1) / 2 * CELL)
    field = ContactPatch(
        block=block, cell_x=CELL, cell_y=CELL, origin_x=centre[0], origin_y=centre[1], load=load, peak=float(pressure.max()),
        mean=load / area, area=area, centre_x=0.0, centre_y=0.0, approach=0.015, lame_a=0.03, lame_b=0.02, lame_n=6.0,
        pressure=pressure,
    )  # fmt: skip
    return encode(field, stamp, "tire_contact")


def _motion(block: int, _blocks: int, stamp: int) -> bytes:
    omega = 2.0 * np.pi * RIDE_FREQUENCY
    wave = math.sqrt(2.0) * np.sin(omega * _times(block))
    acceleration = np.stack([FLOOR_RMS * wave, SEAT_RMS * wave, SEAT_RMS * wave])
    rates = np.zeros_like(acceleration)
    bodies = ("body_z", "seat_frame_z", "occupant1_z")
    motion = BodyMotion(
        block=block,
        sample_period=BLOCK_LENGTH / SAMPLES,
        bodies=bodies,
        position=-acceleration / omega**2,
        velocity=rates,
        acceleration=acceleration,
    )
    return encode(motion, stamp)


def _energy(block: int, blocks: int, stamp: int) -> bytes:
    part = block / (blocks - 1)
    supplied, dissipated, residual = SUPPLIED * part, DISSIPATED * part, RESIDUAL * part
    kinetic = supplied - dissipated - residual
    return encode(
        EnergyLedger(
            block=block,
            kinetic=kinetic,
            potential=0.0,
            stored=0.0,
            dissipated=dissipated,
            supplied=supplied,
            residual=residual,
        ),
        stamp,
    )


def _cost(block: int, _blocks: int, stamp: int) -> bytes:
    jump = 2.5 if block == PEAK_BLOCK % 20 else 0.5
    cost = SolverCost(
        block=block,
        wall_time=WALL_TIME,
        real_time_factor=BLOCK_LENGTH / WALL_TIME,
        steps=12,
        rejected_steps=1,
        events=2,
        field_iterations=30,
        field_residual=1e-7,
        field_jump=jump,
        coupling_steps=4,
        coupling_steps_repeated=1,
        coupling_error=2e-3,
    )
    return encode(cost, stamp)


_ENCODERS = {
    "tire/force": _tire_force,
    "seat/force": _seat_force,
    "tire/patch": _tire_patch,
    "bench/motion": _motion,
    "bench/energy": _energy,
    "bench/cost": _cost,
}
