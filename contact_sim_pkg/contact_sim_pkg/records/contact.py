"""A contact of a rig: its section of the scene, its effects, its topics."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.topic import FORCE, WRENCH, ContactTopic

__all__ = ["LOOSEST_INTEGRATION", "Contact"]

LOOSEST_INTEGRATION = 1e-4
"""Relative tolerance of a time step, at most, whatever accuracy is requested."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Contact:
    """One contact. Several rigs may share it: the seat alone, in a car, under an occupant.

    Attributes:
        name: of its section, of its effects below `effects`, and in front of its topics.
        help: what touches what, in a phrase.
        section: ``module:class`` of its section of the scene.
        section_help: what the section describes, in a phrase.
        effects: in the order of the documentation; a field's topic follows this order too.
        rules: ``module:function`` of rules between keys, each a scene -> its breaches.
        topics: its recorded topics, in the order of a bag.
        loosest_integration: plain data of its effects by name -> largest relative tolerance of the
            time integration.
    """

    name: str
    help: str
    section: str
    section_help: str
    effects: tuple[Effect, ...]
    rules: tuple[str, ...] = ()
    topics: tuple[ContactTopic, ...] = (FORCE, WRENCH)
    loosest_integration: Callable[[Mapping[str, Any]], float] = lambda _effects: LOOSEST_INTEGRATION

    @cached_property
    def carriers(self) -> tuple[str, ...]:
        """The effects without one of which the contact carries no load, the usual one first."""
        return tuple(effect.name for effect in self.effects if effect.carries)

    def missing(self, effect: Effect, named: Container[str]) -> list[str]:
        """Effects that an effect needs and that are not among the ``named`` ones; any that carries
        the load stands for the usual one.
        """
        return [name for name in effect.needs if not any(each in named for each in self.enough(name))]

    def enough(self, needed: str) -> tuple[str, ...]:
        """Effects any of which meets the need for one: for the usual carrier all that carry the load."""
        return self.carriers if needed == self.carriers[0] else (needed,)

    def published(self, scene: Mapping[str, Any]) -> list[str]:
        """Whole names of the topics that the plain data of a resolved scene calls for."""
        keys, named = scene.get(self.name) or {}, scene["effects"].get(self.name) or {}
        return [f"{self.name}/{topic.name}" for topic in self.topics if self._calls_for(topic, keys, named)]

    def _calls_for(self, topic: ContactTopic, keys: Mapping[str, Any], named: Mapping[str, Any]) -> bool:
        """Whether the key and one of the effects that a topic needs are there."""
        publishers = [effect.name for effect in self.effects if effect.publishes == topic.name]
        return (not topic.key or bool(keys.get(topic.key))) and (
            not publishers or any(named.get(name) is not None for name in publishers)
        )
