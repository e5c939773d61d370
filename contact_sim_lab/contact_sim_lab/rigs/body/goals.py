"""Goals of rigid contact: time of impacts and of solves inside compiled loops, and errors of
motions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy

from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_lab.rigs.body import hard_cases_contact as hard_cases_rigid
from contact_sim_lab.rigs.body import rigid_motion
from contact_sim_lab.rigs.body.hard_cases_contact import redundant_residual
from contact_sim_lab.rigs.body.rigid_problem import SIDE, contact_rows, random_face
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigid.bodies.motion import apply_impulse, contact_velocities
from contact_sim_pkg.rigid.contact.planar_impact import impact_impulse
from contact_sim_pkg.rigid.geometry.face import face_impulses, make_face_workspace
from contact_sim_pkg.rigid.impact.planar_pair import PairWorkspace, make_pair_workspace, pair_impulses
from contact_sim_pkg.rigid.parameters import RULE_NAMES, PlanarContact
from contact_sim_pkg.rigid.problem import PLANE, SPACE

__all__ = ["GOALS", "goals"]

IMPACTS, SOLVES = 100_000, 100_000


@entry
def _impacts(states: Vector, rule: int, friction: float, restitution: float, out: Vector) -> None:
    """From angle and velocity [n, 4] of the 1 kg block to its velocity after the impact of its
    lowest corner [n, 3].
    """
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
def _pairs(J: Vector, W: Vector, velocities: Vector, friction: Vector, work: PairWorkspace, out: Vector) -> float:
    """Two contacts of one body in the plane, from velocity before [n, 3] to velocity after; the
    worst residual.
    """
    worst = 0.0
    q, c = numpy.zeros(4), numpy.zeros(4)
    for i in range(velocities.shape[0]):
        contact_velocities(J, velocities[i], q)  # type: ignore[no-untyped-call]
        worst = max(worst, pair_impulses(J, W, q, friction, first=0, second=1, work=work, c=c))  # type: ignore[no-untyped-call]
        for k in range(3):
            out[i, k] = velocities[i, k]
        apply_impulse(J, W, c, out[i])  # type: ignore[no-untyped-call]
    return worst


@entry
def _faces(J: Vector, W: Vector, velocities: Vector, friction: Vector, work: Vector, out: Vector) -> float:
    """A box on four contacts, from velocity before [n, 6] to velocity after; the worst residual."""
    worst, c = 0.0, numpy.zeros(12)
    for i in range(velocities.shape[0]):
        worst = max(worst, face_impulses(J, W, velocities[i], friction, work, c))  # type: ignore[no-untyped-call]
        for k in range(6):
            out[i, k] = velocities[i, k]
        apply_impulse(J, W, c, out[i])  # type: ignore[no-untyped-call]
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


def _rows(what: str, call: Callable[[], float], solves: int, most: float) -> list[Measured]:
    worst, seconds = call(), median_time(call)
    note = f"{solves} different velocities in one call, assembly and least-norm split included"
    return [
        Measured(what, 1e6 * seconds / solves, "µs", most, note=note),
        Measured(f"{what}: worst residual", worst, "", 1e-12),
    ]


def _solve_times() -> list[Measured]:
    generator = numpy.random.default_rng(6)
    face, work = random_face(2, 2, PLANE), make_pair_workspace()
    falling = generator.uniform(-1.0, 1.0, (SOLVES, 3)) - numpy.array([0.0, 1.0, 0.0])
    planar = numpy.zeros((SOLVES, 3))
    found = _rows(
        "two planar contacts by Lemke, order 8",
        lambda: _pairs(face.J, face.W, falling, numpy.full(2, 0.5), work, planar), SOLVES, 0.6,
    )  # fmt: skip
    J = contact_rows(numpy.array([[x, y, -0.05] for x in (-0.1, 0.1) for y in (-0.1, 0.1)]), SPACE)
    W, room, after = numpy.diag([1.0, 1.0, 1.0, 240.0, 240.0, 150.0]), make_face_workspace(4), numpy.zeros((SOLVES, 6))
    for name, least, most in (("resting", 0.0, 0.002), ("sliding", 0.01, 0.02)):
        before = numpy.zeros((SOLVES, 6))
        angle, slip = generator.uniform(0.0, 2.0 * numpy.pi, SOLVES), generator.uniform(least, most, SOLVES)
        before[:, 0], before[:, 1], before[:, 2] = slip * numpy.cos(angle), slip * numpy.sin(angle), -9.81e-3
        found += _rows(
            f"box {name} on four contacts in space, a step of 1 ms",
            lambda before=before: _faces(J, W, before, numpy.full(4, 0.5), room, after), SOLVES, 0.3,  # type: ignore[misc]
        )  # fmt: skip
    return found


REFERENCES = {
    "300 impacts, newton, against enumeration": 1e-10, "300 impacts, energetic, against its path": 1e-10,
    "10 000 impacts, energetic: energy gained, of it": 1e-12, "16 contacts in another order: velocity [m/s]": 1e-12,
    "1 kg under 1e6 kg: residual": 1e-12,
}  # fmt: skip


def _against_references() -> list[Measured]:
    """Random impacts of the block against other methods, their energy, redundant contacts and a
    great mass ratio.
    """
    cases = {case.case: case for case in hard_cases_rigid.CASES}
    return [Measured(what, cases[what].find().value, "", most) for what, most in REFERENCES.items()]


def _time_loops() -> list[Measured]:
    """A second of a cube with states at every millisecond."""
    found = []
    for what, speed in (("rests", 0.0), ("slides to a stop", rigid_motion.SPEED)):
        seconds = median_time(lambda speed=speed: rigid_motion.cube_for_a_second(speed), 3)  # type: ignore[misc]
        found.append(Measured(f"cube that {what}, located, states every 1 ms", 1e3 * seconds, "ms for 1 s"))
    return found


def goals() -> list[Measured]:
    """Times against the goals, and errors of motions with a closed form."""
    time, impacts = rigid_motion.bounce_to_rest()
    return [
        *_impact_times(),
        *_solve_times(),
        *_time_loops(),
        *_against_references(),
        Measured("16 contacts of rank 3: residual", redundant_residual().value, "", 1e-12),
        Measured(
            "bounces to rest: error of the time",
            abs(time - rigid_motion.BOUNCE_TIME),
            "s",
            1e-12,
            note=f"{impacts} impacts",
        ),
        Measured("slide to a stop: error of the distance", rigid_motion.slide_error(), "", 1e-9),
        Measured("creep on a slope of 15°", rigid_motion.creep(), "m/s", 1e-15),
        Measured("1000 elastic bounces: energy", rigid_motion.elastic_drift()[0], "", 1e-12),
    ]


GOALS = (GoalPart("rigid contact", goals),)
