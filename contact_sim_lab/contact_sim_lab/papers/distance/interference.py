"""Interference of two convex bodies: the diameter d of the largest ball inside both.

    maximise d   where   g(p) <= -d/2   for every constraint of both bodies at one common point p, g
    the signed distance

The depth of p below each constraint is a concave function of p, so the problem is convex and what
meets its conditions is the maximum: with the ball touching the constraints k at the outward normals
n_k,

    sum lambda_k n_k = 0,   sum lambda_k = 1,   lambda_k >= 0,   depth_k(p) = d/2,   no other depth
    smaller.

For bodies that do not overlap d is minus their distance. Two spheres give `R1 + R2 - |c1 - c2|`, at
most `2 min(R1, R2)`. d is the penetration depth (the smallest separating translation) where the
ball touches each body once; at edges and in deep overlap it is smaller (a wedge of 60 degrees a
depth w in a half-space has 2 w / 3). `one_foot_each` says which it is.

Found by cutting planes: every foot of a point adds the supporting plane there (and on a quadric its
seven reflections), the largest ball under all planes so far is a linear program, and Newton steps
on the conditions above, started from the planes that hold that ball
(`papers/distance/largest_ball.py`), give the last digits as soon as those planes are near the
right ones.

Source: Driver and Seat eq 2, corrected (one common point, signed distances).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.closest import minimum_distance
from contact_sim_lab.papers.distance.convex_body import ConvexBody, pair_size
from contact_sim_lab.papers.distance.largest_ball import largest_ball

__all__ = ["Interference", "interference"]

Field = NDArray[numpy.float64]


class Interference(NamedTuple):
    depth: float  # [m] d; negative: minus the distance
    point: Field  # [3] [m] centre of the ball, or middle of the closest points
    normal: Field  # [3] outward of body 1 where the ball touches it, towards body 2
    # The ball touches each body once: d is the penetration depth and `normal` its only direction
    one_foot_each: bool
    # The ball touches one body only: one lies inside the other, as far as the ball shows
    nested: bool
    residual: float  # [1] of the KKT conditions, relative to the pair's size


def interference(body_1: ConvexBody, body_2: ConvexBody) -> Interference:
    """Interference of two bodies made by `papers/distance/convex_body.py`.

    Raises `ValueError` where the ball has no bound (two half-spaces that face the same way, say).
    """
    closest = minimum_distance(body_1, body_2)
    if not closest.overlap:
        middle = 0.5 * (closest.point_1 + closest.point_2)
        normal = (closest.point_2 - closest.point_1) / closest.distance
        return Interference(-closest.distance, middle, normal, True, False, closest.residual)
    ball = largest_ball(body_1, body_2, 0.5 * (closest.point_1 + closest.point_2), pair_size(body_1, body_2))
    if math.isinf(ball.radius):
        raise ValueError("interference: the bodies share balls of any size, one of the two must bound the overlap")
    once = ball.feet_1 == 1 and ball.feet_2 == 1
    nested = ball.feet_1 == 0 or ball.feet_2 == 0
    return Interference(2.0 * ball.radius, ball.centre, ball.normal, once, nested, ball.residual)
