"""Messages to record, small and of every kind that the bag tests need."""

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.topics import full_name
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import ContactForce, ContactPatch, RoadPatch, String
from contact_sim_pkg.run.outputs import wrench_of

Encoded = list[tuple[str, int, bytes]]

BLOCK = 10_000_000  # [ns]
TOPICS = ("bench/scene", "road/patch", "tire/force", "tire/wrench", "tire/patch")
COLUMNS = ("normal", "tangential", "approach", "effective_height")


def encoded_block(block: int) -> Encoded:
    """The messages of one block in canonical order; every value depends on the block number alone."""
    stamp = block * BLOCK
    rng = numpy.random.default_rng(block)
    road = RoadPatch(
        block=block,
        travel_start=0.1 * block,
        travel_end=0.1 * (block + 1),
        first_row=3 * block - 2,
        cell_x=0.01,
        cell_y=0.02,
        height=rng.random((6, 4), numpy.float32),
    )
    force = ContactForce(block=block, sample_period=1e-3, **dict(zip(COLUMNS, rng.random((4, 10)), strict=True)))
    wrench = wrench_of((float(block), 0.5, 2.0), (0.0, -1.0, 3.0))
    field = ContactPatch(
        **dict(zip(ContactPatch._fields[1:-1], rng.random(14), strict=True)),
        block=block,
        pressure=rng.random((4, 3), numpy.float32),
    )
    return [
        ("road/patch", stamp, encode(road, stamp)),
        ("tire/force", stamp, encode(force, stamp, "tire_contact")),
        ("tire/wrench", stamp, encode(wrench, stamp, "tire_contact")),
        ("tire/patch", stamp, encode(field, stamp, "tire_contact")),
    ]


@pytest.fixture
def encoded() -> Encoded:
    """A scene and 50 blocks of four messages."""
    blocks = [message for block in range(50) for message in encoded_block(block)]
    return [("bench/scene", 0, encode(String(data="rig: tire\n"))), *blocks]


@pytest.fixture
def record(tmp_path: Path, encoded: Encoded) -> Callable[..., Path]:
    """Records the messages into a new bag, closing a chunk every five blocks of the injected clock."""

    def write(name: str = "ride", *, close: bool = True, shown: Callable[[str], str] = full_name) -> Path:
        time = [0.0]
        texts = {"scene": "rig: tire\n", "numpy": "2.2.6", "kernel_fingerprint": "0f" * 8}
        place = tmp_path / name if close else tmp_path / "live" / name
        writer = BagWriter(
            place,
            recorded_topics(TOPICS, shown),
            texts,
            clock=lambda: time[0],
            free_bytes=lambda: 10**12,
            background=False,
        )
        for number, (topic, stamp, data) in enumerate(encoded):
            time[0] = number * 0.1 / 20
            writer.write(topic, stamp, data)
        if close:
            assert writer.close().complete
        else:
            shutil.copytree(place, tmp_path / name)  # what a killed recording leaves; the live one keeps its lock
        return tmp_path / name

    return write
