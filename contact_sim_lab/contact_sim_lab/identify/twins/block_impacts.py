"""Random impacts of a square block on a corner, by closed modes: velocities before and after, to
identify from.

Newton's restitution 0 and Coulomb friction in the plane x-z, pitch about +y: stick if the impulse
lies in the cone, else slide against the slip before, else against the opposite.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

__all__ = ["BlockImpacts", "random_block_impacts"]

Array = NDArray[Any]


class BlockImpacts(NamedTuple):
    """k impacts, vectors in space with y across the plane."""

    rotation: Array  # [k, 3, 3]
    velocity_before: Array  # [k, 3]
    velocity_after: Array
    spin_before: Array  # [k, 3]
    spin_after: Array


def random_block_impacts(
    random: numpy.random.Generator, count: int, side: float = 0.1, friction: float = 0.4
) -> BlockImpacts:
    """Impacts of a homogeneous square of `side` [m]: angle 0.1 to 0.7 rad, v_x ±2 m/s, v_z -3 to -1
    m/s, spin ±5 rad/s.

    friction: [1]; arrays of the result: [impacts, 3, 3] and [impacts, 3].
    """
    rows: list[tuple[float, Array, Array]] = []
    while len(rows) < count:
        angle, forward = random.uniform(0.1, 0.7), random.uniform(-2.0, 2.0)
        before = numpy.array([forward, random.uniform(-3.0, -1.0), random.uniform(-5.0, 5.0)])
        after = _impact(angle, before, side, friction)
        if after is not None:
            rows.append((angle, before, after))
    angles, before, after = (numpy.array(column) for column in zip(*rows, strict=True))
    # From the plane to space: pitch about y
    sine, cosine, zero = numpy.sin(angles), numpy.cos(angles), numpy.zeros(count)
    one = numpy.ones(count)
    turned = numpy.stack([cosine, zero, sine, zero, one, zero, -sine, zero, cosine], axis=1).reshape(-1, 3, 3)
    speeds = [numpy.stack([state[:, 0], zero, state[:, 1]], axis=1) for state in (before, after)]
    spins = [numpy.stack([zero, state[:, 2], zero], axis=1) for state in (before, after)]
    return BlockImpacts(turned, *speeds, *spins)


def _impact(angle: float, before: Array, side: float, friction: float) -> Array | None:
    """v_x, v_z and pitch rate after; None where no mode fits (jamming)."""
    corners = 0.5 * side * numpy.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]])
    x = numpy.cos(angle) * corners[:, 0] + numpy.sin(angle) * corners[:, 1]
    z = -numpy.sin(angle) * corners[:, 0] + numpy.cos(angle) * corners[:, 1]
    low = int(z.argmin())
    normal, tangent = numpy.array([0.0, 1.0, -x[low]]), numpy.array([1.0, 0.0, z[low]])
    mobility = numpy.diag([1.0, 1.0, 6.0 / side**2])
    rows = numpy.stack([normal, tangent])
    if normal @ before >= 0.0:
        return None
    # Stick, where the impulse lies in the cone; else slide in either direction
    impulse = -numpy.linalg.solve(rows @ mobility @ rows.T, rows @ before)
    if abs(impulse[1]) <= friction * impulse[0]:
        return numpy.asarray(before + mobility @ rows.T @ impulse)
    for sign in (-numpy.sign(tangent @ before), numpy.sign(tangent @ before)):
        push = normal + sign * friction * tangent
        gain = normal @ mobility @ push
        after = before - mobility @ push * (normal @ before) / gain
        if gain > 0.0 and sign * (tangent @ after) <= 0.0:
            return numpy.asarray(after)
    return None
