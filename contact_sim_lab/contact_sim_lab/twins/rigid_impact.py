"""Impact of one planar contact the slow way: all index sets of the complementarity problem, and the
impulse path by scipy.

Twin of `rigid/contact/planar_impact.py`, with which it shares no code. Source: Identifiability eq 9;
Stronge 1990.
"""

from __future__ import annotations

import itertools

import numpy
from scipy.integrate import solve_ivp

from contact_sim_pkg.compiled.arrays import Vector

__all__ = ["energetic_by_path", "enumerate_lcp", "newton_by_enumeration", "poisson_by_enumeration"]


def enumerate_lcp(M: Vector, q: Vector) -> list[Vector]:
    """Every solution z of ``0 <= z _|_ M z + q >= 0`` with a regular index set; up to about 12
    unknowns.

    M: [n, n]; q: [n].
    """
    n = len(q)
    slack = 1e-12 * max(1.0, numpy.abs(q).max())
    found: list[Vector] = []
    for chosen in itertools.product((False, True), repeat=n):
        # Unknowns of the set from M z + q = 0 on it, the others zero
        index = numpy.flatnonzero(chosen)
        z = numpy.zeros(n)
        if len(index):
            block = M[numpy.ix_(index, index)]
            if abs(numpy.linalg.det(block)) < 1e-14:
                continue
            z[index] = numpy.linalg.solve(block, -q[index])
        if z.min() >= -slack and (M @ z + q).min() >= -slack:
            found.append(z)
    return found


def _one_contact(A: Vector, friction: float, q: Vector, floor: float) -> Vector:
    """Impulse ``(c_n, c_t)`` of one contact from the index sets of eq 9 with the two directions of
    the plane.
    """
    D = numpy.array([[1.0, 0.0, 0.0], [0.0, 1.0, -1.0]])
    M = numpy.zeros((4, 4))
    M[:3, :3] = D.T @ A @ D
    M[1:3, 3] = 1.0
    M[3] = [friction, -1.0, -1.0, 0.0]
    shifted = q + A[:, 0] * floor
    right = numpy.array([shifted[0], shifted[1], -shifted[1], friction * floor])
    answers = [D @ z[:3] + numpy.array([floor, 0.0]) for z in enumerate_lcp(M, right)]
    if not answers:
        raise ArithmeticError("no index set solves the contact problem")
    after = [q + A @ c for c in answers]
    if max(numpy.abs(a - after[0]).max() for a in after) > 1e-9 * numpy.abs(right).max():
        raise ArithmeticError("the index sets disagree")
    return numpy.asarray(answers[0])


def newton_by_enumeration(A: Vector, friction: float, restitution: float, u: Vector) -> Vector:
    """Impulse ``(c_n, c_t)`` by Newton's rule; ``A`` [2, 2] in [1/kg], ``u`` (normal, tangential)
    in [m/s].
    """
    return _one_contact(A, friction, u + numpy.array([restitution * min(0.0, u[0]), 0.0]), 0.0)


def poisson_by_enumeration(A: Vector, friction: float, restitution: float, u: Vector) -> Vector:
    """Impulse ``(c_n, c_t)`` by Poisson's rule: two complementarity problems in turn.

    A: [2, 2] [1/kg]; u: [2] [m/s]; the result: [2] [N s].
    """
    first = _one_contact(A, friction, u, 0.0)
    return first + _one_contact(A, friction, u + A @ first, restitution * first[0])


def energetic_by_path(A: Vector, friction: float, restitution: float, u: Vector) -> Vector:
    """Impulse ``(c_n, c_t)`` of the energetic rule: the path over the normal impulse, integrated by
    scipy's DOP853.

    States: normal and tangential velocity, tangential impulse, work of the normal impulse.
    A: [2, 2] [1/kg]; u: [2] [m/s]; the result: [2] [N s].
    """
    state = numpy.array([u[0], u[1], 0.0, 0.0])
    impulse, wanted = 0.0, numpy.nan
    slip = -numpy.sign(u[1]) if u[1] != 0.0 else None
    while True:
        # A part of the path: up to the end of compression or restitution, or of slip.
        ratio = _friction_ratio(A, friction, slip)
        compressing = bool(numpy.isnan(wanted))
        events = [_ends_at(0, 1.0) if compressing else _ends_at(3, 1.0, wanted)]
        if slip is not None and state[1] != 0.0:
            events.append(_ends_at(1, float(-numpy.sign(state[1]))))
        course = solve_ivp(
            _rate, (0.0, 1e6 * numpy.abs(u).max() / A[0, 0]), state, "DOP853", events=events, args=(A, ratio),
            rtol=1e-13, atol=1e-15 * numpy.abs(u).max(),
        )  # fmt: skip
        # State at its end.
        impulse, state = impulse + float(course.t[-1]), course.y[:, -1].copy()
        # Slip has ended: the point sticks, or slips anew where friction is too low.
        if len(events) > 1 and len(course.t_events[1]):
            state[1] = 0.0
            slip = None if abs(A[0, 1]) <= friction * A[1, 1] else -numpy.sign(A[0, 1])
        elif compressing:
            state[0], wanted = 0.0, (1.0 - restitution**2) * state[3]
            if restitution == 0.0:
                return numpy.array([impulse, state[2]])
        else:
            return numpy.array([impulse, state[2]])


def _friction_ratio(A: Vector, friction: float, slip: float | None) -> float:
    """Tangential over normal impulse on a part of the path; ``None``: the contact point holds, or
    slip starts anew.
    """
    if slip is not None:
        return float(slip * friction)
    if abs(A[0, 1]) <= friction * A[1, 1]:
        return float(-A[0, 1] / A[1, 1])
    return float(-numpy.sign(A[0, 1]) * friction)


def _rate(_impulse: float, state: Vector, A: Vector, ratio: float) -> Vector:
    return numpy.array([A[0, 0] + ratio * A[0, 1], A[0, 1] + ratio * A[1, 1], ratio, state[0]])


def _ends_at(index: int, direction: float, level: float = 0.0):  # type: ignore[no-untyped-def]
    def event(_impulse: float, state: Vector, _A: Vector, _ratio: float) -> float:
        return float(state[index] - level)

    event.terminal, event.direction = True, direction  # type: ignore[attr-defined]
    return event
