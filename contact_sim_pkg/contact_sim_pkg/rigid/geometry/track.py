"""Where a march through output samples stands, and the track that it leaves: a row a sample."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import inline_kernel
from contact_sim_pkg.rigid.body import RigidBody
from contact_sim_pkg.rigid.motion.motion import STUCK

TIME, INTERVAL, RESTED, LOST, RESIDUAL, PIECE, STILL, CLOCKS = 0, 1, 2, 3, 4, 5, 6, 7  # entries of the clock
SAMPLE, SAMPLES, EVENTS, SOLVES, COLLIDED, STOPS, SHORT, RESTS, COUNTS = 0, 1, 2, 3, 4, 5, 6, 7, 8  # and of the counts
BRIEF = 1.0e-3  # of the time left or of the longest piece: a piece below it was cut short by an event


class SampleTrack(NamedTuple):
    """State at the end of each sample, and the impulses over it."""

    position: Vector  # [samples, width] in [m]
    angle: Vector  # [samples] in [rad], in the plane
    rotation: Vector  # [samples, width, width]
    velocity: Vector  # [samples, coordinates]
    impulse: Vector  # [samples, rows] in [N s]
    sticks: Vector  # [samples, points], 1 where a point sticks at the end


def track_columns(body: RigidBody, contacts: int) -> tuple[int, int, int, int, int, int]:
    """Where angle, rotation, velocity, impulse and sticking points start in a row of the track, and
    its length.
    """
    width, coordinates = body.width, len(body.load)
    rotation = width + 1
    velocity = rotation + width * width
    impulse = velocity + coordinates
    sticks = impulse + contacts * width
    return width, rotation, velocity, impulse, sticks, sticks + contacts


def read_track(track: Vector, columns: tuple[int, int, int, int, int, int], width: int) -> SampleTrack:
    """The rows of a track by `track_columns`."""
    angle, rotation, velocity, impulse, sticks, _length = columns
    turned = track[:, rotation:velocity].reshape(len(track), width, width)
    return SampleTrack(
        track[:, :angle], track[:, angle], turned, track[:, velocity:impulse], track[:, impulse:sticks],
        track[:, sticks:],
    )  # fmt: skip


@inline_kernel
def record_sample(body, motion, work, row):
    """State at the end of a sample and which points stick, into a row of the track
    (`track_columns`).
    """
    place = 0
    for k in range(body.width):
        row[place] = motion.position[k]
        place += 1
    row[place] = motion.angle[0]
    place += 1
    for k in range(body.width):
        for m in range(body.width):
            row[place] = motion.rotation[k, m]
            place += 1
    for k in range(motion.velocity.shape[0]):
        row[place] = motion.velocity[k]
        place += 1
    place += work.impulse.shape[0]
    for i in range(work.flags.shape[0]):
        row[place + i] = 1.0 if work.flags[i] == STUCK else 0.0


@inline_kernel
def add_impulse(work, row, column):
    """The impulses of a piece to those of its sample."""
    for k in range(work.impulse.shape[0]):
        row[column + k] += work.impulse[k]


@inline_kernel
def repeat_to_the_end(count, track):
    """The last sample over and over: nothing moved in it, and nothing will."""
    for sample in range(count[SAMPLE], count[SAMPLES]):
        for k in range(track.shape[1]):
            track[sample, k] = track[sample - 1, k]
    count[SAMPLE] = count[SAMPLES]
