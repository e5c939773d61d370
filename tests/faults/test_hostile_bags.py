"""Bags from strangers: each text, file and length of a small bag broken in turn, through every command that reads bags.

Each command ends with a documented exit status, one sentence on standard error where it refuses, and no traceback, in seconds.
"""

import dataclasses
import os
import random
import time

import pytest
from tests.bag.hand_made import BLOCK, VIBRATION, seat_ride, write
from tests.bench_process import bench as run_bench
from tests.bench_process import needs_ros
from tests.report.rolling_bag import rolling_bag
from tests.report.synthetic_bag import car_bag

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.typestore import definition, store_of_definition
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main as bench
from contact_sim_pkg.records.messages import String, VibrationBlock
from contact_sim_pkg.run import offline

SECONDS = 100.0  # for one command, on a busy machine
BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{new}: &{new} [*{old}, *{old}, *{old}, *{old}, *{old}, *{old}, *{old}, *{old}, *{old}]\n"
    for old, new in zip("abcdefgh", "bcdefghi", strict=True)
)
TEXTS = {
    "empty": "",
    "blank": " \n",
    "not YAML, not JSON": "{rig: [",
    "null": "null",
    "a list": "[1, 2]",
    "a number": "6.7",
    "a word": "seat",
    "nested": "[" * 20_000 + "]" * 20_000,
    "nested keys": '{"a":' * 20_000 + "1" + "}" * 20_000,
    "alias bomb": BOMB,
    "tag": "!!python/object/apply:os.system ['true']",
    "huge": "rig: seat\n" + "# long\n" * 200_000,
    "wrong types": "{rig: [1], name: {a: 1}, effects: 3, block_length: 0, duration: null, outputs: [], seat: x, travel: 1}",
    "wrong types, in JSON": '{"platform/vibration": {"notes": {"a": 1}}, "road/patch": 4}',
    "control characters": "rig: seat\u001b[2J\u0007",
    "a large number": "1" * 5000,
}
COMMANDS = {
    "run": lambda bag, tmp_path: ["run", "--offline", "--no-record", "--from-bag", bag],
    "run a scene": lambda bag, tmp_path: ["run", "seat_ride", "--duration", "0.02", "--offline", "--no-record", "--from-bag", bag],
    "report": lambda bag, tmp_path: ["report", bag, "--out", tmp_path / "page.html"],
    "report of two": lambda bag, tmp_path: ["report", bag, bag, "--out", tmp_path / "pages.html"],
    "recover": lambda bag, tmp_path: ["recover", bag, tmp_path / "recovered"],
    "identify": lambda bag, tmp_path: ["identify", bag, "--sphere", "1"],
    "material": lambda bag, tmp_path: ["material", bag],
    "accuracy": lambda bag, tmp_path: ["accuracy", bag],
}  # fmt: skip


@pytest.fixture(scope="module")
def ride():
    """A bag whose run is refused only for what a test breaks."""
    return seat_ride()


@pytest.fixture(autouse=True)
def no_simulation(monkeypatch):
    """What is not refused is not simulated: the bags are read, and no kernel is needed."""

    def described(scene, directory, on_progress, stop, sources, *_others):
        notes = {topic: source.describe() for topic, source in sources.items()}
        return offline.RunOutcome(0, 0.0, 0.0, None, False, "", notes)

    monkeypatch.setattr(offline, "run_offline", described)


def ends_in_a_sentence(capsys, tmp_path, bag, command, allowed=(2,)):
    """Run the command on the bag; its status and what it said."""
    began = time.monotonic()
    status = bench([str(part) for part in COMMANDS[command](bag, tmp_path)])
    assert time.monotonic() - began < SECONDS
    out, said = capsys.readouterr()
    assert status in allowed, said
    assert "Traceback" not in said
    if status == 2:
        assert out == ""
        *notes, last = said.rstrip("\n").split("\n")
        assert last.startswith("bench: ") or all(line.startswith("scene of ") for line in (*notes, last)), said
        assert max(map(len, (*notes, last))) < 1000
    return said


def with_text(ride, field, text):
    """The bag with one of its texts replaced."""
    if field == "scene":
        return dataclasses.replace(
            ride,
            texts={**ride.texts, "scene": text},
            messages=[("bench/scene", 0, encode(String(data=text))), *ride.messages[1:]],
        )
    if field == "quality":
        return dataclasses.replace(ride, quality=text)
    if field == "definition":
        return dataclasses.replace(ride, definitions={VIBRATION: text})
    return dataclasses.replace(ride, texts={**ride.texts, field: text})


@pytest.mark.fault("E12", "G4")
@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("field", ["scene", "excitation", "quality", "definition", "kernel_fingerprint"])
def test_any_text_of_a_bag_may_be_anything(capsys, tmp_path, ride, field, text):
    write(tmp_path / "bag", with_text(ride, field, TEXTS[text]))
    for command in COMMANDS:
        ends_in_a_sentence(capsys, tmp_path, tmp_path / "bag", command, (0, 2, 3))
        (tmp_path / "pages.html").unlink(missing_ok=True)
        (tmp_path / "page.html").unlink(missing_ok=True)


LISTS = {
    "no mapping": "[1]",
    "null": "rosbag2_bagfile_information: null",
    "null paths": "rosbag2_bagfile_information: {relative_file_paths: null}",
    "null path": "rosbag2_bagfile_information: {relative_file_paths: [null]}",
    "a mapping": "rosbag2_bagfile_information: {relative_file_paths: {a: b}}",
    "two files": "rosbag2_bagfile_information: {relative_file_paths: [a.mcap, b.mcap]}",
    "elsewhere": "rosbag2_bagfile_information: {relative_file_paths: [/dev/zero]}",
    "not UTF-8": b"\xff\xfe\x00",
    "huge": b"#" * (1 << 21),
}


@pytest.mark.fault("E12", "A3")
@pytest.mark.parametrize("text", [*LISTS, "empty", "nested", "alias bomb", "tag"])
def test_the_list_of_files_may_be_anything(capsys, tmp_path, ride, text):
    write(tmp_path / "bag", ride)
    content = {**TEXTS, **LISTS}[text]
    (tmp_path / "bag" / "metadata.yaml").write_bytes(content if isinstance(content, bytes) else content.encode())
    for command in COMMANDS:
        ends_in_a_sentence(capsys, tmp_path, tmp_path / "bag", command)


@pytest.mark.fault("A3", "E11")
@pytest.mark.parametrize(
    "kind", ["pipe", "device", "pipe in a directory", "pipe as metadata", "link to a device", "no file"]
)
@pytest.mark.parametrize("ending", [".mcap", ".db3"])
def test_what_is_no_regular_file_is_refused_at_once(capsys, tmp_path, kind, ending):
    place = tmp_path / f"bag{ending}"
    if kind == "pipe":
        os.mkfifo(place)
    elif kind == "device":
        place = "/dev/zero"
    elif kind == "link to a device":
        place.symlink_to("/dev/zero")
    elif kind.startswith("pipe "):
        place.mkdir()
        os.mkfifo(place / ("metadata.yaml" if kind == "pipe as metadata" else f"a{ending}"))
    for command in COMMANDS:
        if command == "material" and (kind in ("device", "no file") or ending == ".db3"):
            continue  # read as a table of impacts
        said = ends_in_a_sentence(capsys, tmp_path, place, command)
        assert any(word in said for word in ("regular file", "No such file", "there is no", "files")), said


@pytest.mark.fault("E12", "G4")
@pytest.mark.parametrize(
    "text", ["seat/msg/Own own", "Own[2] own", "int32 1", "float64[2", "Missing it", "int32 = 4", "x" * 300_000]
)
def test_a_definition_that_contains_itself_or_is_none_is_refused(text):
    with pytest.raises(BagError, match="the bag's definition of 'seat/msg/Own' cannot be used"):
        store_of_definition("seat/msg/Own", text)


@pytest.mark.fault("G10")
def test_messages_of_another_encoding_are_refused_by_name_and_recovered_as_they_are(capsys, tmp_path, ride):
    file = write(tmp_path / "bag", dataclasses.replace(ride, encodings={VIBRATION: "json"}))
    assert "/platform/vibration are encoded as 'json'" in ends_in_a_sentence(capsys, tmp_path, file, "run")
    ends_in_a_sentence(capsys, tmp_path, file, "recover", (0,))
    kept = open_bag(tmp_path / "recovered").topic(VIBRATION)
    assert kept.encoding == "json"
    assert "serialization_format: json" in (tmp_path / "recovered" / "metadata.yaml").read_text()


@pytest.mark.fault("B3")
@pytest.mark.parametrize("number", [0, 1])
def test_an_excitation_beyond_its_bound_is_refused_by_the_bound(capsys, tmp_path, ride, number):
    messages = list(ride.messages)
    block = decode(VibrationBlock, messages[1 + number][2])
    block.acceleration_z[3] = 1e300
    messages[1 + number] = (VIBRATION, number * BLOCK, encode(block, number * BLOCK))
    write(tmp_path / "bag", dataclasses.replace(ride, messages=messages))
    said = ends_in_a_sentence(capsys, tmp_path, tmp_path / "bag", "run")
    assert f"acceleration_z of block {number} reaches 1e+300 m/s^2; allowed: up to 10000 m/s^2" in said


@pytest.mark.fault("E10", "E11")
@pytest.mark.parametrize("seed", range(12))
def test_a_bag_with_any_bytes_changed_or_cut_off_ends_in_a_sentence(capsys, tmp_path, ride, seed):
    draw = random.Random(seed)
    file = write(tmp_path / "bag", ride)
    data = bytearray(file.read_bytes())
    for _ in range(draw.choice([0, 1, 5, 50])):
        data[draw.randrange(8, len(data))] = draw.randrange(256)
    file.write_bytes(data[: draw.randrange(len(data)) if seed % 3 == 0 else len(data)])
    for command in COMMANDS:
        ends_in_a_sentence(capsys, tmp_path, file, command, (0, 2, 3))


SCENES = (
    "{rig: [1], name: {a: 1}, effects: 3, block_length: 0, duration: null, outputs: [], travel: 1, tire: 2}",
    "{rig: tire, effects: {tire: [1, 2]}, block_length: x, backrest: [], occupant: {}, vibration: 4, suspension: []}",
    "{effects: {tire: {contact_field: {rows: -1}, friction: 0}, backrest: {friction: []}}, road: [1], integrator: x}",
)


@pytest.mark.fault("E12")
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("make", [rolling_bag, car_bag])
def test_a_scene_of_wrong_types_gives_a_page_or_a_sentence(capsys, tmp_path, make, scene):
    whole = make(tmp_path / "whole", 10)
    texts = {**whole.metadata, "scene": scene}
    with BagWriter(tmp_path / "bag", tuple(whole.topics.values()), texts, reserve_bytes=0, background=False) as writer:
        for message in whole.messages():
            if message.topic != "/bench/scene":
                writer.write(message.topic, message.log_time, message.data)
    ends_in_a_sentence(capsys, tmp_path, tmp_path / "bag", "report", (0, 2))


@needs_ros
@pytest.mark.fault("B10", "E12")
@pytest.mark.parametrize("text", [name for name in TEXTS if name not in ("empty", "blank", "null")])
def test_a_quality_of_service_that_cannot_be_used_is_refused_by_name(text):
    from contact_sim_pkg.nodes.protocol.recorded_publisher import profile_of_recorded
    from contact_sim_pkg.nodes.protocol.states import NodeError

    with pytest.raises(NodeError, match=r"the stored quality of service .* cannot be used") as caught:
        profile_of_recorded(TEXTS[text])
    assert caught.value.exit_status == 2
    assert len(str(caught.value)) < 1000


@needs_ros
@pytest.mark.fault("E12")
def test_a_replay_refuses_what_it_cannot_publish_before_it_begins(tmp_path, ride):
    bags = {
        "quality": with_text(ride, "quality", TEXTS["nested"]),
        "scene": dataclasses.replace(ride, seal=False, texts={**ride.texts, "scene": "rig: car"}),
    }
    for name, content in bags.items():
        write(tmp_path / name, content)
        ended = run_bench("replay", tmp_path / name, "--delay", "0")
        assert ended.returncode == 2, ended.stderr
        assert "Traceback" not in ended.stderr
        assert {"quality": "the stored quality of service", "scene": "is another than"}[name] in ended.stderr


OTHER = definition("contact_msgs_defs/msg/VibrationBlock").replace("sample_period", "sampling_period")


@needs_ros
@pytest.mark.fault("G10")
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"names": {VIBRATION: "/no name"}}, "'/no name' is no name of a topic of ROS"),
        ({"names": {VIBRATION: "/{node}/~"}}, "'/{node}/~' is no name of a topic of ROS"),
        ({"encodings": {VIBRATION: "json"}}, "the messages of /platform/vibration are encoded as 'json'"),
        (
            {"definitions": {VIBRATION: OTHER}},
            "/platform/vibration was recorded with another definition of contact_msgs_defs/msg",
        ),
        ({"messages": "empty"}, "the message of /platform/vibration at 0.01 s has 0 bytes"),
    ],
)
def test_a_topic_that_ros_cannot_carry_is_refused_by_name_and_the_others_go_out_without_it(
    tmp_path, ride, change, sentence
):
    if "messages" in change:
        change = {"messages": [*ride.messages[:-1], (*ride.messages[-1][:2], b"")]}
    file = write(tmp_path / "bag", dataclasses.replace(ride, **change))
    ended = run_bench("replay", file, "--delay", "0")
    assert ended.returncode == 2, ended.stderr
    assert sentence in ended.stderr
    assert "Traceback" not in ended.stderr
    assert "went out" not in ended.stderr
    others = run_bench("replay", file, "--delay", "0", "--topics", "bench/scene")
    assert others.returncode == 0, others.stderr
    assert "1 of 1 messages went out" in others.stderr
