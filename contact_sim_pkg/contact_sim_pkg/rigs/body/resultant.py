"""Resultant of all contacts over uneven ground, whose faces have axes of their own: from the
balance of momentum.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.rigid.bodies.body import RigidBody
from contact_sim_pkg.rigid.problem import PLANE

__all__ = ["resultant"]

Array = NDArray[numpy.float64]


def resultant(body: RigidBody, rotation: Array, velocity: Array, time: float) -> tuple[Array, Array]:
    """Mean force [3] in [N] and torque about the centre of mass [3] in [N m] of the contacts
    between two states, world axes.

    F = m (v2 - v1)/T - load, M = (L2 - L1)/T - torque, L = R I R^T w; impacts in between count in
    full. Source: Newton, Euler.

    Args:
        body: mass, principal moments, weight and known wrench.
        rotation: of the principal axes at both ends, [2, width, width].
        velocity: at both ends, [2, coordinates]; in the plane (x, z, spin from x to z).
        time: T between them in [s].
    """
    width = body.width
    force = body.mass * (velocity[1, :width] - velocity[0, :width]) / time - body.load[:width]
    if width == PLANE:
        spin = body.inertia[0] * (velocity[1, 2] - velocity[0, 2]) / time - body.load[2]
        # about y it turns from z to x
        return numpy.array([force[0], 0.0, force[1]]), numpy.array([0.0, -spin, 0.0])
    momenta = [turn @ (body.inertia * (turn.T @ spin)) for turn, spin in zip(rotation, velocity[:, 3:], strict=True)]
    return force, (momenta[1] - momenta[0]) / time - body.load[3:]
