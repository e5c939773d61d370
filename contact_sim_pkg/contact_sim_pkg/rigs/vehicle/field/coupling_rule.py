"""How far the bodies go from one solution of the pressure fields to the next."""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative
from contact_sim_pkg.records.state import State
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldGrids
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.scene.schema.fields import given
from contact_sim_pkg.scene.schema.general import Integrator
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

SHORTEST, FOR_TOLERANCE, FINEST = 0.04, 1e-2, 0.05
"""Of the standing footprint's length: the segments of a block where a force may err by that much or
more; with the square root of the tolerance they get shorter, as the coupling steps do, down to `FINEST`.
"""

DELIVERED = 5e-5
"""Error of a force over its largest that no request makes smaller on a road that is not level. Measured
at 1e-4 and 1e-5 beside half as many cells again and coupling steps a third as long: 8.0e-5 and 7.6e-5
on `tire_rough_road`, 6.0e-5 and 9.4e-5 on `car_full_bench`, 5.0e-5 and 6.7e-5 on `tire_bump`.
"""

FINEST_REQUEST = 1e-4
"""The finest request that is about delivered."""

SOLVED = 3e-7
"""[s] of computing a cell and coupling step, checks included."""

SHORTEST_FOR_NOISE = 1e-3
"""[s]; a coupling step may always be as short as this."""


FIRST_WAY = 0.125
"""Of the standing footprint's length: the first coupling steps, before any was checked."""

SILENT, SILENT_WAY = 1e-3, 2.5
"""Part of the allowed error below which a step has met nothing, as on level road, and how many first
ways steps that have met nothing may be long: of what comes they know nothing.
"""

AIM, UNLUCKY, UNLUCKIER, NEWEST = 0.9, 3.0, 0.6, 0.125
"""Of `MeasuredWay`: part of the allowed error that is aimed at, largest value over the root mean
square, how much more for each tenfold finer request, weight of the newest value in that square.
"""


class Allowance(NamedTuple):
    """What a coupling step may miss of the effective height of one contact."""

    height: float = math.inf  # [m]
    speed: float = math.inf  # [m/s] of its rate
    noise: float = 0.0  # [m] left in it by the solver of the field
    force: float = math.inf  # [N]
    load: float = 0.0  # [N] at rest

    def part(self, height: float, rate: float) -> float:
        """An error of the ``height`` [m], or of its ``rate`` [m/s], over the allowed one."""
        return max(height / self.height, rate / self.speed)

    def missed_force(self, force: float, stiffness: float, height: float, rate: float) -> float:
        """Error [N] of a ``force`` [N] on a ``stiffness`` [N/m] by an error of the ``height`` [m], or of
        its ``rate`` [m/s], which the loss sees; at least that at rest, since a load may leap in a step.
        """
        if self.load <= 0.0:
            return 0.0
        by_rate = max(force, self.load) * rate * self.force / self.load / self.speed
        return max(max(stiffness, self.force / self.height) * height, by_rate)


class MeasuredWay:
    """Longest way of a coupling step by what steps were found to miss in their middle.

    The largest error of a run falls about with the way of its steps: faster on waves that they
    resolve, not at all on others. So the bound is the way on which the most unlucky step misses `AIM`,
    by the root mean square of what the checked ones missed over their way. Only few are checked: of
    values with a root mean square sigma the largest of some hundred is about `UNLUCKY` sigma.
    """

    STATE = State((), ("longest", "_square"))

    def __init__(self, first: float, shortest: float, tolerance: float = FOR_TOLERANCE) -> None:
        """``first`` [m]: way that a run begins with; ``shortest`` [m]: no bound is less; ``tolerance``
        [1] of the force: a finer one has more steps, and among them unluckier ones.
        """
        self._first, self._shortest = first, shortest
        self._unlucky = UNLUCKY + UNLUCKIER * max(0.0, math.log10(FOR_TOLERANCE / tolerance))
        self.reset()

    def reset(self) -> None:
        """As before the first check."""
        self.longest = self._first  # [m]
        self._square = 0.0  # mean of (part missed over way)^2 [1/m^2]

    def learn(self, way: float, missed: float) -> None:
        """A step over a ``way`` [m] ``missed`` this part of what it may."""
        if way <= 0.0 or (missed < SILENT and self.longest >= SILENT_WAY * self._first):
            return
        self._square += NEWEST * ((missed / way) ** 2 - self._square)
        wanted = AIM / max(self._unlucky * math.sqrt(self._square), 1e-9)
        self.longest = max(self._shortest, min(max(wanted, 0.5 * self.longest), 2.0 * self.longest))


class CouplingRule(NamedTuple):
    """Lengths that a coupling step between two solutions of the fields may have, and what it may
    miss.
    """

    tolerance: float  # error of a force over the standing load
    allowances: tuple[Allowance, Allowance]  # of tire and seat
    longest: tuple[float, float]  # [m] of travel, where the road is nearly straight and where it is not
    shortest: int  # segments: no error alone makes a coupling step shorter
    segments: int | None  # of each coupling step, where all must be equal; None: chosen by the error
    ways: tuple[float, float]  # [m] of the first steps, and the least bound of a step; infinite, 0 without a road


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
        tolerance / damping if damping > 0.0 else math.inf, own * approach, tolerance * load, load,
    )  # fmt: skip


def longest_travels(footprint: float | None, has_bristles: bool, longest: float | None) -> tuple[float, float]:
    """Longest ways in [m] of a coupling step over a ``footprint`` [m], which is None without a field
    on a road: where the road is nearly straight, and elsewhere.
    """
    if footprint is None:
        return math.inf, math.inf
    straight, rough = footprint * (LONGEST_ROUGH if has_bristles else LONGEST), footprint * LONGEST_ROUGH
    return (straight, rough) if longest is None else (min(straight, longest), min(rough, longest))


def shortest_time(allowance: Allowance) -> float:
    """Time in [s] over which the solver's error of a height is no more than the allowed speed; at
    most `SHORTEST_FOR_NOISE`.
    """
    return min(allowance.noise / allowance.speed, SHORTEST_FOR_NOISE)


def highest_speed(scene: ResolvedScene) -> float:
    """Highest speed in [m/s] of a resolved scene's programme, forward or backward."""
    travel = given(scene.travel)
    return max(abs(speed) for _time, speed in travel.points or [[0.0, given(travel.speed)]])


def shortest_way(footprint: float, integrator: Integrator) -> float:
    """Way [m] of a segment over a ``footprint`` [m]: a checked coupling step has two."""
    finer = min(1.0, max(FINEST, math.sqrt(given(integrator.coupling_tolerance) / FOR_TOLERANCE)))
    longest = math.inf if integrator.coupling_length is None else integrator.coupling_length
    return min(SHORTEST * footprint * finer, 0.5 * longest)


def first_ways(footprint: float, integrator: Integrator) -> tuple[float, float]:
    """Ways [m] of `MeasuredWay` over a ``footprint`` [m]: of the first coupling steps, and the least."""
    shortest = 2.0 * shortest_way(footprint, integrator)
    return max(FIRST_WAY * footprint, shortest), shortest


def coupled_timing(scene: ResolvedScene, with_field: bool, footprint: float | None) -> Timing:
    """Cut of a block; segments fit the shortest coupling step over a ``footprint`` [m], which is
    None without a field on a road.
    """
    if footprint is None:
        return make_timing(scene, with_field)
    way = highest_speed(scene) / scene.outputs.force_rate
    shortest = shortest_way(footprint, scene.integrator)
    return make_timing(scene, with_field, max(1, math.ceil(way / shortest)))


def request_cautions(scene: ResolvedScene, rule: CouplingRule | None, grids: FieldGrids | None) -> tuple[str, ...]:
    """A sentence where a scene requests less error of its tire than coupling steps and cells deliver."""
    asked, road = requested(scene.accuracy), scene.road
    if rule is None or grids is None or road is None or road.is_even or asked >= DELIVERED:
        return ()
    field, shortest = grids.usual.settings, rule.ways[1]
    steps = highest_speed(scene) / shortest
    sentence = (
        f"tire: an error of {number_of(asked)} is requested, that of its force is not below some {number_of(DELIVERED)}: coupling "
        f"steps end at {1e3 * shortest:.2g} mm, cells at {1e3 * field.cell_x:.2g} mm; where the road calls for them, they take "
        f"about {steps * field.rows * field.cols * SOLVED:.0f} s of computing a simulated second; "
        f"accuracy: {number_of(FINEST_REQUEST)} takes less and delivers as much"
    )
    return (sentence,)


def uniform_segments(scene: ResolvedScene, footprint: float, timing: Timing) -> int:
    """Segments of coupling steps that are all equal: the most that divide an interval and are short
    against the ``footprint`` [m].
    """
    way = highest_speed(scene) * timing.segment_length
    divisors = [n for n in range(1, timing.segments + 1) if timing.segments % n == 0]
    return max(n for n in divisors if n == 1 or n * way <= LONGEST_UNIFORM * footprint)


def even_part(whole: int, most: float) -> int:
    """A part of ``whole`` segments, at most ``most`` of them and at least one, such that the others are
    as long.
    """
    parts = -(-whole // max(1, int(most)))
    return -(-whole // parts)


@entry
def extent_of(values: Vector) -> float:
    """Largest value over the least."""
    least, largest = values[0], values[0]
    for value in values:
        least, largest = min(least, value), max(largest, value)
    return largest - least


@entry
def bend_of(height: Vector) -> float:
    """Largest distance [m] of a height [points] [m] from the straight line between its ends."""
    last, bend = len(height) - 1, 0.0
    slope = (height[last] - height[0]) / last
    for i in range(1, last):
        bend = max(bend, abs(height[i] - (height[0] + slope * i)))
    return bend
