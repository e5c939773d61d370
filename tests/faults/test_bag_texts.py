"""The texts of a bag, which no checksum of MCAP covers: a byte that changed in them is found, whoever reads the bag."""

import dataclasses
import shutil

import pytest
from tests.bag.hand_made import Content, seat_ride, write
from tests.faults.test_bag_faults import chunk_spans

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import CHECKSUM_KEY, OUTCOME, RECORD
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.recover import recover
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main as bench

TOPICS = ("bench/scene", "platform/vibration")


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """A finished bag of ours, with the texts of a beginning and of an end."""
    from contact_sim_pkg.bag.metadata import recorded_topics

    content, place = seat_ride(), tmp_path_factory.mktemp("texts") / "ride"
    with BagWriter(place, recorded_topics(TOPICS), content.texts, background=False) as writer:
        for topic, time, data in content.messages:
            writer.write(topic, time, data)
        writer.close({"ended": "finished", "failure": ""})
    return place


def changed(bag, place, before, after):
    """A copy of the bag with the first `before` of its file replaced by as many bytes."""
    shutil.copytree(bag, place)
    (file,) = place.glob("*.mcap")
    data = file.read_bytes()
    assert before in data
    assert len(before) == len(after)
    file.write_bytes(data.replace(before, after, 1))
    return place


def read(path, **options):
    """Everything that the reader takes from a bag."""
    found = open_bag(path, **options)
    return found.scene, found.metadata, found.topics, list(found.messages())


def read_or_sentence(path, **options):
    """As `read`, or why the bag is refused."""
    try:
        return read(path, **options)
    except BagError as error:
        return str(error)


@pytest.mark.fault("E10", "E12")
@pytest.mark.parametrize("command", ["run", "report", "material"])
def test_a_mass_that_changed_in_the_scene_is_refused_by_name(bag, tmp_path, capsys, command):
    spoilt = changed(bag, tmp_path / "spoilt", b"frame_mass: 6.7", b"frame_mass: 9.7")
    arguments = {"run": ["--offline", "--no-record", "--from-bag", spoilt]}.get(command, [spoilt])
    assert bench([command, *map(str, arguments)]) == 2
    out, said = capsys.readouterr()
    assert out == ""
    assert "the texts 'contact_bench' in the metadata of" in said
    assert "are not as they were written; the file is damaged or was changed, `bench recover` saves" in said
    assert len(said.splitlines()) == 1


@pytest.mark.fault("E10")
def test_what_recovery_brings_over_is_the_scene_under_the_checksum_and_it_names_the_loss(bag, tmp_path, capsys):
    spoilt = changed(bag, tmp_path / "spoilt", b"frame_mass: 6.7", b"frame_mass: 9.7")
    assert bench(["recover", str(spoilt), str(tmp_path / "whole")]) == 3
    assert "the texts 'contact_bench' in the metadata" in capsys.readouterr().out
    whole = open_bag(tmp_path / "whole")
    assert whole.scene == open_bag(bag).scene
    assert whole.metadata["ended"] == "finished"
    assert "numpy" not in whole.metadata
    assert bench(["recover", str(bag), str(tmp_path / "again")]) == 0
    kept = open_bag(tmp_path / "again").metadata
    assert kept == {**open_bag(bag).metadata, "recovered": "nothing was missing"}


@pytest.mark.fault("E10")
@pytest.mark.parametrize("text", [b"finished", OUTCOME.encode(), CHECKSUM_KEY.encode()])
def test_other_texts_and_names_of_the_metadata_are_covered_too(bag, tmp_path, text):
    spoilt = changed(bag, tmp_path / "spoilt", text, b"F" + text[1:])
    found = read_or_sentence(spoilt)
    assert found == read(bag) or "in the metadata" in found
    outcome = recover(spoilt, tmp_path / "new")
    assert not outcome.lossless or read(tmp_path / "new")[:1] == read(bag)[:1]


@pytest.mark.fault("E10")
def test_any_byte_that_changed_is_told_or_does_not_matter(bag, tmp_path):
    """Every byte of the metadata, and each 29th of the rest: the same content, or a refusal, or a note."""
    spoilt = tmp_path / "spoilt.mcap"
    (file,) = bag.glob("*.mcap")
    data, whole = file.read_bytes(), read(bag)
    texts = range(data.index(RECORD.encode()) - 13, data.index(CHECKSUM_KEY.encode()) + len(CHECKSUM_KEY) + 68)
    told = 0
    for place in sorted({*texts, *range(8, len(data), 29)}):
        flipped = bytearray(data)
        flipped[place] ^= 1 << place % 8
        spoilt.write_bytes(flipped)
        for skip in (False, True):
            found = read_or_sentence(spoilt, skip_bad=skip)
            refused = isinstance(found, str)
            told += refused
            assert (
                len(found.splitlines()) == 1 if refused else found == whole or open_bag(spoilt, skip_bad=skip).notes
            ), place
    assert told > len(texts) / 2


@pytest.mark.fault("E12")
def test_a_bag_without_a_checksum_stays_readable_and_its_two_scenes_are_compared(tmp_path):
    content = seat_ride(seal=False)
    assert open_bag(write(tmp_path / "old", content)).complete
    other = content.texts["scene"].replace("frame_mass: 6.7", "frame_mass: 9.7")
    assert other != content.texts["scene"]
    file = write(tmp_path / "bad", dataclasses.replace(content, texts={**content.texts, "scene": other}))
    with pytest.raises(BagError, match=r"the scene in the metadata of .* is another than the one on bench/scene"):
        open_bag(file)
    found = open_bag(file, skip_bad=True)
    assert found.scene == content.texts["scene"]
    assert "is another than the one on bench/scene, which is taken" in found.notes[0]


@pytest.mark.fault("E10")
@pytest.mark.parametrize("cut", [False, True])
def test_recovery_names_records_and_attachments_that_it_leaves_out(tmp_path, cut):
    content = Content({"scene": "rig: seat\n"}, seat_ride().messages[1:])
    file = write(
        tmp_path / "foreign",
        dataclasses.replace(content, records={"calibration": {"gain": "2"}}, attachments={"a.txt": b"a"}),
    )
    if cut:
        file.write_bytes(file.read_bytes()[:-60])
    outcome = recover(file, tmp_path / "new")
    assert not outcome.lossless
    assert "the metadata record 'calibration', 1 MCAP attachment(s) are not brought over" in outcome.sentence


@pytest.mark.fault("E10")
def test_the_commands_stop_at_a_damaged_chunk_and_go_on_after_it_when_told(tmp_path, capsys):
    file = write(tmp_path / "ride", seat_ride(blocks=3))
    offset, length = chunk_spans(file)[0]
    content = bytearray(file.read_bytes())
    content[offset + length // 2] ^= 1
    file.write_bytes(content)
    again = ["run", "--offline", "--no-record", "--from-bag", str(file)]
    for command in (["report", str(file)], again):
        assert bench(command) == 2
        assert "messages of 0.000 s to 0.020 s, is damaged" in capsys.readouterr().err
    assert bench(["report", str(file), "--skip-bad", "--out", str(tmp_path / "page.html")]) == 0
    assert "is damaged" in capsys.readouterr().err
    assert bench(["recover", str(file), str(tmp_path / "rest")]) == 3
    assert "it was skipped" in capsys.readouterr().out
    assert open_bag(tmp_path / "rest").scene == seat_ride(blocks=3).texts["scene"]
