"""Sizes of the motion of masses, to which the integrator's tolerance is relative."""

from __future__ import annotations

import math

from contact_sim_pkg.laws.elastic_law import approach_of_force
from contact_sim_pkg.laws.parameters import Contact

__all__ = ["POSITION_SCALE", "VELOCITY_SCALE", "contact_scale"]

POSITION_SCALE = 0.01  # [m], size of the approaches, at most; the integrator's tolerance is relative to it
VELOCITY_SCALE = 0.5  # [m/s], size of the velocities on a rough road, at most
STIFF = 0.1  # of a contact less deep than that: its swings are many and hardly damped, and their errors add up


def contact_scale(contact: Contact | None, load: float, mass: float) -> tuple[float, float]:
    """Sizes in [m] and [m/s] of a body's motion on a contact: of its depth under the ``load`` [N]
    at rest, and of its swing.

    ``mass`` [kg] is that of the body which touches. A stiff contact turns a small error of place
    into a large one of force.
    """
    size = POSITION_SCALE if contact is None else 2.0 * float(approach_of_force(contact.elastic, load))
    if size >= POSITION_SCALE:
        return POSITION_SCALE, VELOCITY_SCALE
    return STIFF * size, min(VELOCITY_SCALE, STIFF * math.sqrt(load * size / mass))
