"""Interface of a rig's simulation to the loop that drives it, offline or in a node."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, TypeAlias, runtime_checkable

from contact_sim_pkg.bag.block_encoder import Message, Output, encode_block
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.run.errors import RunError

InputBlock: TypeAlias = RoadPatch | VibrationBlock


@dataclass(frozen=True)
class BlockResult:
    """Outputs of one block."""

    outputs: list[Output]  # recorded topics, `bench/cost` included
    load: float  # [N] largest normal force
    peak_pressure: float  # [Pa]; 0 where no field is computed
    wall_time: float  # [s]

    @cached_property
    def messages(self) -> list[Message]:
        """Topic, stamp [ns] and CDR bytes of each message, in canonical order."""
        return encode_block(self.outputs)


def refuse_out_of_turn(block: int, due: int) -> None:
    """Raise RunError where block number ``block`` is not the one due."""
    if block != due:
        raise RunError(f"block {block} came, block {due} was due")


def cautions_of(simulation: BlockSimulation) -> tuple[str, ...]:
    """What is to be said once before the run, a sentence each: the attribute ``cautions`` of a
    simulation that has one.
    """
    return tuple(getattr(simulation, "cautions", ()))


class BlockSimulation(Protocol):
    """The simulation of one scene, block by block. It owns the state of the run."""

    inputs: tuple[str, ...]  # topics that it needs a block of
    blocks: int  # number of blocks of the scene

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs: a run compiles nothing."""

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``, in order from 0, with the blocks of every input topic.

        Raises RunError where a block is out of order, does not fit the scene, or the physics ends
        in a named failure.
        """


@runtime_checkable
class Resettable(Protocol):
    """A simulation that can go back to its start; one that cannot is made anew."""

    def reset(self) -> None:
        """Before the first block again, with the bits of a new simulation. After `prepare`."""
