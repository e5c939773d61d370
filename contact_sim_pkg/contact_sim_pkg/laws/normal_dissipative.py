"""Dissipation in one contact, after Hunt and Crossley: ``F = A x**n (1 + damping x')``, contact
lost when F reaches 0.

The factor multiplies the elastic pressure of each cell as well as the elastic force of a point
contact, so that the force stays the integral of the pressure. No force jump at first contact, no
tension (end rule ``force``). In a free impact at v0, with d = damping v0: ``d (1 + e) = ln[(1 +
d)/(1 - d e)]``, whatever A, n and mass.

Source: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; Driver and Seat eq 8.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.elastic_law import elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import NormalDissipative


@kernel
def dissipation_factor(
    dissipative: NormalDissipative | None, approach_rate: float, hysteresis_factor: float = 1.0
) -> float:
    """Ratio of the contact force to the elastic force at ``approach_rate`` in [m/s] (closing
    positive), >= 0.

    1 where the scene calls for no dissipation; 0 where the bodies part faster than the material
    recovers. ``hysteresis_factor``: the ratio that a dissipation without rate, as foam has, gives
    alone (``laws/foam_hysteresis.py``); 1 without it.
    """
    if dissipative is None:
        return hysteresis_factor
    return max(0.0, hysteresis_factor + dissipative.damping * approach_rate)


@kernel
def hunt_crossley_force(elastic, dissipative, approach, approach_rate, hysteresis_factor):
    """Contact force in [N]; ``dissipative`` may be ``None``."""
    return elastic_force(elastic, approach) * dissipation_factor(dissipative, approach_rate, hysteresis_factor)


@kernel
def hunt_crossley_tension_event(dissipative, approach_rate, hysteresis_factor):
    """The factor before it is limited: its sign change is the event "the material recovers slower
    than the bodies part".
    """
    if dissipative is None:
        return hysteresis_factor
    return hysteresis_factor + dissipative.damping * approach_rate


@kernel
def _damping_of(dissipative):
    if dissipative is None:
        return 0.0
    return dissipative.damping


@kernel
def hunt_crossley_force_rate(elastic, dissipative, approach, approach_rate, approach_acceleration, hysteresis_factor):
    """dF/dt in [N/s], ``hysteresis_factor`` held; 0 where the bodies part faster than the material
    recovers.
    """
    if hunt_crossley_tension_event(dissipative, approach_rate, hysteresis_factor) <= 0.0:
        return 0.0
    slope = elastic_stiffness(elastic, approach) * dissipation_factor(dissipative, approach_rate, hysteresis_factor)
    dissipation = _damping_of(dissipative) * elastic_force(elastic, approach)
    return slope * approach_rate + dissipation * approach_acceleration
