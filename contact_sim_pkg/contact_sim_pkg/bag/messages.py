"""Records (`records/messages.py`) to the bytes of a message and back, by the names of their fields.

The bytes follow the definition; an array of two sides is sent row by row. Decoded arrays are copies: writable, aligned, contiguous.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from math import prod
from typing import Any, TypeVar

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.records import messages as records
from contact_sim_pkg.records.definitions import HEADER, Field, definition_of

from .encoding import deserialize, header, message_class, serialize, stamp_of
from .errors import MessageError

__all__ = ["BENCH_FRAME", "decode", "encode", "record_of", "stamp_of"]

BENCH_FRAME = "bench"  # the bench's fixed frame

Record = TypeVar("Record")


def encode(record: Any, stamp_ns: int = 0, frame_id: str = BENCH_FRAME) -> bytes:
    """The CDR bytes of a record, stamped [ns] and in a frame; a message without a header holds neither.

    Raises MessageError where a value does not fit its field, or arrays do not fit each other.
    """
    codec = _codec(type(record).__name__)
    return serialize(codec.message(record, stamp_ns, frame_id), codec.type_name)


def decode(kind: type[Record], data: bytes) -> Record:
    """The record of a kind that the bytes hold; MessageError where they do not hold one, or its arrays do not fit."""
    return record_of(kind, deserialize(_codec(kind.__name__).type_name, data))


def record_of(kind: type[Record], message: Any) -> Record:
    """The record of a message read by the definition of its bag.

    A field that the bag's definition does not know has its default. Raises MessageError where arrays do not fit each other,
    AttributeError where a field without a default is missing.
    """
    return kind(**_codec(kind.__name__).values(message))


@cache
def _codec(name: str) -> _Codec:
    return _Codec(name)


class _Codec:
    """How one kind of message is encoded and decoded."""

    def __init__(self, name: str) -> None:
        definition = definition_of(name)
        fields, sides = definition.record_fields, definition.sides
        self.type_name = definition.type_name
        self._class = message_class(definition.type_name)
        self._has_header = any(field.type == HEADER for field in definition.fields)
        self._fields = fields
        self._senders = [(field.name, _sender(field)) for field in fields]
        self._side_arrays = [field.name for field in fields if field.name in sides]
        self._shaped = [field for field in fields if field.shape]
        self._columns = [each for each in fields if each.is_array and not each.shape and each.name not in sides]

    def message(self, record: Any, stamp_ns: int, frame_id: str) -> Any:
        """The message of a record; its numbers of rows, columns and samples are those of its arrays."""
        try:
            fields: dict[str, Any] = self._sizes(record)
            self._refuse_uneven_columns(record)
            for name, send in self._senders:
                value = getattr(record, name)
                fields[name] = value if send is None else send(value)
        except (TypeError, ValueError, AttributeError) as error:
            raise MessageError(f"a {self.type_name} cannot be encoded: {error}") from None
        if self._has_header:
            fields["header"] = header(stamp_ns, frame_id)
        return self._class(**fields)

    def _sizes(self, record: Any) -> dict[str, int]:
        """The size of each side that an array has; MessageError where two arrays have it with different sizes."""
        sizes = {name: len(getattr(record, name)) for name in self._side_arrays}
        for field in self._shaped:
            shape = numpy.shape(getattr(record, field.name))
            found = [sizes.setdefault(side, size) for side, size in zip(field.shape, shape, strict=False)]
            if len(shape) != len(field.shape) or found != list(shape):
                shapes = (f"{each.name} {numpy.shape(getattr(record, each.name))}" for each in self._shaped)
                wanted = " x ".join(f"{sizes.get(side, '?')} {side}" for side in field.shape)
                raise MessageError(
                    f"the arrays of a {self.type_name} do not fit each other: {', '.join(shapes)}; {field.name} must be {wanted}"
                )
        return sizes

    def _refuse_uneven_columns(self, holder: Any) -> None:
        """MessageError where arrays that stand beside each other differ in length."""
        lengths = {field.name: len(getattr(holder, field.name)) for field in self._columns if not field.may_be_empty}
        lengths |= {
            each.name: size for each in self._columns if each.may_be_empty and (size := _length(holder, each.name))
        }
        if len(set(lengths.values())) > 1:
            told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
            raise MessageError(
                f"the arrays of a {self.type_name} differ in length: {told}; one value a sample is needed in each"
            )

    def values(self, message: Any) -> dict[str, Any]:
        """The fields of a record, of a message with the same fields."""
        self._refuse_uneven_columns(message)
        missing = {field.name for field in self._fields if field.has_default and not hasattr(message, field.name)}
        return {field.name: self._value(field, message) for field in self._fields if field.name not in missing}

    def _value(self, field: Field, message: Any) -> Any:
        """One field of a record: an array as a copy in its shape, names as a tuple, a message in it as a record."""
        value = getattr(message, field.name)
        if field.type == "string" and field.is_array:
            return tuple(value)
        if field.is_array:
            return self._shaped_copy(field, message, value) if field.shape else numpy.array(value)
        return record_of(getattr(records, _short(field.type)), value) if _is_message(field) else value

    def _shaped_copy(self, field: Field, message: Any, values: NDArray[Any]) -> NDArray[Any]:
        sides = [getattr(message, side) for side in field.shape]
        shape = [side if isinstance(side, int) else len(side) for side in sides]
        if prod(shape) != len(values):
            grid = " x ".join(f"{size} {side}" for size, side in zip(shape, field.shape, strict=True))
            raise MessageError(
                f"block {message.block} of {self.type_name} has {len(values)} values of {field.name} for {grid}"
            )
        return numpy.array(values).reshape(shape)


def _sender(field: Field) -> Callable[[Any], Any] | None:
    """What makes the value of a message's field of that of a record; None where they are the same."""
    if _is_message(field):
        return partial(_nested, _short(field.type))
    if not field.is_array:
        return None
    return list if field.type == "string" else partial(_row, numpy.dtype(field.type))


def _nested(name: str, record: Any) -> Any:
    return _codec(name).message(record, 0, "")


def _row(kind: numpy.dtype[Any], values: ArrayLike) -> NDArray[Any]:
    """The values one after the other, row by row; TypeError where they are of another kind, such as reals for whole numbers."""
    return numpy.asarray(values).astype(kind, order="C", casting="same_kind", copy=False).reshape(-1)


def _length(holder: Any, name: str) -> int:
    return len(getattr(holder, name, ()))


def _is_message(field: Field) -> bool:
    return _short(field.type)[0].isupper()


def _short(type_name: str) -> str:
    return type_name.rpartition("/")[2]
