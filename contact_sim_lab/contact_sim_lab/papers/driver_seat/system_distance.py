"""System *distance*: two bodies of one's own, by the genetic search of the paper, by SLSQP from its
best point and by Newton steps (Driver and Seat eqs 1, 2).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.closest import Closest, minimum_distance
from contact_sim_lab.papers.distance.convex_body import (
    BodyError,
    ConvexBody,
    box,
    ellipsoid,
    half_space,
    sphere,
)
from contact_sim_lab.papers.distance.convex_intersection import polyhedron
from contact_sim_lab.papers.distance.genetic_search import constraint_values, genetic_distance, genetic_interference
from contact_sim_lab.papers.distance.interference import Interference, interference
from contact_sim_lab.papers.inputs import numbers_of, read_document
from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.files import printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["body_of", "distance"]

Array = NDArray[numpy.float64]

KINDS: dict[str, tuple[str, ...]] = {
    "sphere": ("centre", "radius"),
    "ellipsoid": ("centre", "half_axes"),
    "box": ("centre", "half_sides"),
    "half_space": ("normal", "offset"),
    "polyhedron": ("normals", "offsets"),
}
"""Keys of each kind; ellipsoid and box also take `rotation`, a vector along the axis, its length the angle [rad]."""

TURNED = ("ellipsoid", "box")
CELLS = 241  # of a section, each way
COLOURS = ("#136f96", "#e08a2e")


def distance(path: Path | None, values: Values) -> SystemResult:
    """Distance of the bodies `body_1` and `body_2` of a YAML file, or how deep they overlap.

    Raises PaperError for a body that is none.
    """
    assert path is not None
    document = read_document(path)
    if set(document) != {"body_1", "body_2"}:
        raise PaperError(f"{path}: the keys body_1 and body_2 are needed, not {printable(', '.join(document))}")
    first, second = (body_of(document[name], f"{path}: {name}") for name in ("body_1", "body_2"))
    closest = minimum_distance(first, second)
    if closest.overlap:
        return _overlap(first, second, int(values["seed"]))
    return _apart(first, second, closest, int(values["seed"]))


def body_of(section: Any, where: str) -> ConvexBody:
    """A body of a section of the file; PaperError, which names the place ``where``."""
    if not isinstance(section, Mapping) or section.get("kind") not in KINDS:
        raise PaperError(f"{where}: a kind of {', '.join(KINDS)} is needed, not {printable(str(section))}")
    kind = str(section["kind"])
    allowed = {"kind", *KINDS[kind], *(("rotation",) if kind in TURNED else ())}
    if set(section) - allowed or set(KINDS[kind]) - set(section):
        raise PaperError(f"{where}: {kind} takes {', '.join(sorted(allowed))}, not {printable(', '.join(section))}")
    try:
        return _made(kind, section, where)
    except BodyError as error:
        raise PaperError(f"{where}: {error}") from None


def _made(kind: str, section: Mapping[str, Any], where: str) -> ConvexBody:
    def vector(name: str) -> Array:
        return numbers_of(section[name], f"{where}.{name}", (3,))

    def number(name: str) -> float:
        return float(numbers_of(section[name], f"{where}.{name}", ()))

    if kind == "sphere":
        return sphere(vector("centre"), number("radius"))
    if kind == "half_space":
        return half_space(vector("normal"), number("offset"))
    if kind == "polyhedron":
        normals = numbers_of(section["normals"], f"{where}.normals", (None, 3))
        return polyhedron(normals, numbers_of(section["offsets"], f"{where}.offsets", (len(normals),)))
    turned = rotation_about(vector("rotation")) if "rotation" in section else numpy.eye(3)
    if kind == "box":
        return box(vector("centre"), vector("half_sides"), turned)
    return ellipsoid(vector("centre"), vector("half_axes"), turned)


def rotation_about(turn: Array) -> Array:
    """Rotation matrix [3, 3] of a rotation vector [3] [rad]."""
    from scipy.spatial.transform import Rotation

    return numpy.asarray(Rotation.from_rotvec(turn).as_matrix())


def _apart(first: ConvexBody, second: ConvexBody, closest: Closest, seed: int) -> SystemResult:
    alone = genetic_distance(first, second, seed, polish=False)
    polished = genetic_distance(first, second, seed)
    rows: list[Mapping[str, Any]] = [
        {"by": "genetic search", "distance_m": alone.value, "residual": alone.residual, "evaluations": alone.evaluations,
         **_places(alone.points)},
        {"by": "SLSQP from its point", "distance_m": polished.value, "residual": polished.residual,
         "evaluations": polished.evaluations, **_places(polished.points)},
        {"by": "Newton steps", "distance_m": closest.distance, "residual": closest.residual, "evaluations": None,
         **_places(numpy.stack([closest.point_1, closest.point_2]))},
    ]  # fmt: skip
    points = numpy.stack([closest.point_1, closest.point_2])
    note = "residual: of the Karush-Kuhn-Tucker conditions, lengths over the size of the pair"
    return SystemResult(rows, lambda canvas: _draw(canvas, (first, second), points, 0.0), note, (8.0, 4.0))


def _overlap(first: ConvexBody, second: ConvexBody, seed: int) -> SystemResult:
    try:
        found: Interference = interference(first, second)
    except ValueError as error:
        raise PaperError(str(error)) from None
    searched = genetic_interference(first, second, seed)
    rows: list[Mapping[str, Any]] = [
        {"by": "genetic search, Nelder and Mead from its point", "interference_m": searched.value,
         "residual": searched.residual, **_place("centre", searched.points[0])},
        {"by": "largest ball inside both", "interference_m": found.depth, "residual": found.residual,
         **_place("centre", found.point)},
    ]  # fmt: skip
    kind = "the penetration depth" if found.one_foot_each else "smaller than the penetration depth or of nested bodies"
    note = f"the bodies overlap: d is the diameter of the largest ball inside both (eq 2), here {kind}"
    points = numpy.stack(
        [found.point - 0.5 * found.depth * found.normal, found.point + 0.5 * found.depth * found.normal]
    )
    return SystemResult(rows, lambda canvas: _draw(canvas, (first, second), points, found.depth), note, (8.0, 4.0))


def _places(points: Array) -> dict[str, list[float]]:
    return {**_place("point_1", points[0]), **_place("point_2", points[1])}


def _place(name: str, point: Array) -> dict[str, list[float]]:
    return {f"{name}_m": [float(value) for value in point]}


def _draw(canvas: Canvas, bodies: tuple[ConvexBody, ConvexBody], points: Array, diameter: float) -> None:
    """Sections of both bodies in two planes through the line of the points."""
    middle, line = points.mean(axis=0), points[1] - points[0]
    length = float(numpy.linalg.norm(line))
    line = line / length if length > 0.0 else numpy.array([1.0, 0.0, 0.0])
    side = numpy.cross(line, numpy.eye(3)[numpy.abs(line).argmin()])
    side /= numpy.linalg.norm(side)
    reach = 1.2 * (length + max(_reach(body, middle) for body in bodies))
    places = numpy.linspace(-reach, reach, CELLS)
    axes = canvas.subplots(1, 2)
    for place, across, name in zip(axes, (side, numpy.cross(line, side)), ("first", "second"), strict=True):
        u, v = numpy.meshgrid(places, places)
        grid = middle + u[..., None] * line + v[..., None] * across
        for body, colour in zip(bodies, COLOURS, strict=True):
            worst = constraint_values(body, grid.reshape(-1, 3)).max(axis=0).reshape(u.shape)
            place.contourf(u, v, worst, levels=[-math.inf, 0.0], colors=[colour], alpha=0.25)
            place.contour(u, v, worst, levels=[0.0], colors=[colour], linewidths=1.2)
        place.plot([-0.5 * length, 0.5 * length], [0.0, 0.0], color="#333333", marker="o", markersize=4)
        if diameter > 0.0:
            turn = numpy.linspace(0.0, 2.0 * math.pi, 181)
            place.plot(
                0.5 * diameter * numpy.cos(turn), 0.5 * diameter * numpy.sin(turn), color="#333333", linestyle=":"
            )
        place.set_aspect("equal")
        place.set_title(f"{name} plane through the line", fontsize=9)
        place.set_xlabel("along the line of the points, m")
    axes[0].set_ylabel("across it, m")


def _reach(body: ConvexBody, middle: Array) -> float:
    """How far a body is drawn [m]: to its far side where it has one."""
    finite = body.half_axes[numpy.isfinite(body.half_axes)]
    depths = body.offsets - body.normals @ body.inside
    own = max([*finite, *(depths[: 2 * len(depths)])], default=1.0)
    return min(float(numpy.linalg.norm(body.inside - middle)) + float(own), 2.0 * float(own))
