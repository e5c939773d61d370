"""Messages of the bench as a whole: motion, energy, cost, progress, what is recorded, scene and clock."""

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import deserialize, float64s, grid, header, scalars, serialize, time_of
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages.frames import BENCH_FRAME

_MOTION = "contact_msgs_defs/msg/BodyMotion"
_ENERGY = "contact_msgs_defs/msg/EnergyLedger"
_COST = "contact_msgs_defs/msg/SolverCost"
_PROGRESS = "contact_msgs_defs/msg/BenchProgress"
_RECORDED = "contact_msgs_defs/msg/BenchRecorded"


class MotionBlock(NamedTuple):
    """Motion of all bodies of the rig over a block; sample i at stamp + i sample_period."""

    block: int
    sample_period: float  # [s]
    bodies: tuple[str, ...]
    position: NDArray[numpy.float64]  # [bodies, samples], [m]
    velocity: NDArray[numpy.float64]  # [bodies, samples], [m/s]
    acceleration: NDArray[numpy.float64]  # [bodies, samples], [m/s^2]


class Energy(NamedTuple):
    """Energy ledger in [J] since the start: supplied = kinetic + potential + stored + dissipated + residual."""

    block: int
    kinetic: float
    potential: float
    stored: float
    dissipated: float
    supplied: float
    residual: float


class Cost(NamedTuple):
    """What one block cost; reports wall time."""

    block: int
    wall_time: float  # [s]
    real_time_factor: float
    steps: int
    rejected_steps: int
    events: int
    field_iterations: int
    field_residual: float
    field_jump: float  # [N]
    stretches: int
    stretches_repeated: int
    coupling_error: float  # over the standing load


class Progress(NamedTuple):
    """Where the run stands; the states are the constants of `BenchProgress.msg`."""

    state: int
    block: int  # last block done, -1 before the first
    blocks: int
    messages_sent: int
    real_time_factor: float
    load: float  # [N]
    peak_pressure: float  # [Pa]
    scene: str
    message: str


class Recorded(NamedTuple):
    """What the logger holds."""

    block: int  # last block held whole, -1 before the first
    messages: int
    closed: bool
    bag: str
    message: str


def encode_motion(value: MotionBlock, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """Motion of all bodies in a block; MessageError where an array is not [bodies, samples]."""
    shape = (len(value.bodies), *value.position.shape[1:])
    if any(array.shape != shape or len(shape) != 2 for array in value[3:]):
        shapes = ", ".join(f"{name} {getattr(value, name).shape}" for name in value._fields[3:])
        raise MessageError(
            f"the arrays of a {_MOTION} must be [{len(value.bodies)} bodies, samples]; they are {shapes}"
        )
    fields = (value.block, value.sample_period, shape[1], list(value.bodies), *(float64s(array) for array in value[3:]))
    return serialize(_MOTION, header(stamp_ns, frame_id), *fields)


def decode_motion(data: bytes) -> MotionBlock:
    """Motion of all bodies in a block."""
    message = deserialize(_MOTION, data)
    shape = (len(message.bodies), message.samples)
    arrays = (grid(_MOTION, message.block, *shape, getattr(message, name)) for name in MotionBlock._fields[3:])
    return MotionBlock(message.block, message.sample_period, tuple(message.bodies), *arrays)


def encode_energy(value: Energy, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """The energy ledger at a block's start."""
    return serialize(_ENERGY, header(stamp_ns, frame_id), *value)


def decode_energy(data: bytes) -> Energy:
    """The energy ledger at a block's start."""
    return Energy(*scalars(deserialize(_ENERGY, data), Energy._fields))


def encode_cost(value: Cost, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """What a block cost."""
    return serialize(_COST, header(stamp_ns, frame_id), *value)


def decode_cost(data: bytes) -> Cost:
    """What a block cost."""
    return Cost(*scalars(deserialize(_COST, data), Cost._fields))


def encode_progress(value: Progress, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """Where the run stands."""
    return serialize(_PROGRESS, header(stamp_ns, frame_id), *value)


def decode_progress(data: bytes) -> Progress:
    """Where the run stands."""
    return Progress(*scalars(deserialize(_PROGRESS, data), Progress._fields))


def encode_recorded(value: Recorded, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """What the logger holds."""
    return serialize(_RECORDED, header(stamp_ns, frame_id), *value)


def decode_recorded(data: bytes) -> Recorded:
    """What the logger holds."""
    return Recorded(*scalars(deserialize(_RECORDED, data), Recorded._fields))


def encode_scene(text: str) -> bytes:
    """The resolved scene as YAML, in a `std_msgs/String`, which has no stamp: recorded at time 0."""
    return serialize("std_msgs/msg/String", text)


def decode_scene(data: bytes) -> str:
    """The text of a `std_msgs/String`."""
    return str(deserialize("std_msgs/msg/String", data).data)


def encode_clock(stamp_ns: int) -> bytes:
    """Simulated time for `/clock`."""
    return serialize("rosgraph_msgs/msg/Clock", time_of(stamp_ns))
