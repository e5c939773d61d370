"""Edges and walls of a road: what no grid resolves is said once before the run, what no tire climbs
is refused.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import height_along
from contact_sim_pkg.run.sources import make_surface, make_travel
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.road import BumpRoad, CleatRoad, StepRoad

__all__ = ["edge_cautions", "refuse_high_walls", "sharp_edge"]

CELLS = 3.0
"""Cells along an edge: on a shorter one the peak pressure grows with every finer grid."""

PLACED = 3.5
"""[1/m] error of the largest force over the length of a cell: 7 a metre by which an edge is out of place
(a kerb of 30 mm at 5 m/s), half a cell at most.
"""

CLIMBED, CLIMBED_HIGH, HIGHEST = 0.998, 0.95, 0.89
"""Of the radius: a tire that touches further before its axle does not climb, or not as far as the top
of what is higher than `HIGHEST`, the height of a sharp wall that it does climb.
"""

BESIDE, ROOM = 0.018, 0.05
"""[m] of contact beside the place where a rigid tire touches: known to be there, and enough."""

SPACING, MOST_PLACES = 1e-3, 2000
"""[m] of the places that are looked at, and how many of them the wheel stands over."""


def sharp_edge(scene: ResolvedScene, field: FieldSettings | None) -> float | None:
    """Length [m] along the road of an edge that the cells of a field do not resolve; None where
    there is none, or no field.
    """
    road = scene.road
    if road is None or field is None:
        return None
    if road.kind in ("cleat", "pothole"):
        length = float(road.edge)
    elif road.kind == "step":
        length = float(road.length)
    else:
        return None
    return length if length < CELLS * field.cell_x else None


def edge_cautions(scene: ResolvedScene, field: FieldSettings | None) -> tuple[str, ...]:
    """A sentence where the peak pressure of the tire is not determined."""
    length = sharp_edge(scene, field)
    if length is None or field is None:
        return ()
    sentence = (
        f"tire: its peak pressure on the edge of the road is not determined: the edge is {1e3 * length:g} mm long, three cells "
        f"of effects.tire.contact_field are {1e3 * CELLS * field.cell_x:.3g} mm, and each finer grid finds a higher peak; "
        f"force and motion err there by some {PLACED * field.cell_x:.1g} of the largest, since the cells place the edge within "
        "half of one"
    )
    return (sentence,)


def refuse_high_walls(scene: ResolvedScene, form: TireForm, field: FieldSettings | None) -> None:
    """Raise SceneError where the tire is to roll against an obstacle that it cannot climb, or that it
    would touch further before its axle than its field reaches.

    That is known of an obstacle that rises out of even road. The tire is taken as rigid: its height
    over the road is ``max over x of road(s + x) - z(x)``, z the ``form`` over its lowest point, and
    it touches where that is largest.
    """
    road = scene.road
    if field is None or road is None or road.kind not in ("bump", "cleat", "step") or road.height <= 0.0:
        return
    reached, radius = _touched(scene, road, form), form.radius_rolling
    steepest = CLIMBED if road.height <= HIGHEST * radius else CLIMBED_HIGH
    if reached > steepest * radius:
        flank = "edge" if road.kind == "cleat" else "length"
        sentence = (
            f"{road.height:g} m is a wall near the height of the axle, which stands {radius:.3g} m above the road, and no tire "
            f"climbs it; at most {HIGHEST * radius:.2g} m, or flanks less steep: a longer road.{flank}"
        )
        raise SceneError([Fault("scene", 0, 0, "road.height", sentence)])
    half = field.rows * field.cell_x  # of the wide grid
    if reached + BESIDE > half:
        needed = math.ceil(100.0 * (reached + ROOM)) / 100.0
        sentence = (
            f"the tire touches the {road.kind} of {road.height:g} m already {reached:.3g} m before its axle, and a field of "
            f"{half:.3g} m sees no further than that; {needed:g} m are enough"
        )
        raise SceneError([Fault("scene", 0, 0, "effects.tire.contact_field.length", sentence)])


def _touched(scene: ResolvedScene, road: BumpRoad | CleatRoad | StepRoad, form: TireForm) -> float:
    """Furthest place before the axle [m] at which a rigid tire touches the obstacle within the run."""
    radius = form.radius_rolling
    start, end = make_travel(scene).extent(0.0, scene.duration)
    if not start + radius < road.position < end + radius:
        return 0.0
    surface = make_surface(scene, SPACING)
    x = numpy.arange(0.0, radius, SPACING)
    height = numpy.array([height_along(form, float(each)) for each in x])
    first, last = road.position - 0.5 * road.length - radius, road.position + 0.5 * road.length
    places = numpy.arange(first, last, max(SPACING, (last - first) / MOST_PLACES))
    line = numpy.zeros(1)
    furthest = [int(numpy.argmax(surface.heights(place + x, line)[:, 0] - height)) for place in places]
    return float(x[max(furthest, default=0)])
