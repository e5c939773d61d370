"""Contact problems the slow way: residual as it is defined, index sets of two planar contacts, the
least-norm split by scipy.

Twin of `rigid/contact/solver.py`, with which it shares no code.
"""

from __future__ import annotations

import itertools
import math

import numpy
from scipy.optimize import minimize

from contact_sim_lab.twins.rigid_impact import enumerate_lcp
from contact_sim_pkg.compiled.arrays import Vector

__all__ = ["coulomb_residual", "planar_velocity_by_enumeration", "planar_wrench_cone_split"]


def _nearest_on_polygon(point: Vector, radius: float, facets: int) -> Vector:
    """Nearest point of a regular polygon, over all its edges."""
    if radius == 0.0:
        return numpy.zeros(2)
    angles = 2.0 * math.pi * numpy.arange(facets) / facets
    corners = radius * numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
    best, inside = None, True
    for start, end in itertools.pairwise([*corners, corners[0]]):
        edge = end - start
        outward = numpy.array([edge[1], -edge[0]])
        inside = inside and bool(outward @ (point - start) <= 0.0)
        along = numpy.clip((point - start) @ edge / max(edge @ edge, 1e-300), 0.0, 1.0)
        candidate = start + along * edge
        if best is None or numpy.linalg.norm(candidate - point) < numpy.linalg.norm(best - point):
            best = candidate
    return point if inside else numpy.asarray(best)


def coulomb_residual(A: Vector, q: Vector, c: Vector, friction: Vector, width: int, facets: int) -> float:
    """Greatest break of Signorini's and Coulomb's conditions over the greatest velocity; ``facets``
    0: the disc.

    A: [n, n] [1/kg]; q, c: [n] [m/s], [N s].
    """
    u = q + A @ c
    friction = numpy.broadcast_to(friction, len(c) // width)
    scale = max(numpy.abs(q).max(), (numpy.diag(A) * c)[::width].max())
    worst = 0.0
    for i, ratio in enumerate(friction):
        row, weight = i * width, A[i * width, i * width]
        # Tangential impulse as the nearest point of the friction disc, or polygon, to impulse less
        # slip
        radius = ratio * max(c[row], 0.0)
        point = c[row + 1 : row + width] - u[row + 1 : row + width] / weight
        if width == 2 or facets == 0:
            nearest = point * min(1.0, radius / max(numpy.linalg.norm(point), 1e-300))
        else:
            nearest = _nearest_on_polygon(point, radius, facets)
        coulomb = weight * numpy.linalg.norm(c[row + 1 : row + width] - nearest)
        worst = max(worst, abs(min(weight * c[row], u[row])), float(coulomb))
    return float(worst / scale)


def planar_velocity_by_enumeration(J: Vector, W: Vector, v: Vector, friction: Vector) -> Vector:
    """Velocity after the planar contacts ``J`` (rows normal, tangent a contact), from all index
    sets of eq 9.

    J: [2 contacts, velocities]; W: [velocities, velocities]; v: [velocities].
    """
    contacts = len(J) // 2
    normals, tangents = J[0::2].T, J[1::2].T
    D = numpy.hstack([tangents, -tangents])
    E = numpy.vstack([numpy.eye(contacts), numpy.eye(contacts)])
    G = numpy.hstack([normals, D])
    # Complementarity problem of normal impulses, friction impulses and slip speeds
    M = numpy.zeros((4 * contacts, 4 * contacts))
    M[: 3 * contacts, : 3 * contacts] = G.T @ W @ G
    M[contacts : 3 * contacts, 3 * contacts :] = E
    M[3 * contacts :, :contacts] = numpy.diag(friction)
    M[3 * contacts :, contacts : 3 * contacts] = -E.T
    q = numpy.concatenate([G.T @ v, numpy.zeros(contacts)])
    answers = [v + W @ G @ z[: 3 * contacts] for z in enumerate_lcp(M, q)]
    if not answers:
        raise ArithmeticError("no index set solves the contact problem")
    return numpy.asarray(answers[0])


def planar_wrench_cone_split(J: Vector, wrench: Vector, friction: float) -> Vector:
    """Impulses of least norm with this wrench, all contacts sticking inside their cones: bounds by
    SLSQP, then exactly.

    J: [rows, 3], rows normal, tangent of each contact; wrench: [3]; friction: [1]; the result:
    [rows], in the unit of `J^-T wrench`.
    """
    rows = len(J)
    found = minimize(
        lambda x: float(x @ x), numpy.linalg.lstsq(J.T, wrench, rcond=None)[0], jac=lambda x: 2.0 * x, method="SLSQP",
        options={"ftol": 1e-16, "maxiter": 1000},
        constraints=[
            {"type": "eq", "fun": lambda x: J.T @ x - wrench},
            {"type": "ineq", "fun": lambda x: x[0::2]},
            {"type": "ineq", "fun": lambda x: friction * x[0::2] - x[1::2]},
            {"type": "ineq", "fun": lambda x: friction * x[0::2] + x[1::2]},
        ],
        bounds=[(None, None)] * rows,
    )  # fmt: skip
    normal, bound = numpy.eye(rows)[0::2], numpy.eye(rows)[1::2]
    limits = numpy.vstack([normal, friction * normal - bound, friction * normal + bound])
    active = limits[limits @ found.x < 1e-6 * numpy.abs(found.x).max()]
    return numpy.asarray(
        numpy.linalg.lstsq(
            numpy.vstack([J.T, active]), numpy.concatenate([wrench, numpy.zeros(len(active))]), rcond=None
        )[0]
    )
