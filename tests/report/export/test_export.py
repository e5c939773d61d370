"""Exported tables read back equal the bag."""

import csv
import importlib.util

import numpy as np
import pytest
from tests.bag.hand_made import Content, write

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.memory import MemoryLimitError
from contact_sim_pkg.records.messages import ContactEpisodes, ContactForce, RollerVolumes, String
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.report.export.write import export


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert {len(row) for row in rows} == {len(header)}, "a spreadsheet sees a rectangle"
    return {name: [row[place] for row in rows] for place, name in enumerate(header)}


@pytest.fixture(scope="module")
def folder(car, tmp_path_factory):
    out = tmp_path_factory.mktemp("export") / "tables"
    assert [path.name for path in export(car, "csv", (), out)] == [
        "bench_scene.csv", "tire_force.csv", "seat_force.csv", "tire_patch.csv", "tire_patch_pressure.csv", "bench_motion.csv",
        "bench_energy.csv", "bench_cost.csv",
    ]  # fmt: skip
    return out


def test_samples_are_rows_with_times_and_units(car, folder):
    table, columns = read(folder / "tire_force.csv"), car.columns("tire/force")
    assert list(table) == ["time [s]", "block", "normal [N]", "tangential [N]", "approach [m]", "effective_height [m]"]
    np.testing.assert_allclose([float(text) for text in table["time [s]"]], np.arange(10_000) * 1e-3, atol=1e-12)
    for name in ("normal", "approach"):
        unit = {"normal": "N", "approach": "m"}[name]
        assert [float(text) for text in table[f"{name} [{unit}]"]] == np.concatenate([*columns[name]]).tolist()


def test_bodies_become_columns_by_name(car, folder):
    table, columns = read(folder / "bench_motion.csv"), car.columns("bench/motion")
    rows = np.concatenate([np.reshape(row, (3, -1)) for row in columns["acceleration"]], axis=1)
    assert [float(text) for text in table["acceleration.seat_frame_z [m/s^2]"]] == rows[1].tolist()


def test_maps_are_frames_of_a_mat_bit_by_bit(car, folder):
    lines = (folder / "tire_patch_pressure.csv").read_text().splitlines()
    assert lines[0] == "pressure [Pa],rows,16,cols,12"
    assert lines[1].startswith("cell_x [m],0.01,cell_y [m],0.01,origin_x [m],")
    frame = 57
    start = 2 + frame * 17
    assert lines[start] == "frame,57,time [s],0.57,rows,16,cols,12"
    values = np.array([line.split(",") for line in lines[start + 1 : start + 17]], dtype=np.float32)
    assert (values == car.columns("tire/patch", ("pressure",))["pressure"][frame].reshape(16, 12)).all()
    assert not any("pressure" in name for name in read(folder / "tire_patch.csv"))


def test_pandas_reads_the_same(car, folder):
    pandas = pytest.importorskip("pandas")
    table = pandas.read_csv(folder / "tire_force.csv", float_precision="round_trip")
    assert table["normal [N]"].tolist() == np.concatenate([*car.columns("tire/force")["normal"]]).tolist()


def test_events_are_rows_of_their_own(tmp_path):
    with BagWriter(tmp_path / "bag", recorded_topics(("bench/episodes",)), reserve_bytes=0, background=False) as writer:
        for block, count in enumerate((2, 1)):
            values = {
                name: np.arange(count, dtype=float) + block for name in ContactEpisodes._fields if name != "block"
            }
            values |= {"point": np.full(count, -1, np.int32), "touched": np.ones(count, np.uint8)}
            writer.write("bench/episodes", block * 10**7, encode(ContactEpisodes(block=block, **values), block * 10**7))
    columns = {
        column.name: list(column.values) for column in table_of(open_bag(tmp_path / "bag"), "bench/episodes").columns
    }
    assert columns["time"] == [0.0, 0.0, 0.01]
    assert columns["index"] == [0, 1, 0]
    assert columns["restitution"] == [0.0, 1.0, 1.0]


def test_what_exists_is_kept_and_what_is_not_there_is_named(car, folder, tmp_path):
    with pytest.raises(FileRefusedError):
        list(export(car, "csv", ("tire/force",), folder))
    with pytest.raises(BagError, match="no topic called"):
        list(export(car, "csv", ("tire/none",), tmp_path / "none"))
    assert not (tmp_path / "none").exists()
    with pytest.raises(FileRefusedError, match="is a file; --out names a folder"):
        list(export(car, "csv", (), folder / "tire_force.csv"))


def test_parquet_without_pyarrow_is_one_sentence(car, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("contact_sim_pkg.report.export.write.find_spec", lambda _: None)
    assert main(["export", str(car.path.parent), "--parquet", "--out", str(tmp_path / "out")]) == 2
    assert (
        capsys.readouterr().err
        == "bench: --parquet needs pyarrow, which is not installed; pip install pyarrow, or --csv\n"
    )
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(importlib.util.find_spec("pyarrow") is None, reason="pyarrow is not installed")
def test_parquet_holds_the_same_with_units(car, tmp_path):
    from pyarrow import parquet

    (path,) = export(car, "parquet", ("tire/force",), tmp_path / "out")
    table = parquet.read_table(path)
    assert table.schema.field("normal [N]").metadata == {b"unit": b"N"}
    assert table["normal [N]"].to_numpy().tolist() == np.concatenate([*car.columns("tire/force")["normal"]]).tolist()


def force(first):
    values = {name: np.arange(3.0) + first for name in ("normal", "tangential", "approach", "effective_height")}
    return ContactForce(block=1, sample_period=1e-3, impulses=np.zeros(0), **values)


def foreign(folder, messages, names):
    """A bag of messages on topics of our table that have other names."""
    written = [(topic, number, encode(message, number)) for number, (topic, message) in enumerate(messages)]
    return write(folder, Content({}, written, names=names))


@pytest.mark.fault("E13", "G15")
def test_each_topic_has_a_file_of_its_own(tmp_path, capsys):
    """`/a/b` and `/a_b` have one name as files, a map and a topic another; one topic has a name too long for a file."""
    long = "/" + 253 * "x"
    names = {"tire/force": "/a/b", "seat/force": "/a_b", "bench/scene": long}
    messages = [("tire/force", force(1)), ("seat/force", force(5)), ("bench/scene", String(data="a text"))]
    bag = foreign(tmp_path / "bag", messages, names)
    assert main(["export", str(bag), "--csv", "--out", str(tmp_path / "out")]) == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["a_b.csv", "a_b_2.csv", 200 * "x" + ".csv"]
    assert read(tmp_path / "out" / "a_b.csv")["normal [N]"] == ["1.0", "2.0", "3.0"]
    assert read(tmp_path / "out" / "a_b_2.csv")["normal [N]"] == ["5.0", "6.0", "7.0"]
    said = capsys.readouterr().err.splitlines()
    assert sorted(said) == ["/a_b is in a_b_2.csv", f"{long} is in {200 * 'x'}.csv"]


@pytest.mark.fault("E13")
@pytest.mark.parametrize("in_the_way", ["tire_patch_pressure.csv", "bench_cost.csv"])
def test_what_is_in_the_way_is_found_before_the_first_file(car, tmp_path, in_the_way):
    """The file of a map, and that of the last topic."""
    (tmp_path / in_the_way).write_text("mine")
    with pytest.raises(FileRefusedError, match="exists already"):
        list(export(car, "csv", (), tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == [in_the_way]
    (tmp_path / in_the_way).unlink()
    (tmp_path / in_the_way).mkdir()
    with pytest.raises(FileRefusedError, match="is a directory"):
        list(export(car, "csv", (), tmp_path, overwrite=True))
    assert [path.name for path in tmp_path.iterdir()] == [in_the_way]


@pytest.mark.fault("G15")
def test_texts_stay_texts_and_numbers_numbers(tmp_path):
    texts = ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "plain", "1=1", ""]
    bag = foreign(tmp_path / "bag", [("bench/scene", String(data=text)) for text in texts], {"bench/scene": "/note"})
    (path,) = export(open_bag(bag), "csv", (), tmp_path / "out")
    table = read(path)
    assert table["data"] == ["'=1+1", "'+1", "'-1", "'@SUM(A1)", "'\t=1", "plain", "1=1", ""]
    # without a header the time is that of the log
    assert [float(text) for text in table["time [s]"]] == pytest.approx(np.arange(8) * 1e-9, abs=1e-15)
    bag = foreign(tmp_path / "numbers", [("tire/force", force(-4))], {})
    (path,) = export(open_bag(bag), "csv", ("tire/force",), tmp_path / "numbers" / "out")
    assert read(path)["normal [N]"] == ["-4.0", "-3.0", "-2.0"]


@pytest.mark.fault("G13")
def test_a_table_beyond_the_limit_of_memory_is_refused(tmp_path, monkeypatch):
    """24 texts of 1 MB in a bag of a few kB; with a limit of 10 MB."""
    monkeypatch.setenv("CONTACT_BENCH_MEMORY", "0.01")
    texts = [("bench/scene", String(data="x" * 1_000_000)) for _ in range(24)]
    bag = foreign(tmp_path / "bag", texts, {"bench/scene": "/note"})
    assert bag.stat().st_size < 100_000
    with pytest.raises(MemoryLimitError, match=r"/note: the table of its first 3 messages needs .* limit 0.01 GiB"):
        list(export(open_bag(bag), "csv", (), tmp_path / "out"))
    monkeypatch.setenv("CONTACT_BENCH_MEMORY", "1")
    (path,) = export(open_bag(bag), "csv", (), tmp_path / "out")
    assert len(path.read_bytes()) > 24_000_000


def test_the_own_time_of_a_message_has_one_name(tmp_path):
    kind = "contact_msgs_defs/msg/RollerVolumes"
    bag = open_bag(roller_bag(tmp_path))
    columns = bag.columns("roller/volumes")
    table = {column.name: column.values for column in table_of(bag, "roller/volumes").columns}
    assert bag.topic("roller/volumes").type == kind
    assert columns["time"].tolist() == table["time"].tolist() == [2.0]
    assert columns["time_in_message"].tolist() == table["time_in_message"].tolist() == [2.5]
    assert bag.columns("roller/volumes", ("time_in_message",)).keys() == {"time_in_message"}


def roller_bag(folder):
    """One message, stamped 2 s, on an instant at 2.5 s."""
    values = dict.fromkeys(RollerVolumes._fields, 4.0) | {"volume": np.full(7, 3.0), "with_bending": np.zeros(0)}
    message = RollerVolumes(**values | {"block": 1, "time": 2.5})
    return write(folder / "bag", Content({}, [("roller/volumes", 2 * 10**9, encode(message, 2 * 10**9))]))
