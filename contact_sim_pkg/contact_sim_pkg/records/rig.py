"""A rig as everyone else sees it: what a scene gives it, what simulates it, what it publishes.

A record names what it takes long to load as ``module:name`` and loads it on use, so that a node
that only records or only shakes starts without a compiler.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

__all__ = ["Rig", "load"]


@dataclass(frozen=True, kw_only=True)
class Rig:
    """One rig. A section that another rig needs or takes, and this one does not, is refused.

    Attributes:
        name: the word behind `rig` in a scene.
        contacts: each needs a normal force; a contact's own section of the scene has its name.
        needs: sections that the scene must have.
        takes: sections that it may have; those of the contacts are defaults where absent.
        simulation: ``module:class`` of a `run.block_simulation.BlockSimulation` that takes a resolved scene.
        topics: resolved scene -> topics of its contacts; those of `bench/` follow.
        report: ``module:name`` of the `records.report.ContactReport` of each contact that has one.
        forecast: module whose `facts_before_run` and `sentence_before_run` report what is known
            before the run; empty: nothing.
    """

    name: str
    contacts: tuple[str, ...]
    needs: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    simulation: str
    topics: Callable[[dict[str, Any]], list[str]]
    report: tuple[str, ...] = ()
    forecast: str = ""


def load(named: str) -> Any:
    """The object behind ``module:name``, or the module behind ``module``. Raises what its import raises."""
    module, _, name = named.partition(":")
    found = import_module(module)
    return getattr(found, name) if name else found
