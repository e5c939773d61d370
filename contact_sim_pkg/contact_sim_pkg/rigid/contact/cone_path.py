"""Contacts with the true friction cone in space by Lemke's path: the last method, for what Newton's
method does not settle.

The problem is covered as in Lemke's method, ``q + t d``: for great t nothing but ``c = 0`` solves
it, and from there the solutions form a path that, where the normals of the contacts are alike (a
plane), is bounded and so ends at ``t = 0``, however it turns in between. With the true cone it is
smooth but for the points where a contact changes its mode, instead of straight between pivots: it
is followed by tangent and Newton's method, and what goes on at a change is the mode beside. Plain
numpy: one in a hundred of random problems needs it, and nothing needs to be compiled for it.
Source: Cottle, Pang, Stone, The Linear Complementarity Problem, 4.4; Allgower, Georg, Numerical
Continuation Methods, 2 and 6.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.contact.cone_modes import ContactModes, ModeEquations
from contact_sim_pkg.rigid.problem import ContactProblem

__all__ = ["candidates_by_path"]

# of the diagonal: redundant contacts have one answer; Newton's method takes it away
SHIFTS = (1.0e-10, 1.0e-8)
WAYS = 8  # covers that are tried with each shift
STEPS = 300  # of one path; most that end take 15 to 120
ALL_STEPS = 2000
SHORTEST = 1.0e-12  # step, and the event value that is 0
ENTERED = 1.0e-12  # event value of a mode that has just begun
MET = 1.0e-13  # event value at an end
CORRECTIONS, QUICK = 8, 3  # of Newton's method; of a step after which the next one may be longer
SOLVED_TO, GOOD_ENOUGH = 1.0e-13, 1.0e-10  # equations, of 1 and the greatest unknown
LONGER, SHORTER = 1.7, 0.3
STRAIGHT = 0.8  # least cosine between the tangents of a step
TRIALS = 60
GREATEST = (
    # impulse, in the greatest of a step without friction, over 1 / shift: an answer at infinity
    # ends there
    1.0e-2
)
PROBE = 1.0e-7


class PathLostError(Exception):
    """The path goes off, or rounding hides where it leads."""


def _tangent(state: ModeEquations) -> Vector:
    """Unit vector along the path, its sense open."""
    if len(state.values) == 0:
        return numpy.ones(1)
    tangent: Vector = numpy.linalg.svd(state.slopes)[2][-1]
    return tangent


def _next_tangent(state: ModeEquations, before: Vector) -> Vector:
    """Unit vector along the path in the sense of the tangent ``before``."""
    along = numpy.linalg.solve(numpy.vstack([state.slopes, before]), numpy.append(numpy.zeros(len(state.values)), 1.0))
    tangent: Vector = along / numpy.linalg.norm(along)
    return tangent


def _corrected(modes: ContactModes, guess: Vector, tangent: Vector) -> tuple[ModeEquations, int] | None:
    """The point of the path nearest to ``guess`` across ``tangent``, and the corrections it
    took.
    """
    x = guess
    for count in range(CORRECTIONS + 1):
        state = modes.evaluate(x)
        size = 1.0 + numpy.abs(x).max()
        broken = numpy.abs(state.values).max(initial=0.0)
        if broken <= SOLVED_TO * size or (count == CORRECTIONS and broken <= GOOD_ENOUGH * size):
            return state, count
        if not broken < numpy.inf:
            return None
        try:
            x = x - numpy.linalg.solve(numpy.vstack([state.slopes, tangent]), numpy.append(state.values, 0.0))
        except numpy.linalg.LinAlgError:
            return None
    return None


def _crossed(state: ModeEquations, watched: numpy.typing.NDArray[numpy.bool_]) -> Vector:
    """Event values of the watched modes [modes], and t last."""
    return numpy.append(state.event_values[watched], state.unknowns[-1])


def _event(
    modes: ContactModes, start: ModeEquations, end: ModeEquations, tangent: Vector, length: float
) -> tuple[ModeEquations, int] | None:
    """First point between ``start`` and ``end`` at which a watched event value or t is 0, and the
    place of that in `_crossed`.
    """
    watched = start.event_values > ENTERED
    low, high, above, below = 0.0, length, _crossed(start, watched), _crossed(end, watched)
    state, first = end, int(below.argmin())
    for trial in range(TRIALS):
        # regula falsi towards the first value that changed its sign; every third trial halves
        gone = numpy.flatnonzero(below < 0.0)
        if len(gone) == 0:
            break
        share = float((above[gone] / (above[gone] - below[gone])).min()) if trial % 3 < 2 else 0.5
        middle = low + (high - low) * share
        # back onto the path, across the tangent
        found = _corrected(modes, start.unknowns + middle * tangent, tangent)
        if found is None:
            return None
        state = found[0]
        now = _crossed(state, watched)
        first = int(now.argmin())
        if abs(now[first]) <= MET:
            break
        # the bracket keeps its start before the event and its end behind
        if now[first] < 0.0:
            high, below = middle, now
        else:
            low, above = middle, now
    return state, first


def _turned(modes: ContactModes, state: ModeEquations, contact: int, kind: int) -> tuple[ModeEquations, Vector]:
    """The path from the mode beside on: its event value grows along it."""
    modes.change_mode(state, contact, kind)
    begun = modes.evaluate(modes.unknowns())
    tangent = _tangent(begun)
    ahead = modes.evaluate(begun.unknowns + PROBE * tangent)
    grows = ahead.event_values[contact, kind] >= begun.event_values[contact, kind]
    return begun, tangent if grows else -tangent


def _forward(
    modes: ContactModes, state: ModeEquations, tangent: Vector, length: float
) -> tuple[ModeEquations, Vector, int] | None:
    """One step: the state, its tangent and the corrections it took; None where the step is too
    long.
    """
    found = _corrected(modes, state.unknowns + length * tangent, tangent)
    if found is None:
        return None
    after = _next_tangent(found[0], tangent)
    entered = (state.event_values <= ENTERED) & (found[0].event_values < 0.0)
    if not after @ tangent >= STRAIGHT or entered.any():
        return None
    return found[0], after, found[1]


def follow(modes: ContactModes, steps: Iterator[int]) -> Vector:
    """Impulses [rows] in [N s] at the end of the path; takes its ``steps`` from what is left;
    raises `PathLostError`.
    """
    state = modes.evaluate(modes.unknowns())
    tangent, length = _tangent(state), 1.0
    if tangent[-1] > 0.0:  # t falls
        tangent = -tangent
    for _ in steps:
        step = _forward(modes, state, tangent, length)
        watched = state.event_values > ENTERED
        ends = step is not None and _crossed(step[0], watched).min() < 0.0
        event = _event(modes, state, step[0], tangent, length) if step is not None and ends else None
        size = 1.0 + float(numpy.abs(state.unknowns).max())
        if size * modes.shift > GREATEST or state.unknowns[-1] > modes.begin or length < SHORTEST:
            raise PathLostError
        if step is None or (ends and event is None):
            length *= SHORTER
        elif event is None:
            state, tangent, corrections = step
            length = min(length * (LONGER if corrections <= QUICK else 1.0), 0.5 * size)
        elif event[1] == watched.sum():  # t is 0
            return modes.impulses(event[0])
        else:
            contact, kind = (int(part) for part in numpy.argwhere(watched)[event[1]])
            state, tangent = _turned(modes, event[0], contact, kind)
            length = min(length, 0.1 * size)
    raise PathLostError


def candidates_by_path(problem: ContactProblem) -> Iterator[Vector]:
    """Impulses [rows] near a solution of ``problem`` (in space, true cone), one for each way that
    leads to one.
    """
    steps = iter(range(ALL_STEPS))
    for way in range(WAYS):
        for shift in SHIFTS:
            try:
                yield follow(ContactModes(problem, shift, way), itertools.islice(steps, STEPS))
            except PathLostError:
                continue
