"""Moments on a tilted and yawed roller: of the contact's pressure, of the rolling friction, of the bent shaft's friction.

With the load F, tilt psi, and the ellipse (a nearer to x, b, turned by phi) of the yaw theta:

    pressure   M_psi = F R sin psi                                               eqs 11-16
    rolling    M_theta = f_r F R sin psi                                         eq 17c, f_r signed
    bending    M_psi = -T R cos psi (A - l + R sin psi)                          eq 17a, T = f0 Q pi a b h / J_y, h = r - approach
               M_theta = T (a^2 - b^2) sin(2 phi) / 8                            eq 17b

17a is printed with `A - 1 + R cos psi` and a factor 1/2, 17b with 1/4 and phi = theta: no traction gives both factors. Source:
the paper on rolling vibro-impact; the corrected factors are integrals over the ellipse.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.core.jit import entry
from contact_sim_pkg.core.roller.ellipse import EXACT, rolling_contact
from contact_sim_pkg.core.roller.parameters import Bending, Curvatures, Roller

__all__ = ["Moments", "moments"]


class Moments(NamedTuple):
    """[N m]."""

    tilt: float
    yaw: float


@entry
def moments(
    roller: Roller,
    curvatures: Curvatures,
    bending: Bending | None,
    modulus: float,
    load: float,
    tilt: float,
    yaw: float,
) -> Moments:
    """Moments of a contact under `load` [N] at angles [rad]; modulus: E* [Pa]. All are 0 without load."""
    if not load > 0.0:
        return Moments(0.0, 0.0)
    arm = roller.radius * math.sin(tilt)
    about_y, about_z = load * arm, roller.rolling_friction * load * arm
    if bending is not None:
        contact = rolling_contact(curvatures, yaw, modulus, load, EXACT)
        a, b = contact.along_x, contact.along_y
        pull = bending.friction * bending.load * math.pi * a * b * (bending.radius - contact.approach)
        pull /= bending.second_moment
        distance = bending.contact_distance - bending.load_distance + arm
        about_y -= pull * roller.radius * math.cos(tilt) * distance
        about_z += 0.125 * pull * (a * a - b * b) * math.sin(2.0 * contact.angle)
    return Moments(about_y, about_z)
