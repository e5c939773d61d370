"""An effect of a contact as everyone else sees it. Validation, topics, the study of effects and the
documentation go over these records; a rig's lie beside its kernels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from contact_sim_pkg.records.topic import ContactTopic

__all__ = ["Effect", "Rule", "never_called_for", "without_loss"]

Rule: TypeAlias = Callable[[Any], str]
"""Of a `scene.resolved_scene.ResolvedScene`, which records do not know: what in its data calls for
an effect, as a sentence; empty where nothing does."""


def never_called_for(_scene: Any) -> str:
    """The rule of an effect that is a choice of the model, or a question of the scene."""
    return ""


def without_loss(contact: str, *losses: str) -> Rule:
    """The rule of a loss: none of the ``losses`` of the contact acts."""

    def rule(scene: Any) -> str:
        named = scene.data["effects"].get(contact) or {}
        return (
            "" if any(named.get(loss) is not None for loss in losses) else f"nothing dissipates energy at the {contact}"
        )

    return rule


@dataclass(frozen=True, kw_only=True, eq=False)
class Effect:
    """One effect of one contact. It acts where the scene names it.

    Attributes:
        name: its key under `effects.CONTACT`.
        section: ``module:class`` of its keys.
        help: what it is, in a phrase.
        source: paper or book that its formulas come from; empty for a choice of the model.
        needs: effects without which it cannot act; for the usual one that carries the load stands any
            other that does.
        excludes: effects that it cannot act beside.
        carries: whether it carries the load of the contact: every scene with the contact names it, or
            another that does.
        publishes: topic of the contact that is there because of it; empty: none.
        topic: that topic, where the effect is another package's and the contact does not list it.
        observer: ``module:name`` of what looks at the outputs of each block, for an effect that acts on
            nothing: a function of a resolved scene that returns a `run.observers.Observer`; empty: the
            rig's own simulation has the effect.
        elements: ``module:name`` of a function that makes what the effect brings into the motion of a vehicle,
            masses and elements between them (`rigs/vehicle/acting.py`); empty: none.
        feeds: topics of the contact whose values it changes.
        inputs: sections of the scene, or dotted keys, that act through it, or through others that name
            them too: they go with the last one.
        called_for: what in the data of a scene calls for it. That it acts by more than the requested
            accuracy there is for a measurement to show.
        not_below: numerical error, by kind as of `definitions.KINDS`, that no request makes smaller:
            measured, of a table or a number of parts that has no dial.
    """

    name: str
    section: str
    help: str
    source: str = ""
    needs: tuple[str, ...] = ()
    excludes: tuple[str, ...] = ()
    carries: bool = False
    publishes: str = ""
    topic: ContactTopic | None = None
    observer: str = ""
    elements: str = ""
    feeds: tuple[str, ...]
    inputs: tuple[str, ...] = ()
    called_for: Rule = never_called_for
    not_below: Mapping[str, float] = field(default_factory=dict)
