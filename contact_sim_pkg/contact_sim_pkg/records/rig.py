"""A rig as everyone else sees it: its contacts, what a scene gives it, what simulates it.

A record names what it takes long to load as ``module:name`` and loads it on use, so that a node
that only records or only shakes starts without a compiler.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, NamedTuple

from contact_sim_pkg.files import RefusedError, printable
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.guests import GuestError, guest
from contact_sim_pkg.records.regime import Regime

__all__ = ["BRINGERS", "PluginError", "Rig", "Standing", "TouchedBody", "load"]

BRINGERS: dict[str, str] = {}
"""Name and version of the plug-in that brings a package, by the package, once it is loaded."""


class PluginError(RefusedError, ValueError):
    """A package of others that does not work, or that cannot stand beside another: a sentence."""


class TouchedBody(NamedTuple):
    """A coordinate of a body that a contact acts on."""

    contact: str
    mass: float  # [kg]


class Standing(NamedTuple):
    """Loads and masses of a scene.

    Attributes:
        loads: [N] of each contact at rest, by its name; those that rest on none are left out.
        bodies: by coordinate of `bench/motion`; bodies that no contact touches are left out.
    """

    loads: Mapping[str, float]
    bodies: Mapping[str, TouchedBody]


@dataclass(frozen=True, kw_only=True)
class Rig:
    """One rig. A section that another rig needs or takes, and this one does not, is refused.

    Attributes:
        name: the word behind `rig` in a scene.
        help: what it is, in a phrase.
        contacts: each needs a normal force; its own section of the scene has its name.
        needs: sections that the scene must have.
        takes: further sections that it may have; those of its contacts are defaults where absent.
        simulation: ``module:class`` of a `run.block_simulation.BlockSimulation` that takes a
            resolved scene.
        report: ``module:name`` of the `records.report.ContactReport` of each contact that has one.
        road_strip: ``module:function`` of the plain data of a resolved scene -> the strip of road
            that its tire needs; empty: it rides on none.
        work: ``module:function`` of a resolved scene -> parts of its work beside that of blocks and
            fields; empty: none.
        other_half: ``module:function`` of a resolved scene, called in a second process: compiles
            kernels that the run comes to late; empty: none.
        unused_axes: plain data of its effects by contact -> axes whose vibration moves nothing.
        bench_topics: its own topics below `bench/`, by their whole name.
        scenes: its shipped scenes, each with its place in `bench list`: the smaller the run, the
            sooner.
        forecast: module whose `facts_before_run` and `sentence_before_run` report what is known
            before the run; empty: nothing.
        rules: ``module:function`` of rules between keys of its contacts, each a scene -> its
            breaches.
        standing: ``module:function`` of the plain data of a resolved scene -> `Standing`:
            scales of its errors; empty: unknown, and nothing rests on a contact.
        events: ``module:function`` of a resolved scene -> names and instants [s] of what the scene
            itself prescribes: largest slip, torque; empty: nothing.
        regimes: what its scenes may expect of a run; a word that another rig has as well means the same.
        kernels: about how many kernels its richest scene compiles at its first start; 0: unknown.
    """

    name: str
    help: str
    contacts: tuple[Contact, ...]
    needs: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    simulation: str
    report: tuple[str, ...] = ()
    road_strip: str = ""
    work: str = ""
    other_half: str = ""
    unused_axes: Callable[[Mapping[str, Any]], str] = lambda _effects: ""
    bench_topics: tuple[str, ...] = ()
    scenes: Mapping[str, int] = field(default_factory=dict)
    forecast: str = ""
    rules: tuple[str, ...] = ()
    standing: str = ""
    events: str = ""
    regimes: tuple[Regime, ...] = ()
    kernels: int = 0


def load(named: str, longest: float = 0.0) -> Any:
    """The object behind ``module:name``, or the module behind ``module``. Raises what its import
    raises; of a plug-in that is loaded PluginError, which names it, and what it prints goes to
    standard error.

    longest: [s] after which the import of a plug-in's module is broken off; 0: never.
    """
    module, _, name = named.partition(":")
    plugin = BRINGERS.get(module.partition(".")[0])
    if plugin is None:
        found = import_module(module)
        return getattr(found, name) if name else found
    try:
        with guest(longest) as printed:
            found = import_module(module)
            found = getattr(found, name) if name else found
        sys.stderr.write(printed.getvalue())
        return found
    except PluginError:
        raise
    except Exception as error:
        cause = printable(str(error) if isinstance(error, GuestError) else f"{type(error).__name__}: {error}", 500)
        raise PluginError(f"plug-in {plugin}: {named} does not load ({cause})") from error
