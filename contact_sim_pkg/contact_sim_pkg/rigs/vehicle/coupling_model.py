"""How far the bodies go from one solution of the pressure fields to the next."""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative
from contact_sim_pkg.rigs.vehicle.contact_field import FieldGrids
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given
from contact_sim_pkg.scene.timing import Timing, make_timing

LONGEST = 1.1
"""Of the standing footprint's length, from one solution of the tire's field to the next, where the
road is nearly straight: one of them feels every obstacle that is longer than a tenth of it.
"""

LONGEST_ROUGH = 0.5
"""The same where it is not, so that two fields feel an obstacle, and where bristles pass the
footprint under a pressure that is linear in time.
"""

STRAIGHT = 3.0
"""Of the allowed height: a smooth height that bends by less is nearly straight. Of the bend the
weights of the footprint miss a part only.
"""

LONGEST_UNIFORM = 0.125
"""The same where the coupling steps cannot be chosen by their error."""

SHORTEST = 0.1
"""Of the standing footprint's length: a coupling step may be as short as this."""


SHORTEST_FOR_NOISE = 1e-3
"""[s]; a coupling step may always be as short as this."""


class Allowance(NamedTuple):
    """What a coupling step may miss of the effective height of one contact."""

    height: float = math.inf  # [m]
    speed: float = math.inf  # [m/s] of its rate
    noise: float = 0.0  # [m] left in it by the solver of the field


class CouplingRule(NamedTuple):
    """Lengths that a coupling step between two solutions of the fields may have, and what it may
    miss.
    """

    tolerance: float  # error of a force over the standing load
    allowances: tuple[Allowance, Allowance]  # of tire and seat
    longest: tuple[float, float]  # [m] of travel, where the road is nearly straight and where it is not
    shortest: int  # segments: no error alone makes a coupling step shorter
    segments: int | None  # of each coupling step, where all must be equal; None: chosen by the error


def allowance_of(contact: Contact | None, field: FieldGrids | None, load: float, tolerance: float) -> Allowance:
    """What changes the force of a contact under ``load`` [N] by the part ``tolerance`` of it: a
    height, or a speed through its loss.

    A field is solved to a tolerance of its own: its error would be taken for changes of the height,
    so less than that counts as that.
    """
    if contact is None:
        return Allowance()
    own = 0.0 if field is None else field.usual.settings.tolerance
    tolerance, approach = max(tolerance, own), float(approach_of_force(contact.elastic, load))
    loss = contact.dissipative
    damping = loss.damping if isinstance(loss, NormalDissipative) else 0.0
    return Allowance(
        tolerance * load / float(elastic_stiffness(contact.elastic, approach)),
        tolerance / damping if damping > 0.0 else math.inf, own * approach,
    )  # fmt: skip


def longest_travels(footprint: float | None, has_bristles: bool) -> tuple[float, float]:
    """Longest ways in [m] of a coupling step over a ``footprint`` [m], which is None without a field
    on a road: where the road is nearly straight, and elsewhere.
    """
    if footprint is None:
        return math.inf, math.inf
    return footprint * (LONGEST_ROUGH if has_bristles else LONGEST), footprint * LONGEST_ROUGH


def shortest_time(allowance: Allowance) -> float:
    """Time in [s] over which the solver's error of a height is no more than the allowed speed; at
    most `SHORTEST_FOR_NOISE`.
    """
    return min(allowance.noise / allowance.speed, SHORTEST_FOR_NOISE)


def highest_speed(scene: ResolvedScene) -> float:
    """Highest speed in [m/s] of a resolved scene's programme, forward or backward."""
    travel = given(scene.travel)
    return max(abs(speed) for _time, speed in travel.points or [[0.0, given(travel.speed)]])


def coupled_timing(scene: ResolvedScene, with_field: bool, footprint: float | None) -> Timing:
    """Cut of a block; segments fit the shortest coupling step over a ``footprint`` [m], which is
    None without a field on a road.
    """
    if footprint is None:
        return make_timing(scene, with_field)
    way = highest_speed(scene) / scene.outputs.force_rate
    return make_timing(scene, with_field, max(1, math.ceil(way / (SHORTEST * footprint))))


def uniform_segments(scene: ResolvedScene, footprint: float, timing: Timing) -> int:
    """Segments of coupling steps that are all equal: the most that divide an interval and are short
    against the ``footprint`` [m].
    """
    way = highest_speed(scene) * timing.segment_length
    divisors = [n for n in range(1, timing.segments + 1) if timing.segments % n == 0]
    return max(n for n in divisors if n == 1 or n * way <= LONGEST_UNIFORM * footprint)
