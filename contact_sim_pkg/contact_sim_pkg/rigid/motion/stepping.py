"""A rigid body in time at a fixed step, of first order: contacts within reach are solved once a
step, in velocities and impulses.

A contact is in reach where its gap is closed or closes within the step, of itself or by what the
others take from the body (`rigid/geometry/reach.py`); all in reach meet ``gap/h + u_n+ >= 0``.
Where one approaches faster than the rest speed 2 g h, with restitution, the step ends on the ground
by the same rows, and the velocity after it is that of the impact law: a bounce above the ground
would gain height, and a body that bounces would never rest. Source: Identifiability eqs 9, 14;
Stewart and Trinkle 1996.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody, contact_count, fitted_ground
from contact_sim_pkg.rigid.contact.answers import nearest_motion
from contact_sim_pkg.rigid.contact.packed import PackedSolver
from contact_sim_pkg.rigid.contact.solver import NEWTON, ContactSolution
from contact_sim_pkg.rigid.geometry.reach import begin_step, reach_further
from contact_sim_pkg.rigid.motion.motion import (
    MotionWorkspace,
    apply_impulse,
    carry_spin,
    commit,
    displace,
    make_motion_workspace,
)
from contact_sim_pkg.rigid.parameters import ENERGETIC
from contact_sim_pkg.rigid.problem import DISC
from contact_sim_pkg.rigid.results import NOT_CONVERGED, SOLVED, SPIN_TOO_FAST

__all__ = ["SteppedBody"]

LARGEST_TURN = 1.0  # [rad] of a step
CONTRADICTS = 1.0e-10  # residual of contacts that require what no motion gives
# of the contact velocities: by so much those of a step may differ from a motion of the body
CLOSED_AT_ONCE = 1.0e-3


@entry
def end_step(body: RigidBody, motion: Motion, work: MotionWorkspace, landing: Vector, step: float) -> None:
    """Apply the impulses; the position after ``step`` [s] follows from the velocity that those of
    ``landing`` [rows] would give.
    """
    for k in range(work.free.shape[0]):
        motion.velocity[k] = work.free[k]
    apply_impulse(work.J, work.W, landing, motion.velocity)
    displace(body, motion, motion.velocity, work, step)
    apply_impulse(work.J, work.W, work.impulse, work.free)
    carry_spin(body, motion, work.free, work)
    commit(body, motion, work.free, work)


class SteppedBody:
    """One body over a ground, at a fixed step. ``motion`` changes in place."""

    def __init__(
        self, body: RigidBody, ground: Ground, motion: Motion, step: float, rule: int = ENERGETIC,
        facets: int = DISC, method: int = NEWTON, sweeps: int = 20,
    ) -> None:  # fmt: skip
        """``step`` in [s]; ``facets`` of the friction cone, ``method`` and ``sweeps`` of the solver
        of active contacts.
        """
        ground = fitted_ground(body, ground)
        self.body, self.ground, self.motion, self.step, self.rule = body, ground, motion, step, rule
        points, coordinates = contact_count(body, ground), len(body.load)
        self.work = make_motion_workspace(body, ground, facets)
        self._solver = PackedSolver(coordinates, body.width, facets, method, sweeps)
        weight = float(numpy.linalg.norm(body.load[: body.width]) / body.mass)
        self.rest_speed = 2.0 * step * weight
        self.impulse = numpy.zeros(points * body.width)  # [rows] in [N s] over the last call
        self._margin, self._change = numpy.zeros(points), numpy.zeros(coordinates)
        # [rows] in [N s] of a step, without bounce
        self._landing = numpy.zeros(points * body.width)
        self.dissipated = 0.0  # [J] by contacts, in all
        self.residual = 0.0  # largest of the last call
        self.impacts = 0

    def advance(self, steps: int) -> int:
        """``steps`` steps; returns a status of `rigid/results.py`."""
        work = self.work
        self.impulse[:] = 0.0
        self.residual = 0.0
        for _ in range(steps):
            # contacts within reach, and the velocity without them
            found, turn = begin_step(
                self.body, self.ground, self.motion, work, self._margin, self.step, self.rest_speed
            )
            if not turn <= LARGEST_TURN:
                return SPIN_TOO_FAST
            # their impulses; a body in the air has none
            if found:
                status = self._solve(bounces=found == 2)
                if status != SOLVED:
                    return status
            else:
                work.impulse[:], self._landing[:] = 0.0, 0.0
            # books, then the state at the end of the step
            self.impulse += work.impulse
            self.dissipated -= self._work_of_contacts()
            end_step(self.body, self.motion, work, self._landing, self.step)
        return SOLVED

    def _work_of_contacts(self) -> float:
        """In [J], of the impulses on the velocities without them and with them."""
        work = self.work
        before = work.J @ work.free
        return float(work.impulse @ (before + 0.5 * (work.J @ work.W @ work.J.T) @ work.impulse))

    def _solve(self, *, bounces: bool) -> int:
        work, further = self.work, 1
        while further:
            found = self._land()
            further = self._reach_further() if found.status == SOLVED else 0
            bounces = bounces or further == 2
        self._landing[:] = work.impulse
        if bounces and found.status == SOLVED:
            self.impacts += 1
            found = self._solver.collide(work, self.rule)
        self.residual = max(self.residual, float(found.residual)) if math.isfinite(found.residual) else math.inf
        return int(found.status)

    def _land(self) -> ContactSolution:
        """The contacts in reach without bounce."""
        found = self._solver.hold(self.work)
        if found.status in (SOLVED, NOT_CONVERGED) and not found.residual <= CONTRADICTS and self._meets_a_motion():
            found = self._solver.hold(self.work)
        return found

    def _reach_further(self) -> int:
        """Contacts that those in reach drive into the ground: 0 there are none, 1 they are active
        too, 2 they or others bounce.
        """
        return int(
            reach_further(self.body, self.motion, self.work, self._margin, self._change, self.step, self.rest_speed)
        )

    def _meets_a_motion(self) -> bool:
        """Replace the required contact velocities by the nearest ones of a motion of the body;
        False where they are far.

        A step that closes unlike gaps of points that stick requires velocities that differ from any
        motion by the tilt that it takes away: an error of first order.
        """
        work = self.work
        rows = numpy.repeat(work.problem.friction >= 0.0, self.body.width)
        near = nearest_motion(work.J[rows], work.problem.q[rows], CLOSED_AT_ONCE)
        if near is not None:
            work.problem.q[rows] = near
        return near is not None
