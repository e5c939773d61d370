"""A simulation that makes its excitation itself, block by block, and whose parameters may change between its blocks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from contact_sim_pkg.bag.block_encoder import Message, Output
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, cautions_of
from contact_sim_pkg.run.live_parameters import Parameter
from contact_sim_pkg.run.steered_run import SteeredRun
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["OwnExcitation"]


class OwnExcitation:
    """A `BlockSimulation` without inputs.

    Attributes:
        inputs: none.
        blocks: number of blocks of the scene.
        topics: of the excitation that it makes.
        excitation: the blocks that the last `advance` has made and used: topic, stamp [ns], CDR bytes.
    """

    inputs: tuple[str, ...] = ()

    def __init__(self, scene: ResolvedScene) -> None:
        """Make sources and simulation of a scene."""
        self._run = SteeredRun(scene)
        self._changed: list[Output] = []  # of the block that comes next
        self.topics = tuple(self._run.sources)
        self.blocks = self._run.simulation.blocks
        self.excitation: list[Message] = []

    @property
    def cautions(self) -> tuple[str, ...]:
        """See `cautions_of`."""
        return cautions_of(self._run.simulation)

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Every key of the scene with its present value."""
        return self._run.parameters

    @property
    def has_changed(self) -> bool:
        """Whether a parameter has changed since the start."""
        return bool(self._run.changes)

    def describe(self) -> dict[str, dict[str, Any]]:
        """Findings in the excitation and their treatment, by topic."""
        return {topic: source.describe() for topic, source in self._run.sources.items()}

    def prepare(self) -> None:
        """See `BlockSimulation`."""
        self._run.simulation.prepare()

    def change(self, block: int, values: Mapping[str, float]) -> None:
        """Change parameters before a ``block``, which carries their messages; all of them, or none. Raises ParameterError."""
        self._changed = self._run.change(block, values)

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """See `BlockSimulation`; the messages of changes come with those of their block."""
        made = {topic: source.block(block) for topic, source in self._run.sources.items()}
        result = self._run.simulation.advance(block, {**made, **inputs})
        stamp = block * self._run.scene.block_length_ns
        self.excitation = [(topic, stamp, encode(each, stamp)) for topic, each in made.items()]
        changed, self._changed = self._changed, []
        return replace(result, outputs=[*changed, *result.outputs]) if changed else result

    def reset(self) -> None:
        """Go back to the start, with the scene's own parameters."""
        self._run = self._run.restarted()
        self._changed, self.excitation = [], []
