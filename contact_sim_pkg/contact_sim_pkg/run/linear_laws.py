"""The laws of a contact as springs and dampers, linear where the contact rests: links of the
integrator's work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from contact_sim_pkg.run.integrator_work import Link, power_law_link
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.laws import Foam, FrictionSection, GeneralDissipation, HuntCrossley, PowerLaw

if TYPE_CHECKING:
    from contact_sim_pkg.run.contact_laws import Cushion

__all__ = ["links_of_laws"]

SPEED = 0.5  # [m/s] at which a dissipative law is linearised


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
