"""Simulated measurements: impacts of a known material by the slow reference, with noise."""

from __future__ import annotations

import functools
import math

import numpy

from contact_sim_lab.rigs.impact.twins import goloshchapov
from contact_sim_pkg.rigs.impact.material.reading import Impacts

MASS, RADIUS = 0.02, 0.01


@functools.cache
def exact_impact(modulus: float, loss_tangent: float, speed: float, end: str = "force") -> tuple[float, float]:
    """Contact time [s] and restitution from the reference's integration in time."""
    scaled = goloshchapov.impact(goloshchapov.severity(loss_tangent, end), end)
    coefficient = 4.0 / 3.0 * math.sqrt(2.0) * modulus * math.sqrt(RADIUS)
    length = (MASS * speed**2 / coefficient) ** 0.4
    return scaled.duration * length / speed, scaled.restitution


def noisy(values: numpy.ndarray, noise: float, random: numpy.random.Generator) -> numpy.ndarray:
    return values * (1.0 + noise * random.standard_normal(len(values)))


def repeats(
    duration: float, restitution: float, speed: float, count: int, noise: float, seed: int, temperature: float = 293.0
) -> Impacts:
    """Repeats of one impact, with noise on speed, contact time and restitution."""
    random = numpy.random.default_rng(seed)
    ones = numpy.ones(count)
    return Impacts(
        "simulated", numpy.arange(2, count + 2), MASS * ones, RADIUS * ones, noisy(speed * ones, noise, random),
        noisy(duration * ones, noise, random), noisy(restitution * ones, noise, random), temperature * ones, (),
    )  # fmt: skip


def text(impacts: Impacts) -> str:
    """The file of these impacts."""
    lines = ["# simulated", "m [g],R [mm],V0,tau [ms],k,T [C]"]
    for i in range(len(impacts.mass)):
        temperature = impacts.temperature[i] - 273.15
        lines.append(
            f"{impacts.mass[i] * 1e3!r},{impacts.radius[i] * 1e3!r},{impacts.speed[i]!r},{impacts.duration[i] * 1e3!r},"
            f"{impacts.restitution[i]!r},{temperature!r}".replace("np.float64(", "").replace(")", "")
        )
    return "\n".join(lines) + "\n"
