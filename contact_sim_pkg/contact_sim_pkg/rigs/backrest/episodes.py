"""Contact episodes of the backrest rig: when they begin and end, and the works between (Driver and
Seat, eqs 10 and 11).

An episode of a point lasts from a touch to the last loss of its force: where the bodies part faster
than the material recovers, and close again before they separate, it goes on. One of the whole
contact lasts from the first point's touch until no point carries. Works of closing and opening are
integrated states, whose values at the beginning are taken off at the end.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.backrest.parameters import (
    CARRIED,
    CLOSING_WORK,
    DEEPEST,
    ENDED,
    MOST_EPISODES,
    OPENING_WORK,
    OVERLAPPING,
    PLACE,
    START,
    TOUCHED,
)


@borrowing_kernel
def _works(rig, state, point):
    """Works of closing and opening in [J] since the start of the run, of one point or (``point`` =
    points) of all.
    """
    modes, points = rig.modal.shape[1], rig.places.shape[1]
    closing, opening = 2 * modes + points, 2 * modes + 2 * points
    if point < points:
        return state[closing + point], state[opening + point]
    total_closing, total_opening = 0.0, 0.0
    for c in range(points):
        total_closing += state[closing + c]
        total_opening += state[opening + c]
    return total_closing, total_opening


@borrowing_kernel
def open_episode(rig, mode, place, time, approach, state, touched):
    """Note the beginning of the episode of a point, or (``place`` = points) of the whole
    contact.
    """
    closing, opening = _works(rig, state, place)
    lasting = mode.lasting
    lasting[place, START] = time
    lasting[place, CLOSING_WORK] = closing
    lasting[place, OPENING_WORK] = opening
    lasting[place, DEEPEST] = max(approach, 0.0)
    lasting[place, TOUCHED] = touched


@borrowing_kernel
def begin_episode(rig, mode, point, time, approach, state):
    """A point touches."""
    places = 2 if mode.counts[OVERLAPPING] == 0 else 1
    for k in range(places):
        open_episode(rig, mode, point if k == 0 else rig.places.shape[1], time, approach, state, 1.0)
    mode.counts[OVERLAPPING] += 1


@borrowing_kernel
def note_turn(mode, point, approach):
    """A point turns: its approach may be the largest so far."""
    for place in (point, mode.lasting.shape[0] - 1):
        mode.lasting[place, DEEPEST] = max(mode.lasting[place, DEEPEST], approach)


@borrowing_kernel
def note_loss(mode, point, time):
    """A point loses its force."""
    for place in (point, mode.lasting.shape[0] - 1):
        mode.lasting[place, CARRIED] = time


@borrowing_kernel
def _close_episode(rig, mode, place, state):
    number = mode.counts[ENDED]
    mode.counts[ENDED] += 1
    if number >= MOST_EPISODES:
        return
    closing, opening = _works(rig, state, place)
    for column in (START, CARRIED, DEEPEST, TOUCHED):
        mode.ended[number, column] = mode.lasting[place, column]
    mode.ended[number, CLOSING_WORK] = closing - mode.lasting[place, CLOSING_WORK]
    mode.ended[number, OPENING_WORK] = opening - mode.lasting[place, OPENING_WORK]
    mode.ended[number, PLACE] = place


@borrowing_kernel
def end_episode(rig, mode, point, state):
    """A point separates."""
    mode.counts[OVERLAPPING] -= 1
    places = 2 if mode.counts[OVERLAPPING] == 0 else 1
    for k in range(places):
        _close_episode(rig, mode, point if k == 0 else rig.places.shape[1], state)
