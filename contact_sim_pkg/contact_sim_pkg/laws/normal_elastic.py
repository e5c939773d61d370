"""Elastic normal law of one contact.

``F = A x**n`` for an approach x > 0, else 0; stored energy ``A x**(n+1)/(n+1)``. n = 3/2 is Hertz
(Johnson, Contact Mechanics, 4.3; Driver and Seat, eq 7), n = 1 a linear spring. Exact in its class;
no adhesion.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.parameters import NormalElastic


@kernel
def elastic_force(elastic: NormalElastic, approach: float) -> float:
    """Force that pushes the bodies apart in [N] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    if elastic.exponent == 1.5:  # Hertz: the same to the last digit or two, and three times as fast
        return elastic.coefficient * approach * math.sqrt(approach)
    return elastic.coefficient * approach**elastic.exponent


@kernel
def elastic_order(elastic: NormalElastic) -> float:
    """Power [1] of the approach with which the force begins at first contact."""
    return elastic.exponent


@kernel
def elastic_stiffness(elastic: NormalElastic, approach: float) -> float:
    """Slope dF/dx in [N/m] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    return elastic.exponent * elastic.coefficient * approach ** (elastic.exponent - 1.0)


@kernel
def elastic_energy(elastic: NormalElastic, approach: float) -> float:
    """Energy stored at ``approach`` in [J]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    return elastic.coefficient * approach ** (elastic.exponent + 1.0) / (elastic.exponent + 1.0)


@kernel
def approach_of_force(elastic: NormalElastic, force: float) -> float:
    """Approach in [m] at which the law gives ``force`` in [N]; 0 for ``force <= 0``."""
    if force <= 0.0:
        return 0.0
    return (force / elastic.coefficient) ** (1.0 / elastic.exponent)
