"""States of a rigid body, sampled in time.

Samples that no motion has: a jump of position or rotation that the velocities do not explain, a
velocity that they deny.

Impacts change velocities at once, never positions. From sample to sample a body goes ``(v_i +
v_{i+1}) dt/2``, but for at most ``|v_{i+1} - v_i| dt/2`` where the change comes early or late in
the step. Rotations likewise, with angular velocities.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.rotation import Array, logarithm

__all__ = ["BodyStates", "SampleNoise", "checked", "refuse_jumps"]


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


SIGMAS = 12.0  # of the noise of the samples
CHANGES = 2.0  # times the change of velocity nearby: impacts that come and go between samples
SHARE = 0.3  # of the distance gone: error of a velocity that was filtered or measured with another scale
ALONE = 100.0  # times the median step: a first or last sample so far off has a wrong stamp
LEAST = 1e-3  # of the span of a channel, which rounding of samples at rest may reach
LEAST_TURN = 0.01  # [rad], likewise
WIDEST_STEP = 5.0  # times the median step: over a gap anything may have happened
WIDEST_TURN = 1.0  # [rad] in a step: above, rotations are ambiguous


def refuse_jumps(states: BodyStates, noise: SampleNoise, gravity: float) -> None:
    """Raise IdentificationError for the worst sample that no motion has, by channel, number, time
    and size.

    Args:
        states: checked.
        noise: first guess or stated, one standard deviation of each channel.
        gravity: [m/s^2]; what velocities change by in flight.
    """
    steps = numpy.diff(states.time)
    _refuse_lone_stamp(states.time, steps)
    # Increments of rotation and position from sample to sample, and what gravity makes of them
    turns = logarithm(states.rotation[1:] @ numpy.swapaxes(states.rotation[:-1], -1, -2))
    slack = 2.0 * gravity * steps**2 + LEAST * float(numpy.ptp(states.position, axis=0).max())
    places = numpy.diff(states.position, axis=0)
    _refuse_lone_velocity("velocity", "m/s", states.time, places, states.velocity, noise[0], noise[2])
    _refuse_lone_velocity("angular velocity", "rad/s", states.time, turns, states.angular_velocity, noise[1], noise[3])
    _refuse(
        name="position",
        unit="m",
        time=states.time,
        gone=places,
        speed=states.velocity,
        noise=noise[0],
        speed_noise=noise[2],
        slack=slack,
    )
    _refuse(
        name="rotation",
        unit="rad",
        time=states.time,
        gone=turns,
        speed=states.angular_velocity,
        noise=noise[1],
        speed_noise=noise[3],
        slack=LEAST_TURN + 0.0 * slack,
    )


def _refuse_lone_stamp(time: Array, steps: Array) -> None:
    usual = float(numpy.median(steps))
    for step, sample, side in ((steps[0], 0, "before"), (steps[-1], len(time) - 1, "after")):
        if step > ALONE * usual:
            raise IdentificationError(
                f"sample {sample} (t = {time[sample]:.6g} s) lies {step:.4g} s {side} the others, which are {usual:.3g} s "
                "from each other: its stamp is wrong; correct it or remove the sample"
            )


def _refuse(
    name: str, unit: str, time: Array, gone: Array, speed: Array, noise: float, speed_noise: float, slack: Array
) -> None:
    """One kind of motion: `gone` [n-1, 3] from sample to sample, `speed` [n, 3] at the samples."""
    steps = numpy.diff(time)
    # Distance from the mean of the velocities, allowed by their changes nearby
    off = numpy.linalg.norm(gone - 0.5 * (speed[1:] + speed[:-1]) * steps[:, None], axis=1)
    change = numpy.linalg.norm(numpy.diff(speed, axis=0), axis=1)
    fastest = numpy.linalg.norm(speed, axis=1)
    nearby = _widest(change, 2)
    size = numpy.maximum(fastest[1:], fastest[:-1])
    allowed = (CHANGES * nearby + SHARE * size) * steps + slack + SIGMAS * (noise + speed_noise * steps)
    # A gap in the record, or a large rotation, has no such bound
    comparable = steps <= WIDEST_STEP * numpy.median(steps)
    if unit == "rad":
        comparable &= size * steps < WIDEST_TURN
    worst = int(numpy.argmax(numpy.where(comparable, off / numpy.maximum(allowed, 1e-300), 0.0)))
    if comparable[worst] and off[worst] > allowed[worst]:
        raise IdentificationError(
            f"the {name} jumps by {off[worst]:.3g} {unit} between samples {worst} and {worst + 1} (t = {time[worst]:.6g} s), where "
            f"the velocities leave room for {allowed[worst]:.2g} {unit}: a sample or a stamp is wrong; remove or correct it"
        )


def _refuse_lone_velocity(
    name: str, unit: str, time: Array, gone: Array, speed: Array, noise: float, speed_noise: float
) -> None:
    """A velocity unlike both its neighbours, while the body goes from the one to the other as they
    say.
    """
    lone = speed[1:-1] - 0.5 * (speed[:-2] + speed[2:])
    span = time[2:] - time[:-2]
    denied = numpy.linalg.norm(gone[1:] + gone[:-1] - 0.5 * (speed[:-2] + speed[2:]) * span[:, None], axis=1)
    size, change = numpy.linalg.norm(lone, axis=1), numpy.linalg.norm(speed[2:] - speed[:-2], axis=1)
    floor = 10.0 * change + LEAST * float(abs(speed).max()) + SIGMAS * (speed_noise + noise / span)
    wrong = (size > floor) & (denied < 0.1 * size * span) & (size * span > SIGMAS * noise)
    if wrong.any():
        worst = int(numpy.argmax(numpy.where(wrong, size, 0.0)))
        raise IdentificationError(
            f"the {name} of sample {worst + 1} (t = {time[worst + 1]:.6g} s) is {size[worst]:.3g} {unit} off both its neighbours, "
            "and the body does not move so: the sample is wrong; remove or correct it"
        )


def _widest(values: Array, reach: int) -> Array:
    """Largest of the values around each, `reach` on either side."""
    padded = numpy.pad(values, reach)
    return numpy.asarray(numpy.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1))
