"""How far the bodies go from one solution of the pressure fields to the next."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from contact_sim_pkg.core.effects.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.core.parameters import Contact, NormalDissipative
from contact_sim_pkg.scene.build_contact import FieldGrids
from contact_sim_pkg.scene.timing import Timing, make_timing

LONGEST = 0.5
"""Of the standing footprint's length, from one solution of the tire's field to the next: every obstacle is felt by two."""

LONGEST_LOOSE, LOOSE = 1.0, 0.1
"""The same where an error of `LOOSE` or more is allowed: every obstacle is felt by one."""

LONGEST_UNIFORM = 0.125
"""The same where the stretches cannot be chosen by their error."""

SHORTEST = 0.1
"""Of the standing footprint's length: a stretch may be as short as this."""


class CouplingRule(NamedTuple):
    """Lengths that a stretch between two solutions of the fields may have, and the height that it may miss."""

    tolerance: float  # error of a force over the standing load
    heights: tuple[float, float]  # [m] allowed error of the effective height of tire and seat
    speeds: tuple[float, float]  # [m/s] allowed error of the rates of these heights
    noises: tuple[float, float]  # [m] what the solver of the fields leaves in these heights
    longest_travel: float  # [m]
    segments: int | None  # of each stretch, where all must be equal; None: chosen by the error


def allowed_height(contact: Contact | None, load: float, tolerance: float) -> float:
    """Height in [m] that changes the force of a contact under ``load`` [N] by the part ``tolerance`` of it."""
    if contact is None:
        return math.inf
    return tolerance * load / elastic_stiffness(contact.elastic, approach_of_force(contact.elastic, load))


def attainable(field: FieldGrids | None, tolerance: float) -> float:
    """The tolerance, but not less than that of the ``field``: its own error would be taken for changes of the height."""
    return tolerance if field is None else max(tolerance, field.usual.settings.tolerance)


def allowed_speed(contact: Contact | None, tolerance: float) -> float:
    """Speed in [m/s] that changes the force of a contact by the part ``tolerance`` of it, through a Hunt-Crossley loss."""
    if contact is None or not isinstance(contact.dissipative, NormalDissipative) or contact.dissipative.damping == 0.0:
        return math.inf
    return tolerance / contact.dissipative.damping


def noise_of(contact: Contact | None, field: FieldGrids | None, load: float) -> float:
    """Height in [m] that the solver of a ``field`` leaves open under ``load`` [N]: its tolerance of the approach."""
    if contact is None or field is None:
        return 0.0
    return field.usual.settings.tolerance * float(approach_of_force(contact.elastic, load))


def longest_travel(footprint: float | None, tolerance: float) -> float:
    """Longest way in [m] of a stretch over a ``footprint`` [m], which is None without a field on a road."""
    if footprint is None:
        return math.inf
    return footprint * (LONGEST_LOOSE if tolerance >= LOOSE else LONGEST)


def highest_speed(scene: dict[str, Any]) -> float:
    """Highest speed in [m/s] of a resolved scene's programme, forward or backward."""
    travel = scene["travel"]
    points = travel.get("points") or [(0.0, travel["speed"])]
    return max(abs(float(speed)) for _, speed in points)


def coupled_timing(scene: dict[str, Any], with_field: bool, footprint: float | None) -> Timing:
    """Cut of a block; segments fit the shortest stretch over a ``footprint`` [m], which is None without a field on a road."""
    if footprint is None:
        return make_timing(scene, with_field)
    way = highest_speed(scene) / float(scene["outputs"]["force_rate"])
    return make_timing(scene, with_field, max(1, math.ceil(way / (SHORTEST * footprint))))


def uniform_segments(scene: dict[str, Any], footprint: float, timing: Timing) -> int:
    """Segments of stretches that are all equal: the most that divide an interval and are short against the ``footprint`` [m]."""
    way = highest_speed(scene) * timing.segment_length
    divisors = [n for n in range(1, timing.segments + 1) if timing.segments % n == 0]
    return max(n for n in divisors if n == 1 or n * way <= LONGEST_UNIFORM * footprint)
