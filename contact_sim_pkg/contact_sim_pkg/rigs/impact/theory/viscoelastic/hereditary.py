"""Indentation of a viscoelastic half-space under a given force by the hereditary integral (Lee and
Radok; Goloshchapov eqs 108-113).

``x^(3/2) = 3 (1 - nu)/(8 sqrt R) I(t)``, ``I = int_0^t J(t - s) dF(s)``, J the shear creep
compliance. A force F0 at the first time is a step. For exponentials I is a recursion: ``tau y' = F
- y`` for each time constant, solved exactly for a force that is linear between samples, so the cost
scales with the number of samples, not with its square. Right while the contact grows: samples after
its largest depth are flagged. Source: Lee and Radok, J. Appl. Mech. 27 (1960) 438.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigs.impact.theory.checks import check_poisson_ratio, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.viscoelastic.creep import Creep, check

__all__ = ["Indentation", "hereditary_integral", "indentation"]


class Indentation(NamedTuple):
    """Result at each sample."""

    depth: Vector  # x [m], 0 where the integral is not positive
    # Whether the contact has grown up to there: only then the integral holds
    growing: NDArray[numpy.bool_]


def indentation(
    creep: Creep, times: Vector, force: Vector, radius: float, poisson_ratio: float, form: str = "corrected"
) -> Indentation:
    """Depth [times] [m] under ``force`` [times] [N] at rising ``times`` [s], linear between them.

    ``printed``: factor 3/4 of eq 112, twice eq 110 at t = 0. Raises ImpactError for a radius not
    above 0 [m], a Poisson ratio outside -1 < nu <= 1/2, and as `hereditary_integral`; ValueError
    for another form.
    """
    check_positive("radius", radius, "m")
    check_poisson_ratio(poisson_ratio)
    if form not in ("corrected", "printed"):
        raise ValueError(f"form '{form}': corrected or printed is needed")
    factor = (0.375 if form == "corrected" else 0.75) * (1.0 - poisson_ratio) / math.sqrt(radius)
    cube = factor * hereditary_integral(creep, times, force)
    depth = numpy.maximum(cube, 0.0) ** (2.0 / 3.0)
    return Indentation(depth, depth >= numpy.maximum.accumulate(depth))


def hereditary_integral(creep: Creep, times: Vector, force: Vector) -> Vector:
    """``I(t) = int J(t - s) dF(s)`` in [m^2] at each of ``times``; exact for a force that is linear
    between samples.

    times [samples] [s], rising; force [samples] [N]. Raises ImpactError for other arrays and for a
    creep of no material.
    """
    check(creep)
    t, f = numpy.ascontiguousarray(times, dtype=numpy.float64), numpy.ascontiguousarray(force, dtype=numpy.float64)
    if t.shape != f.shape or t.ndim != 1 or t.size == 0:
        raise ImpactError(f"{t.size} times and {f.size} forces: as many of each, at least one, are needed")
    if not (numpy.isfinite(t).all() and numpy.isfinite(f).all() and (numpy.diff(t) > 0.0).all()):
        raise ImpactError("the times must rise, and times and forces be finite")
    out = numpy.empty_like(f)
    _recursion(creep.glassy, creep.fluidity, numpy.array(creep.compliances), numpy.array(creep.times), t, f, out)
    return out


@entry
def _recursion(
    glassy: float, fluidity: float, compliances: Vector, retardation: Vector, times: Vector, force: Vector, out: Vector
) -> None:
    """Loop over the samples: one internal variable a time constant, one for the fluid."""
    delayed = numpy.zeros(compliances.shape[0])
    impulse = 0.0
    out[0] = glassy * force[0]
    for n in range(1, times.shape[0]):
        step = times[n] - times[n - 1]
        before, change = force[n - 1], force[n] - force[n - 1]
        impulse += step * (before + 0.5 * change)
        total = glassy * force[n] + fluidity * impulse
        for i in range(compliances.shape[0]):
            ratio = step / retardation[i]
            moved = -math.expm1(-ratio)  # 1 - e^(-a)
            late = 1.0 - moved / ratio  # part of the change that has come through
            if ratio < 1.0e-3:
                late = ratio * (0.5 - ratio * (1.0 / 6.0 - ratio * (1.0 / 24.0 - ratio / 120.0)))
            delayed[i] += (before - delayed[i]) * moved + change * late
            total += compliances[i] * delayed[i]
        out[n] = total
