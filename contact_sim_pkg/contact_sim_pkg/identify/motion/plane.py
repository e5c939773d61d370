"""Whether a motion stays in a plane."""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.geometry import GroundPlane
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise

__all__ = ["body_axis", "plane_of_motion"]

SIGMAS = 5.0
FLOOR = 1e-9  # of the largest speed
LEVEL = 1e-6  # allowed component of the axis along the ground's normal


def plane_of_motion(states: BodyStates, ground: GroundPlane, noise: SampleNoise) -> Array | None:
    """Normal [x, y, z] of the plane in world axes, its largest component positive; None where the
    motion is spatial.

    In a plane the spin keeps one axis, level with the ground, and the speed along that axis never
    changes.
    """
    spins = states.angular_velocity
    _, values, axes = numpy.linalg.svd(spins / numpy.sqrt(len(spins)), full_matrices=False)
    if values[0] <= SIGMAS * noise.angular_velocity + 1e-12:
        return None
    axis = axes[0] * numpy.sign(axes[0][abs(axes[0]).argmax()])
    across = states.velocity @ axis
    straight = values[1] <= max(SIGMAS * noise.angular_velocity, FLOOR * values[0])
    speed = float(abs(states.velocity).max())
    kept = float(abs(across - numpy.median(across)).max()) <= max(SIGMAS * noise.velocity, FLOOR * speed)
    level = abs(float(axis @ ground.normal)) <= max(LEVEL, SIGMAS * noise.angular_velocity / float(values[0]))
    return _named(axis, SIGMAS * noise.angular_velocity / float(values[0])) if straight and kept and level else None


def body_axis(states: BodyStates, axis: Array, noise: SampleNoise) -> Array:
    """Normal [x, y, z] of the plane in body axes: the mean over all samples; axis: in world
    axes.
    """
    mean = numpy.einsum("nji,j->i", states.rotation, axis)
    return _named(mean / numpy.linalg.norm(mean), SIGMAS * noise.rotation)


def _named(axis: Array, angle_error: float) -> Array:
    """A coordinate axis where one lies within ``angle_error`` [rad], else the axis as it is."""
    nearest = numpy.round(axis)
    return nearest if float(numpy.linalg.norm(axis - nearest)) <= max(angle_error, 1e-9) else axis
