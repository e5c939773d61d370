"""Scene, excitation and simulation of a run whose parameters change between its blocks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, Protocol, runtime_checkable

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.excitation.blocks import RoadBlocks
from contact_sim_pkg.excitation.changed_road import changed_road
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.records.messages import ParameterChange
from contact_sim_pkg.run.block_simulation import BlockSimulation, InputBlock, Resettable
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.live_parameters import (
    STEERING,
    Change,
    Parameter,
    ParameterError,
    by_block,
    changed_scene,
    parameters_of,
    refuse_fixed,
)
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.saved_state import StateError
from contact_sim_pkg.run.sources import Source, make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Steerable", "SteeredRun"]

OUTSIDE = ("road", "vibration")
"""Sections of a scene that come to a simulation as blocks alone."""


@runtime_checkable
class Steerable(Protocol):
    """A simulation that can go on in the place of one with other parameters."""

    def take_over(self, before: Any, block: int, inputs: Mapping[str, InputBlock]) -> None:
        """Take the state over from the simulation that was there ``before``, ahead of ``block`` with its ``inputs``; what of
        the energy changes with the parameters counts as supplied.

        Raises StateError, RunError where that is not possible; ``before`` stays as it was.
        """


class _Unchanged(NamedTuple):
    """A run before the changes ahead of a block."""

    block: int
    now: ResolvedScene
    simulated: ResolvedScene
    sources: dict[str, Source]
    simulation: BlockSimulation
    changes: tuple[Change, ...]


class SteeredRun:
    """What a run is made of; `change` puts other parameters in between two blocks.

    Attributes:
        scene: of the start.
        sources: of its excitation.
        simulation: of its rig.
        changes: so far.
    """

    def __init__(
        self, scene: ResolvedScene, simulation: BlockSimulation | None = None, sources: dict[str, Source] | None = None
    ) -> None:
        """Make the run of a scene, unless its ``simulation`` is given; ``sources`` of others do not change."""
        self.scene = self._now = self._simulated = scene
        self._given = sources
        self.sources = make_sources(scene) if sources is None else sources
        self.simulation = simulation or make_simulation(scene)
        self.changes: tuple[Change, ...] = ()
        self._unchanged: _Unchanged | None = None

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Every key of the scene with its present value."""
        return parameters_of(self.scene, self.changes)

    def restarted(self) -> SteeredRun:
        """The run of the scene before its first block, ready to go; this one where nothing has changed in it."""
        if not self.changes and isinstance(self.simulation, Resettable):
            self.simulation.reset()
            return self
        run = SteeredRun(self.scene, None, self._given)
        run.simulation.prepare()
        return run

    def with_changes(self, changes: Iterable[Change]) -> SteeredRun:
        """A run with other changes, whose state is to be loaded; this one where they are the same."""
        found = tuple(changes)
        if found == self.changes:
            self._unchanged = None
            return self
        run = SteeredRun(self.scene, None, self._given)
        for block, values in by_block(found):
            run._go_to(block, values)
        run.simulation = make_simulation(run._simulated)
        run.simulation.prepare()
        run.changes = found
        return run

    def _go_to(self, block: int, values: Mapping[str, float]) -> None:
        """Take the values into scene and sources."""
        before, now = self._now, changed_scene(self._now, block, values)
        if self._given is None:
            self.sources = _changed_sources(self.sources, before, now, block)
        self._now = now
        if block == 0 or any(
            before.data.get(key) != now.data.get(key) for key in {**before.data, **now.data} if key not in OUTSIDE
        ):
            self._simulated = now

    def change(
        self, block: int, values: Mapping[str, float], given: Mapping[str, InputBlock] | None = None
    ) -> list[Output]:
        """Change parameters before a ``block``, whose inputs are those ``given`` and else the run's; all of them, or none.

        Several changes before one block are one: it is made anew with the values of all, as who repeats the run makes it.

        Returns a message for each key that changes before the block. Raises ParameterError, and the run goes on as if nothing
        had been asked for.
        """
        refuse_fixed(self.parameters, values)
        present = self._kept(block)
        first = present
        if self._unchanged is not None and self._unchanged.block == block:
            first = self._unchanged
        merged = {each.key: each.value for each in self.changes[len(first.changes) :]} | dict(values)
        try:
            self._restore(first)
            self._go_to(block, merged)
            if self._simulated is not first.simulated:
                self.simulation = self._changed_simulation(block, {} if given is None else given)
        except BaseException as error:
            self._restore(present)
            if isinstance(error, (SceneError, ExcitationError, StateError, RunError)):
                raise ParameterError(f"{', '.join(values)}: {error}") from error
            raise
        made = tuple(Change(block, key, float(value)) for key, value in merged.items())
        self.changes, self._unchanged = (*first.changes, *made), first
        stamp = block * self.scene.block_length_ns
        return [Output(STEERING, stamp, ParameterChange(**each._asdict())) for each in made]

    def _kept(self, block: int) -> _Unchanged:
        return _Unchanged(block, self._now, self._simulated, self.sources, self.simulation, self.changes)

    def _restore(self, kept: _Unchanged) -> None:
        _, self._now, self._simulated, self.sources, self.simulation, self.changes = kept

    def _changed_simulation(self, block: int, given: Mapping[str, InputBlock]) -> BlockSimulation:
        """The simulation of the present scene, in the state of that which is there."""
        made: Any = make_simulation(self._simulated)
        if block == 0:
            made.prepare()
            return made  # type: ignore[no-any-return]
        if not isinstance(self.simulation, Steerable):
            unknown = getattr(self.simulation, "undeclared", "") or f"the simulation of rig {self.scene.rig}"
            raise StateError(f"{unknown} declares no way to go on with other parameters")
        if not _has_parts_of(_rig_of(made), _rig_of(self.simulation)):
            raise StateError("the rig would have other parts, which the state does not fit")
        inputs = {name: source.block(block) for name, source in self.sources.items() if name not in given}
        made.take_over(self.simulation, block, {**inputs, **given})
        simulation: BlockSimulation = made
        return simulation


def _changed_sources(
    sources: Mapping[str, Source], before: ResolvedScene, after: ResolvedScene, block: int
) -> dict[str, Source]:
    """Sources of the scene ``after`` a change before a ``block``; those that it does not concern are the same."""
    if all(before.data.get(key) == after.data.get(key) for key in ("road", "travel", "vibration")):
        return {**sources}
    made = make_sources(after)
    if block == 0:
        return made
    found: dict[str, Source] = {}
    for topic, source in made.items():
        then = sources[topic]
        if isinstance(source, RoadBlocks) and isinstance(then, RoadBlocks):
            same = before.data["road"] == after.data["road"]
            found[topic] = changed_road(then, source, block, same_surface=same)
        else:
            found[topic] = source
    return found


def _rig_of(simulation: Any) -> Any:
    return getattr(simulation.model, "rig", None)


def _has_parts_of(value: Any, other: Any) -> bool:
    """Whether named tuples, tuples and what they hold are of the same classes: nothing has come or gone."""
    if type(value) is not type(other):
        return False
    if isinstance(value, tuple):
        return len(value) == len(other) and all(map(_has_parts_of, value, other))
    return True
