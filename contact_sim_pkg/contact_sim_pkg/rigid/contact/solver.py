"""Solve a contact problem by one of four methods, and name how it ended.

Methods: MODES (closed formulas, one contact in the plane), GAUSS_SEIDEL (inexpensive: a fixed
number of sweeps), LEMKE (exact in the plane and for a polyhedral cone; for the true cone in space
the start of Newton's method) and NEWTON (default): Newton's method from a few sweeps, certified by
its residual, and LEMKE wherever it does not settle or the cone is polyhedral.

Source: Identifiability eqs 2, 8 and 9.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.rigid.contact.cone_newton import GOOD, NewtonWorkspace, make_newton_workspace, solve_by_newton
from contact_sim_pkg.rigid.contact.gauss_seidel import gauss_seidel
from contact_sim_pkg.rigid.contact.lemke_contact import ContactLemke, make_contact_lemke, solve_by_lemke
from contact_sim_pkg.rigid.contact.load_split import SplitWorkspace, make_split_workspace, split_load
from contact_sim_pkg.rigid.contact.planar_impact import contact_modes
from contact_sim_pkg.rigid.contact.slide_direction import slide_in_one_direction
from contact_sim_pkg.rigid.parameters import PlanarContact
from contact_sim_pkg.rigid.problem import DISC, PLANE, ContactProblem, residual, velocity_scale
from contact_sim_pkg.rigid.results import CONTACT_NOT_FINITE, NOT_CONVERGED, SOLVED, SPLIT_NOT_UNIQUE, UNIQUE

MODES, GAUSS_SEIDEL, LEMKE, NEWTON = 0, 1, 2, 3
START_FACETS = 8  # of the polyhedral cone from which Newton's method starts on the true one
TURNS = 30  # times the facets are turned to the slip where Newton's method alone does not settle
SWEEPS = 20  # of Gauss-Seidel unless specified
FIRST_SWEEPS = 6  # before Newton's method
PASS_WEIGHT = 1.0e-3  # of the proximal term, in A_nn of the contact
PASS_END = 1.0e-16  # change of velocity, of the greatest, at which the passes end
PASSES = 20
POLISH, ALONE = PASSES, PASSES + 1  # what follows the passes
# of the greatest velocity: conditions that contradict each other by no more do so by rounding of
# their velocities
NEAREST = 1.0e-6


class Solver(NamedTuple):
    """A method and its work space."""

    method: int
    sweeps: int  # of Gauss-Seidel
    lemke: ContactLemke
    newton: NewtonWorkspace
    split: SplitWorkspace
    center: Vector  # [rows]
    weight: Vector  # [rows]
    passed: Vector  # [rows], answer of the last pass


class ContactSolution(NamedTuple):
    """How a contact solve ended; the impulses are in the array that was handed in."""

    status: int  # results.SOLVED ...
    flags: int  # results.SPLIT_NOT_UNIQUE ...
    residual: float  # of `problem.residual`
    work: int  # sweeps of Gauss-Seidel


def make_solver(
    contacts: int, coordinates: int, width: int, facets: int = DISC, method: int = NEWTON, sweeps: int = SWEEPS
) -> Solver:
    """Work space for problems of up to ``contacts`` contacts on bodies with ``coordinates``
    coordinates.
    """
    rows = contacts * width
    lemke = make_contact_lemke(contacts, width, facets if facets != DISC else START_FACETS)
    newton, split = make_newton_workspace(rows), make_split_workspace(rows, coordinates)
    return Solver(
        method=method,
        sweeps=sweeps,
        lemke=lemke,
        newton=newton,
        split=split,
        center=numpy.zeros(rows),
        weight=numpy.zeros(rows),
        passed=numpy.zeros(rows),
    )


@borrowing_kernel
def _is_finite(problem):
    finite = True
    for i in range(problem.q.shape[0]):
        finite = finite and abs(problem.q[i]) < numpy.inf and problem.A[i, i] < numpy.inf
    return finite


@borrowing_kernel
def _by_modes(problem, c):
    contact = PlanarContact(problem.A[0, 0], problem.A[0, 1], problem.A[1, 1], problem.friction[0], 0.0)
    impulse = contact_modes(contact, problem.q[0], problem.q[1], problem.floor[0])
    c[0], c[1] = impulse.normal, impulse.tangential


@borrowing_kernel
def _turn_facets(problem, work, u):
    """Turn the friction directions of each contact so that one of them opposes its slip."""
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        if u[row + 1] != 0.0 or u[row + 2] != 0.0:
            work.turn[i] = numpy.arctan2(-u[row + 2], -u[row + 1])


@borrowing_kernel
def _by_direction(problem, solver, c):
    """One contact that slides; ``c`` is kept where there is none."""
    found = solver.newton.best
    slides = slide_in_one_direction(problem.A, problem.q, problem.friction[0], problem.floor[0], found)
    if not (slides and residual(problem, found, solver.newton.velocity) <= GOOD):
        return NOT_CONVERGED
    copy_row(found, c)
    return SOLVED


@borrowing_kernel
def _exactly(problem, solver, start, attempts, c):
    """Newton's method from ``c`` (``start``) or a few sweeps; Lemke; on the true cone Newton from
    there, with facets turned.

    At most ``attempts`` times: the facets of a further one are turned to the slip that the last one
    found.
    """
    plane = problem.width == PLANE
    on_disc = not plane and problem.facets == DISC
    facets = 2 if plane else (START_FACETS if on_disc else problem.facets)
    status = SOLVED
    swept = solver.method == NEWTON and (plane or on_disc)
    for attempt in range(attempts):
        # a few sweeps make a start for Newton; later starts are those of Lemke
        if swept and attempt == 0:
            if not start:
                gauss_seidel(problem, c, FIRST_SWEEPS, 0.0)
        else:
            status = solve_by_lemke(problem, solver.lemke, facets, c)
            if status != SOLVED or not on_disc:
                break
        # certified by its residual; one sliding contact has a bracketed equation of its own
        status, _residual = solve_by_newton(problem, solver.newton, c)
        if status != SOLVED and on_disc and problem.friction.shape[0] == 1:
            status = _by_direction(problem, solver, c)
        if status == SOLVED:
            break
        if on_disc:
            # the facets of the next start turn to the slip found
            residual(problem, c, solver.newton.velocity)
            _turn_facets(problem, solver.lemke, solver.newton.velocity)
    for i in range(problem.friction.shape[0]):
        solver.lemke.turn[i] = 0.0
    return status


@kernel
def may_share_load(problem):
    """Whether the impulses of this problem can be shared in more than one way."""
    contacts, rough = 0, False
    for i in range(problem.friction.shape[0]):
        contacts += 1 if problem.friction[i] >= 0.0 else 0
        rough = rough or problem.friction[i] > 0.0
    return contacts >= 4 or (contacts == 3 and problem.width == PLANE) or (contacts >= 2 and rough)


@borrowing_kernel
def _about(problem, weight, sign, center):
    """Add (sign 1) or take away (-1) the proximal terms: ``A + s I``, ``q - s center``, s of the
    row in ``weight``.
    """
    for row in range(problem.q.shape[0]):
        problem.A[row, row] += sign * weight[row]
        problem.q[row] -= sign * weight[row] * center[row]


@borrowing_kernel
def _begin(solver, attempt, c):
    """What an attempt starts from: a pass from the one before, POLISH from the last pass, ALONE
    from no impulse.
    """
    if attempt < POLISH:
        copy_row(c, solver.center)
        return
    for row in range(c.shape[0]):
        c[row] = solver.passed[row] if attempt == POLISH else 0.0
        solver.center[row], solver.weight[row] = 0.0, 0.0


@borrowing_kernel
def _change(problem, solver, c):
    """Greatest change of velocity by the last pass, of the greatest velocity."""
    change = 0.0
    for row in range(c.shape[0]):
        change = max(change, solver.weight[row] * abs(c[row] - solver.center[row]))
    return change / velocity_scale(problem, c) if change > 0.0 else 0.0


@borrowing_kernel
def _by_passes(problem, solver, c):
    """Redundant contacts: proximal point iteration from no load, each pass of which has one
    solution.

    How the load is shared decides, where points slide in different directions, the friction and so
    the velocity: the answer picked here does not depend on the order of the contacts. Source:
    Rockafellar 1976. Passes go on without end where redundant contacts contradict each other by
    rounding of gaps or arms, and squeeze each other until one slips: Newton's method then goes on
    from the last, without the proximal term. One contact, and what has no pass, is solved ALONE.
    """
    # proximal terms, where the load can be shared in more than one way
    part = PASS_WEIGHT if solver.method == NEWTON and may_share_load(problem) else 0.0
    for row in range(c.shape[0]):
        first = row - row % problem.width
        c[row], solver.weight[row] = 0.0, part * problem.A[first, first]
    status, attempt, passed = NOT_CONVERGED, 0 if part > 0.0 else ALONE, False
    while attempt <= ALONE:
        # one problem with the proximal terms of this pass
        _begin(solver, attempt, c)
        _about(problem, solver.weight, 1.0, solver.center)
        status = _exactly(problem, solver, 0 < attempt < ALONE, 1 if attempt == POLISH else TURNS, c)
        _about(problem, solver.weight, -1.0, solver.center)
        # the last ones are without proximal terms: polished, or solved alone
        if attempt >= POLISH:
            attempt = ALONE if attempt == POLISH and status != SOLVED else ALONE + 1
            continue
        if status != SOLVED:
            attempt = POLISH if passed else ALONE
            continue
        # a pass that was solved: go on until velocities no longer change
        copy_row(c, solver.passed)
        passed = True
        attempt = attempt + 1 if _change(problem, solver, c) > PASS_END else POLISH
        if attempt == POLISH and residual(problem, c, solver.newton.velocity) <= GOOD:
            break
    # contradictions that are rounding: the last pass is the answer
    if status != SOLVED and passed and residual(problem, solver.passed, solver.newton.velocity) <= NEAREST:
        copy_row(solver.passed, c)
        status = NOT_CONVERGED
    return status


@borrowing_kernel
def _clear_inactive(problem):
    """No velocity and no floor for inactive contacts."""
    for i in range(problem.friction.shape[0]):
        if problem.friction[i] < 0.0:
            problem.floor[i] = 0.0
            for row in range(i * problem.width, (i + 1) * problem.width):
                problem.q[row] = 0.0


@borrowing_kernel
def solve_contact(problem: ContactProblem, solver: Solver, c: Vector) -> ContactSolution:
    """Impulses of ``problem`` into ``c`` [rows]; zeros where the status is RAY or
    CONTACT_NOT_FINITE.

    MODES needs one contact in the plane. Gauss-Seidel starts from the ``c`` that is given.
    """
    u = solver.newton.velocity
    # inactive contacts must not set the scale
    _clear_inactive(problem)
    status, swept = SOLVED, 0
    if not _is_finite(problem):
        status = CONTACT_NOT_FINITE
    elif solver.method == GAUSS_SEIDEL:
        swept = gauss_seidel(problem, c, solver.sweeps, 0.0)
    elif solver.method == MODES and problem.q.shape[0] == PLANE and problem.width == PLANE:
        _by_modes(problem, c)
    else:
        status = _by_passes(problem, solver, c)
    # no answer: no impulse either
    if status != SOLVED and status != NOT_CONVERGED:
        for i in range(c.shape[0]):
            c[i] = 0.0
        return ContactSolution(status, UNIQUE, numpy.inf, swept)
    return ContactSolution(status, UNIQUE, residual(problem, c, u), swept)


@borrowing_kernel
def solve_and_split(problem: ContactProblem, J: Vector, W: Vector, solver: Solver, c: Vector) -> ContactSolution:
    """`solve_contact` into ``c`` [rows], then the least-norm split of the load."""
    found = solve_contact(problem, solver, c)
    if found.status != SOLVED or not may_share_load(problem):
        return found
    u, kept = solver.newton.velocity, solver.newton.best
    copy_row(c, kept)
    split_load(problem, J, W, u, scale=velocity_scale(problem, c), facets=problem.facets, c=c, work=solver.split)
    after = residual(problem, c, u)
    if after > GOOD and after > found.residual:
        copy_row(kept, c)
        after = residual(problem, c, u)
    return ContactSolution(SOLVED, SPLIT_NOT_UNIQUE, after, found.work)
