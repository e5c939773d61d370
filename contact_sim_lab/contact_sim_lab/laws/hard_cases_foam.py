"""Hard cases of foam: no indentation, tiny and crushing loads, and the energy that it
dissipates.
"""

from __future__ import annotations

import itertools
import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.foam_hysteresis import hysteresis_energy, hysteresis_factor, hysteresis_rate
from contact_sim_pkg.laws.parameters import FoamElastic, FoamHysteresis

MODEL = "foam"
FOAM = FoamElastic(0.12, 0.08, 4.0e4, 3.0e3, 150.0, 3.0)
MEMORY = FoamHysteresis(0, 0.3, 0.5)


def without_indentation() -> Finding:
    """Largest force, slope and energy for x <= 0."""
    places = (0.0, -0.0, -5e-324, -1.0, -math.inf)
    values = [f(FOAM, x) for x in places for f in (elastic_force, elastic_stiffness, elastic_energy)]
    return exactly(float(numpy.max(numpy.abs(values))), 0.0, hard=max(places))


def first_touch() -> Finding:
    """Force and energy at 1e-15 m against the linear start, which differ by less than 1e-12:
    largest relative error.
    """
    start = FOAM.area / FOAM.thickness * (FOAM.modulus + FOAM.densification * FOAM.densification_exponent)
    x = 1e-15
    errors = (elastic_force(FOAM, x) / (start * x) - 1.0, elastic_energy(FOAM, x) / (0.5 * start * x * x) - 1.0)
    return at_most(max(abs(error) for error in errors), 1e-12, hard=x / FOAM.thickness)


def crushed() -> Finding:
    """Answers that are not finite, or do not rise, up to ten times the thickness."""
    depths = (0.9, 0.99, 0.998, 0.9989, 0.9991, 1.0, 1.5, 10.0)
    forces = [elastic_force(FOAM, x * FOAM.thickness) for x in depths]
    wrong = sum(not math.isfinite(force) for force in forces)
    return exactly(wrong + sum(later <= earlier for earlier, later in itertools.pairwise(forces)), 0, hard=max(depths))


def inverse() -> Finding:
    """Largest relative error of the force at the approach of a force, 1e-12 to 1e12 N."""
    loads = [10.0**power for power in range(-12, 13)]
    return at_most(
        max(abs(elastic_force(FOAM, approach_of_force(FOAM, load)) / load - 1.0) for load in loads),
        1e-11,
        hard=max(loads) / min(loads),
    )


def dissipation_is_never_negative() -> Finding:
    """Least rate of dissipation over the loading's power, over z and both directions: (F - F_el) x'
    less the rate of what is stored.
    """
    least, fullest = math.inf, 0.0
    for z in numpy.linspace(-1.0, 1.0, 41):
        for power in (-3.0, 3.0):
            fullest = max(fullest, abs(float(z)))
            state, out = numpy.array([z]), numpy.zeros(1)
            hysteresis_rate(MEMORY, power, state, out)
            stored = MEMORY.share * MEMORY.energy * z * out[0]
            least = min(least, ((hysteresis_factor(MEMORY, state) - 1.0) * power - stored) / abs(power))
    return Finding(least, "≥ 0 to rounding", 1.0 if least >= -1e-15 else -math.inf, fullest)


def stays_within_one() -> Finding:
    """z over 60 energies of loading and of unloading, and what it stores over 1/2 s u_0: largest
    beyond 1.
    """
    z, step = numpy.array([0.0]), 0.01
    out = numpy.zeros(1)
    beyond = 0.0
    for power in (1.0, -1.0):
        for _ in range(3000):
            hysteresis_rate(MEMORY, power, z, out)
            z[0] += step * out[0]
            beyond = max(
                beyond, abs(z[0]) - 1.0, hysteresis_energy(MEMORY, z) / (0.5 * MEMORY.share * MEMORY.energy) - 1.0
            )
    return at_most(max(0.0, beyond), 1e-12, hard=3000 * step / MEMORY.energy)


CASES = (
    HardCase(MODEL, "x ≤ 0: largest force, slope, energy", without_indentation,
        guard.at_most("largest indentation [m]", 0.0)),
    HardCase(MODEL, "first contact, 1e-15 m: against the linear start", first_touch,
        guard.at_most("indentation over thickness", 1e-12)),
    HardCase(MODEL, "crushed to ten thicknesses: answers without sense", crushed,
        guard.at_least("largest indentation over thickness", 10.0)),
    HardCase(MODEL, "approach of 1e-12 to 1e12 N: largest error", inverse, guard.scales("loads", 1e24)),
    HardCase(MODEL, "dissipation without rate is never negative: least share", dissipation_is_never_negative,
        guard.at_least("memory at the end of its range", 1.0)),
    HardCase(MODEL, "memory stays within ±1: largest beyond", stays_within_one,
        guard.at_least("energies of the memory that pass, each way", 60.0)),
)  # fmt: skip
