"""`bench serve`: the process that steps a unit. Messages come and go by two files, as `bench_process.h` says.

| question | content | answer |
|---|---|---|
| – | | `h`: block length, duration [s], numbers of outputs and inputs, GUID |
| `r` reset | | `k`: outputs |
| `s` step | number of blocks, held | `k`: outputs |
| `g` get the state | held | `k`: the state |
| `l` load a state | the state | `k`: number of blocks done, held, outputs |

*held* is what the host has set: whether the inputs act (0 or 1), their values, their derivatives with time. Numbers are doubles
and integers of eight bytes. An answer `e` is a sentence: nothing was changed, or the run has ended in a failure.
"""

from __future__ import annotations

import hashlib
import json
import struct
from pathlib import Path
from typing import Any, BinaryIO

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.files import RefusedError, read_regular_file
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.saved_state import StateError
from contact_sim_pkg.scene.resolve import read_explicit
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.steering.contact_bench import ContactBench
from contact_sim_pkg.steering.fmu.last_row import LastRows

__all__ = ["UnitError", "serve"]

MOST = 64 << 20  # [bytes] of a file of a unit
LONGEST = 1 << 32  # [bytes] of a question
ANSWERED = (RefusedError, RunError, StateError, ValueError)
HEADER = struct.Struct("<cQ")
DIGEST = 32

Values = NDArray[numpy.float64]


class UnitError(RefusedError):
    """A folder is not what an exported unit holds."""


class Unit:
    """A bench with the values of its outputs."""

    def __init__(self, folder: Path) -> None:
        """Of the folder ``resources`` of a unit; compiles or loads its kernels.

        Raises:
            UnitError: the folder holds no unit. SceneError: the scene or its files are not what they were.
            RunError: this bench lacks a column.
        """
        try:
            self._model: dict[str, Any] = json.loads(read_regular_file(folder / "model.json", MOST))
            text = read_regular_file(folder / "scene.yaml", MOST).decode()
            self.guid = str(self._model["guid"])
            columns = [(str(topic), str(column)) for topic, column in self._model["outputs"]]
            held = {str(where): folder / str(name) for where, name in self._model["files"].items()}
            self.inputs = len(self._model["inputs"])
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise UnitError(f"{folder} holds no unit of the bench: {type(error).__name__} {error}") from None
        self.bench = ContactBench(ResolvedScene(read_explicit(text, str(folder / "scene.yaml")), held))
        self.rows = LastRows(columns)

    def greeting(self) -> bytes:
        """The first message."""
        bench = self.bench
        length, duration = bench.block_length, bench.blocks * bench.block_length
        return struct.pack("<ddQQ", length, duration, self.rows.values.size, self.inputs) + self.guid.encode()

    def answer(self, kind: bytes, content: bytes) -> bytes:
        """The content of the answer to a question. Raises one of `ANSWERED`."""
        known = {b"s": self._step, b"r": self._reset, b"g": self._get, b"l": self._load}
        if kind not in known:
            raise UnitError(f"there is no question {kind!r}")
        return known[kind](content)

    def _reset(self, _content: bytes) -> bytes:
        self.bench.reset()
        self.rows.clear()
        return self.rows.values.tobytes()

    def _step(self, content: bytes) -> bytes:
        count = int.from_bytes(content[:8], "little")
        held: Values = numpy.frombuffer(content[8:])
        duration = count * self.bench.block_length
        vibration = self._vibration(count, held) if self.inputs and held[0] else None
        self.rows.take(self.bench.step(duration, vibration).outputs)
        return self.rows.values.tobytes()

    def _vibration(self, count: int, held: Values) -> Values:
        """Samples [samples + 1, 2] of a step: the values set, with their slopes."""
        vibration = self.bench.scene.vibration
        assert vibration is not None
        samples = count * round(vibration.sample_rate * self.bench.block_length)
        times = numpy.arange(samples + 1) / vibration.sample_rate
        values, slopes = held[1 : 1 + self.inputs], held[1 + self.inputs :]
        found: Values = values + times[:, None] * slopes
        return found

    def _get(self, content: bytes) -> bytes:
        body = content + self.rows.values.tobytes() + self.bench.save()
        return hashlib.sha256(body).digest() + body

    def _load(self, content: bytes) -> bytes:
        held, size = 8 * (1 + 2 * self.inputs), self.rows.values.nbytes
        body = content[DIGEST:]
        if len(body) < held + size or hashlib.sha256(body).digest() != content[:DIGEST]:
            raise StateError("these bytes are no state of the unit, or were changed")
        self.bench.load(body[held + size :])
        self.rows.values[:] = numpy.frombuffer(body[held : held + size])
        blocks = round(self.bench.time / self.bench.block_length)
        return blocks.to_bytes(8, "little") + body[: held + size]


def serve(folder: Path, questions: BinaryIO, answers: BinaryIO) -> None:
    """Answer the questions about a unit until they end. Raises as `Unit`."""
    unit = Unit(folder)
    _send(answers, b"h", unit.greeting())
    while len(header := questions.read(HEADER.size)) == HEADER.size:
        kind, length = HEADER.unpack(header)
        if length > LONGEST:
            raise UnitError(f"a question of {length} bytes")
        content = questions.read(length)
        if len(content) < length:
            return
        try:
            answer = unit.answer(kind, content)
        except ANSWERED as error:
            _send(answers, b"e", str(error).encode())
        else:
            _send(answers, b"k", answer)


def _send(answers: BinaryIO, kind: bytes, content: bytes) -> None:
    answers.write(HEADER.pack(kind, len(content)) + content)
    answers.flush()
