"""Message objects to CDR bytes and back, without a word about the fields of any message.

The bytes are little-endian CDR with the header 00 01 00 00, filled up with zeros to a multiple of
4: what DDS delivers to a `raw` subscription when these bytes are given to
`publisher.publish(bytes)`. Alignment gaps hold zeros, so equal values give equal bytes.
"""

import struct
from functools import cache
from typing import Any

from rosbags.serde import SerdeError

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.typestore import installed_types

SECOND = 1_000_000_000  # [ns]
LAST_STAMP = 2**31 * SECOND - 1  # [ns]; the seconds of a ROS stamp are an int32
_FILL = (b"", b"\0\0\0", b"\0\0", b"\0")  # by length modulo 4


@cache
def message_class(type_name: str) -> Any:
    """The class of a message; its fields in the order of the definition are its arguments."""
    return installed_types().types[type_name]


def header(stamp_ns: int, frame_id: str) -> Any:
    """A `std_msgs/Header` of a simulated time in [ns], 0 to 2^31 s; MessageError outside."""
    if not 0 <= stamp_ns <= LAST_STAMP:
        raise MessageError(f"a stamp of {stamp_ns} ns cannot be sent; allowed: 0 to {LAST_STAMP} ns")
    time = message_class("builtin_interfaces/msg/Time")(*divmod(stamp_ns, SECOND))
    return message_class("std_msgs/msg/Header")(time, frame_id)


def serialize(message: Any, type_name: str) -> bytes:
    """The CDR bytes of a message; MessageError where a field does not fit its type."""
    try:
        data = installed_types().serialize_cdr(message, type_name, little_endian=True)
    except (struct.error, TypeError, ValueError, AttributeError) as error:
        raise MessageError(f"a {type_name} cannot be encoded: {error}") from None
    return b"".join((data, _FILL[len(data) % 4]))


def deserialize(type_name: str, data: bytes) -> Any:
    """The decoded message; its arrays are views of the bytes. MessageError for other bytes."""
    try:
        return installed_types().deserialize_cdr(data, type_name)
    except (SerdeError, struct.error, ValueError, IndexError, AssertionError) as error:
        raise MessageError(f"{len(data)} bytes do not hold a {type_name}: {error}") from None


def stamp_of(data: bytes) -> int:
    """The stamp in [ns] of an encoded message whose first field is a header or a stamp: 8 bytes at
    offset 4.
    """
    if len(data) < 12 or data[:2] not in (b"\0\1", b"\0\0"):
        raise MessageError(f"{len(data)} bytes that begin with {data[:4].hex(' ') or 'nothing'} hold no stamp")
    seconds, nanoseconds = struct.unpack_from("<iI" if data[1] else ">iI", data, 4)
    return int(seconds * SECOND + nanoseconds)
