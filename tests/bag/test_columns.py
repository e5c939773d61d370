"""Columns of messages are those of the message objects, in whatever layouts they come."""

import numpy
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from contact_sim_pkg.bag import columns
from contact_sim_pkg.bag.columns import Stack
from contact_sim_pkg.memory import MemoryLimitError

TYPE = "probe_msgs/msg/Probe"
DEFINITION = """builtin_interfaces/Time stamp
bool on
string name
float32[] series
uint16[3] fixed
string[] parts
float64 value
int8 small
uint64 large
"""


def store():
    types = get_typestore(Stores.ROS2_JAZZY)
    types.register(get_types_from_msg(DEFINITION, TYPE))
    return types


def columns_of(types, messages, *, little_endian=True, fields=None):
    stack = Stack(types, TYPE, fields, lambda _, data: types.deserialize_cdr(data, TYPE))
    for number, message in enumerate(messages):
        stack.add(number, bytes(types.serialize_cdr(message, TYPE, little_endian=little_endian)))
    return stack.columns()


def probe(types, number, *, name="abc", values=2, parts=("x", "longer")):
    time = types.types["builtin_interfaces/msg/Time"](sec=number, nanosec=5)
    series = numpy.arange(values, dtype=numpy.float32) + number
    fixed = numpy.arange(3, dtype=numpy.uint16) * number
    return types.types[TYPE](
        stamp=time, on=number % 2 == 0, name=name, series=series, fixed=fixed, parts=list(parts), value=0.5 * number,
        small=-(number % 100), large=2**63 + number,
    )  # fmt: skip


@pytest.mark.parametrize("little_endian", [True, False])
@pytest.mark.parametrize("name", ["", "a", "abcd"])
@pytest.mark.parametrize("values", [0, 1, 3])
@pytest.mark.parametrize("parts", [(), ("x", "longer")])
def test_columns_of_one_layout(little_endian, name, values, parts):
    types = store()
    messages = [probe(types, number, name=name, values=values, parts=parts) for number in range(4)]

    found = columns_of(types, messages, little_endian=little_endian)

    assert found["stamp"].tolist() == [number * 10**9 + 5 for number in range(4)]
    assert found["on"].tolist() == [True, False, True, False]
    assert found["name"].tolist() == [name] * 4
    assert found["series"].dtype == numpy.float32
    assert found["series"].tolist() == [[number + i for i in range(values)] for number in range(4)]
    assert found["fixed"].tolist() == [[0, number, 2 * number] for number in range(4)]
    assert found["parts"].tolist() == [list(parts)] * 4
    assert found["value"].tolist() == [0.0, 0.5, 1.0, 1.5]
    assert found["small"].tolist() == [0, -1, -2, -3]
    assert found["large"].tolist() == [2**63 + number for number in range(4)]


def test_columns_of_changing_layouts():
    types = store()
    lengths, names = [2, 2, 3, 3, 3, 2, 0], ["a", "a", "a", "bcdef", "b", "a", "a"]
    messages = [
        probe(types, number, name=name, values=length)
        for number, (length, name) in enumerate(zip(lengths, names, strict=True))
    ]

    found = columns_of(types, messages)

    assert [len(row) for row in found["series"]] == lengths
    assert [row.tolist() for row in found["series"]] == [message.series.tolist() for message in messages]
    assert found["name"].tolist() == names
    assert found["value"].tolist() == [0.5 * number for number in range(7)]
    assert found["fixed"].shape == (7, 3)


def test_texts_of_equal_length_stay_apart():
    types = store()

    found = columns_of(types, [probe(types, number, name=name) for number, name in enumerate(["up", "up", "on", "on"])])

    assert found["name"].tolist() == ["up", "up", "on", "on"]


def test_batches_are_seams_that_nothing_shows(monkeypatch):
    types = store()
    messages = [probe(types, number, values=2 + number // 4) for number in range(11)]
    whole = columns_of(types, messages)
    monkeypatch.setattr(columns, "_BATCH_MESSAGES", 3)

    in_parts = columns_of(types, messages)

    for name, column in whole.items():
        assert [numpy.asarray(row).tolist() for row in in_parts[name]] == [
            numpy.asarray(row).tolist() for row in column
        ]
    assert in_parts["log_time"].tolist() == list(range(11))


def test_whole_numbers_stay_whole_where_only_some_need_a_sign_less_type():
    types = store()
    messages = [probe(types, number, name="ab"[number % 2]) for number in range(4)]
    for message, large in zip(messages, (1, 2**63 + 1, 2, 2**64 - 1), strict=True):
        message.large = large

    assert columns_of(types, messages)["large"].tolist() == [1, 2**63 + 1, 2, 2**64 - 1]


def test_one_long_text_costs_no_other_message_memory(monkeypatch):
    """Of 2000 texts one has 1 MB: in an array of texts each would take four bytes for every character of the longest."""
    types = store()
    monkeypatch.setenv("CONTACT_BENCH_MEMORY", "0.01")
    messages = [
        probe(types, number, name="long" * 250_000 if number == 7 else "ab"[number % 2]) for number in range(2000)
    ]

    found = columns_of(types, messages, fields=("name",))["name"]

    assert found[7] == "long" * 250_000
    assert found[8:11].tolist() == ["a", "b", "a"]


@pytest.mark.fault("G13")
def test_columns_beyond_the_limit_are_refused_while_they_grow(monkeypatch):
    types = store()
    monkeypatch.setenv("CONTACT_BENCH_MEMORY", "0.001")
    messages = (probe(types, number, values=1000) for number in range(100_000))  # 4 kB each

    with pytest.raises(MemoryLimitError, match=r"Probe: the table of its first \d+ messages needs .* limit 0.001 GiB"):
        columns_of(types, messages)
