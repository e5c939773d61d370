"""Work of the rigs tire, seat and car, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.rigs.vehicle.tire.schema import RigidRingSection, TireSection
from contact_sim_pkg.run.integrator_work import Link, integrator_steps, links_of_laws, segments
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["seat_steps", "tire_steps", "work_of_car", "work_of_seat", "work_of_tire"]


def work_of_tire(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of a quarter car."""
    yield segments(scene)
    yield from tire_steps(scene)


def work_of_seat(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of an occupant on a seat."""
    yield segments(scene)
    yield from seat_steps(scene)


def work_of_car(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of both."""
    yield segments(scene)
    yield from tire_steps(scene)
    yield from seat_steps(scene)


def seat_steps(scene: ResolvedScene) -> Iterator[Work]:
    """Steps of the occupant and of its contact with the cushion."""
    occupant = scene.section(SeatSection).occupant
    rows = zip(occupant.masses, occupant.stiffness, occupant.damping, strict=True)
    links = [Link("occupant", min(mass, occupant.frame_mass), k, c) for mass, k, c in rows]
    load = (occupant.frame_mass + sum(occupant.masses)) * GRAVITY
    yield from integrator_steps(scene, "seat", [*links, *links_of_laws(scene, "seat", occupant.frame_mass, load)])


def tire_steps(scene: ResolvedScene) -> Iterator[Work]:
    """Steps of suspension and sidewalls; Hertz's law of the tire is softer than the latter."""
    tire, ring = scene.section(TireSection), scene.effect("tire", RigidRingSection)
    least = min(tire.wheel_mass, tire.body_mass)
    links = [Link("suspension", least, tire.suspension_stiffness, tire.suspension_damping)]
    if ring is not None:
        links.append(Link("rigid_ring", min(ring.belt_mass, least), ring.stiffness, ring.damping))
    yield from integrator_steps(scene, "tire", links)
