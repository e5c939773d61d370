"""The bench in the hands of a program: reset, step, read, with an excitation of one's own where it is wanted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import VibrationBlock
from contact_sim_pkg.report.export.table import has_columns, table_of_records
from contact_sim_pkg.report.export.time_series import Series, series_of
from contact_sim_pkg.run.block_simulation import InputBlock
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.live_parameters import Parameter
from contact_sim_pkg.run.saved_state import load_state, open_state, save_state
from contact_sim_pkg.run.steered_run import SteeredRun
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ContactBench", "Step"]

NANOSECONDS = 1_000_000_000
VIBRATION = "platform/vibration"
ROUNDING = 1e-9  # of a block


class Step(Mapping[str, Series]):
    """What the topics of a step hold: ``step["seat/force"]["normal"]``, ``step["seat/force"].units["normal"]``.

    Wrenches are left out: they repeat the forces. Pressure fields are in ``outputs``.

    Attributes:
        start, end: [s].
        outputs: records with their topics and stamps, as they would be published.
    """

    def __init__(self, start: float, end: float, outputs: list[Output]) -> None:
        """Of all outputs between two times."""
        self.start, self.end, self.outputs = start, end, outputs
        self._by_topic: dict[str, list[Output]] = {}
        for each in filter(lambda each: has_columns(each.record), outputs):
            self._by_topic.setdefault(each.topic, []).append(each)
        self._known: dict[str, Series] = {}

    def __getitem__(self, topic: str) -> Series:
        """The series of a topic. Raises KeyError, which names those that are there."""
        if topic not in self._by_topic:
            raise KeyError(f"there is no topic {topic!r} in this step; there are {', '.join(self._by_topic)}")
        if topic not in self._known:
            found = self._by_topic[topic]
            times = [each.stamp / NANOSECONDS for each in found]
            self._known[topic] = series_of(table_of_records(topic, times, [each.record for each in found]))
        return self._known[topic]

    def __iter__(self) -> Iterator[str]:
        """Topics."""
        return iter(self._by_topic)

    def __len__(self) -> int:
        """Number of topics."""
        return len(self._by_topic)


class ContactBench:
    """A scene that a program steps: the same bits as its run, in whole blocks.

    Attributes:
        scene: resolved.
        block_length: [s], the step.
        blocks: number of blocks of the scene.
        inputs: topics of its excitation.
    """

    def __init__(self, scene: ResolvedScene | str | Path, *values: str) -> None:
        """Make the bench and compile or load its kernels.

        Args:
            scene: a scene, or its name or path.
            values: such as ``"duration=10"``, of a scene by name or path.

        Raises:
            SceneError: the scene is faulty.
            ValueError: values for a scene that is resolved.
        """
        self._name = None if isinstance(scene, ResolvedScene) else (str(scene), values)
        if isinstance(scene, ResolvedScene) and values:
            raise ValueError("values are for a scene by its name; a resolved one has none left open")
        self._build(scene if isinstance(scene, ResolvedScene) else _resolved(str(scene), values))

    def _build(self, scene: ResolvedScene) -> None:
        self.scene = scene
        self.block_length = scene.block_length
        self._run = SteeredRun(scene)
        self._run.simulation.prepare()
        self.blocks, self.inputs = self._run.simulation.blocks, tuple(self._run.sources)
        self._block = 0
        self._is_broken = False

    @property
    def time(self) -> float:
        """Simulated so far [s]."""
        return self._block * self.block_length

    @property
    def is_over(self) -> bool:
        """Whether the scene has no further block."""
        return self._block >= self.blocks

    def reset(self, seed: int | None = None) -> None:
        """Go back to the start, with another ``seed`` of the excitation where one is given.

        Raises ValueError for a seed of a bench that was made of a resolved scene.
        """
        if seed is not None:
            if self._name is None:
                raise ValueError("another seed needs a bench made of the name or path of a scene")
            name, values = self._name
            self._build(_resolved(name, (*values, f"seed={seed}")))
            return
        self._run = self._run.restarted()
        self._block, self._is_broken = 0, False

    def save(self) -> bytes:
        """The state between two steps, as bytes: `load` goes on from it with the same bits, here, in another bench of
        the scene, or in another process. Raises StateError where a part of the scene declares no state.
        """
        self._refuse_broken()
        return save_state(self._run.simulation, self._block, self.scene, self._run.changes)

    def load(self, data: bytes) -> None:
        """Go back, or on, to a state that was saved. Raises StateError, and changes nothing, where the bytes are damaged,
        or of another scene, bench, version or processor.
        """
        saved = open_state(data, self.scene)
        run = self._run.with_changes(saved.changes)
        load_state(saved, run.simulation, self.scene)
        self._run, self._block, self._is_broken = run, saved.block, False

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Every key of the scene, dotted: present value, unit, range, and whether `step` may change it, or why not."""
        return self._run.parameters

    def step(
        self, duration: float | None = None, vibration: ArrayLike | None = None,
        parameters: Mapping[str, float] | None = None,
    ) -> Step:  # fmt: skip
        """Simulate on, and return what the topics hold.

        Args:
            duration: [s], a whole number of blocks; None: one block.
            vibration: acceleration [m/s²] in place of the scene's own: upwards [samples], or forward and upward
                [samples, 2], at ``vibration.sample_rate``. Between samples it is linear, after the last one of the step it
                is held; with one sample more that one is the end.
            parameters: values of live keys from the start of the step on, all of them or none; each is a message
                ``bench/steering`` of the step.

        Raises:
            ValueError: no whole number of blocks, or another number of samples.
            ParameterError: a key that is fixed, or a value that is refused; the run goes on as if it had not been given.
            RunError: the scene is over, or the physics ended in a named failure; then only `reset` goes on.
        """
        count = self._count(duration)
        self._refuse_broken()
        if self._block + count > self.blocks:
            raise RunError(
                f"the scene ends at {self.blocks * self.block_length:g} s, it is {self.time:g} s; give it a longer duration"
            )
        own = None if vibration is None else self._vibration(count, vibration)
        first, outputs = self._block, list[Output]()
        if parameters:
            given = {} if own is None else {VIBRATION: own(first, 0)}
            outputs += self._run.change(first, parameters, given)
        self._is_broken = True  # until the last block has ended
        for number in range(count):
            block = first + number
            inputs: dict[str, InputBlock] = {
                topic: source.block(block)
                for topic, source in self._run.sources.items()
                if topic != VIBRATION or own is None
            }
            if own is not None:
                inputs[VIBRATION] = own(block, number)
            outputs += self._run.simulation.advance(block, inputs).outputs
        self._block, self._is_broken = first + count, False
        return Step(first * self.block_length, self.time, outputs)

    def vibration(self, duration: float | None = None) -> NDArray[numpy.float64]:
        """The scene's own vibration of the next step, forward and upward [samples + 1, 2], m/s²: to be changed and given to
        `step`.

        Raises ValueError where the scene has none, or the duration is no whole number of blocks.
        """
        self._refuse_still()
        blocks = [self._run.sources[VIBRATION].block(self._block + number) for number in range(self._count(duration))]
        parts = [
            numpy.stack([each.acceleration_x, each.acceleration_z], axis=1)
            for each in blocks if isinstance(each, VibrationBlock)
        ]  # fmt: skip
        return numpy.concatenate([*(each[:-1] for each in parts), parts[-1][-1:]])

    def _refuse_broken(self) -> None:
        if self._is_broken:
            raise RunError("the run ended in a failure; reset the bench, or load a state")

    def _refuse_still(self) -> None:
        if VIBRATION not in self._run.sources:
            raise ValueError(f"{self.scene.name} has no vibration; its inputs are {', '.join(self.inputs) or 'none'}")

    def _count(self, duration: float | None) -> int:
        if duration is None:
            return 1
        blocks = duration / self.block_length
        if round(blocks) < 1 or abs(blocks - round(blocks)) > ROUNDING * max(blocks, 1.0):
            raise ValueError(f"duration is {duration:g} s; the bench steps whole blocks of {self.block_length:g} s")
        return round(blocks)

    def _vibration(self, count: int, given: ArrayLike) -> Any:
        """Of a block by its number, and by its number in the step: the given acceleration."""
        self._refuse_still()
        assert self.scene.vibration is not None
        rate = self.scene.vibration.sample_rate
        samples = round(rate * self.block_length)
        values: NDArray[numpy.float64] = numpy.asarray(given, dtype=numpy.float64)
        both = values if values.ndim == 2 else numpy.stack([numpy.zeros(values.size), values.ravel()], axis=1)
        total = count * samples
        if (
            both.ndim != 2
            or both.shape[1] != 2
            or len(both) not in (total, total + 1)
            or not numpy.isfinite(both).all()
        ):
            raise ValueError(
                f"vibration has the shape {values.shape}; {total} finite samples upwards, or {total} by 2, are {count} blocks "
                f"at {rate:g} Hz (one more is the end)"
            )
        whole = both if len(both) > total else numpy.concatenate([both, both[-1:]])

        def block_of(block: int, number: int) -> VibrationBlock:
            part = whole[number * samples : (number + 1) * samples + 1]
            return VibrationBlock(
                block=block,
                sample_period=1.0 / rate,
                acceleration_x=part[:, 0].copy(),
                acceleration_z=part[:, 1].copy(),
            )

        return block_of


def _resolved(name: str, values: tuple[str, ...]) -> ResolvedScene:
    return resolve(load_scene(name, [set_value(each, "the value ") for each in values]))
