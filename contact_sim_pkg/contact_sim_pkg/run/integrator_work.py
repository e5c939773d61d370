"""Steps of the integrator that a rig with compliant contacts needs at least: those of its fastest motion.

The pair of order 5 passes about 1.2 rad of an undamped swing in a step, and 3.3 time constants of a damper (Hairer and Wanner,
Solving Ordinary Differential Equations II, IV.2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.laws import FrictionSection, GeneralLoss, HuntCrossley, PowerLaw
from contact_sim_pkg.scene.timing import make_timing

__all__ = ["Link", "integrator_steps", "links_of_laws", "power_law_link", "segments"]

SWING, DAMPED = 1.2, 3.3  # [rad], [time constants] of a step
SPEED = 0.5  # [m/s] at which a loss is taken


class Link(NamedTuple):
    """A spring or damper, and the mass that it moves."""

    name: str
    mass: float  # [kg]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]


def segments(scene: ResolvedScene) -> Work:
    """Segments of the linear drive: at least one step each."""
    timing = make_timing(scene, True)
    return Work("segments between two samples of drive or output", scene.duration / timing.segment_length, STEP_COST)


def integrator_steps(
    scene: ResolvedScene, contact: str, links: Iterable[Link], cost: float = STEP_COST
) -> Iterator[Work]:
    """Steps that each link alone would take; ``cost`` [s] of one."""
    for link in links:
        rate = max(math.sqrt(link.stiffness / link.mass) / SWING, link.damping / link.mass / DAMPED)
        yield Work(f"steps of the integrator for {contact}.{link.name}", rate * scene.duration, cost)


def links_of_laws(scene: ResolvedScene, contact: str, mass: float, load: float) -> Iterator[Link]:
    """The laws of a contact that touches with a ``mass`` [kg], at its depth under the ``load`` [N] at rest."""
    elastic, friction = scene.effect(contact, PowerLaw), scene.effect(contact, FrictionSection)
    if elastic is not None and load > 0.0:
        general, loss = scene.effect(contact, GeneralLoss), scene.effect(contact, HuntCrossley)
        depth = (load / elastic.coefficient) ** (1.0 / elastic.exponent)
        if general is not None and general.coefficient is not None:
            power = general.rate_exponent
            slope = general.coefficient * depth**general.approach_exponent
            yield Link("general_dissipative", mass, 0.0, slope * (max(power, 1.0) * SPEED ** (power - 1.0)))
        damping = 0.0 if loss is None else loss.damping or 0.0
        yield Link("normal_dissipative", mass, 0.0, damping * load)
        yield power_law_link("normal_elastic", mass, load, elastic.coefficient, elastic.exponent)
    if friction is not None:
        yield Link("friction", mass, friction.stiffness, friction.damping)


def power_law_link(name: str, mass: float, load: float, coefficient: float, exponent: float) -> Link:
    """The tangent of coefficient · depth^exponent at the ``load`` [N]."""
    depth = (load / coefficient) ** (1.0 / exponent)
    return Link(name, mass, exponent * load / depth, 0.0)
