"""Messages of the impact rig: the impacts that ended in a block, and of each impact its course and what the effects say of it."""

from typing import Any, NamedTuple, TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import deserialize, equal_lengths, float64s, grid, header, serialize
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages.frames import IMPACT_FRAME

Numbers = NDArray[numpy.float64]


class ImpactEvents(NamedTuple):
    """The impacts that ended in one block, one value an impact in each array."""

    block: int
    number: NDArray[numpy.int32]  # of the impact, from 0
    release: NDArray[numpy.int32]  # of the release it belongs to, from 0
    start: Numbers  # [s] touch
    end: Numbers  # [s] last loss of force
    mass: Numbers  # [kg]
    radius: Numbers  # [m]
    temperature: Numbers  # [K]
    speed: Numbers  # V0 [m/s]
    duration: Numbers  # tau [s]
    restitution: Numbers  # k
    measured_speed: Numbers  # [m/s]
    measured_duration: Numbers  # [s]
    measured_restitution: Numbers
    depth: Numbers  # x_m [m]
    compression_time: Numbers  # tau_1 [s]
    peak_force: Numbers  # [N]
    peak_time: Numbers  # [s] from the touch
    compression_work: Numbers  # [J] <= 0
    restitution_work: Numbers  # [J] >= 0
    storage_modulus: Numbers  # E' [Pa] of both bodies in series
    loss_tangent: Numbers
    shape_factor: Numbers  # k_p
    gravity: Numbers  # [m/s^2] along the blow during contact


class ImpactCourse(NamedTuple):
    """One impact in time."""

    block: int
    number: int
    start: float  # [s]
    time: Numbers  # [s] from the touch
    depth: Numbers  # [m]
    speed: Numbers  # [m/s]
    elastic_force: Numbers  # [N]
    viscous_force: Numbers  # [N]


class ImpactStress(NamedTuple):
    """Stress over the contact radius, in time."""

    block: int
    number: int
    start: float  # [s]
    shape: str
    time: Numbers  # [instants] [s]
    radius: Numbers  # [instants] [m] contact radius
    place: Numbers  # [places] r/radius
    elastic: Numbers  # [instants, places] [Pa]
    viscous: Numbers  # [instants, places] [Pa]
    limited: NDArray[numpy.uint8]  # [instants]


class ImpactWave(NamedTuple):
    """The surface wave around one impact."""

    block: int
    number: int
    start: float  # [s]
    amplitude: float  # [m]
    length: float  # [m]
    frequency: float  # [rad/s]
    damping: float  # [1/s]
    speed: float  # [m/s]
    relative_speed: float
    start_time: float  # [s]
    start_radius: float  # [m]
    ring_ratio: float
    time: Numbers  # [instants] [s]
    radius: Numbers  # [places] [m]
    height: Numbers  # [instants, places] [m]


class ImpactFront(NamedTuple):
    """The micro-impact wave of one impact."""

    block: int
    number: int
    start: float  # [s]
    shear_speed: float  # [m/s]
    front_time: float  # t_s [s]
    front_depth: float  # [m]
    front_heat: float  # [J]
    time: Numbers  # [s]
    border_speed: Numbers  # [m/s]
    front_speed: Numbers  # [m/s]
    supersonic: NDArray[numpy.uint8]


class ImpactPosition(NamedTuple):
    """Position of the contact surface of one impact."""

    block: int
    number: int
    start: float  # [s]
    variant: int
    time: Numbers  # [s]
    surface_depth: Numbers  # [m]
    compression: Numbers  # alpha_h
    volume: Numbers  # [m^3]
    compression_volume: Numbers  # [m^3]
    heating_volume: Numbers  # [m^3]


class ImpactHistory(NamedTuple):
    """Depth by the hereditary integral under the force of one impact."""

    block: int
    number: int
    start: float  # [s]
    model: str
    time: Numbers  # [s]
    depth: Numbers  # [m]
    valid: NDArray[numpy.uint8]


Message = TypeVar("Message", ImpactCourse, ImpactStress, ImpactWave, ImpactFront, ImpactPosition, ImpactHistory)
_GRIDS = {"elastic": ("time", "place"), "viscous": ("time", "place"), "height": ("time", "radius")}
"""Fields that are grids in some message, and the fields that their axes are."""


def encode_impact_events(value: ImpactEvents, stamp_ns: int, frame_id: str = IMPACT_FRAME) -> bytes:
    """The impacts that ended in a block; MessageError where an array differs in length from the others."""
    arrays = {name: numpy.asarray(getattr(value, name)) for name in value._fields[1:]}
    equal_lengths(_type(value), **arrays)
    fields = (numpy.ascontiguousarray(a) if a.dtype.kind in "iu" else float64s(a) for a in arrays.values())
    return serialize(_type(value), header(stamp_ns, frame_id), value.block, *fields)


def decode_impact_events(data: bytes) -> ImpactEvents:
    """The impacts that ended in a block."""
    return events_of_message(deserialize(_name(ImpactEvents), data))


def events_of_message(message: Any) -> ImpactEvents:
    """The same from a message that was read by the definition of its bag."""
    arrays = {name: numpy.array(getattr(message, name)) for name in ImpactEvents._fields[1:]}
    equal_lengths(_name(ImpactEvents), **arrays)
    return ImpactEvents(message.block, *arrays.values())


def encode_impact(value: Message, stamp_ns: int, frame_id: str = IMPACT_FRAME) -> bytes:
    """What is said of one impact; MessageError where a grid does not fit its axes."""
    fields = []
    for name in value._fields:
        field = getattr(value, name)
        if name in _GRIDS and isinstance(value, (ImpactStress, ImpactWave)):
            shape = tuple(len(getattr(value, axis)) for axis in _GRIDS[name])
            if field.shape != shape:
                raise MessageError(f"{name} of a {_type(value)} must be {shape}; it is {field.shape}")
        if isinstance(field, numpy.ndarray):
            field = numpy.ascontiguousarray(field) if field.dtype == numpy.uint8 else float64s(field)
        fields.append(field)
    return serialize(_type(value), header(stamp_ns, frame_id), *fields)


def decode_impact(kind: type[Message], data: bytes) -> Message:
    """What is said of one impact, of the given kind."""
    return impact_of_message(kind, deserialize(_name(kind), data))


def impact_of_message(kind: type[Message], message: Any) -> Message:
    """The same from a message that was read by the definition of its bag."""
    found: list[Any] = []
    for name in kind._fields:
        field = getattr(message, name)
        if name in _GRIDS and kind in (ImpactStress, ImpactWave):
            rows, cols = (len(getattr(message, axis)) for axis in _GRIDS[name])
            field = grid(_name(kind), message.block, rows, cols, field)
        found.append(numpy.array(field) if isinstance(field, numpy.ndarray) else field)
    return kind(*found)


def _type(value: Any) -> str:
    return _name(type(value))


def _name(kind: type) -> str:
    return f"contact_msgs_defs/msg/{kind.__name__}"
