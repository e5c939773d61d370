"""Steps of the integrator that a rig with compliant contacts needs at least: those of its fastest
motion.

The pair of order 5 passes about 1.2 rad of an undamped swing in a step, and 3.3 time constants of a
damper (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.laws import Foam, FrictionSection, GeneralDissipation, HuntCrossley, PowerLaw
from contact_sim_pkg.scene.timing import make_timing

if TYPE_CHECKING:
    from contact_sim_pkg.run.contact_laws import Cushion

__all__ = ["Link", "integrator_steps", "links_of_laws", "power_law_link", "segments"]

SWING, DAMPED = 1.2, 3.3  # [rad], [time constants] of a step
SPEED = 0.5  # [m/s] at which a dissipative law is linearised


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


def links_of_laws(
    scene: ResolvedScene, contact: str, mass: float, load: float,
    build_cushion: Callable[[ResolvedScene, float], Cushion | None],
) -> Iterator[Link]:  # fmt: skip
    """The laws of a contact as springs and dampers of the ``mass`` [kg], linear at the ``load`` [N]
    at rest.

    build_cushion: scene, load -> its foam cushion, None where it has none; called for where foam
    carries or a loss depends on the depth. Errors as those of ``build_cushion``.
    """
    for record, keys in scene.effects_at(contact):
        if isinstance(keys, PowerLaw) and load > 0.0:
            if scene.effect(contact, Foam) is None:  # foam carries in its place
                yield power_law_link(record.name, mass, load, keys.coefficient, keys.exponent)
        elif isinstance(keys, Foam) and load > 0.0:
            yield Link(record.name, mass, _tangent_at_rest(scene, contact, load, build_cushion)[1], 0.0)
        elif isinstance(keys, GeneralDissipation) and load > 0.0:
            depth, _stiffness = _tangent_at_rest(scene, contact, load, build_cushion)
            yield Link(record.name, mass, 0.0, _damping(keys, depth))
        else:
            yield Link(record.name, mass, *_tangent(keys, load))


def _tangent_at_rest(
    scene: ResolvedScene, contact: str, load: float, build_cushion: Callable[[ResolvedScene, float], Cushion | None]
) -> tuple[float, float]:
    """Approach [m] and stiffness [N/m] at the ``load`` [N] of the elastic law that carries it."""
    from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness  # brings the compiler
    from contact_sim_pkg.run.contact_laws import elastic_law

    cushion = build_cushion(scene, load)
    law = elastic_law(scene, contact) if cushion is None else cushion.law
    depth = approach_of_force(law, load)
    return depth, elastic_stiffness(law, depth)


def _damping(law: GeneralDissipation, depth: float) -> float:
    """Slope [N s/m] over the rate at a ``depth`` [m]; 0 of a law by its restitution."""
    power = law.rate_exponent
    slope: float = (law.coefficient or 0.0) * depth**law.approach_exponent * max(power, 1.0) * SPEED ** (power - 1.0)
    return slope


def _tangent(law: Any, load: float) -> tuple[float, float]:
    """Stiffness [N/m] and damping [N s/m] of a law at its ``load`` [N]."""
    if isinstance(law, FrictionSection):
        return law.stiffness, law.damping
    if isinstance(law, HuntCrossley):
        return 0.0, (law.damping or 0.0) * max(load, 0.0)
    return 0.0, 0.0


def power_law_link(name: str, mass: float, load: float, coefficient: float, exponent: float) -> Link:
    """Tangent of the force coefficient · depth^exponent [N] at the ``load`` [N], above 0."""
    depth = (load / coefficient) ** (1.0 / exponent)
    return Link(name, mass, exponent * load / depth, 0.0)
