"""Messages of one type stacked into arrays, one column a field."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError

_TIME = "builtin_interfaces/msg/Time"
_HEADER = "header."

Getter = Callable[[Any], Any]


def stacked(
    messages: Iterable[tuple[int, Any]], store: Typestore, type_name: str, fields: tuple[str, ...] | None
) -> dict[str, Any]:
    """Columns of the messages (log time in [ns], object) as `Bag.columns` describes them; BagError:
    unknown field.
    """
    getters = dict(_getters(store, type_name, "", lambda message: message))
    derived = {"log_time", "time"} if "stamp" in getters else {"log_time"}
    unknown = set(fields or ()) - set(getters) - derived
    if unknown:
        raise BagError(f"{type_name} has no field {', '.join(sorted(unknown))}; it has {', '.join(getters)}")
    wanted = {name: getter for name, getter in getters.items() if fields is None or name in fields or name == "stamp"}
    # one pass over the messages, which may be an iterator over the file
    values: dict[str, list[Any]] = {"log_time": [], **{name: [] for name in wanted}}
    for log_time, message in messages:
        values["log_time"].append(log_time)
        for name, getter in wanted.items():
            values[name].append(getter(message))
    columns = {name: _column(rows) for name, rows in values.items()}
    if "stamp" in columns:
        columns["time"] = columns["stamp"] / SECOND
    return {name: column for name, column in columns.items() if fields is None or name in fields}


def _column(rows: list[Any]) -> Any:
    """[messages] of scalars, [messages, length] of arrays of one length, else the list as it is."""
    if rows and isinstance(rows[0], (list, numpy.ndarray)) and len({len(row) for row in rows}) > 1:
        return rows
    if rows and isinstance(rows[0], list) and any(not isinstance(item, str) for item in rows[0]):
        return rows  # sub-messages stay objects
    return numpy.array(rows) if rows else numpy.empty(0)


def _getters(store: Typestore, type_name: str, prefix: str, reach: Getter) -> Iterable[tuple[str, Getter]]:
    """Name and getter of each leaf; a header's leaves lose their prefix, a time is one integer in
    [ns].
    """
    for name, (kind, detail) in store.fielddefs[type_name][1]:
        full = f"{prefix}{name}"
        getter = _then(reach, name)
        if kind is not Nodetype.NAME:
            yield full.removeprefix(_HEADER), getter
        elif detail == _TIME:
            yield full.removeprefix(_HEADER), _nanoseconds(getter)
        else:
            yield from _getters(store, str(detail), f"{full}.", getter)


def _then(reach: Getter, name: str) -> Getter:
    return lambda message: getattr(reach(message), name)


def _nanoseconds(reach: Getter) -> Getter:
    def stamp(message: Any) -> int:
        time = reach(message)
        return int(time.sec * SECOND + time.nanosec)

    return stamp
