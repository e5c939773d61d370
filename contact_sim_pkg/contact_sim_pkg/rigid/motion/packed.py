"""Solve the active contacts of a body, and those alone: of all that it can have few are active at
a time.

The arrays of a solve are made once for each number of active contacts. Bookkeeping around
`rigid/contact/solver.py` and `rigid/impact/law.py`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.bodies.motion import MotionWorkspace
from contact_sim_pkg.rigid.contact.answers import contact_impulses
from contact_sim_pkg.rigid.contact.solver import NEWTON, SWEEPS, ContactSolution, Solver, make_solver
from contact_sim_pkg.rigid.impact.law import ImpactWorkspace, impact_impulses, make_impact_workspace
from contact_sim_pkg.rigid.problem import DISC, ContactProblem, make_problem
from contact_sim_pkg.rigid.results import SOLVED, UNIQUE

__all__ = ["PackedSolver"]


class _Room(NamedTuple):
    """Arrays for one number of contacts."""

    problem: ContactProblem
    jacobian: Vector  # [rows, coordinates]
    solver: Solver
    impact: ImpactWorkspace
    impulse: Vector  # [rows]


class PackedSolver:
    """Impulses of the active contacts of a `MotionWorkspace`, into its ``impulse``; those of the
    others are 0.
    """

    def __init__(
        self, coordinates: int, width: int, facets: int = DISC, method: int = NEWTON, sweeps: int = SWEEPS
    ) -> None:
        """Of a body with ``coordinates`` coordinates; ``method`` and ``sweeps`` of the solver of
        active contacts.
        """
        self._coordinates, self._width, self._facets, self._method, self._sweeps = (
            coordinates,
            width,
            facets,
            method,
            sweeps,
        )
        self._rooms: dict[int, _Room] = {}

    def hold(self, work: MotionWorkspace) -> ContactSolution:
        """Impulses of the active contacts over a step without bounce."""
        rows, room = self._pack(work)
        work.impulse[:] = 0.0
        if len(rows) == 0:
            return ContactSolution(SOLVED, UNIQUE, 0.0, 0)
        found = contact_impulses(room.problem, room.jacobian, work.W, room.solver, room.impulse)
        work.impulse[rows] = room.impulse
        return found

    def collide(self, work: MotionWorkspace, rule: int) -> ContactSolution:
        """Impact of the active contacts from the contact velocities ``work.u``."""
        rows, room = self._pack(work)
        work.impulse[:] = 0.0
        if len(rows) == 0:
            return ContactSolution(SOLVED, UNIQUE, 0.0, 0)
        restitution = work.restitution[rows[:: self._width] // self._width]
        found = impact_impulses(
            room.problem,
            J=room.jacobian,
            W=work.W,
            u=work.u[rows],
            restitution=restitution,
            rule=rule,
            work=room.impact,
            c=room.impulse,
        )
        work.impulse[rows] = room.impulse
        return found

    def _pack(self, work: MotionWorkspace) -> tuple[numpy.typing.NDArray[numpy.intp], _Room]:
        active = numpy.flatnonzero(work.problem.friction >= 0.0)
        rows = (active[:, None] * self._width + numpy.arange(self._width)).ravel()
        room = self._rooms.get(len(active))
        if room is None:
            room = self._rooms[len(active)] = self._make_room(len(active))
        problem = room.problem
        problem.A[:] = work.problem.A[numpy.ix_(rows, rows)]
        problem.q[:], problem.friction[:] = work.problem.q[rows], work.problem.friction[active]
        problem.floor[:], room.jacobian[:] = work.problem.floor[active], work.J[rows]
        room.impulse[:] = 0.0
        return rows, room

    def _make_room(self, contacts: int) -> _Room:
        rows, coordinates, width, facets = contacts * self._width, self._coordinates, self._width, self._facets
        return _Room(
            make_problem(contacts, width, facets),
            numpy.zeros((rows, coordinates)),
            make_solver(contacts, coordinates, width, facets, self._method, self._sweeps),
            make_impact_workspace(contacts, coordinates, width, facets),
            numpy.zeros(rows),
        )
