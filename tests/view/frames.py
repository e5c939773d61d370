"""A small run written by hand, and the frames of the page as a client of its own reads them."""

import asyncio
import json
import struct
from pathlib import Path

import numpy
from tests.bag.hand_made import BLOCK, Content, seat_ride, write
from tests.standard.records import hertz_patch, motion_of
from websockets.asyncio.client import connect

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.records.messages import ContactForce, SolverCost

BLOCKS = 50
"""of 10 ms"""


def force_of(block: int) -> ContactForce:
    """600 N in block 0 and 1 N more in each block; ten samples 1 ms apart."""
    normal = numpy.full(10, 600.0 + block)
    return ContactForce(
        block=block, sample_period=1e-3, normal=normal, tangential=0.1 * normal, approach=0.0 * normal,
        effective_height=0.0 * normal,
    )  # fmt: skip


def patch_of_block(block: int):
    """A Hertz contact whose load is that of the block."""
    return hertz_patch()._replace(block=block, load=600.0 + block)


def written(folder: Path) -> Path:
    """A bag of BLOCKS blocks with force, field, motion and cost."""
    ride = seat_ride()
    sent = [message for message in ride.messages if message[0] == "bench/scene"]
    motion = motion_of(("floor_z", "seat_frame_z"), acceleration=numpy.array([1.0, 2.0]))
    for block in range(BLOCKS):
        stamp = block * BLOCK
        sent += [
            ("seat/force", stamp, encode(force_of(block), stamp)),
            ("seat/patch", stamp, encode(patch_of_block(block), stamp)),
            ("bench/motion", stamp, encode(motion._replace(block=block), stamp)),
            ("bench/cost", stamp, encode(SolverCost(block=block, wall_time=5e-3, real_time_factor=2.0), stamp)),
        ]
    write(folder / "bag", Content(ride.texts, sent))
    return folder / "bag"


def read(frame: bytes):
    """What a frame says, the series of each topic [1 + names, points], the bytes of each field [rows, cols]."""
    (length,) = struct.unpack_from("<I", frame)
    about, at = json.loads(frame[4 : 4 + length]), 4 + length
    series, fields = {}, {}
    for plot in about["plots"]:
        shape = 1 + len(plot["names"]), plot["points"]
        series[plot["topic"]] = numpy.frombuffer(frame, "<f4", shape[0] * shape[1], at).reshape(shape)
        at += 4 * shape[0] * shape[1]
    for each in about["maps"]:
        shape = each["rows"], each["cols"]
        fields[each["topic"]] = numpy.frombuffer(frame, "u1", shape[0] * shape[1], at).reshape(shape)
        at += shape[0] * shape[1]
    assert at == len(frame)
    return about, series, fields


class Client:
    """A page's end of the connection, driven call by call."""

    def __init__(self, port: int) -> None:
        self._loop = asyncio.new_event_loop()
        self._socket = self._loop.run_until_complete(connect(f"ws://127.0.0.1:{port}/frames", max_size=None))

    def send(self, do: str, **more) -> None:
        self._loop.run_until_complete(self._socket.send(json.dumps({"do": do, **more})))

    def frame(self, seconds: float = 60.0):
        """The next frame, asked for now."""
        self.send("next")
        return read(self._loop.run_until_complete(asyncio.wait_for(self._socket.recv(), seconds)))

    def until(self, condition):
        """The first frame that a condition holds for."""
        for _ in range(2000):
            found = self.frame()
            if condition(*found):
                return found
        raise AssertionError("no such frame")

    def close(self) -> None:
        self._loop.run_until_complete(self._socket.close())
        self._loop.close()
