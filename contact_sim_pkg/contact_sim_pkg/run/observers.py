"""Effects that only look: after each block they see its outputs, and add outputs of their own.

They change no state and no other output, so a run with them has the bits of one without: the arrays
that they see are views that cannot be written to. An effect names its observer
(`records.effect.Effect.observer`); that is how a plug-in adds one to any rig.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.registry import contacts, rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.run.block_simulation import BlockResult, BlockSimulation, InputBlock
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Observer", "observed"]

WRITES = re.compile(r"(?:destination|array) is read-only|setitem\(readonly array")
"""The words of numpy and of numba where somebody writes to an array that cannot be written to."""
CURE = "an observer only reads: change a copy of the array"


class Observer(Protocol):
    """What looks at the blocks of one run, in their order."""

    def prepare(self) -> None:
        """Compile or load its kernels, if it has any: a run compiles nothing."""

    def observe(self, outputs: Sequence[Output]) -> Iterable[Output]:
        """Outputs of its own, on the topic that its effect announces, from all outputs of a block, whose
        arrays are contiguous and read-only; stamps [ns] as theirs.
        """


class _Observed:
    """A simulation and those who look at it; all else is the simulation's."""

    reset = take_over = STATE = None
    """It is made anew, not saved and not taken over: nobody knows what an observer remembers."""

    def __init__(self, simulation: BlockSimulation, observers: Mapping[str, tuple[Observer, str]]) -> None:
        """``observers``: of an effect by its dotted name, with the topic that it announces."""
        self._simulation, self._observers = simulation, observers
        self.undeclared = ", ".join(observers)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._simulation, name)

    def prepare(self) -> None:
        """Of all."""
        self._simulation.prepare()
        for observer, _topic in self._observers.values():
            observer.prepare()

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """The block of the simulation, with what was seen in it.

        Raises RunError, which names the effect, where one fails or publishes what it did not announce.
        """
        result = self._simulation.advance(block, inputs)
        seen: list[Output] = []
        shown = tuple(each._replace(record=_read_only(each.record)) for each in result.outputs)
        for effect, (observer, topic) in self._observers.items():
            try:
                found = list(observer.observe(shown))
            except Exception as error:
                if WRITES.search(str(error)):
                    raise RunError(f"{effect} writes to an output of block {block} that it observes; {CURE}") from error
                raise RunError(f"{effect} failed in block {block}: {type(error).__name__}: {error}") from error
            for output in found:
                if output.topic != topic:
                    raise RunError(
                        f"{effect} publishes {output.topic} in block {block}; it announces {topic or 'no topic'}"
                    )
            seen += found
        return replace(result, outputs=[*result.outputs, *seen])


def _read_only(value: Any) -> Any:
    """A record of a message as it is, those within it too, its arrays as contiguous views, or copies,
    that cannot be written to.
    """
    if isinstance(value, numpy.ndarray):
        view = numpy.asarray(value, order="C").view()
        view.setflags(write=False)
        return view
    if isinstance(value, list | tuple) and value and not isinstance(value[0], str):
        shown = map(_read_only, value)
        return value._make(shown) if hasattr(value, "_make") else tuple(shown)
    return value


def observed(scene: ResolvedScene, simulation: BlockSimulation) -> BlockSimulation:
    """The simulation of a resolved scene with the observers that the scene calls for; the simulation
    itself where it calls for none.
    """
    called = {
        f"effects.{contact.name}.{effect.name}": (
            load(effect.observer)(scene), f"{contact.name}/{effect.publishes}" if effect.publishes else ""
        )
        for contact in rigs()[scene.rig].contacts
        for effect in contacts()[contact.name].effects
        if effect.observer and (scene.data["effects"].get(contact.name) or {}).get(effect.name) is not None
    }  # fmt: skip
    found: Any = _Observed(simulation, called) if called else simulation
    simulated: BlockSimulation = found
    return simulated
