"""An effect of a contact as everyone else sees it. Validation, topics, the study of effects and the
documentation go over these records; a rig's lie beside its kernels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.topic import ContactTopic

__all__ = ["Effect", "Observed", "Rule", "Verdict", "choice_of_model", "needed_where_it_opens"]


class Observed(NamedTuple):
    """Result of a run that the rules look at: by contact the normal force [N] and whether it opens,
    and the largest fore-aft acceleration [m/s^2] of the floor.
    """

    forces: dict[str, NDArray[numpy.float64]]
    opens: dict[str, bool]
    forward: float


Verdict: TypeAlias = tuple[bool | None, str]
"""Whether a scene calls for an effect (None: there is no rule), and the figures behind it."""
Rule: TypeAlias = Callable[[Any, Observed], Verdict]
"""Of a `scene.resolved_scene.ResolvedScene`, which records do not know, and a run of it."""


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
        feeds: topics of the contact whose values it changes.
        inputs: sections of the scene that act through it alone.
        called_for: rule that says from a scene and its result whether the scene calls for it.
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
    feeds: tuple[str, ...]
    inputs: tuple[str, ...] = ()
    called_for: Rule
    not_below: Mapping[str, float] = field(default_factory=dict)


def choice_of_model(why: str) -> Rule:
    """The rule of an effect that no result can call for."""
    return lambda _scene, _observed: (None, why)


def needed_where_it_opens(contact: str) -> Rule:
    """The rule of a loss: an impact has no restitution without one."""

    def rule(_scene: Any, observed: Observed) -> Verdict:
        if observed.opens[contact]:
            return True, "the contact opens: an impact needs a loss to have a restitution"
        return None, "the contact stays closed; how much it damps is a choice of the model"

    return rule
