"""Work-precision studies of rigid contact: the solver of the contact problem, the facets of the
friction cone, the step in time, the tolerance of a body that turns on active contacts.

Times of a contact problem are those of one solve in a compiled loop; of a motion, those of the
whole run.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, row
from contact_sim_lab.rigs.body import crossing_body, tipping_body
from contact_sim_lab.rigs.body.rigid_problem import (
    ContactCase,
    contact_rows,
    milliseconds_of_a_solve,
    random_face,
    solve,
    stack,
)
from contact_sim_lab.twins.rigid_contact import planar_velocity_by_enumeration
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.bodies.body import box, regular_block
from contact_sim_pkg.rigid.contact.solver import GAUSS_SEIDEL, LEMKE, MODES, NEWTON
from contact_sim_pkg.rigid.problem import PLANE, SPACE

__all__ = [
    "CONE_PART",
    "SOLVER_PART",
    "TURN_PART",
    "WORK_PRECISION",
    "cone_rows",
    "solver_rows",
    "turn_rows",
]  # fmt: skip

SOLVER_PART = "post-impact velocity: solver"
CONE_PART = "friction cone in space"
TURN_PART = "body that turns on active contacts: end position"
CLOSED = "closed form"
ENUMERATION = "all index sets, numpy, no shared code"
POINT_MASS = "closed form of a sliding point"
DIRECTIONS = 37  # of slip, over which the worst error is taken
FACETS = (4, 8, 16, 32, 0)
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def _velocity_error(case: ContactCase, c: Vector, expected: Vector) -> float:
    """Greatest difference of the velocities after the impact, over the greatest velocity before."""
    after = case.v + case.W @ case.J.T @ c
    return float(numpy.abs(after - expected).max() / numpy.abs(case.v).max())


def solver_rows() -> list[Row]:
    """One and two contacts in the plane, and a stack of mass ratio 100, by every level."""
    cases = {
        "one contact": random_face(1, 1, PLANE), "two contacts of a face": random_face(2, 2, PLANE),
        "1 kg under 100 kg": stack(100.0),
    }  # fmt: skip
    found = []
    for name, case in cases.items():
        expected = planar_velocity_by_enumeration(case.J, case.W, case.v, case.friction)
        levels = [
            ("Gauss-Seidel, 20 sweeps", GAUSS_SEIDEL, 20), ("Gauss-Seidel, 2000 sweeps", GAUSS_SEIDEL, 2000),
            ("Lemke", LEMKE, 0), ("Newton, Lemke where it stalls", NEWTON, 0),
        ]  # fmt: skip
        if len(case.friction) == 1:
            levels.append(("closed modes", MODES, 0))
        for level, kind, sweeps in levels:
            ms = milliseconds_of_a_solve(case, kind, 0, sweeps)
            error = _velocity_error(case, solve(case, kind, 0, sweeps)[0], expected)
            found.append(row(SOLVER_PART, name, "velocity", FidelityLevel(level, ms), ENUMERATION, error))
    return found


def cone_rows() -> list[Row]:
    """A point that slides on in any direction: worst error of its velocity by number of facets; 0
    is the true cone.
    """
    J, W, friction = contact_rows(numpy.zeros((1, 3)), SPACE), numpy.diag([1.0, 1.0, 1.0, 2.0, 2.0, 2.0]), 0.5
    found = []
    for facets in FACETS:
        worst, case = 0.0, ContactCase(J, W, numpy.zeros(6), numpy.full(1, friction), SPACE)
        for angle in numpy.linspace(0.0, math.pi, DIRECTIONS):
            slip = numpy.array([math.cos(angle), math.sin(angle), 0.0, 0.0, 0.0, 0.0])
            case = case._replace(v=3.0 * slip - numpy.eye(6)[2])
            worst = max(worst, _velocity_error(case, solve(case, NEWTON, facets)[0], (3.0 - friction) * slip))
        ms = milliseconds_of_a_solve(case, NEWTON, facets)
        name = f"{facets} facets" if facets else "true cone"
        found.append(
            row(CONE_PART, "sliding point, worst direction", "velocity", FidelityLevel(name, ms), POINT_MASS, worst)
        )
    return found


def turn_rows() -> list[Row]:
    """Bodies that tip over on a corner and on an edge, and one whose slip turns, by the tolerance
    of their integration.
    """
    found = []
    for name, case in (
        ("block on a corner", regular_block(0.1, 1.0, 1.0, 0.0)),
        ("box on an edge", box((0.1, 0.14, 0.2), 1.0, 1.0, 0.0)),
    ):
        tips = tipping_body.tipping(case)
        if tips is not None:
            run, error = functools.partial(tipping_body.tip, tips), functools.partial(tipping_body.tip_error, tips)
            found += _by_tolerance(name, run, error, tipping_body.REFERENCE)
    across = "box that slides across a slope"
    return found + _by_tolerance(across, crossing_body.cross, crossing_body.cross_error, crossing_body.REFERENCE)


def _by_tolerance(
    name: str, run: Callable[[float], object], error_of: Callable[[float], float], reference: str
) -> list[Row]:
    """A row for each tolerance; times of the whole run."""
    found = []
    for tolerance in TOLERANCES:
        time = milliseconds(lambda at=tolerance: run(at))  # type: ignore[misc]
        level = FidelityLevel(f"located, {tolerance:g}", time, tolerance=tolerance)
        found.append(row(TURN_PART, name, "position", level, reference, error_of(tolerance)))
    return found


WORK_PRECISION = (
    WorkPrecision(SOLVER_PART, solver_rows),
    WorkPrecision(CONE_PART, cone_rows),
    WorkPrecision(TURN_PART, turn_rows),
)
