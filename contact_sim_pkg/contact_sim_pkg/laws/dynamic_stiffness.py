"""Dynamic stiffness of a contact: the first harmonic of its force over a harmonic motion.

``delta = delta_0 + a sin(2 pi f t)``, ``F = F_el(delta) max(0, 1 + s z + lambda delta')``. The
hysteresis variable follows the stored energy u alone and is known in closed form: over a part of
the motion in which u rises by w, ``1 - z`` falls by ``exp(-w/u_0)``, where it falls by w, ``1 + z``
does. Small amplitudes: ``K = F_el' + s F_el^2/u_0``, damping ``lambda F_el``.

Source: Nayfeh and Mook, Nonlinear Oscillations, 2.3.4 (harmonic balance).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_not_negative, require_positive
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force
from contact_sim_pkg.laws.parameters import ElasticLaw

__all__ = ["DynamicStiffness", "dynamic_stiffness"]

SAMPLES = 512  # a cycle


class DynamicStiffness(NamedTuple):
    """First harmonic of a force."""

    stiffness: float  # [N/m] in phase with the displacement
    damping: float  # [N s/m] in phase with the velocity


def dynamic_stiffness(
    elastic: ElasticLaw,
    load: float,
    amplitude: float,
    frequency: float,
    *,
    damping: float = 0.0,
    share: float = 0.0,
    energy: float = 1.0,
) -> DynamicStiffness:
    """Dynamic stiffness about the approach at which ``elastic`` carries ``load`` [N].

    amplitude: a [m]; frequency: f [Hz]; damping: lambda [s/m] of ``NormalDissipative``; share: s
    [1], energy: u_0 [J] of ``FoamHysteresis``. Once the hysteresis repeats itself.
    """
    for name, value, unit in (("load", load, "N"), ("amplitude", amplitude, "m"), ("frequency", frequency, "Hz")):
        require_positive(name, value, unit)
    require_not_negative("damping", damping, "s/m")
    require_not_negative("share", share)
    require_positive("energy", energy, "J")
    phase = 2.0 * math.pi * (numpy.arange(SAMPLES) + 0.5) / SAMPLES
    approach = float(approach_of_force(elastic, load)) + amplitude * numpy.sin(phase)
    rate = 2.0 * math.pi * frequency * amplitude * numpy.cos(phase)
    stored = numpy.array([elastic_energy(elastic, float(x)) for x in approach])
    force = numpy.array([elastic_force(elastic, float(x)) for x in approach])
    force = force * numpy.maximum(0.0, 1.0 + share * _hysteresis(stored, energy) + damping * rate)
    in_phase = 2.0 * float((force * numpy.sin(phase)).mean()) / amplitude
    ahead = 2.0 * float((force * numpy.cos(phase)).mean()) / amplitude
    return DynamicStiffness(in_phase, ahead / (2.0 * math.pi * frequency))


def _hysteresis(stored: NDArray[numpy.float64], energy: float) -> NDArray[numpy.float64]:
    """The hysteresis variable [samples] over a cycle of ``stored`` [J] that repeats itself."""
    change = numpy.diff(stored, prepend=stored[-1])
    decay, target = numpy.exp(-numpy.abs(change) / energy), numpy.sign(change)
    # z after a cycle is linear in z before it: its fixed point needs one cycle from 0.
    z, kept = 0.0, 1.0
    for d, t in zip(decay, target, strict=True):
        z, kept = t + (z - t) * d, kept * d
    z = z / (1.0 - kept) if kept < 1.0 else 0.0
    found = numpy.empty_like(stored)
    for i, (d, t) in enumerate(zip(decay, target, strict=True)):
        z = found[i] = t + (z - t) * d
    return found
