"""Messages of the roller rig: contact and motion, track, dangerous volumes, stability."""

from typing import Any, NamedTuple, TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import deserialize, equal_lengths, float64s, header, serialize
from contact_sim_pkg.bag.messages.frames import ROLLER_FRAME

Numbers = NDArray[numpy.float64]


class RollerContact(NamedTuple):
    """Contact and motion over a block, one value a sample."""

    block: int
    period: float  # [s]
    load: Numbers  # [N]
    along_x: Numbers  # [m] semi-axis nearer to x
    along_y: Numbers  # [m]
    angle: Numbers  # [rad] of along_x from x
    peak_pressure: Numbers  # [Pa]
    approach: Numbers  # [m]
    tilt: Numbers  # [rad]
    yaw: Numbers  # [rad]
    heave: Numbers  # [m] outwards


class RollerTrack(NamedTuple):
    """The track of a body behind a block."""

    block: int
    body: str  # "shaft" or "roller"
    turns: float  # ridden
    cycles: float  # turns of the rig that they stand for
    turn_time: float  # [s]
    radius: float  # [m]
    height: Numbers  # [cells] [m] outwards
    load: Numbers  # [cells] [N]
    lowered: float  # [m]
    range: float  # [m]
    free: float  # share of time without contact
    checked: float  # turns that the time acceleration was held against; 0: not here
    check_error: float  # of the change of heights over them; NaN: none


class RollerVolumes(NamedTuple):
    """Dangerous volumes at one instant."""

    block: int
    time: float  # [s]
    load: float  # [N]
    along_x: float  # [m]
    along_y: float  # [m]
    angle: float  # [rad]
    peak_pressure: float  # [Pa]
    approach: float  # [m]
    normal_limit: float  # [Pa]
    shear_limit: float  # [Pa]
    working_volume: float  # [m^3]
    volume: Numbers  # [7] [m^3] xx, yy, zz, xy, xz, yz, any
    with_bending: Numbers  # [7] or [0] [m^3]


class RollerStability(NamedTuple):
    """Stability of tilt and yaw under a load."""

    block: int
    load: float  # [N]
    growth_rate: float  # [1/s]
    frequency: float  # [Hz]
    tilt: float  # [rad] static
    yaw: float  # [rad] static
    critical_load: float  # [N]; NaN: none
    critical_damping: float  # [N m s]; NaN: none
    root_real: Numbers  # [4] [1/s]
    root_imaginary: Numbers  # [4] [1/s]


Message = TypeVar("Message", RollerContact, RollerTrack, RollerVolumes, RollerStability)
_TOGETHER = {
    RollerContact: RollerContact._fields[2:], RollerTrack: ("height", "load"),
    RollerStability: ("root_real", "root_imaginary"),
}  # fmt: skip
"""Arrays of equal length."""


def encode_roller(value: Message, stamp_ns: int, frame_id: str = ROLLER_FRAME) -> bytes:
    """One message; MessageError where arrays that belong together differ in length."""
    _agree(value)
    fields = [float64s(field) if isinstance(field, numpy.ndarray) else field for field in value]
    return serialize(_name(type(value)), header(stamp_ns, frame_id), *fields)


def decode_roller(kind: type[Message], data: bytes) -> Message:
    """A message of the given kind."""
    return roller_of_message(kind, deserialize(_name(kind), data))


def roller_of_message(kind: type[Message], message: Any) -> Message:
    """The same from a message that was read by the definition of its bag."""
    found: list[Any] = []
    for name in kind._fields:
        field = getattr(message, name)
        found.append(numpy.array(field) if isinstance(field, numpy.ndarray) else field)
    value = kind(*found)
    _agree(value)
    return value


def _agree(value: Any) -> None:
    names = _TOGETHER.get(type(value), ())
    equal_lengths(_name(type(value)), **{name: numpy.asarray(getattr(value, name)) for name in names})


def _name(kind: type) -> str:
    return f"contact_msgs_defs/msg/{kind.__name__}"
