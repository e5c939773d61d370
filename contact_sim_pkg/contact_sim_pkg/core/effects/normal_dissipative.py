"""Loss in one contact, after Hunt and Crossley: ``F = A x**n (1 + damping x')``, contact lost when F reaches 0.

The factor multiplies the elastic pressure of each cell as well as the elastic force of a point contact, so that the
force stays the integral of the pressure. No force jump at first touch, no tension (end rule ``force``: SEEDS 2.5).
In a free impact at v0, with d = damping v0: ``d (1 + e) = ln[(1 + d)/(1 - d e)]``, whatever A, n and mass.
"""

from __future__ import annotations

from ..jit import kernel
from ..parameters import NormalDissipative


@kernel
def loss_factor(dissipative: NormalDissipative | None, approach_rate: float) -> float:
    """Ratio of the contact force to the elastic force at ``approach_rate`` in [m/s] (closing positive), >= 0.

    1 where the scene calls for no loss; 0 where the bodies part faster than the material recovers.
    """
    if dissipative is None:
        return 1.0
    return max(0.0, 1.0 + dissipative.damping * approach_rate)


@kernel
def tension_margin(dissipative: NormalDissipative | None, approach_rate: float) -> float:
    """The factor before it is limited: its sign change is the event "the material recovers slower than the bodies part"."""
    if dissipative is None:
        return 1.0
    return 1.0 + dissipative.damping * approach_rate
