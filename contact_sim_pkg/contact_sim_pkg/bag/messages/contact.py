"""Messages of one contact: resultant, pressure field, shear field."""

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import (
    deserialize,
    equal_lengths,
    float32s,
    float64s,
    grid,
    header,
    message_class,
    scalars,
    serialize,
)
from contact_sim_pkg.bag.errors import MessageError

_FORCE = "contact_msgs_defs/msg/ContactForce"
_PATCH = "contact_msgs_defs/msg/ContactPatch"
_SHEAR = "contact_msgs_defs/msg/ContactShear"
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
    return PatchField._make((*scalars(message, PatchField._fields[:-1]), pressure))


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
    return ShearField._make((*scalars(message, names[:-3]), *fields))


def _samples_agree(arrays: dict[str, NDArray[numpy.float64]]) -> None:
    """Arrays of a ContactForce have one length; impulses may be left out."""
    equal_lengths(_FORCE, **{name: array for name, array in arrays.items() if name != "impulses" or len(array)})
