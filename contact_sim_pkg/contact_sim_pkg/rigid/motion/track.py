"""State of a run over output samples, and the track that it leaves: a row a sample."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NamedTuple, TypeAlias

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigid.bodies.body import RigidBody
from contact_sim_pkg.rigid.bodies.motion import STICKING

# of the time left or of the longest sub-step: one below it was cut short by an event
BRIEF = 1.0e-3

RUN_STATE = numpy.dtype(
    [
        ("time", float),  # [s] since the start of the current output sample
        ("interval", float),  # [s] from one output sample to the next
        # [s] from the start of the call: when the last bounce ended; nan: not yet
        ("rest_time", float),
        ("dissipated", float),  # [J] by impacts and by sliding, in all
        ("residual", float),  # greatest of the contact solves of the call
        ("substep", float),  # [s] length of the sub-step that a solve request is for
        ("rounding", float),  # [m/s] speed that counts as rounding
        ("sample", numpy.int64),  # number of the current output sample
        ("samples", numpy.int64),  # output samples of the call
        ("events", numpy.int64),  # located, in all
        ("solves", numpy.int64),  # contact problems solved, in all
        ("collided", numpy.int64),  # 1: the state is that after an impact
        ("stops", numpy.int64),  # ends of slip located in the current sample
        ("short", numpy.int64),  # sub-steps of the current sample that an event cut short
        # one more than the number of the last sample in which nothing moved; 0: none
        ("resting", numpy.int64),
    ]
)
"""Fields of a `RunState`."""

RunState: TypeAlias = "numpy.recarray[Any, numpy.dtype[numpy.record]]"
"""[1] of RUN_STATE: its element is read and written by name."""


def make_run_state() -> RunState:
    """Run state of a body that has not moved yet, all zeros."""
    return numpy.zeros(1, RUN_STATE).view(numpy.recarray)


def run_fields(state: RunState) -> SimpleNamespace:
    """Views [1] of the fields of a run state by their names, for Python: reading an attribute of
    the element itself takes numpy some fifty times as long.
    """
    plain = numpy.asarray(state)
    return SimpleNamespace(**{name: plain[name] for name in RUN_STATE.names or ()})


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
    """The rows of a ``track`` [samples, columns] by `track_columns`, named."""
    angle, rotation, velocity, impulse, sticks, _length = columns
    turned = track[:, rotation:velocity].reshape(len(track), width, width)
    return SampleTrack(
        track[:, :angle], track[:, angle], turned, track[:, velocity:impulse], track[:, impulse:sticks],
        track[:, sticks:],
    )  # fmt: skip


@borrowing_kernel
def record_sample(body, motion, work, row):
    """State at the end of a sample and which points stick, into a row of the track
    (`track_columns`).
    """
    # position, angle, rotation, velocity
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
    # the impulses stand there already: `add_impulse`
    place += work.impulse.shape[0]
    for i in range(work.flags.shape[0]):
        row[place + i] = 1.0 if work.flags[i] == STICKING else 0.0


@borrowing_kernel
def add_impulse(work, row, column):
    """The impulses of a sub-step to those of its sample."""
    for k in range(work.impulse.shape[0]):
        row[column + k] += work.impulse[k]


@borrowing_kernel
def repeat_to_the_end(run, track):
    """The last sample over and over: nothing moved in it, and nothing will."""
    for sample in range(run.sample, run.samples):
        for k in range(track.shape[1]):
            track[sample, k] = track[sample - 1, k]
    run.sample = run.samples
