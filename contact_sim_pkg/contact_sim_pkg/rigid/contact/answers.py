"""Contact impulses for callers from Python: the methods of `rigid/contact/solver.py`, and what
follows where they end without an answer.

A second solve at velocities that rounding has not put out of reach. A problem that no method settles
is refused by its status.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigid.contact.solver import NEAREST, ContactSolution, Solver, solve_and_split
from contact_sim_pkg.rigid.problem import ContactProblem, residual
from contact_sim_pkg.rigid.results import CONTACT_NOT_FINITE, NOT_CONVERGED, SOLVED, UNIQUE

__all__ = ["contact_impulses", "solve_repeatedly"]


@entry
def solve_repeatedly(
    problem: ContactProblem, J: Vector, W: Vector, solver: Solver, c: Vector, times: int
) -> ContactSolution:
    """`solve_and_split` into ``c`` [rows], ``times`` times, each again from no load: the time of
    one solve in a study is without the call from Python.

    An entry of its own for that would compile all solvers once more.
    """
    found = ContactSolution(NOT_CONVERGED, UNIQUE, numpy.inf, 0)
    for solve in range(times):
        for row in range(c.shape[0] if solve > 0 else 0):
            c[row] = 0.0
        found = solve_and_split(problem, J, W, solver, c)
    return found


def contact_impulses(problem: ContactProblem, J: Vector, W: Vector, solver: Solver, c: Vector) -> ContactSolution:
    """Impulses of ``problem`` into ``c`` [rows], with the least-norm split of the load;
    ``problem.A`` must be ``J W J'``.

    SOLVED: the residual is at most 1e-12 on the true cone; or conditions that contradict each other
    by rounding are met as nearly as the residual says, up to NEAREST.
    """
    found = solve_repeatedly(problem, J, W, solver, c, 1)
    if found.status in (SOLVED, CONTACT_NOT_FINITE):
        return found
    found = _by_nearest_motion(problem, J, W, solver, c, found)
    return found._replace(status=SOLVED) if found.residual <= NEAREST else found


def _by_nearest_motion(
    problem: ContactProblem, J: Vector, W: Vector, solver: Solver, c: Vector, found: ContactSolution
) -> ContactSolution:
    """The answer at the contact velocities nearest to ``q`` that a motion of the bodies gives,
    where only rounding lies between.

    Contacts that are wedged in meet any approach ``J v`` with finite impulses, but none that no
    motion gives, however small. A body that moves at 1 m/s and approaches at 1e-10 m/s has rounding
    of 1e-6 in its approach.
    """
    near = nearest_motion(J, problem.q, NEAREST)
    if near is None:
        return found
    trial = numpy.zeros_like(c)
    ended = solve_repeatedly(problem._replace(q=near), J, W, solver, trial, 1)
    if ended.status != SOLVED:
        return found
    c[:] = trial
    return ended._replace(residual=float(residual(problem, c, solver.newton.velocity)))


def nearest_motion(J: Vector, q: Vector, most: float) -> Vector | None:
    """The contact velocities ``J v`` nearest to ``q`` [rows] in [m/s]; None where they differ by
    more than ``most`` of its largest.
    """
    near: Vector = J @ numpy.linalg.lstsq(J, q)[0]
    return near if numpy.abs(near - q).max() <= most * numpy.abs(q).max() else None
