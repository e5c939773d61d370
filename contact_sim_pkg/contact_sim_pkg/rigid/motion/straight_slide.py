"""Sub-steps of a body on active contacts that need no survey and no solver: it rests, or it slides
on over a plane without turning.

At rest the next sample repeats the last one. A body that slides without turning has one slip for
all its points. It lies along the velocity w that the load alone would leave, so friction takes ``mu
Q/m`` from it, Q the normal impulse on the whole body. No moment about the centre of mass is left,
``sum N_i r_i x (n - mu d) = 0``, and so the loads of least norm are linear over the face, ``N_i =
Q/k + b rho_t,i + g rho_s,i`` with ``sum N_i r_i = -mu h d Q``, h the height of the face over the
centre of mass. Source: Identifiability eqs 12-18, with the split of least norm.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigid.bodies.active_contacts import DRIFT
from contact_sim_pkg.rigid.bodies.motion import ACTIVE, SEPARATED, STICKING
from contact_sim_pkg.rigid.motion.slip import SLOW, SWERVE
from contact_sim_pkg.rigid.problem import PLANE, SPACE

NARROW = 1.0e-9  # of the size of the face, to the power 3: points this near to a line are no face
SLIPS = 10.0  # times what counts as rounding: a slower body is left to the solvers
T, S, ROW = 0, 1, 2  # columns of an active point: its place along the tangents, its row


class Face(NamedTuple):
    """Active points of a body that slides straight on; ``active`` 0: there is no such body."""

    active: int
    row: int  # of the first, whose axes all have
    height: float  # [m] over the centre of mass, negative
    mean: tuple[float, float]  # [m] along the tangents t, s
    inverse_spread: tuple[
        float, float, float
    ]  # [1/m^2] tt, ts, ss, of the sums of products of the places about their mean


NO_FACE = Face(active=0, row=0, height=0.0, mean=(0.0, 0.0), inverse_spread=(0.0, 0.0, 0.0))


@borrowing_kernel
def is_at_rest(motion, work, size):
    """Whether nothing moves, the active points stick on the ground and no other touches it: a
    sub-step of time then changes nothing.
    """
    resting = True
    for k in range(motion.velocity.shape[0]):
        resting = resting and motion.velocity[k] == 0.0
    for i in range(work.flags.shape[0]):
        active = work.flags[i] == STICKING and abs(work.gap[i]) <= DRIFT * size
        resting = resting and (active or work.flags[i] == SEPARATED)
    return resting


@borrowing_kernel
def _slides_straight(body, ground, motion, work):
    """Whether a body slides over a plane without turning and without a torque, every point on the
    ground active.
    """
    straight, slides = ground.profile.nodes.shape[0] == 0 and body.friction > 0.0, False
    for k in range(body.width):
        slides = slides or motion.velocity[k] != 0.0
    for k in range(body.width, motion.velocity.shape[0]):
        straight = straight and motion.velocity[k] == 0.0 and body.load[k] == 0.0
    for i in range(work.flags.shape[0]):
        straight = straight and (work.flags[i] == SEPARATED or work.flags[i] == ACTIVE)
    return straight and slides


@borrowing_kernel
def _place(body, J, first, row):
    """Arm of a contact along the tangents, and along the normal, from the moments of its rows."""
    if body.width == PLANE:
        return J[row, 2], 0.0, -J[row + 1, 2]
    t, s, h = 0.0, 0.0, 0.0
    for k in range(3):
        t -= J[row, 3 + k] * J[first + 2, k]
        s += J[row, 3 + k] * J[first + 1, k]
        h += J[row + 1, 3 + k] * J[first + 2, k]
    return t, s, h


@borrowing_kernel
def straight_face(body, ground, motion, work, face):
    """The active points of a body that slides straight on, about their mean into ``face`` [points,
    3 or more].
    """
    count, first, height, mean_t, mean_s = 0, 0, 0.0, 0.0, 0.0
    tt, ts, ss = 0.0, 0.0, 0.0
    if _slides_straight(body, ground, motion, work):
        for i in range(work.flags.shape[0]):
            if work.flags[i] == ACTIVE:
                # arms of all contacts along the tangents of the first
                row = i * body.width
                first = row if count == 0 else first
                t, s, height = _place(body, work.J, first, row)
                face[count, T], face[count, S], face[count, ROW] = t, s, row
                mean_t, mean_s, count = mean_t + t, mean_s + s, count + 1
    # two points in the plane, three in space make a face
    if count < body.width:
        return NO_FACE
    # about their mean; inverse of the sums of products
    mean_t, mean_s = mean_t / count, mean_s / count
    for j in range(count):
        face[j, T] -= mean_t
        face[j, S] -= mean_s
        t, s = face[j, T], face[j, S]
        tt, ts, ss = tt + t * t, ts + t * s, ss + s * s
    if body.width == PLANE:
        return Face(count, first, height, (mean_t, mean_s), (1.0 / tt, 0.0, 0.0))
    size, whole = tt + ss, tt * ss - ts * ts
    count = count if whole > NARROW * size * size else 0
    return Face(count, first, height, (mean_t, mean_s), (ss / whole, -ts / whole, tt / whole))


@borrowing_kernel
def _tangential(body, J, row, x):
    """A velocity of the centre of mass along the tangents of a contact."""
    t, s = 0.0, 0.0
    for k in range(body.width):
        t += J[row + 1, k] * x[k]
        if body.width == SPACE:
            s += J[row + 2, k] * x[k]
    return t, s


@borrowing_kernel
def _press(body, face, points, push, d_t, d_s, impulse):
    """Loads of least norm under a body that is pushed by ``push`` [N s] and slides along d, and its
    friction; whether all press.
    """
    rise = body.friction * points.height
    t, s = -push * (rise * d_t + points.mean[0]), -push * (rise * d_s + points.mean[1])
    tt, ts, ss = points.inverse_spread
    b, g = tt * t + ts * s, ts * t + ss * s
    presses = True
    for j in range(points.active):
        load, row = push / points.active + b * face[j, T] + g * face[j, S], int(face[j, ROW])
        presses = presses and load >= 0.0
        impulse[row], impulse[row + 1] = load, -body.friction * load * d_t
        if body.width == SPACE:
            impulse[row + 2] = -body.friction * load * d_s
    return presses


@borrowing_kernel
def slide_straight(body, motion, work, face, points, time, rounding):
    """One sub-step of ``time`` [s]: state, ``work.impulse``; returns the energy lost in [J], -1
    (nothing taken) where slip may end.

    ``rounding`` [m/s]: what counts as rounding. ``work.impulse`` is 0 for contacts that are not
    active.
    """
    J, v, row, fall = work.J, motion.velocity, points.row, time / body.mass
    # speed that the normal impulse takes from the approach
    press = 0.0
    for k in range(body.width):
        press -= J[row, k] * (v[k] + fall * body.load[k])
    v_t, v_s = _tangential(body, J, row, v)
    f_t, f_s = _tangential(body, J, row, body.load)
    # slip without friction; friction acts against it
    w_t, w_s = v_t + fall * f_t, v_s + fall * f_s
    speed, before = math.sqrt(w_t * w_t + w_s * w_s), v_t * v_t + v_s * v_s
    left = speed - body.friction * press
    d_t, d_s = w_t / speed, w_s / speed
    along = v_t * d_t + v_s * d_s
    # slip that ends, turns or is rounding is left to the general solvers
    if not (press > 0.0 and left > SLIPS * rounding and left * along > SLOW * before and before > rounding * rounding):
        return -1.0
    if abs(v_t * d_s - v_s * d_t) > SWERVE * math.sqrt(before):
        return -1.0
    if not _press(body, face, points, body.mass * press, d_t, d_s, work.impulse):
        return -1.0
    # uniform deceleration: the mean of both velocities is exact
    for k in range(body.width):
        end = left * (d_t * J[row + 1, k] + (d_s * J[row + 2, k] if body.width == SPACE else 0.0))
        motion.position[k] += 0.5 * time * (v[k] + end)
        v[k] = end
    return 0.5 * body.friction * body.mass * press * (along + left)
