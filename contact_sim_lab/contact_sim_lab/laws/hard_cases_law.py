"""Hard cases of the normal law and of the restitution that is requested."""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import impact
from contact_sim_pkg.laws.normal_dissipative import dissipation_factor
from contact_sim_pkg.laws.normal_elastic import elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import NormalDissipative, NormalElastic
from contact_sim_pkg.laws.restitution import damping_of_restitution

NOT_TOUCHING = (0.0, -0.0, -1e-320, -1e-12, -1.0, -1e9, -math.inf)
EXPONENTS = (1.0, 1.5, 2.7, 3.0)


def without_indentation() -> Finding:
    """Largest force, slope and energy for x <= 0: none, and never NaN."""
    laws = [NormalElastic(1e5, n) for n in EXPONENTS]
    values = [
        f(law, x) for law in laws for x in NOT_TOUCHING for f in (elastic_force, elastic_stiffness, elastic_energy)
    ]
    return exactly(float(numpy.max(numpy.abs(values))), 0.0, hard=max(NOT_TOUCHING))


def smallest_indentation() -> Finding:
    """Force at the smallest positive numbers: finite and not negative."""
    places = (5e-324, 1e-300, 1e-150)
    values = [elastic_force(NormalElastic(1e5, n), x) for n in EXPONENTS for x in places]
    return exactly(float(sum(not (math.isfinite(v) and v >= 0.0) for v in values)), 0.0, hard=min(places))


def never_pulls() -> Finding:
    """Smallest dissipation factor while the bodies part faster than the material recovers."""
    dissipative = NormalDissipative(1.0)
    speeds = (1.0, 1.0 + 1e-12, 2.0, 1e3, 1e300)
    return exactly(
        min(dissipation_factor(dissipative, -speed) for speed in speeds), 0.0, hard=min(speeds) * dissipative.damping
    )


def low_restitution() -> Finding:
    """Largest relative error of the damping for e below 1/3, where the usual start lies beyond the
    pole.
    """
    ratios = (0.333, 0.3, 0.2, 0.1, 0.05, 0.02)
    return at_most(max(_damping_error(e, 0.7) for e in ratios), 1e-12, hard=max(ratios))


def high_restitution() -> Finding:
    """Largest relative error of the damping for e up to 1 - 1e-6, where the relation has a double
    root.
    """
    ratios = (0.4, 0.7, 0.9, 0.99, 0.999, 0.9999, 0.999999)
    return at_most(max(_damping_error(e, 0.7) for e in ratios), 1e-8, hard=1.0 - max(ratios))


def _damping_error(ratio: float, speed: float) -> float:
    exact = impact.damping_of_restitution(ratio, speed)
    return abs(damping_of_restitution(ratio, speed) - exact) / exact


def lowest_restitution() -> Finding:
    """d at e = 0.01: finite, just below its pole 1/e = 100."""
    found = damping_of_restitution(0.01, 1.0)
    return close_to(found, impact.damping_of_restitution(0.01, 1.0), 1e-12, hard=found * 0.01)


def plastic_is_refused() -> Finding:
    """How many of the restitutions outside 0.01 to 1 are refused by a typed error."""
    refused, ratios = 0, (0.0, 0.0099, 1.0000001, -0.5, math.nan)
    for ratio in ratios:
        try:
            damping_of_restitution(ratio, 1.0)
        except ValueError:
            refused += 1
    return exactly(refused, 5, hard=sum(0.01 <= ratio <= 1.0 for ratio in ratios))


def grazing() -> Finding:
    """Damping for an impact at 1e-9 m/s: that of the floor of 1 mm/s."""
    speed, floor = 1e-9, 1e-3
    expected = impact.damping_of_restitution(0.5, floor)
    return close_to(damping_of_restitution(0.5, speed), expected, 1e-12 * expected, hard=speed / floor)


CASES = (
    HardCase("any law", "x ≤ 0 gives no force, no slope, no energy", without_indentation,
        guard.at_most("largest indentation [m]", 0.0)),
    HardCase("any law", "smallest positive x: answers that are not finite or negative", smallest_indentation,
        guard.at_most("smallest indentation [m]", 1e-300)),
    HardCase("Hunt-Crossley", "fast pull-out: smallest dissipation factor", never_pulls,
        guard.at_least("parting speed times damping, least", 1.0)),
    HardCase("Hunt-Crossley", "e < 1/3: error of the damping", low_restitution,
        guard.below("largest restitution", 1.0 / 3.0)),
    HardCase("Hunt-Crossley", "e up to 1 - 1e-6: error of the damping", high_restitution,
        guard.at_most("loss of the largest restitution", 1.1e-6)),
    HardCase("Hunt-Crossley", "e = 0.01, at the pole", lowest_restitution,
        guard.at_least("damping over its pole", 0.99)),
    HardCase("Hunt-Crossley", "e outside 0.01 to 1 is refused", plastic_is_refused,
        guard.zero("restitutions within 0.01 to 1")),
    HardCase("Hunt-Crossley", "grazing, v0 → 0: damping from the floor of 1 mm/s", grazing,
        guard.at_most("impact speed over the floor", 1e-6)),
)  # fmt: skip
