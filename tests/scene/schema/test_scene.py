"""Types and bounds of every single key of the schema."""

import copy
import functools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.schema.catalog import catalog, without_kinds
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.validate import validate
from contact_sim_pkg.scene.yaml.document import parse_document
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Mark, ScalarNode

ENTRIES = [entry for entry in catalog().values() if entry.location[-1] != "kind"]
NUMBERS = [entry for entry in ENTRIES if entry.kind in ("number", "integer")]
KEY, VALUE = (7, 7), (7, 20)  # line and column where `document_with` says that they stand
BASE = "name: s\nrig: seat\nduration: 1\neffects: {seat: {normal_elastic: {}}}\n"


def name_of(entry):
    return ".".join(entry.location)


@functools.cache
def parsed(text):
    """The tree of a document; who changes it takes a copy."""
    return parse_document(text, "s.yaml").root


def document_with(entry, key, raw):
    """A seat scene in which `key` stands beside (or in place of) the key of the entry."""
    root = copy.deepcopy(parsed(BASE))
    location, path, section = entry.location, without_kinds(entry.location), root
    for depth, part in enumerate(path[:-1]):
        if part not in section.entries:
            section.entries[part] = MappingNode(Mark("s.yaml", 9, depth + 1))
            section.key_marks[part] = Mark("s.yaml", 9, depth + 1)
        section = section.entries[part]
        if depth == 0 and len(location) > len(path):
            section.entries["kind"] = ScalarNode(Mark("s.yaml", 9, 3), location[1], location[1])
            section.key_marks["kind"] = Mark("s.yaml", 9, 3)
    value = copy.deepcopy(parsed(f"v: {raw}").entries["v"])
    section.entries[key] = value
    section.key_marks[key] = Mark("s.yaml", *KEY)
    value.mark = Mark("s.yaml", *VALUE)
    return root


def faults_at(root, where):
    """What is told at one place; other places are incomplete on purpose."""
    try:
        validate(root, "s.yaml", rules=())
    except SceneError as error:
        return [fault for fault in error.faults if fault.where == where]
    return []


def path_of(entry, key=None):
    path = without_kinds(entry.location)
    return ".".join([*path[:-1], key or path[-1]])


def expect(found):
    """All keys are tried, then what is wrong is told of all together."""
    assert not found, "\n".join(found)


def refusals(entry, key, raw, mark, *told):
    """What is wrong with the refusal of `raw` at `key`: expected are one fault, at its mark, and what it tells."""
    faults = faults_at(document_with(entry, key, raw), path_of(entry, key))
    where = f"{name_of(entry)}: {key}: {raw}"
    if len(faults) != 1:
        return [f"{where}: {len(faults)} faults"]
    found = [f"{where}: {text!r} is not in {faults[0].sentence!r}" for text in told if text not in faults[0].sentence]
    if (faults[0].line, faults[0].column) != mark:
        found.append(f"{where}: at {faults[0].line}:{faults[0].column}, not at {mark}")
    return found


def test_every_key_with_one_letter_dropped_is_refused_at_its_place():
    found = []
    for entry in ENTRIES:
        key = entry.location[-1]
        for index in range(len(key)):
            found += refusals(entry, key[:index] + key[index + 1 :], "1", KEY, "unknown")
    expect(found)


def test_a_long_key_with_one_letter_dropped_is_told_what_was_meant():
    found = []
    for entry in ENTRIES:
        key = entry.location[-1]
        if len(key) > 3:
            found += refusals(entry, key[:1] + key[2:], "1", KEY, f"did you mean '{key}'?")
    expect(found)


@pytest.mark.parametrize(
    "raw", ["on", "yes", "010", "60:30", "1_000", ".nan", ".inf", "true", "'5'", "[1]", "{a: 1}", "1e999"]
)
def test_a_number_must_be_written_as_one_and_the_raw_text_is_shown(raw):
    shown = {"[1]": "a list", "{a: 1}": "a mapping", "'5'": "'5'"}.get(raw, f"'{raw}'")
    expect([line for entry in NUMBERS for line in refusals(entry, entry.location[-1], raw, VALUE, shown)])


def test_values_beyond_a_bound_are_refused_with_bound_and_unit():
    found = []
    for entry in NUMBERS:
        low, high = float(entry.low), float(entry.high)
        outside = [low if entry.above else math.nextafter(low, -math.inf), math.nextafter(high, math.inf)]
        if entry.kind == "integer":
            outside = [int(entry.low) - 1, int(entry.high) + 1]
        for value in outside:
            told = (repr(value), "allowed are", entry.unit)
            found += refusals(entry, entry.location[-1], repr(value), VALUE, *told)
    expect(found)


def test_the_bounds_themselves_are_allowed():
    found = []
    for entry in NUMBERS:
        low = max(math.nextafter(float(entry.low), math.inf), 1e-30) if entry.above else entry.low
        for value in (low, entry.high):
            root = document_with(entry, entry.location[-1], repr(value))
            found += [f"{name_of(entry)}: {fault.sentence}" for fault in faults_at(root, path_of(entry))]
    expect(found)


@given(value=st.floats(), entry=st.sampled_from(NUMBERS))
@settings(max_examples=300)
def test_any_float_validates_or_is_refused_as_a_scene_error(value, entry):
    root = document_with(entry, entry.location[-1], "1")
    section = root
    for part in without_kinds(entry.location)[:-1]:
        section = section.entries[part]
    section.entries[entry.location[-1]] = ScalarNode(Mark("s.yaml", 7, 20), repr(value), value)
    fits = math.isfinite(value) and entry.kind == "number" and entry.low <= value <= entry.high
    fits = fits and not (entry.above and value == entry.low) and (value == 0.0 or abs(value) >= 1e-30)
    try:
        validate(root, "s.yaml", rules=())
        refused = False
    except SceneError as error:
        refused = any(fault.where == path_of(entry) for fault in error.faults)
    assert refused == (not fits)


SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5)
KEYS = st.sampled_from(["kind", "file", "speed", "seat", "a"])
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3), max_leaves=8
)


@given(st.dictionaries(st.sampled_from([*Scene.model_fields, "x"]), VALUES))
@settings(max_examples=300)
def test_any_document_validates_or_is_refused_as_a_scene_error(data):
    root = MappingNode(Mark("s.yaml", 1, 1))
    for key, value in data.items():
        root.entries[key] = _node(value)
        root.key_marks[key] = Mark("s.yaml", 1, 1)
    try:
        validate(root, "s.yaml")
    except SceneError as error:
        assert error.faults  # noqa: PT017


def _node(value):
    mark = Mark("s.yaml", 2, 2)
    if isinstance(value, dict):
        node = MappingNode(mark)
        for key, item in value.items():
            node.entries[key], node.key_marks[key] = _node(item), mark
        return node
    if isinstance(value, list):
        return ListNode(mark, [_node(item) for item in value])
    return ScalarNode(mark, str(value), value)


def test_every_key_says_what_it_is_and_every_required_key_has_an_example():
    unexplained = [name_of(entry) for entry in ENTRIES if not entry.help]
    unbounded = [name_of(entry) for entry in NUMBERS if entry.low is None or entry.high is None]
    without_example = [name_of(entry) for entry in ENTRIES if entry.required and entry.example in (None, "")]
    assert (unexplained, unbounded, without_example) == ([], [], [])


@pytest.mark.parametrize(
    ("where", "raw", "told"),
    [
        ("road", "{kind: flt}", "did you mean 'flat'?"),
        ("road", "{height: 1}", "is missing; allowed: bump, cleat, flat, iso8608"),
        ("road", "[1]", "a list stands where a mapping"),
        ("road", "3", "'3' stands where a mapping"),
        ("tire", "3", "'3' stands where a mapping"),
        ("name", "12", "in quotes: '12'"),
        ("name", "../x", "is not a name"),
        ("rig", "yes", "'yes' is not allowed; allowed: tire, seat, car, backrest, occupant, impact, block, roller"),
        ("seed", "1.5", "1.5 is not a whole number"),
        (
            "duration",
            "5e-324",
            "5e-324 s is too near to 0 to compute with; write 0, or at least 1e-30 in size; allowed are",
        ),
        ("block", "{velocity: [-1e-31, 0, 0]}", "a number in the list is too near to 0 to compute with"),
        ("seat", "{occupant: {masses: [1, 2, 3, 4, 5, 6, 7, 8, 9]}}", "0 to 8 numbers"),
        ("seat", "{occupant: {masses: [1, -2]}}", "each 0.05 to 1000 kg"),
        ("travel", "{points: [[0, 1], [2]]}", "pairs [time, speed]"),
    ],
)
def test_a_value_that_does_not_fit_is_refused_with_what_is_allowed(where, raw, told):
    text = "".join(line + "\n" for line in BASE.splitlines() if not line.startswith(where)) + f"{where}: {raw}\n"
    with pytest.raises(SceneError) as caught:
        validate(parse_document(text, "s.yaml").root, "s.yaml", rules=())
    assert told in str(caught.value)
    assert f".yaml:{len(text.splitlines())}:" in str(caught.value)
    assert len(caught.value.faults) == 1
