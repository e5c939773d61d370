"""Moving contact point: where a bent shell comes nearest to the flat seat it faces (Driver and
Seat, eqs 1 and 2).

``d = max over the shell of sum_i q_i phi_i(x, y) - dx^2/2R1 - dy^2/2R2`` is the least distance of
the two surfaces (negative) or the depth to which one enters the other, along the seat's normal.
Every crest of a coarse grid of candidate points, those on the sides included, is climbed by Newton
steps within the sides, and the highest is taken. Since the gradient vanishes at the point found, or
a side holds it, ``dd/dq_i = phi_i`` there: the force of a law ``F(d)`` keeps its potential while
its point moves.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.backrest.parameters import GAP, SHAPE, SLOPE, ContactSearch

NEWTON_STEPS = 40
REACH = 0.1  # longest step over the half wave of the highest mode
HALVINGS = 30
CLOSE = 1.0e-13  # of a step over the side


@borrowing_kernel
def _next_multiple(sine, cosine, first_sine, first_cosine):
    """Sine and cosine of the next multiple of an angle."""
    return sine * first_cosine + cosine * first_sine, cosine * first_cosine - sine * first_sine


@borrowing_kernel
def _depth(search, state, x, y):
    """Depth in [m] at a point, its gradient, and its second derivatives xx, xy, yy."""
    # The undeformed crown is a paraboloid about the middle of the shell.
    a, b = math.pi / search.length_1, math.pi / search.length_2
    sin_a, cos_a, sin_b, cos_b = math.sin(a * x), math.cos(a * x), math.sin(b * y), math.cos(b * y)
    from_x, from_y = x - 0.5 * search.length_1, y - 0.5 * search.length_2
    depth = -0.5 * (from_x * from_x * search.curvature_1 + from_y * from_y * search.curvature_2)
    d_x, d_y = -from_x * search.curvature_1, -from_y * search.curvature_2
    d_xx, d_xy, d_yy = -search.curvature_1, 0.0, -search.curvature_2
    # Sines of multiples follow from those before: no further call of sin.
    sin_m, cos_m = 0.0, 1.0
    for m in range(1, search.side + 1):
        sin_m, cos_m = _next_multiple(sin_m, cos_m, sin_a, cos_a)
        sin_n, cos_n = 0.0, 1.0
        for n in range(1, search.side + 1):
            sin_n, cos_n = _next_multiple(sin_n, cos_n, sin_b, cos_b)
            q = state[(m - 1) * search.side + n - 1]
            depth += q * sin_m * sin_n
            d_x += q * m * a * cos_m * sin_n
            d_y += q * n * b * sin_m * cos_n
            d_xx -= q * (m * a) ** 2 * sin_m * sin_n
            d_xy += q * m * a * n * b * cos_m * cos_n
            d_yy -= q * (n * b) ** 2 * sin_m * sin_n
    return depth, d_x, d_y, d_xx, d_xy, d_yy


@borrowing_kernel
def _compute_depths(search, state):
    """Depth at every candidate point into ``search.depths``, whose outermost rows and columns stay
    -infinity.
    """
    rows, cols = search.depths.shape[0] - 2, search.depths.shape[1] - 2
    for i in range(rows):
        for j in range(cols):
            c = i * cols + j
            depth = -search.gaps[c]
            for k in range(search.candidates.shape[1]):
                depth += search.candidates[c, k] * state[k]
            search.depths[i + 1, j + 1] = depth


@borrowing_kernel
def _is_crest(depths, i, j):
    """Whether no neighbour of a candidate point is deeper."""
    for k in range(i - 1, i + 2):
        for m in range(j - 1, j + 2):
            if depths[k, m] > depths[i, j]:
                return False
    return True


@borrowing_kernel
def _beyond(place, slope, length):
    """Whether a point on a side would go on beyond it."""
    return (place <= 0.0 and slope < 0.0) or (place >= length and slope > 0.0)


@borrowing_kernel
def _uphill(slope, curvature, length):
    """Step along one direction: to the crest of the parabola where there is one, else a part of the
    side uphill.
    """
    return -slope / curvature if curvature < 0.0 else math.copysign(0.05 * length, slope)


@borrowing_kernel
def _step_uphill(search, x, y, slopes):
    """Newton step towards the crest, within the directions in which no side holds the point."""
    _depth_here, d_x, d_y, d_xx, d_xy, d_yy = slopes
    if _beyond(x, d_x, search.length_1):
        return 0.0, 0.0 if _beyond(y, d_y, search.length_2) else _uphill(d_y, d_yy, search.length_2)
    if _beyond(y, d_y, search.length_2):
        return _uphill(d_x, d_xx, search.length_1), 0.0
    determinant = d_xx * d_yy - d_xy * d_xy
    if d_xx < 0.0 and determinant > 0.0:
        return (d_xy * d_y - d_yy * d_x) / determinant, (d_xy * d_x - d_xx * d_y) / determinant
    return _uphill(d_x, d_xx, search.length_1), _uphill(d_y, d_yy, search.length_2)


@borrowing_kernel
def _climbed(search, state, x, y):
    """Crest reached from a point: its place and depth."""
    slopes = _depth(search, state, x, y)
    reach_1, reach_2 = REACH * search.length_1 / search.side, REACH * search.length_2 / search.side
    for _ in range(NEWTON_STEPS):
        step_x, step_y = _step_uphill(search, x, y, slopes)
        if abs(step_x) <= CLOSE * search.length_1 and abs(step_y) <= CLOSE * search.length_2:
            break
        part = 1.0 / max(1.0, abs(step_x) / reach_1, abs(step_y) / reach_2)  # not over the next crest
        for _halving in range(HALVINGS):
            new_x = min(max(x + part * step_x, 0.0), search.length_1)
            new_y = min(max(y + part * step_y, 0.0), search.length_2)
            there = _depth(search, state, new_x, new_y)
            if there[0] >= slopes[0]:
                break
            part *= 0.5
        if not there[0] >= slopes[0]:
            break
        x, y, slopes = new_x, new_y, there
    return x, y, slopes[0]


@borrowing_kernel
def nearest_point(search: ContactSearch, state: Vector) -> tuple[float, float]:
    """Place x, y [m] over the shell at which the depth is largest.

    state: begins with the modal coordinates [modes] [m].
    """
    _compute_depths(search, state)
    cols = search.depths.shape[1] - 2
    best_x, best_y, depth = 0.5 * search.length_1, 0.5 * search.length_2, -math.inf
    for c in range(search.places.shape[0]):
        if not _is_crest(search.depths, c // cols + 1, c % cols + 1):
            continue
        x, y, here = _climbed(search, state, search.places[c, 0], search.places[c, 1])
        if here > depth:
            best_x, best_y, depth = x, y, here
    return best_x, best_y


@borrowing_kernel
def move_point(search, rig, state):
    """Write shapes, slopes and gap of the nearest point into the rig's one contact point; nothing
    where none is searched.
    """
    if search is None:
        return
    x, y = nearest_point(search, state)
    a, b = math.pi / search.length_1, math.pi / search.length_2
    for m in range(1, search.side + 1):
        for n in range(1, search.side + 1):
            i = (m - 1) * search.side + n - 1
            rig.coupling[SHAPE, 0, i] = math.sin(m * a * x) * math.sin(n * b * y)
            rig.coupling[SLOPE, 0, i] = search.lever * n * b * math.sin(m * a * x) * math.cos(n * b * y)
    from_x, from_y = x - 0.5 * search.length_1, y - 0.5 * search.length_2
    rig.places[GAP, 0] = 0.5 * (from_x * from_x * search.curvature_1 + from_y * from_y * search.curvature_2)


@borrowing_kernel
def place_of(search, state):
    """Place in [m] of the moving point from the shell's middle, along its two sides; 0, 0 where
    none is searched.
    """
    if search is None:
        return 0.0, 0.0
    x, y = nearest_point(search, state)
    return x - 0.5 * search.length_1, y - 0.5 * search.length_2
