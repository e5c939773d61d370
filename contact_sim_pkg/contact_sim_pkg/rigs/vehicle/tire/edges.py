"""Corners and walls of a road: where no grid determines the peak pressure is said once before the
run, what no tire climbs and what a tire touches beyond its grid is refused.
"""

from __future__ import annotations

import math
from contextlib import suppress
from typing import NamedTuple

import numpy

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import Obstacle
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import ElasticLaw
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import highest_speed
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import height_along
from contact_sim_pkg.run.sources import make_surface, make_travel
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Landing", "SharpEdge", "edge_cautions", "landing_of", "refuse_high_walls", "sharp_edge"]

CELLS = 3.0
"""Cells along an edge or a whole obstacle: the cells do not place a shorter one, and forces err by that."""

CELLS_OF_PEAK = 8.0
"""Cells along a whole obstacle: on fewer of them the peak pressure is that of the cells."""

CORNER = 0.015
"""Change of the road's slope at once, from which on the peak pressure is found there and grows with
every finer grid: by E* times the change times ln 2/(2 pi) each time the cells are halved, or a little
more (Johnson, Contact Mechanics, section 5.2: the pressure of a wedge grows with the logarithm of the
distance). Largest peak of a tire of 3335 N over a ramp of 20 mm at 72, 144, 288 cells along: slope 0.01
239, 239, 239 kPa; 0.02 303, 315, 327; 0.04 345, 369, 392.
"""

PLACED = 3.5
"""[1/m] error of the largest force over the length of a cell: 7 a metre by which an edge is out of place
(a kerb of 30 mm at 5 m/s), half a cell at most.
"""

PLACED_MOTION = 11.0
"""[1/m] the same of the motion: bars of 20 mm height with flanks of 1 mm err by 0.02 to 0.04 on cells of 3.75 mm."""

FEW_OF_FORCE, FEW_OF_MOTION = 0.06, 0.2
"""Errors by an obstacle of `CELLS` to `CELLS_OF_PEAK` cells: 20 mm height and 12 to 28 mm length on cells of
3.75 mm err by 0.02 to 0.06 and 0.04 to 0.16.
"""

OF_FORCE, OF_MOTION = 0.1, 0.3
"""Errors by an obstacle of fewer than `CELLS` cells, which may stand on one cell more or less: bars of
20 mm height and 4 to 12 mm length on cells of 3.75 mm err by 0.03 to 0.09 and 0.10 to 0.28.
"""

CLIMBED, CLIMBED_HIGH, HIGHEST = 0.998, 0.95, 0.89
"""Of the radius: a tire that touches further before its axle does not climb, or not as far as the top
of what is higher than `HIGHEST`, the height of a sharp wall that it does climb.
"""

RIM, ROOM = 1.5, 2.0
"""Cells beyond the furthest place that the contact touches: needed, since its grid ends with free
ones, and enough beyond the furthest that it may touch.
"""

PLACES_AT_ONCE = 1 << 16
"""Of the wheel on the road of a file."""

SPACING, MOST_PLACES = 1e-3, 2000
"""[m] of the places that are looked at, and how many of them the wheel stands over."""


class SharpEdge(NamedTuple):
    """Corners of a road, or an obstacle of few cells, at which the grid does not determine the peak
    pressure.
    """

    length: float  # [m] of the flank between two corners, or of the obstacle
    turn: float  # [1] change of the slope at each, as the cells see it
    is_short: bool  # whether the cells place it only within half of one
    is_obstacle: bool = False  # whether it is the whole obstacle that has few cells


def sharp_edge(scene: ResolvedScene, field: FieldSettings | None) -> SharpEdge | None:
    """The corners of an obstacle on the cells of a field, or the obstacle where it has few of them; None
    where there are none, or no field.
    """
    obstacle = None if scene.road is None else scene.road.obstacle()
    if obstacle is None or field is None:
        return None
    flank, whole = obstacle.flank, obstacle.length if obstacle.ends else math.inf
    turn = abs(obstacle.height) / max(flank, field.cell_x)
    if turn < CORNER:
        return None
    if whole < CELLS_OF_PEAK * field.cell_x:
        return SharpEdge(whole, turn, whole < CELLS * field.cell_x, is_obstacle=True)
    return SharpEdge(flank, turn, flank < CELLS * field.cell_x) if obstacle.has_corners else None


def edge_cautions(scene: ResolvedScene, field: FieldSettings | None) -> tuple[str, ...]:
    """A sentence where the peak pressure of the tire is not determined."""
    edge = sharp_edge(scene, field)
    if edge is None or field is None:
        return ()
    if edge.is_obstacle:
        cells = CELLS if edge.is_short else CELLS_OF_PEAK
        force, motion = (OF_FORCE, OF_MOTION) if edge.is_short else (FEW_OF_FORCE, FEW_OF_MOTION)
        sentence = (
            "tire: its peak pressure on the obstacle of the road is not determined: the obstacle is "
            f"{1e3 * edge.length:g} mm long, {cells:g} cells of effects.tire.contact_field are "
            f"{1e3 * cells * field.cell_x:.3g} mm; force and motion may err there by {force:g} and {motion:g} of the largest; "
            "take more rows, or a shorter field"
        )
    elif edge.is_short:
        force, motion = PLACED * field.cell_x, PLACED_MOTION * field.cell_x
        sentence = (
            f"tire: its peak pressure on the edge of the road is not determined: the edge is {1e3 * edge.length:g} mm long, three "
            f"cells of effects.tire.contact_field are {1e3 * CELLS * field.cell_x:.3g} mm, and each finer grid finds a higher "
            f"peak; force and motion err there by some {force:.1g} and up to {motion:.1g} of the largest, since the cells place "
            "the edge within half of one"
        )
    else:
        sentence = (
            "tire: its peak pressure at the corners of the road is not determined: the slope of the road changes there by "
            f"{edge.turn:.2g} at once, and each finer grid finds a higher peak; force and motion converge"
        )
    return (sentence,)


class Landing(NamedTuple):
    """What the road presses into the tire as it lifts the wheel."""

    approach: float  # [m] at rest
    footprint: float  # [m] length at rest
    frequency: float  # [rad/s] of the wheel on its tire

    def touching(self, form: TireForm, depth: float) -> tuple[float, float]:
        """Parts [m] of a ``depth`` [m] as far as which the tire touches, at least and at most.

        Half of it on a half-space (Hertz: ``a^2 = R d``). The belt of an inflated tire follows the road,
        and at least what lies deeper than the ends of the footprint at rest touches.
        """
        if not form.circular:
            return 0.5 * depth, 0.5 * depth
        return depth - max(0.0, self.approach - self.footprint**2 / (8.0 * form.radius_rolling)), depth


def landing_of(law: ElasticLaw, load: float, mass: float, footprint: float) -> Landing:
    """Of a ``mass`` [kg] on a tire that carries ``load`` [N] at rest on a ``footprint`` [m]."""
    approach = float(approach_of_force(law, load))
    return Landing(approach, footprint, math.sqrt(float(elastic_stiffness(law, approach)) / mass))


def refuse_high_walls(scene: ResolvedScene, form: TireForm, field: FieldSettings | None, landing: Landing) -> None:
    """Raise SceneError where the tire is to roll against an obstacle that it cannot climb, or that it
    would touch further before its axle than its field reaches.

    That is known of an obstacle that rises out of even road. The height of a rigid tire over the road
    is ``h(s) = max over x of road(s + x) - z(x)``, z the ``form`` over its lowest point, and it touches
    where that is largest. A wheel that is lifted by h at the speed of the scene, on its tire as on a
    linear spring without damping, sinks in by a, and touches as far as ``road - z > h - a``.
    """
    road = scene.road
    if field is not None and road is not None and "road.file" in scene.files:
        # What is wrong with the file says the source of the road, which may also be a bag.
        with suppress(ExcitationError):
            _refuse_high_places(scene, form, field, landing)
    obstacle = None if road is None else road.obstacle()
    if field is None or road is None or obstacle is None or obstacle.height <= 0.0:
        return
    (rigid, reached, most), radius = _touched(scene, obstacle, form, landing), form.radius_rolling
    steepest = CLIMBED if obstacle.height <= HIGHEST * radius else CLIMBED_HIGH
    if rigid > steepest * radius:
        sentence = (
            f"{obstacle.height:g} m is a wall near the height of the axle, which stands {radius:.3g} m above the road, and no tire "
            f"climbs it; at most {HIGHEST * radius:.2g} m, or flanks less steep: a longer road.{obstacle.flank_key}"
        )
        raise SceneError([Fault("scene", 0, 0, "road.height", sentence)])
    half = field.rows * field.cell_x  # of the wide grid
    if reached + RIM * field.cell_x > half:
        needed = math.ceil(100.0 * (most + ROOM * field.cell_x)) / 100.0
        sentence = (
            f"the tire touches the {road.kind} of {obstacle.height:g} m as far as {reached:.3g} m before its axle, and a field of "
            f"{half:.3g} m sees no further than that; {needed:g} m are enough"
        )
        raise SceneError([Fault("scene", 0, 0, "effects.tire.contact_field.length", sentence)])


def _touched(scene: ResolvedScene, obstacle: Obstacle, form: TireForm, landing: Landing) -> tuple[float, float, float]:
    """Furthest places before the axle [m] at which a rigid tire touches the obstacle within the run,
    and one that sinks in, at least and at most.
    """
    radius = form.radius_rolling
    seen = radius if form.circular else 2.0 * radius  # a parabola goes on
    start, end = make_travel(scene).extent(0.0, scene.duration)
    if not start + radius < obstacle.position < end + radius:
        return 0.0, 0.0, 0.0
    surface = make_surface(scene, SPACING)
    x = numpy.arange(0.0, seen, SPACING)
    height = numpy.array([height_along(form, float(each)) for each in x])
    first, last = obstacle.position - 0.5 * obstacle.length - seen, obstacle.position + 0.5 * obstacle.length
    spacing = max(SPACING, (last - first) / MOST_PLACES)
    line, phase = numpy.zeros(1), landing.frequency * spacing / max(highest_speed(scene), SPACING)
    below, swing, before = 0.0, 0.0, 0.0  # wheel below where it would rest, its speed over the frequency; lifted
    rigid, reached = 0.0, [0.0, 0.0]
    for place in numpy.arange(first, last, spacing):
        over = surface.heights(place + x, line)[:, 0] - height
        lifted = float(over.max())
        below += lifted - before
        below, swing, before = (
            below * math.cos(phase) - swing * math.sin(phase), below * math.sin(phase) + swing * math.cos(phase), lifted
        )  # fmt: skip
        rigid = max(rigid, float(x[int(numpy.argmax(over[x < radius]))]))
        for each, depth in enumerate(landing.touching(form, landing.approach + below)):
            touching = numpy.flatnonzero(over > lifted - depth)
            reached[each] = max(reached[each], float(x[touching[-1]]) if len(touching) else 0.0)
    return rigid, reached[0], reached[1]


def _refuse_high_places(scene: ResolvedScene, form: TireForm, field: FieldSettings, landing: Landing) -> None:
    """Raise SceneError where the tire, rolling along the middle of its track over the road of a file, would touch it
    further before its axle than its field reaches.

    The height of a rigid tire over the road is as in `refuse_high_walls`; the tire touches what lies less
    deep below it than what touches at rest. Speed is left out: it presses the tire further in.
    """
    radius, cell = form.radius_rolling, field.cell_x
    half = field.rows * cell  # of the wide grid
    x = numpy.arange(0.0, radius, cell)
    below = [height_along(form, float(each)) for each in x]
    within = int(numpy.searchsorted(x, half - RIM * cell, side="right"))
    depth = landing.touching(form, landing.approach)[0]
    surface, line = make_surface(scene, cell), numpy.zeros(1)
    start, end = make_travel(scene).extent(0.0, scene.duration)
    for first in range(0, int((end - start) / cell) + 1, PLACES_AT_ONCE):
        count = min(PLACES_AT_ONCE, int((end - start) / cell) + 1 - first)
        nodes = start + numpy.arange(first, first + count + len(x) - 1, dtype=numpy.float64) * cell
        height = surface.heights(nodes, line)[:, 0]
        lifted, beyond = numpy.full(count, -numpy.inf), numpy.full(count, -numpy.inf)
        for ahead, lower in enumerate(below):
            over = height[ahead : ahead + count] - lower
            numpy.maximum(lifted, over, out=lifted)
            if ahead >= within:
                numpy.maximum(beyond, over, out=beyond)
        far = numpy.flatnonzero(beyond > lifted - depth)
        if len(far):
            seen = radius if form.circular else 2.0 * radius
            needed = math.ceil(100.0 * (seen + ROOM * cell)) / 100.0
            rise = float(height[far[0] : far[0] + len(x)].max() - height[far[0]])
            sentence = (
                f"{nodes[far[0]]:.4g} m after its start the tire stands before a rise of {rise:.3g} m, which it touches further "
                f"before its axle than the {half:.3g} m that its field sees; {needed:g} m are enough, or travel and "
                "duration that end before"
            )
            raise SceneError([Fault("scene", 0, 0, "effects.tire.contact_field.length", sentence)])
