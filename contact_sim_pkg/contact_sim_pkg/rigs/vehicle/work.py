"""Work of the rigs tire, seat and car, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.rigs.vehicle.tire.schema import RigidRingSection, TireSection
from contact_sim_pkg.run.integrator_work import Link, integrator_steps, segments
from contact_sim_pkg.run.linear_laws import links_of_laws
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["seat_steps", "tire_steps", "work_of_car", "work_of_seat", "work_of_tire"]


def work_of_tire(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of a quarter car."""
    yield segments(scene)
    yield from tire_steps(scene)


def work_of_seat(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of an occupant on a seat."""
    yield segments(scene)
    yield from seat_steps(scene, _weight(scene))


def work_of_car(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of both."""
    yield segments(scene)
    yield from tire_steps(scene)
    yield from seat_steps(scene, _weight(scene))


def seat_steps(scene: ResolvedScene, load: float) -> Iterator[Work]:
    """Steps of the occupant and of its contact with the cushion, which bears ``load`` [N] at rest."""
    from contact_sim_pkg.rigs.vehicle.seat.cushion import build_pan_cushion  # brings the compiler

    occupant = scene.section(SeatSection).occupant.model_of()
    # A massless interface moves with what hangs on it, and makes nothing faster.
    masses = [mass or occupant.mass for mass in occupant.masses]
    links = [
        Link("occupant", min(masses[link.lower], masses[link.upper]), link.stiffness, link.damping)
        for link in occupant.links
    ]
    laws = links_of_laws(scene, "seat", masses[0], load, build_pan_cushion)
    yield from integrator_steps(scene, "seat", [*links, *laws, *_links_of_effects(scene, "seat")])


def _weight(scene: ResolvedScene) -> float:
    """Of the occupant [N]."""
    return scene.section(SeatSection).occupant.model_of().mass * GRAVITY


def tire_steps(scene: ResolvedScene) -> Iterator[Work]:
    """Steps of suspension and sidewalls; the law of the tire is softer than the latter."""
    tire, ring = scene.section(TireSection), scene.effect("tire", RigidRingSection)
    least = min(tire.wheel_mass, tire.body_mass)
    links = [Link("suspension", least, tire.suspension_stiffness, tire.suspension_damping)]
    if ring is not None:
        links.append(Link("rigid_ring", min(ring.belt_mass, least), given(ring.stiffness), given(ring.damping)))
    yield from integrator_steps(scene, "tire", [*links, *_links_of_effects(scene, "tire")])


def _links_of_effects(scene: ResolvedScene, contact: str) -> Iterator[Link]:
    """Of the effects that act as elements, whose keys know their springs."""
    for effect, keys in scene.effects_at(contact):
        if effect.elements and (links := getattr(keys, "links", None)) is not None:
            yield from links(scene)
