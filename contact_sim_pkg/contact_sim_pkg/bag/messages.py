"""What the bench's messages hold, and their encoding. The only file that knows message fields.

`encode_*`(value, stamp in [ns], frame) gives CDR bytes, `decode_*`(bytes) the value; `stamp_of` reads the stamp alone.
The `.msg` files state unit, frame, sign and order of each field; the tuples below hold the same values, grids as
2-D arrays. Decoded arrays are copies: writable, aligned, contiguous. Longer than most files here, because
the fields of all messages are to be known in one place.
"""

from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock

from .encoding import (
    above_zero,
    deserialize,
    equal_lengths,
    finite,
    float32s,
    float64s,
    grid,
    header,
    message_class,
    serialize,
    time_of,
)
from .encoding import stamp_of as stamp_of
from .errors import MessageError

BENCH_FRAME = "bench"
TIRE_FRAME = "tire_contact"
SEAT_FRAME = "seat_contact"

_ROAD = "contact_msgs_defs/msg/RoadPatch"
_VIBRATION = "contact_msgs_defs/msg/VibrationBlock"
_FORCE = "contact_msgs_defs/msg/ContactForce"
_PATCH = "contact_msgs_defs/msg/ContactPatch"
_SHEAR = "contact_msgs_defs/msg/ContactShear"
_MOTION = "contact_msgs_defs/msg/BodyMotion"
_ENERGY = "contact_msgs_defs/msg/EnergyLedger"
_COST = "contact_msgs_defs/msg/SolverCost"
_PROGRESS = "contact_msgs_defs/msg/BenchProgress"
_RECORDED = "contact_msgs_defs/msg/BenchRecorded"
_WRENCH = "geometry_msgs/msg/WrenchStamped"

Vector = tuple[float, float, float]


NO_SAMPLES: NDArray[numpy.float64] = numpy.empty(0)


class ContactForceBlock(NamedTuple):
    """The resultant of one contact on the upper body over a block; sample i at stamp + i sample_period."""

    block: int
    sample_period: float  # [s]
    normal: NDArray[numpy.float64]  # [samples], [N], up, >= 0
    tangential: NDArray[numpy.float64]  # [samples], [N], forward positive
    approach: NDArray[numpy.float64]  # [samples], [m], positive in compression
    effective_height: NDArray[numpy.float64]  # [samples], [m]
    impulses: NDArray[numpy.float64] = NO_SAMPLES  # [samples], [N], or empty


class Wrench(NamedTuple):
    """Force in [N] and moment in [N m] on the upper body at the origin of the frame; x forward, y left, z up."""

    force: Vector
    torque: Vector


class PatchField(NamedTuple):
    """The pressure of one contact at one instant; cell (i, j) at origin + (i cell_x, j cell_y) in its frame."""

    block: int
    cell_x: float  # [m]
    cell_y: float  # [m]
    origin_x: float  # [m]
    origin_y: float  # [m]
    load: float  # [N]
    peak: float  # [Pa]
    mean: float  # [Pa]
    area: float  # [m^2]
    centre_x: float  # [m]
    centre_y: float  # [m]
    approach: float  # [m]
    lame_a: float  # [m]
    lame_b: float  # [m]
    lame_n: float
    pressure: NDArray[numpy.float32]  # [rows, cols], [Pa], >= 0


class ShearField(NamedTuple):
    """The shear of a rolling tire at one instant, on the cells of the PatchField of the same stamp."""

    block: int
    cell_x: float  # [m]
    cell_y: float  # [m]
    origin_x: float  # [m]
    origin_y: float  # [m]
    slip: float
    slip_angle: float  # [rad]
    force_x: float  # [N]
    force_y: float  # [N]
    moment_z: float  # [N m]
    sliding_share: float
    dissipated: float  # [J] since the field before
    shear_x: NDArray[numpy.float32]  # [rows, cols], [Pa]
    shear_y: NDArray[numpy.float32]  # [rows, cols], [Pa]
    state: NDArray[numpy.uint8]  # [rows, cols], 0 apart, 1 sticks, 2 slips


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


def encode_road_patch(value: RoadPatch, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """One block of road; rows and cols are the shape of `height`."""
    rows, cols = value.height.shape
    return serialize(
        _ROAD, header(stamp_ns, frame_id), *value[:4], rows, cols, value.cell_x, value.cell_y, float32s(value.height)
    )


def decode_road_patch(data: bytes) -> RoadPatch:
    """One block of road; MessageError where the grid does not fit, a spacing is not above 0 or a value not finite."""
    message = deserialize(_ROAD, data)
    height = grid(_ROAD, message.block, message.rows, message.cols, message.height)
    finite(_ROAD, message.block, travel_start=message.travel_start, travel_end=message.travel_end, height=height)
    above_zero(_ROAD, message.block, cell_x=message.cell_x, cell_y=message.cell_y)
    travel = (message.travel_start, message.travel_end)
    return RoadPatch(message.block, *travel, message.first_row, message.cell_x, message.cell_y, height)


def encode_vibration(value: VibrationBlock, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """One block of vibration; `samples` is the length of its arrays."""
    x, z = float64s(value.acceleration_x), float64s(value.acceleration_z)
    equal_lengths(_VIBRATION, acceleration_x=x, acceleration_z=z)
    return serialize(_VIBRATION, header(stamp_ns, frame_id), value.block, value.sample_period, len(x), x, z)


def decode_vibration(data: bytes) -> VibrationBlock:
    """One block of vibration; MessageError where samples and arrays disagree, or a value is not finite."""
    message = deserialize(_VIBRATION, data)
    x, z = numpy.array(message.acceleration_x), numpy.array(message.acceleration_z)
    if not len(x) == len(z) == message.samples or len(x) < 2:
        raise MessageError(
            f"block {message.block} of {_VIBRATION} has {len(x)} and {len(z)} values for {message.samples} samples; "
            "allowed: one value a sample, from 2 samples"
        )
    finite(_VIBRATION, message.block, acceleration_x=x, acceleration_z=z)
    above_zero(_VIBRATION, message.block, sample_period=message.sample_period)
    return VibrationBlock(message.block, message.sample_period, x, z)


def encode_contact_force(value: ContactForceBlock, stamp_ns: int, frame_id: str) -> bytes:
    """All samples of one contact's resultant in a block."""
    arrays = {name: float64s(getattr(value, name)) for name in value._fields[2:]}
    _samples_agree(arrays)
    return serialize(_FORCE, header(stamp_ns, frame_id), value.block, value.sample_period, *arrays.values())


def decode_contact_force(data: bytes) -> ContactForceBlock:
    """All samples of one contact's resultant in a block."""
    message = deserialize(_FORCE, data)
    arrays = {name: numpy.array(getattr(message, name, NO_SAMPLES)) for name in ContactForceBlock._fields[2:]}
    _samples_agree(arrays)
    return ContactForceBlock(message.block, message.sample_period, **arrays)


def encode_wrench(value: Wrench, stamp_ns: int, frame_id: str) -> bytes:
    """A resultant at one instant, for plotters."""
    vector, wrench = message_class("geometry_msgs/msg/Vector3"), message_class("geometry_msgs/msg/Wrench")
    return serialize(_WRENCH, header(stamp_ns, frame_id), wrench(vector(*value.force), vector(*value.torque)))


def decode_wrench(data: bytes) -> Wrench:
    """A resultant at one instant."""
    wrench = deserialize(_WRENCH, data).wrench
    return Wrench(*((vector.x, vector.y, vector.z) for vector in (wrench.force, wrench.torque)))


def encode_contact_patch(value: PatchField, stamp_ns: int, frame_id: str) -> bytes:
    """A pressure field; rows and cols are the shape of `pressure`."""
    rows, cols = value.pressure.shape
    return serialize(
        _PATCH, header(stamp_ns, frame_id), value.block, rows, cols, *value[1:-1], float32s(value.pressure)
    )


def decode_contact_patch(data: bytes) -> PatchField:
    """A pressure field; MessageError where rows, cols and pressure disagree."""
    message = deserialize(_PATCH, data)
    pressure = grid(_PATCH, message.block, message.rows, message.cols, message.pressure)
    scalars = _scalars(message, PatchField._fields[:-1])
    return PatchField._make((*scalars, pressure))


def encode_contact_shear(value: ShearField, stamp_ns: int, frame_id: str) -> bytes:
    """A shear field; rows and cols are the shape of `shear_x`. MessageError where the three fields differ in shape."""
    rows, cols = value.shear_x.shape
    if not value.shear_x.shape == value.shear_y.shape == value.state.shape:
        shapes = ", ".join(f"{name} {getattr(value, name).shape}" for name in value._fields[-3:])
        raise MessageError(f"the fields of a {_SHEAR} must have one shape; they are {shapes}")
    fields = (float32s(value.shear_x), float32s(value.shear_y), numpy.ascontiguousarray(value.state).reshape(-1))
    return serialize(_SHEAR, header(stamp_ns, frame_id), value.block, rows, cols, *value[1:-3], *fields)


def decode_contact_shear(data: bytes) -> ShearField:
    """A shear field; MessageError where rows, cols and the fields disagree."""
    message = deserialize(_SHEAR, data)
    names = ShearField._fields
    fields = (grid(_SHEAR, message.block, message.rows, message.cols, getattr(message, name)) for name in names[-3:])
    return ShearField._make((*_scalars(message, names[:-3]), *fields))


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
    return Energy(*_scalars(deserialize(_ENERGY, data), Energy._fields))


def encode_cost(value: Cost, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """What a block cost."""
    return serialize(_COST, header(stamp_ns, frame_id), *value)


def decode_cost(data: bytes) -> Cost:
    """What a block cost."""
    return Cost(*_scalars(deserialize(_COST, data), Cost._fields))


def encode_progress(value: Progress, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """Where the run stands."""
    return serialize(_PROGRESS, header(stamp_ns, frame_id), *value)


def decode_progress(data: bytes) -> Progress:
    """Where the run stands."""
    return Progress(*_scalars(deserialize(_PROGRESS, data), Progress._fields))


def encode_recorded(value: Recorded, stamp_ns: int, frame_id: str = BENCH_FRAME) -> bytes:
    """What the logger holds."""
    return serialize(_RECORDED, header(stamp_ns, frame_id), *value)


def decode_recorded(data: bytes) -> Recorded:
    """What the logger holds."""
    return Recorded(*_scalars(deserialize(_RECORDED, data), Recorded._fields))


def encode_scene(text: str) -> bytes:
    """The resolved scene as YAML, in a `std_msgs/String`, which has no stamp: recorded at time 0."""
    return serialize("std_msgs/msg/String", text)


def decode_scene(data: bytes) -> str:
    """The text of a `std_msgs/String`."""
    return str(deserialize("std_msgs/msg/String", data).data)


def encode_clock(stamp_ns: int) -> bytes:
    """Simulated time for `/clock`."""
    return serialize("rosgraph_msgs/msg/Clock", time_of(stamp_ns))


def _samples_agree(arrays: dict[str, NDArray[numpy.float64]]) -> None:
    """Arrays of a ContactForce have one length; impulses may be left out."""
    equal_lengths(_FORCE, **{name: array for name, array in arrays.items() if name != "impulses" or len(array)})


def _scalars(message: Any, names: tuple[str, ...]) -> tuple[Any, ...]:
    return tuple(getattr(message, name) for name in names)
