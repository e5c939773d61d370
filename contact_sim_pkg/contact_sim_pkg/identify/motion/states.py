"""States of a rigid body, sampled in time."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["BodyStates", "SampleNoise", "checked"]

FEWEST = 4  # samples
LARGEST = 1e12  # SI value of a sample
ORTHOGONAL = 1e-6  # allowed |R^T R - 1|


class BodyStates(NamedTuple):
    """Motion of the centre of mass and of the body's axes, all in world axes (z up)."""

    time: Array  # [n], [s], growing
    position: Array  # [n, 3], [m], centre of mass
    rotation: Array  # [n, 3, 3], body to world
    velocity: Array  # [n, 3], [m/s], centre of mass
    angular_velocity: Array  # [n, 3], [rad/s]


class SampleNoise(NamedTuple):
    """Standard deviation of one component of each channel."""

    position: float  # [m]
    rotation: float  # [rad]
    velocity: float  # [m/s]
    angular_velocity: float  # [rad/s]


def checked(states: BodyStates) -> BodyStates:
    """The same states; IdentificationError where a shape, a value, the order of time or a rotation
    is wrong.
    """
    samples = len(states.time)
    if samples < FEWEST:
        raise IdentificationError(f"the motion has {samples} samples; an identification needs at least {FEWEST}")
    for name, shape in (("position", (3,)), ("rotation", (3, 3)), ("velocity", (3,)), ("angular_velocity", (3,))):
        found = getattr(states, name).shape
        if found != (samples, *shape):
            raise IdentificationError(f"{name} has the shape {found}; allowed: {(samples, *shape)}, one entry a sample")
    for name, values in states._asdict().items():
        wild = ~(abs(values) <= LARGEST)
        if wild.any():
            raise IdentificationError(
                f"{name} of sample {int(numpy.argwhere(wild)[0][0])} is not finite or beyond {LARGEST:g}; take the sample out of "
                "the motion"
            )
    steps = numpy.diff(states.time)
    if not (steps > 0.0).all():
        place = int(numpy.argmin(steps))
        raise IdentificationError(
            f"time does not grow from sample {place} to {place + 1} ({states.time[place]:.9g} s to "
            f"{states.time[place + 1]:.9g} s); sort the samples and drop repeated ones"
        )
    # Rotations are orthogonal
    turned = numpy.einsum("nji,njk->nik", states.rotation, states.rotation) - numpy.eye(3)
    if abs(turned).max() > ORTHOGONAL:
        raise IdentificationError(
            f"rotation of sample {int(abs(turned).max(axis=(1, 2)).argmax())} is no rotation matrix"
        )
    return states
