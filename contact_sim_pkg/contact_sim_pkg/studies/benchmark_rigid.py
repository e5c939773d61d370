"""Goals of rigid contact: time of impacts and of solves inside compiled loops, and errors of motions."""

from __future__ import annotations

import numpy

from contact_sim_pkg.core.jit import entry
from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.rigid.contact_solver import LEMKE, Solver, make_solver, solve_and_split
from contact_sim_pkg.core.rigid.parameters import RULE_NAMES, PlanarContact
from contact_sim_pkg.core.rigid.planar_impact import impact_impulse
from contact_sim_pkg.core.rigid.problem import PLANE, SPACE, ContactProblem, fill_delassus, make_problem, multiply_add
from contact_sim_pkg.studies import rigid_motion
from contact_sim_pkg.studies.benchmark_goal import Measured, median_time
from contact_sim_pkg.studies.hard_cases_rigid import redundant_residual
from contact_sim_pkg.studies.rigid_problem import SIDE, contact_rows, random_face

__all__ = ["goals"]

IMPACTS, SOLVES = 100_000, 2_000


@entry
def _impacts(states: Vector, rule: int, friction: float, restitution: float, out: Vector) -> None:
    """From angle and velocity [n, 4] of the 1 kg block to its velocity after the impact of its lowest corner [n, 3]."""
    radius, inertia = SIDE / numpy.sqrt(2.0), SIDE * SIDE / 6.0
    for i in range(states.shape[0]):
        lean = numpy.pi / 4.0 - states[i, 0]
        n_w, t_w = -radius * numpy.sin(lean), radius * numpy.cos(lean)
        v_x, v_y, w = states[i, 1], states[i, 2], states[i, 3]
        contact = PlanarContact(
            1.0 + n_w * n_w / inertia, n_w * t_w / inertia, 1.0 + t_w * t_w / inertia, friction, restitution
        )
        c = impact_impulse(contact, rule, v_y + n_w * w, v_x + t_w * w)
        out[i, 0] = v_x + c.tangential
        out[i, 1] = v_y + c.normal
        out[i, 2] = w + (n_w * c.normal + t_w * c.tangential) / inertia


@entry
def _solves(
    problem: ContactProblem, J: Vector, W: Vector, velocities: Vector, solver: Solver, c: Vector, u: Vector
) -> float:
    """Assembly and solve of one body's contacts for each of the velocities [n, coordinates]; the worst residual."""
    worst = 0.0
    for i in range(velocities.shape[0]):
        fill_delassus(J, W, problem.A)  # type: ignore[no-untyped-call]
        for row in range(J.shape[0]):
            total = 0.0
            for k in range(J.shape[1]):
                total += J[row, k] * velocities[i, k]
            problem.q[row] = total
        worst = max(worst, solve_and_split(problem, J, W, solver, c).residual)
    multiply_add(problem.A, c, problem.q, u)  # type: ignore[no-untyped-call]
    return worst


def _impact_times() -> list[Measured]:
    generator = numpy.random.default_rng(5)
    states = generator.uniform([0.0, -2.0, -3.0, -5.0], [1.57, 2.0, -1.0, 5.0], (IMPACTS, 4))
    out, found = numpy.zeros((IMPACTS, 3)), []
    for name, rule in RULE_NAMES.items():
        seconds = median_time(lambda rule=rule: _impacts(states, rule, 0.3, 0.5, out))  # type: ignore[misc]
        note = f"{IMPACTS} different impacts in one call"
        found.append(
            Measured(f"one planar contact, {name}: state to velocity", 1e6 * seconds / IMPACTS, "µs", 0.3, note=note)
        )
    return found


def _solve_time(
    what: str, J: Vector, W: Vector, velocities: Vector, width: int, most: float, rung: int | None
) -> list[Measured]:
    contacts = len(J) // width
    problem = make_problem(contacts, width)
    problem.friction[:] = 0.5
    solver = make_solver(contacts, len(W), width) if rung is None else make_solver(contacts, len(W), width, 0, rung)
    c, u = numpy.zeros(len(J)), numpy.zeros(len(J))
    worst = _solves(problem, J, W, velocities, solver, c, u)
    seconds = median_time(lambda: _solves(problem, J, W, velocities, solver, c, u))
    return [
        Measured(what, 1e6 * seconds / len(velocities), "µs", most, note="assembly and load split included"),
        Measured(f"{what}: worst residual", worst, "", 1e-12),
    ]


def _solve_times() -> list[Measured]:
    generator = numpy.random.default_rng(6)
    face = random_face(2, 2, PLANE)
    falling = generator.uniform(-1.0, 1.0, (SOLVES, 3)) - numpy.array([0.0, 1.0, 0.0])
    found = _solve_time("two planar contacts by Lemke", face.J, face.W, falling, PLANE, 0.6, LEMKE)
    corners = numpy.array([[x, y, -0.05] for x in (-0.1, 0.1) for y in (-0.1, 0.1)])
    W = numpy.diag([1.0, 1.0, 1.0, 240.0, 240.0, 150.0])
    slip = numpy.zeros((SOLVES, 6))
    slip[:, :2], slip[:, 2] = generator.uniform(-0.01, 0.01, (SOLVES, 2)), -9.81e-3
    return [
        *found,
        *_solve_time("box on four contacts in space", contact_rows(corners, SPACE), W, slip, SPACE, 0.3, None),
    ]


def goals() -> list[Measured]:
    """Times against the goals, and errors of motions with a closed form."""
    time, impacts = rigid_motion.bounce_to_rest()
    return [
        *_impact_times(),
        *_solve_times(),
        Measured("16 contacts of rank 3: residual", redundant_residual().value, "", 1e-12),
        Measured(
            "bounces to rest: error of the time",
            abs(time - rigid_motion.BOUNCE_TIME),
            "s",
            1e-12,
            note=f"{impacts} impacts",
        ),
        Measured("slide to a stop: error of the distance", rigid_motion.slide_error(None), "", 1e-9),
        Measured("creep on a slope of 15°", rigid_motion.creep(), "m/s", 1e-15),
        Measured("1000 elastic bounces: energy", rigid_motion.elastic_drift(), "", 1e-12),
    ]
