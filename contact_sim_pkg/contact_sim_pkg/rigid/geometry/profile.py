"""A ground of heights at even distances along x, the same across: what of a body can touch it, and
where.

It is straight from height to height, and beyond its ends. The faces that follow each other over
peaks are one convex piece; in a valley two pieces meet. A point of a body (with its sphere) can
meet every piece within its reach, so that in a valley it has two contacts, each with a gap that
changes steadily. In the plane the edges of a polygon meet the peaks too. Contacts are numbered: for
each point ``reach`` pieces (piece number modulo reach), then ``ridges`` peaks (their number modulo
ridges).

Source: Identifiability eqs 10 and 40.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.problem import PLANE

Numbers = numpy.typing.NDArray[numpy.int64]
STRAIGHT = 1.0e-9  # change of slope below which two faces are one
PAST = 1.0e-9  # of a face or an edge: how far past its end a piece of time goes
HEIGHT, PIECE, PEAK, RUN, END = 0, 1, 2, 3, 4  # columns of the nodes


class Profile(NamedTuple):
    """Heights, and what of them a body can touch at once."""

    # [nodes, 5]: height in [m]; of the face that starts there its convex piece; number of its peak
    # (-1: none); of the straight run of faces that it belongs to the first node and the last
    nodes: Vector
    origin: float  # [m], x of node 0
    cell: float  # [m]
    order: Numbers  # [points] of a polygon, once round; none for other bodies
    top: float  # [m], greatest height
    reach: int  # pieces that a point can touch at once
    ridges: int  # peaks that the edges of the body can touch at once


def flat() -> Profile:
    """No heights: the ground is a plane."""
    return Profile(numpy.zeros((0, 5)), 0.0, 1.0, numpy.zeros(0, numpy.int64), 0.0, 1, 0)


def make_profile(heights: Vector, origin: float, cell: float) -> Profile:
    """Ground through ``heights`` [nodes] in [m] (two or more) at ``origin``, ``origin + cell``, ...
    along x in [m].
    """
    z = numpy.array(heights, float)
    slope_change = numpy.diff(numpy.diff(z) / cell)
    ends = numpy.array([0, *(numpy.flatnonzero(abs(slope_change) > STRAIGHT) + 1), len(z) - 1])
    run = numpy.minimum(numpy.searchsorted(ends, numpy.arange(len(z)), side="right") - 1, len(ends) - 2)
    nodes = numpy.column_stack([z, numpy.zeros(len(z)), numpy.full(len(z), -1.0), ends[run], ends[run + 1]])
    nodes[1:-1, PIECE] = numpy.cumsum(slope_change > STRAIGHT)
    nodes[-1, PIECE] = nodes[-2, PIECE]
    tops = numpy.flatnonzero(slope_change < -STRAIGHT) + 1
    nodes[tops, PEAK] = numpy.arange(len(tops))
    return flat()._replace(nodes=nodes, origin=float(origin), cell=float(cell), top=float(z.max()))


def fitted(profile: Profile, width: int, points: Vector, radius: float) -> Profile:
    """The profile with the numbers of contacts that a body of ``points`` [points, width] and
    ``radius`` [m] can have at once.
    """
    if len(profile.nodes) == 0:
        return profile
    reach = _most_within(profile.nodes[:, PIECE], 2.0 * radius / profile.cell) + 1
    if width != PLANE or radius > 0.0 or len(points) < 3:
        return profile._replace(reach=reach)
    arms = points - points.mean(axis=0)
    order = numpy.argsort(numpy.arctan2(arms[:, 1], arms[:, 0]))
    size = float(numpy.linalg.norm(points, axis=1).max())
    tops = numpy.cumsum(numpy.where(profile.nodes[:, PEAK] >= 0.0, 1.0, 0.0))
    return profile._replace(reach=reach, order=order, ridges=_most_within(tops, 2.0 * size / profile.cell))


def _most_within(count: Vector, cells: float) -> int:
    """Greatest growth of a count that grows along the nodes within so many cells and two more at
    each end.
    """
    ends = numpy.minimum(numpy.arange(len(count)) + math.floor(cells) + 5, len(count) - 1)
    return int((count[ends] - count).max())


def heights_at(profile: Profile, x: Vector) -> Vector:
    """Heights [places] in [m] at ``x`` [places] in [m]; beyond its ends the ground goes straight
    on.
    """
    place = (x - profile.origin) / profile.cell
    face = numpy.clip(numpy.floor(place).astype(int), 0, len(profile.nodes) - 2)
    start, end = profile.nodes[face, HEIGHT], profile.nodes[face + 1, HEIGHT]
    return numpy.asarray(start + (place - face) * (end - start))


def clearance(profile: Profile, corners: Vector, radius: float) -> float:
    """Least gap in [m] between the spheres of ``radius`` about ``corners`` [points, 2] (x, z) and
    the ground.

    Of a fitted profile the peaks under the polygon of the corners count too. Below the ground it is
    negative.
    """
    x_0, z_0, low, high, slopes = _faces(profile)
    x, z = corners[:, :1], corners[:, 1:]
    # nearest place of each face to each corner
    rise = z - z_0[:-1] - slopes * (x - x_0[:-1])
    foot = numpy.clip(x + rise * slopes / (1.0 + slopes**2), low, high)
    away = numpy.hypot(x - foot, z - z_0[:-1] - slopes * (foot - x_0[:-1])).min(axis=1)
    # a corner below a face counts as negative
    below = (numpy.where((x >= low) & (x <= high), rise, math.inf) < 0.0).any(axis=1)
    gap = float((numpy.where(below, -away, away) - radius).min())
    if profile.ridges == 0:
        return gap
    # depth of each peak below the nearest edge of the polygon, negative inside
    peaks, start, edges = _peaks_and_edges(profile, corners)
    outward = numpy.column_stack([edges[:, 1], -edges[:, 0]]) / numpy.linalg.norm(edges, axis=1)[:, None]
    depths = ((peaks[:, None, :] - start) * outward).sum(axis=2).max(axis=1)
    return min(gap, float(depths.min(initial=math.inf)))


def rise_needed(profile: Profile, corners: Vector, radius: float) -> float:
    """How far in [m] the body of `clearance`, with ``corners`` [points, 2], has to be raised along
    z to lie on the ground; negative above it.

    The ground at x' requires a middle ``sqrt(r^2 - (x' - x)^2)`` above it: most where a face is
    tangent, or at its end beside that.
    """
    x_0, z_0, low, high, slopes = _faces(profile)
    x, z = corners[:, :1], corners[:, 1:]
    # where the sphere of a corner meets each face when it is raised from below
    place = numpy.clip(x + radius * slopes / numpy.sqrt(1.0 + slopes**2), low, high)
    under = radius**2 - (place - x) ** 2
    required = z_0[:-1] + slopes * (place - x_0[:-1]) + numpy.sqrt(numpy.maximum(under, 0.0)) - z
    rise = float(required[under >= 0.0].max())
    if profile.ridges == 0:
        return rise
    # each peak must come out below the lowest edge above it
    peaks, start, edges = _peaks_and_edges(profile, corners)
    start, edges = start[edges[:, 0] != 0.0], edges[edges[:, 0] != 0.0]
    share = (peaks[:, :1] - start[:, 0]) / edges[:, 0]
    lowest = numpy.where((share >= 0.0) & (share <= 1.0), start[:, 1] + share * edges[:, 1], math.inf).min(axis=1)
    return max(rise, float((peaks[:, 1] - lowest).max(initial=-math.inf)))


def _faces(profile: Profile) -> tuple[Vector, Vector, Vector, Vector, Vector]:
    """Nodes (x, z); of each face where it begins and ends along x, and its slope."""
    x = numpy.array(profile.origin + profile.cell * numpy.arange(len(profile.nodes)), float)
    low, high = x[:-1].copy(), x[1:].copy()
    low[0], high[-1] = -math.inf, math.inf
    return x, profile.nodes[:, HEIGHT], low, high, numpy.diff(profile.nodes[:, HEIGHT]) / profile.cell


def _peaks_and_edges(profile: Profile, corners: Vector) -> tuple[Vector, Vector, Vector]:
    """Peaks (x, z); starts of the edges of the polygon of ``corners``, once round, and the
    edges.
    """
    x, z, _low, _high, _slopes = _faces(profile)
    start = corners[profile.order]
    return numpy.column_stack([x, z])[profile.nodes[:, PEAK] >= 0.0], start, numpy.roll(start, -1, axis=0) - start


@kernel
def _face_at(profile, x):
    """Number of the face over which x lies; the first and the last go on."""
    return int(min(max(math.floor((x - profile.origin) / profile.cell), 0.0), profile.nodes.shape[0] - 2.0))


@kernel
def _face(profile, j):
    """Start (x, z) of a face and its direction."""
    rise = profile.nodes[j + 1, HEIGHT] - profile.nodes[j, HEIGHT]
    length = math.sqrt(profile.cell * profile.cell + rise * rise)
    return profile.origin + j * profile.cell, profile.nodes[j, HEIGHT], profile.cell / length, rise / length


@kernel
def _gap_of_corner(profile, slot, x, z, first, last):
    """Gap of a point without radius to a piece: the greatest distance from its faces first to last;
    its normal and run of faces.
    """
    gap, n_x, n_z, feature = -math.inf, 0.0, 1.0, -1
    for j in range(max(first, 0), min(last + 1, profile.nodes.shape[0] - 1)):
        if int(profile.nodes[j, PIECE]) % profile.reach != slot:
            continue
        x_0, z_0, t_x, t_z = _face(profile, j)
        distance = t_x * (z - z_0) - t_z * (x - x_0)
        if distance > gap:
            gap, n_x, n_z, feature = distance, -t_z, t_x, int(profile.nodes[j, RUN])
    if feature < 0:
        return profile.cell, 0.0, 1.0, feature
    return gap, n_x, n_z, feature


@kernel
def _lies_below(profile, slot, x, z):
    """Whether (x, z) lies below a face of the piece of a slot."""
    j = _face_at(profile, x)
    x_0, z_0, t_x, t_z = _face(profile, j)
    return int(profile.nodes[j, PIECE]) % profile.reach == slot and t_x * (z - z_0) <= t_z * (x - x_0)


@kernel
def _gap_of_sphere(profile, slot, x, z, radius):
    """Gap of a sphere to a piece, its normal, and the curvature 1/distance where a peak touches it.

    From a middle outside the piece the nearest of the faces that look at it and of the peaks
    counts: below the plane of a face lies all that is behind a sharp peak. Inside it is the nearest
    plane of a face.
    """
    first, last = _face_at(profile, x - radius) - 1, _face_at(profile, x + radius) + 1
    if _lies_below(profile, slot, x, z):
        gap, n_x, n_z, _feature = _gap_of_corner(profile, slot, x, z, first, last)
        return gap - radius, n_x, n_z, 0.0
    faces = profile.nodes.shape[0] - 1
    gap, n_x, n_z, curvature = math.inf, 0.0, 1.0, 0.0
    for j in range(max(first, 0), min(last + 1, faces)):
        if int(profile.nodes[j, PIECE]) % profile.reach != slot:
            continue
        x_0, z_0, t_x, t_z = _face(profile, j)
        along, distance = t_x * (x - x_0) + t_z * (z - z_0), t_x * (z - z_0) - t_z * (x - x_0)
        length = profile.cell / t_x
        if (along >= 0.0 or j == 0) and (along <= length or j == faces - 1):
            if 0.0 <= distance < gap:
                gap, n_x, n_z, curvature = distance, -t_z, t_x, 0.0
            continue
        node = j if along < 0.0 else j + 1
        # a valley is met by the faces beside it
        if profile.nodes[node - 1, PIECE] != profile.nodes[node, PIECE]:
            continue
        beyond = along if along < 0.0 else along - length
        away = math.sqrt(beyond * beyond + distance * distance)
        if away >= gap or away == 0.0:
            continue
        gap, n_x, n_z, curvature = away, -t_z, t_x, 0.0
        # where two faces are one, rounding alone lies between them
        if profile.nodes[node, PEAK] >= 0.0:
            curvature = 1.0 / away
            n_x, n_z = (beyond * t_x - distance * t_z) / away, (beyond * t_z + distance * t_x) / away
    if gap == math.inf:
        return profile.cell, 0.0, 1.0, 0.0
    return gap - radius, n_x, n_z, curvature


@kernel
def point_on_profile(profile, slot, x, z, radius):
    """Gap in [m] of a sphere about (x, z) to the piece of a slot; normal (x, z), curvature in
    [1/m], and the run of a corner.
    """
    if radius > 0.0:
        gap, n_x, n_z, curvature = _gap_of_sphere(profile, slot, x, z, radius)
        return gap, n_x, n_z, curvature, -1
    own = _face_at(profile, x)
    gap, n_x, n_z, feature = _gap_of_corner(profile, slot, x, z, own - 1, own + 1)
    return gap, n_x, n_z, 0.0, feature


@kernel
def _corner(points, rotation, i):
    """Corner of a polygon from the centre of mass, world axes."""
    x, z = points[i, 0], points[i, 1]
    return rotation[0, 0] * x + rotation[0, 1] * z, rotation[1, 0] * x + rotation[1, 1] * z


@kernel
def _edge(profile, points, rotation, e):
    """Start of an edge of the polygon from the centre of mass, its direction once round, and its
    length.
    """
    count = profile.order.shape[0]
    a_x, a_z = _corner(points, rotation, profile.order[e])
    b_x, b_z = _corner(points, rotation, profile.order[(e + 1) % count])
    length = math.sqrt((b_x - a_x) ** 2 + (b_z - a_z) ** 2)
    return a_x, a_z, (b_x - a_x) / length, (b_z - a_z) / length, length


@kernel
def ridge_on_polygon(profile, slot, points, rotation, x, z, size):
    """Gap in [m] of a polygon at (x, z) to the peak of a slot: the greatest of its distances from
    the edges.

    Then the normal towards the body, the peak from the centre of mass, and the edge (-1: no peak is
    near).
    """
    # the nodes below the polygon
    last = min(_face_at(profile, x + size) + 1, profile.nodes.shape[0] - 1)
    for node in range(max(_face_at(profile, x - size) - 1, 0), last + 1):
        if profile.nodes[node, PEAK] < 0.0 or int(profile.nodes[node, PEAK]) % profile.ridges != slot:
            continue
        r_x, r_z = profile.origin + node * profile.cell - x, profile.nodes[node, HEIGHT] - z
        gap, n_x, n_z, feature = -math.inf, 0.0, 1.0, -1
        # inside all edges is negative: the nearest edge has the greatest distance
        for e in range(profile.order.shape[0]):
            a_x, a_z, d_x, d_z, _length = _edge(profile, points, rotation, e)
            distance = d_z * (r_x - a_x) - d_x * (r_z - a_z)
            if distance > gap:
                gap, n_x, n_z, feature = distance, -d_z, d_x, e
        return gap, n_x, n_z, r_x, r_z, feature
    return size, 0.0, 1.0, 0.0, 0.0, -1


@kernel
def time_to_kink(profile, points, rotation, feature, is_ridge, x, r_x, r_z, along, slip):
    """Time in [s] until a contact has gone over a peak, at ``slip`` [m/s] along the tangent, whose
    x is ``along``.

    A corner at x leaves its face, or a ridge at the arm (r_x, r_z) its edge; inf where that lies
    ahead of neither.
    """
    if feature < 0 or slip == 0.0:
        return math.inf
    if is_ridge:
        a_x, a_z, d_x, d_z, length = _edge(profile, points, rotation, feature)
        place = d_x * (r_x - a_x) + d_z * (r_z - a_z)
        # the normal is the direction of the edge turned to the left, so both point alike
        rate = -slip
        left = length - place if rate > 0.0 else place
    else:
        last = int(profile.nodes[feature, END])
        place, rate = (x - profile.origin) - feature * profile.cell, slip * along
        length = (last - feature) * profile.cell
        if profile.nodes[last if rate > 0.0 else feature, PEAK] < 0.0:
            return math.inf
        left = length - place if rate > 0.0 else place
    return max(PAST * length, (1.0 + PAST) * left) / abs(rate)
