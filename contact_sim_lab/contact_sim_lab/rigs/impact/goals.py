"""Goals of the sphere's impact: steel to 1e-8 within 100 steps, rubber that follows the tolerance,
a material from 100 impacts.
"""

from __future__ import annotations

import statistics

import numpy

from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_lab.rigs.impact import hard_cases_sphere as cases
from contact_sim_pkg.rigs.impact.material.estimate import MaterialEstimate, repeated_impacts
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.theory.bodies import Material
from contact_sim_pkg.rigs.impact.theory.inverse import material_of_impact
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact
from contact_sim_pkg.rigs.impact.theory.table import look_up

__all__ = ["GOALS", "goals"]

RUNS, REPEATS, NOISE = 40, 100, 0.01
TANGENT = 0.2
CALLS = 200


def goals() -> list[Measured]:
    """Errors, steps and times."""
    return [*_steel(), *_rubber(), *_material(), *_times()]


def _steel() -> list[Measured]:
    """Each approach phase of the ball in the rig's integrator, with an outer tick of 1 ms; and the
    series of the impact rig.
    """
    gaps = [1e-3 * (0.01 + phase / 25.0) for phase in range(20)]
    found = [cases.rig_with_a_tick(5e-9, gap) for gap in gaps]
    worst, steps = max(error for error, _steps in found), max(count for _error, count in found)
    note = "tolerance 5e-9, tick 1 ms, worst of 20 approach phases"
    return [
        Measured("steel sphere, 1 m/s: error of T, depth, force", worst, "", most=1e-8, note=note),
        Measured("steel sphere, 1 m/s: steps for it", float(steps), "steps", most=100.0, note="rejected ones included"),
        Measured("steel sphere, series of the impact rig: error", cases.steel().value, "", most=1e-8),
        Measured("steel sphere, series of the impact rig: steps", cases.steel_steps().value, "steps", most=100.0),
    ]


def _rubber() -> list[Measured]:
    ratio, slope = cases.rubber_in_the_rig().value, cases.rubber_slope().value
    note = "1e-3 to 1e-11, tan beta 0 to 1, worst of 20 approach phases"
    return [
        Measured("rubber, error of k and T over requested tolerance", ratio, "times", most=10.0, note=note),
        Measured("rubber, slope of log error over log tolerance", slope, "", least=0.8, note=note),
    ]


def _material() -> list[Measured]:
    """The worst of 40 sets, and the part of the 95 % intervals that hold the truth: 80 of them, so
    0.88 to 1 is their noise.
    """
    errors, covered = numpy.zeros((RUNS, 2)), 0
    for seed in range(RUNS):
        found = _reading(seed)
        pairs = ((found.storage_modulus, cases.RUBBER.storage_modulus), (found.loss_tangent, TANGENT))
        # Point errors against the truth, and whether the intervals hold it.
        errors[seed] = [abs(value.value / true - 1.0) for value, true in pairs]
        covered += sum(
            value.low is not None and value.high is not None and value.low <= true <= value.high
            for value, true in pairs
        )
    note = f"worst of {RUNS} sets of {REPEATS} impacts, 1 % noise, tan beta {TANGENT}"
    return [
        Measured("material: error of E'", 100.0 * float(errors[:, 0].max()), "%", most=1.0, note=note),
        Measured("material: error of tan beta", 100.0 * float(errors[:, 1].max()), "%", most=2.0, note=note),
        Measured(
            "material: 95 % intervals that hold the truth",
            covered / (2.0 * RUNS),
            "",
            least=0.88,
            note=f"{2 * RUNS} of them",
        ),
    ]


def _reading(seed: int) -> MaterialEstimate:
    impact = solve_impact(cases.SPHERE, Material(cases.RUBBER.storage_modulus, TANGENT), 2.0)
    random, ones = numpy.random.default_rng(seed), numpy.ones(REPEATS)
    speed, duration, restitution = (
        value * (1.0 + NOISE * random.standard_normal(REPEATS)) for value in (2.0, impact.duration, impact.restitution)
    )
    mass, radius = cases.SPHERE.mass * ones, cases.SPHERE.radius * ones
    impacts = Impacts("simulated", numpy.arange(REPEATS), mass, radius, speed, duration, restitution, None, ())
    return repeated_impacts(impacts, numpy.arange(REPEATS), Options())


def _times() -> list[Measured]:
    """Median time of a call from Python."""
    material = Material(cases.RUBBER.storage_modulus, TANGENT)
    impact = solve_impact(cases.SPHERE, material, 2.0)
    ways = {
        "an impact from its loss tangent": lambda: solve_impact(cases.SPHERE, material, 2.0),
        "the same by the table": lambda: look_up(TANGENT, "force"),
        "a material from its impact": lambda: material_of_impact(
            cases.SPHERE, 2.0, impact.duration, impact.restitution
        ),
    }
    return [
        Measured(f"sphere impact, {name}", 1e6 * statistics.median(median_time(way, CALLS) for _ in range(3)), "µs")
        for name, way in ways.items()
    ]


GOALS = (GoalPart("sphere impact", goals),)
