"""Message objects to CDR bytes and back, without a word about the fields of any message.

The bytes are little-endian CDR with the header 00 01 00 00, filled up with zeros to a multiple of 4: what DDS
delivers to a `raw` subscription when these bytes are given to `publisher.publish(bytes)`. Alignment gaps hold zeros,
so equal values give equal bytes.
"""

import struct
from functools import cache
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray
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


def time_of(stamp_ns: int) -> Any:
    """A `builtin_interfaces/Time` of a simulated time in [ns], 0 to 2^31 s; MessageError outside."""
    if not 0 <= stamp_ns <= LAST_STAMP:
        raise MessageError(f"a stamp of {stamp_ns} ns cannot be sent; allowed: 0 to {LAST_STAMP} ns")
    return message_class("builtin_interfaces/msg/Time")(*divmod(stamp_ns, SECOND))


def header(stamp_ns: int, frame_id: str) -> Any:
    """A `std_msgs/Header`."""
    return message_class("std_msgs/msg/Header")(time_of(stamp_ns), frame_id)


def serialize(type_name: str, *fields: Any) -> bytes:
    """The CDR bytes of a message with these fields, in the order of the definition.

    Raises MessageError where a field does not fit its type.
    """
    try:
        data = installed_types().serialize_cdr(message_class(type_name)(*fields), type_name, little_endian=True)
    except (struct.error, TypeError, ValueError, AttributeError) as error:
        raise MessageError(f"a {type_name} cannot be encoded: {error}") from None
    return b"".join((data, _FILL[len(data) % 4]))


def deserialize(type_name: str, data: bytes) -> Any:
    """The message that the bytes hold; its arrays are views of them. MessageError where they do not hold one."""
    try:
        return installed_types().deserialize_cdr(data, type_name)
    except (SerdeError, struct.error, ValueError, IndexError, AssertionError) as error:
        raise MessageError(f"{len(data)} bytes do not hold a {type_name}: {error}") from None


def stamp_of(data: bytes) -> int:
    """The stamp in [ns] of an encoded message whose first field is a header or a stamp: 8 bytes at offset 4."""
    if len(data) < 12 or data[:2] not in (b"\0\1", b"\0\0"):
        raise MessageError(f"{len(data)} bytes that begin with {data[:4].hex(' ') or 'nothing'} hold no stamp")
    seconds, nanoseconds = struct.unpack_from("<iI" if data[1] else ">iI", data, 4)
    return int(seconds * SECOND + nanoseconds)


def float64s(values: ArrayLike) -> NDArray[numpy.float64]:
    """The values as one row of float64, row-major."""
    return numpy.ascontiguousarray(values, dtype=numpy.float64).reshape(-1)


def float32s(values: ArrayLike) -> NDArray[numpy.float32]:
    """The values as one row of float32, row-major."""
    return numpy.ascontiguousarray(values, dtype=numpy.float32).reshape(-1)


def equal_lengths(type_name: str, **arrays: NDArray[Any]) -> None:
    """MessageError where the arrays of one message differ in length."""
    if len({len(array) for array in arrays.values()}) > 1:
        lengths = ", ".join(f"{name} has {len(array)}" for name, array in arrays.items())
        raise MessageError(
            f"the arrays of a {type_name} differ in length: {lengths}; one value a sample is needed in each"
        )


def finite(type_name: str, block: int, **values: Any) -> None:
    """MessageError that names the first of the values that is not finite, or the first place in it that is not."""
    for name, value in values.items():
        if not numpy.isfinite(value).all():
            bad = numpy.argwhere(~numpy.isfinite(value))
            where = ("", ", the first at number {}", ", the first at row {}, column {}")[bad.shape[1]].format(*bad[0])
            raise MessageError(
                f"{name} of {type_name}, block {block}, has {len(bad)} value(s) that are NaN or infinite{where}"
            )


def grid(type_name: str, block: int, rows: int, cols: int, values: NDArray[Any]) -> NDArray[Any]:
    """A copy of the values as [rows, cols]; MessageError where there are more or fewer."""
    if rows * cols != len(values):
        raise MessageError(f"block {block} of {type_name} has {len(values)} values for a grid of {rows} x {cols}")
    return numpy.array(values).reshape(rows, cols)


def above_zero(type_name: str, block: int, **values: float) -> None:
    """MessageError that names the first of the values that is not above 0 and finite."""
    for name, value in values.items():
        if not 0.0 < value < float("inf"):
            raise MessageError(f"{name} of {type_name}, block {block}, is {value}; it must be above 0 and finite")


def scalars(message: Any, names: tuple[str, ...]) -> tuple[Any, ...]:
    """The fields of these names."""
    return tuple(getattr(message, name) for name in names)
