"""Steps of the integrator that a rig with compliant contacts needs at least: those of its fastest
motion.

The pair of order 5 passes about 1.2 rad of an undamped swing in a step, and 3.3 time constants of a
damper (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import make_timing

__all__ = ["Link", "integrator_steps", "power_law_link", "segments"]

SWING, DAMPED = 1.2, 3.3  # [rad], [time constants] of a step


class Link(NamedTuple):
    """A spring or damper, and the mass that it moves."""

    name: str
    mass: float  # [kg]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]


def segments(scene: ResolvedScene, cost: float = STEP_COST) -> Work:
    """Segments of the linear drive: at least one step each, of so much ``cost`` [s]."""
    timing = make_timing(scene, True)
    return Work("segments between two samples of drive or output", scene.duration / timing.segment_length, cost)


def integrator_steps(
    scene: ResolvedScene, contact: str, links: Iterable[Link], cost: float = STEP_COST
) -> Iterator[Work]:
    """Steps that each link alone would take; ``cost`` [s] of one."""
    for link in links:
        rate = max(math.sqrt(link.stiffness / link.mass) / SWING, link.damping / link.mass / DAMPED)
        yield Work(f"steps of the integrator for {contact}.{link.name}", rate * scene.duration, cost)


def power_law_link(name: str, mass: float, load: float, coefficient: float, exponent: float) -> Link:
    """Tangent of the force coefficient · depth^exponent [N] at the ``load`` [N], above 0."""
    depth = (load / coefficient) ** (1.0 / exponent)
    return Link(name, mass, exponent * load / depth, 0.0)
