"""docs/interfaces.md says what the code says, and the code says what a bag holds."""

import re
from importlib.resources import files
from pathlib import Path

import pytest
from tests.bench_process import resolved

from contact_sim_lab.pages.interface_reference import (
    PARAMETERS,
    FieldRow,
    message_fields,
    own_types,
    reference,
    with_tables,
)
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS, full_name
from contact_sim_pkg.run.bag_content import recorded_names
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.load import shipped_names
from contact_sim_pkg.scene.renamed_keys import RENAMED
from contact_sim_pkg.scene.schema.catalog import catalog, without_kinds

ROOT = Path(__file__).resolve().parents[3]
TEXT = (ROOT / PARAMETERS).read_text(encoding="utf-8")


def rows():
    """By topic: its cells in the table of topics."""
    lines = [line for line in reference(TEXT).splitlines() if line.startswith("| `")]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    return {cell[0].strip("`"): cell[1:] for cell in cells if cell[0].strip("`") in TOPICS}


def test_the_tables_of_the_document_are_those_of_the_code():
    text = (ROOT / "docs" / "interfaces.md").read_text(encoding="utf-8")
    command = "python -m contact_sim_lab.pages.interface_reference docs/interfaces.md"
    assert with_tables(text, TEXT) == text, f"run: {command}"


def test_a_document_without_marks_is_refused():
    with pytest.raises(ValueError, match="needs the lines"):
        with_tables("# Interfaces\n", TEXT)


def test_every_topic_and_every_message_is_in_the_tables():
    assert list(rows()) == list(TOPICS)
    shipped = {path.name[:-4] for path in (files("contact_sim_pkg") / "msg").iterdir() if path.name.endswith(".msg")}
    assert {name.rpartition("/")[2] for name in own_types()} == shipped


def test_every_topic_has_one_publisher():
    assert all(re.fullmatch(r"\w+", cells[1]) for cells in rows().values())


def test_the_keys_of_a_rate_are_keys_of_a_scene():
    keys = {".".join(without_kinds(location)) for location in catalog()}
    named = {key for topic in TOPICS.values() for key in re.findall("`(.*?)`", topic.rate)}
    assert {"block_length", "outputs.field_rate"} <= named <= keys


@pytest.mark.parametrize("name", shipped_names())
def test_the_topics_of_a_scene_appear_as_in_the_table(name):
    scene = resolved(name)
    effects = {effect for each in scene.data["effects"].values() for effect in each}
    for topic in recorded_names(scene):
        appears = rows()[topic][3]
        if TOPICS[topic].kind not in ("result", "cost") or appears == "every rig":
            continue
        (part,) = [part for part in appears.split("; ") if re.search(rf"\b{scene.data['rig']}\b", part)]
        needed = set(re.findall("`([a-z_]+)`", part))
        assert not needed or needed & effects


def test_the_counts_of_messages_in_a_bag_follow_from_the_rates(tmp_path):
    values = (
        "duration=0.5", "outputs.display_rate=200", "outputs.field_rate=500", "seat.response_segment=0.1",
        "effects.seat.contact_field={}",
    )  # fmt: skip
    expected = {
        "every `block_length`": 50, "`outputs.display_rate`": 100, "`outputs.field_rate`": 250, "once": 1,
        "every half of `seat.response_segment`": 8,
    }  # fmt: skip
    run_offline(resolved("seat_ride", *values), tmp_path / "bag")
    bag, counted = open_bag(tmp_path / "bag"), 0
    for name, topic in TOPICS.items():
        rate = topic.rate.partition(",")[0]
        if full_name(name) in bag.topics:
            assert bag.count(full_name(name)) == expected[rate], name
            counted += 1
    assert counted == 9


def test_a_renamed_key_is_listed(monkeypatch):
    monkeypatch.setitem(RENAMED, "seat.occupant.hip_mass", "seat.occupant.frame_mass")
    assert "| `seat.occupant.hip_mass` | `seat.occupant.frame_mass` |" in reference(TEXT)


def test_fields_of_a_message_are_read_with_unit_and_meaning():
    text = "# Head.\n\nuint8 STUCK=1   # holds\n\nfloat64[] way  # [N m^2] of the force\nstring name\n"
    assert message_fields(text) == [
        FieldRow("STUCK=1", "uint8", "", "holds"),
        FieldRow("way", "float64[]", "N m^2", "of the force"),
        FieldRow("name", "string", "", ""),
    ]
