"""What no grid resolves: the peak pressure on an edge of the road, said once before the run."""

from __future__ import annotations

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["edge_cautions", "sharp_edge"]

CELLS = 3.0
"""Cells along an edge: on a shorter one the peak pressure grows with every finer grid."""


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
        "forces and motion converge"
    )
    return (sentence,)
