"""Moments on a tilted and yawed roller: of the contact's pressure, of the rolling friction, of the
bent shaft's friction.

With the load F, tilt psi, and the ellipse (a nearer to x, b, turned by phi) of the yaw theta:

    pressure   M_psi = F R sin psi                                               eqs 11-16
    rolling    M_theta = f_r F R sin psi                                         eq 17c, f_r signed
    bending    M_psi = -T R cos psi (A - l + R sin psi)                          eq 17a, T = f0 Q pi
    a b h / J_y, h = r - approach
               M_theta = T (a^2 - b^2) sin(2 phi) / 8                            eq 17b

17a is printed with `A - 1 + R cos psi` and a factor 1/2, 17b with 1/4 and phi = theta: no traction
gives both factors. Source: Rolling Contact; the corrected factors are integrals over the ellipse.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller
from contact_sim_pkg.rigs.roller.theory.yaw_ellipse import YawEllipse, exact_ellipse

__all__ = ["Moments", "moments", "moments_of_bent", "moments_of_straight"]


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
    """Moments of a contact under `load` [N] at angles [rad]; modulus: E* [Pa]. All are 0 without
    load. Not checked.
    """
    if bending is None or not load > 0.0:
        return moments_of_straight(roller, load, tilt)
    return moments_of_bent(roller, bending, load, tilt, exact_ellipse(curvatures, modulus, yaw))


@kernel
def moments_of_straight(roller: Roller, load: float, tilt: float) -> Moments:
    """Of pressure and rolling alone. Not checked.

    load: [N]; tilt: [rad]; the results: [N m].
    """
    about_y = max(load, 0.0) * roller.radius * math.sin(tilt)
    return Moments(about_y, roller.rolling_friction * about_y)


@kernel
def moments_of_bent(roller: Roller, bending: Bending, load: float, tilt: float, ellipse: YawEllipse) -> Moments:
    """With the friction of the bent shaft, from the ellipse under 1 N at the yaw; load > 0. Not
    checked.

    tilt: [rad]; the results: [N m].
    """
    straight, arm = moments_of_straight(roller, load, tilt), roller.radius * math.sin(tilt)
    grown = numpy.cbrt(load) ** 2
    pull = bending.friction * bending.load * math.pi * grown * ellipse.product / bending.second_moment
    pull *= bending.radius - grown * ellipse.approach
    distance = bending.contact_distance - bending.load_distance + arm
    about_y = straight.tilt - pull * roller.radius * math.cos(tilt) * distance
    return Moments(about_y, straight.yaw + 0.125 * pull * grown * ellipse.turned)
