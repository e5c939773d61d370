"""YAML 1.2 with positions, and nothing that could run code or grow without bound."""

import pytest

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.yaml.document import LARGEST_FILE, parse_document, read_document
from contact_sim_pkg.scene.yaml.nodes import MappingNode, ScalarNode, to_plain


def values(text):
    return to_plain(parse_document(text, "s.yaml").root)


def fault(text):
    with pytest.raises(SceneError) as caught:
        parse_document(text, "s.yaml")
    return caught.value.faults[0]


@pytest.mark.parametrize(
    ("raw", "value"),
    [
        ("5e6", 5e6), ("5.0e6", 5e6), ("5.0e+6", 5e6), ("1E-3", 1e-3), ("-.5", -0.5), ("5.", 5.0), ("+7", 7), ("0", 0),
        ("12", 12), ("-0.0", 0.0), ("1e308", 1e308), ("5e-324", 5e-324),
        ("123456789012345678901", 123456789012345678901.0),
    ],
)  # fmt: skip
def test_json_numbers_are_numbers(raw, value):
    read = values(f"a: {raw}")["a"]
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize(
    "raw",
    [
        "010",
        "60:30",
        "on",
        "off",
        "yes",
        "no",
        "1_000",
        ".nan",
        ".inf",
        "-.inf",
        "nan",
        "inf",
        "1e400",
        "0x10",
        "0o17",
        "e5",
        ".",
        "-",
    ],
)
def test_what_only_old_yaml_reads_as_a_number_or_switch_is_text(raw):
    assert values(f"a: [{raw}]")["a"] == [raw]


@pytest.mark.parametrize(("raw", "value"), [("true", True), ("False", False), ("'true'", "true"), ('"5"', "5")])
def test_booleans_are_words_and_quotes_make_text(raw, value):
    assert values(f"a: {raw}") == {"a": value}


def test_values_and_keys_know_their_line_and_column():
    root = parse_document("a:\n  bc: 3\n  d: [1,\n      2]\n", "s.yaml").root
    inner = root.entries["a"]
    assert isinstance(inner, MappingNode)
    assert (inner.key_marks["bc"].line, inner.key_marks["bc"].column) == (2, 3)
    assert (inner.entries["bc"].mark.line, inner.entries["bc"].mark.column) == (2, 7)
    assert (inner.entries["d"].items[1].mark.line, inner.entries["d"].items[1].mark.column) == (4, 7)


def test_the_raw_text_of_a_value_is_kept():
    node = parse_document("a: 5.00e+6", "s.yaml").root.entries["a"]
    assert isinstance(node, ScalarNode)
    assert (node.raw, node.value) == ("5.00e+6", 5e6)


def test_a_repeated_key_names_both_lines_and_the_first_value_stays():
    document = parse_document("a: 1\nb: 2\na: 3\n", "s.yaml")
    assert [(found.line, found.where) for found in document.faults] == [(3, "a")]
    assert "line 1 and in line 3" in document.faults[0].sentence
    assert to_plain(document.root) == {"a": 1, "b": 2}


def test_a_repeated_key_below_others_is_named_with_its_path():
    assert parse_document("a:\n  b: {c: 1, c: 2}\n", "s.yaml").faults[0].where == "a.b.c"


def test_a_key_without_value_is_a_fault_at_the_key():
    document = parse_document("a:\n  b:\nc: 1\n", "s.yaml")
    assert [(found.line, found.column, found.where) for found in document.faults] == [(2, 3, "a.b")]


def test_an_alias_gives_an_equal_value_of_its_own():
    root = parse_document("a: &x {b: 1}\nc: *x\n", "s.yaml").root
    assert to_plain(root) == {"a": {"b": 1}, "c": {"b": 1}}
    assert root.entries["a"] is not root.entries["c"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a: !!float 1", "tag"),
        ("a: !x {b: 1}", "tag"),
        ("a: [1, 2", "expected"),
        ("a: b: c", "not allowed"),
        ("\ta: 1", "cannot start"),
        ("- 1\n- 2", "found a list"),
        ("3", "found the value '3'"),
        ("", "is empty"),
        ("# only a comment\n", "is empty"),
        ("a: 1\n---\nb: 2", "second document"),
        ("%YAML 1.1\n---\na: 1", "YAML 1.2"),
        ("%YAML 1.3\n---\na: 1", "is not YAML 1.2: version"),
        ("%YAML 1.0\n---\na: 1", "is not YAML 1.2: version"),
        ("a: *b", "alias"),
        ("a: &x [*x]", "alias"),
        ("? [1]\n: 2", "a key must be a word"),
        ("a: \x01", "U+0001"),
        ("a: " + "x" * 20000, "characters"),
        ("[" * 5000, "nested deeper"),
        ("a: &a [1]\nb: [" + "*a, " * 40 + "]", "aliases"),
        ("a: [" + "1,\n" * 20000 + "]", "more than 10000"),
    ],
)
def test_what_is_not_a_plain_small_document_is_refused_with_its_place(text, told):
    found = fault(text)
    assert told in found.sentence
    assert found.file == "s.yaml"
    assert found.line >= 1
    assert found.column >= 1


def test_an_alias_counts_with_all_that_it_stands_for():
    bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1]\n"
    for level in range(1, 8):
        bomb += f"a{level}: &a{level} [" + ", ".join([f"*a{level - 1}"] * 4) + "]\n"
    assert "more than" in fault(bomb).sentence


def test_a_file_that_is_too_large_is_not_read(tmp_path):
    path = tmp_path / "large.yaml"
    with path.open("wb") as stream:
        stream.truncate(LARGEST_FILE + 1)
    with pytest.raises(SceneError, match="1 MiB"):
        read_document(path)


def test_a_file_that_is_not_utf8_is_refused_with_the_byte(tmp_path):
    path = tmp_path / "latin.yaml"
    path.write_bytes(b"a: \xe9")
    with pytest.raises(SceneError, match="byte 3 is not UTF-8"):
        read_document(path)
