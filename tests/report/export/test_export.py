"""Exported tables read back equal the bag."""

import csv
import importlib.util

import numpy as np
import pytest
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bag.hand_made import Content, write
from tests.report import uneven_bag as known

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import RecordedTopic, recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.typestore import definition, type_hash
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.memory import MemoryLimitError
from contact_sim_pkg.records.messages import (
    AxleForce,
    ContactEpisodes,
    ContactForce,
    RollerVolumes,
    Series,
    SolverCost,
    String,
)
from contact_sim_pkg.report.export import write as write_module
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.report.export.write import export


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert {len(row) for row in rows} == {len(header)}, "a spreadsheet sees a rectangle"
    return {name: [row[place] for row in rows] for place, name in enumerate(header)}


def test_a_large_map_is_written_where_its_topic_is_named(car, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(write_module, "LARGEST_MAP", 1000)
    names = [path.name for path in export(car, "csv", (), tmp_path / "all")]
    assert "tire_patch.csv" in names
    assert "tire_patch_pressure.csv" not in names
    cells = sum(message.rows * message.cols for _, message in car.decoded("tire/patch"))
    [note] = car.notes
    assert note.startswith(f"/tire/patch pressure: {cells:,} cells in {car.count('tire/patch')} frames, ")
    assert note.endswith("it is left out, --topic /tire/patch writes it")
    car.notes.clear()
    named = [path.name for path in export(car, "csv", ("tire/patch",), tmp_path / "named")]
    assert named == ["tire_patch.csv", "tire_patch_pressure.csv"]


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


@pytest.fixture(scope="module")
def by_rosbags(uneven):
    """Messages of each topic as rosbags reads them by the definitions in the bag, and their log times [ns]."""
    found = {}
    with Reader(uneven.path.parent) as reader:
        for connection, time, data in reader.messages():
            store = get_typestore(Stores.EMPTY)
            store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
            found.setdefault(connection.topic, []).append((time, store.deserialize_cdr(data, connection.msgtype)))
    return found


@pytest.fixture(scope="module")
def uneven_folder(uneven, tmp_path_factory):
    out = tmp_path_factory.mktemp("export") / "uneven"
    return out, [path.name for path in export(uneven, "csv", (), out)]


def numbers(texts):
    return np.array([float(text or "nan") for text in texts])


def stamps(messages):
    return np.array([each.header.stamp.sec + 1e-9 * each.header.stamp.nanosec for _, each in messages])


def test_rows_of_samples_equal_those_that_rosbags_reads(uneven_folder, by_rosbags):
    for topic, file in (
        ("/tire/force", "tire_force.csv"),
        ("/seat/force", "seat_force.csv"),
        ("/tire/axle", "tire_axle.csv"),
    ):
        table, messages = read(uneven_folder[0] / file), by_rosbags[topic]
        times = [begin + known.PERIOD * np.arange(known.SAMPLES) for begin in stamps(messages)]
        np.testing.assert_allclose(numbers(table["time [s]"]), np.concatenate(times), rtol=1e-14)
        assert numbers(table["block"]).tolist() == np.repeat(11 + np.arange(known.BLOCKS), known.SAMPLES).tolist()
        columns = [name for name in table if name not in ("time [s]", "block")]
        assert len(columns) >= 5
        for column in columns:
            expected = np.concatenate([getattr(each, column.split(" [")[0]) for _, each in messages])
            assert numbers(table[column]).tolist() == expected.tolist()


def test_columns_of_bodies_have_the_unit_of_their_quantity_and_the_rows_of_their_body(uneven_folder, by_rosbags):
    table, messages = read(uneven_folder[0] / "bench_motion.csv"), by_rosbags["/bench/motion"]
    units = {"position": "m", "velocity": "m/s", "acceleration": "m/s^2"}
    assert [name for name in table if "." in name] == [
        f"{name}.{body} [{unit}]" for name, unit in units.items() for body in known.BODIES
    ]
    for name, unit in units.items():
        rows = np.concatenate([getattr(each, name).reshape(len(known.BODIES), -1) for _, each in messages], axis=1)
        for body, row in zip(known.BODIES, rows, strict=True):
            assert numbers(table[f"{name}.{body} [{unit}]"]).tolist() == row.tolist()


def test_scalars_of_a_message_are_a_row_with_its_stamp(uneven_folder, by_rosbags):
    units = {"load": "N", "peak": "Pa", "area": "m^2", "centre_y": "m", "lame_n": "", "cell_y": "m"}
    for topic, file in (("/tire/patch", "tire_patch.csv"), ("/seat/patch", "seat_patch.csv")):
        table, messages = read(uneven_folder[0] / file), by_rosbags[topic]
        np.testing.assert_allclose(numbers(table["time [s]"]), stamps(messages), rtol=1e-14)
        for name, unit in units.items():
            column = table[f"{name} [{unit}]" if unit else name]
            assert numbers(column).tolist() == [getattr(each, name) for _, each in messages]


def test_events_have_the_stamp_of_their_message_and_a_number_in_it(uneven_folder, by_rosbags):
    table, messages = read(uneven_folder[0] / "bench_episodes.csv"), by_rosbags["/bench/episodes"]
    np.testing.assert_allclose(numbers(table["time [s]"]), np.repeat(stamps(messages), (2, 3)), rtol=1e-14)
    assert table["index"] == ["0", "1", "0", "1", "2"]
    for name, unit in (("start", "s"), ("compression_work", "J"), ("peak_force", "N"), ("largest_approach", "m")):
        expected = np.concatenate([getattr(each, name) for _, each in messages])
        assert numbers(table[f"{name} [{unit}]"]).tolist() == expected.tolist()


def test_a_map_lies_as_its_message_has_it(uneven_folder, by_rosbags):
    messages = by_rosbags["/seat/patch"]
    lines = (uneven_folder[0] / "seat_patch_pressure.csv").read_text().splitlines()
    assert lines[0] == "pressure [Pa],rows,6,cols,4"
    assert lines[1] == "cell_x [m],0.011,cell_y [m],0.007,origin_x [m],-0.021,origin_y [m],0.005"
    frames = [lines[start : start + 7] for start in range(2, len(lines), 7)]
    assert len(frames) == known.BLOCKS
    for number, (frame, (_, message)) in enumerate(zip(frames, messages, strict=True)):
        assert frame[0] == f"frame,{number},time [s],{3.73 + 0.01 * number:.2f},rows,6,cols,4"
        values = np.array([line.split(",") for line in frame[1:]], dtype=np.float32)
        np.testing.assert_array_equal(values, message.pressure.reshape(6, 4))


def test_short_arrays_are_empty_behind_their_end_and_named_columns_have_units_of_their_own(tmp_path):
    """Three estimates in one block, one in the next; columns of a plug-in, each with a unit."""
    blocks = ((0.03, ("a", "b", "c"), (1.5, 2.5, 3.5)), (0.07, ("a",), (4.5,)))
    values = np.random.default_rng(8).uniform(size=(3, 5))
    with BagWriter(tmp_path / "bag", recorded_topics(("bench/cost",)), reserve_bytes=0, background=False) as writer:
        for time, names, errors in blocks:
            cost = SolverCost(
                block=1,
                wall_time=time,
                real_time_factor=2.0,
                estimated=names,
                estimated_error=errors,
                estimated_of=errors,
            )
            writer.write("bench/cost", round(time * 1e9), encode(cost, round(time * 1e9)))
    table = {column.name: list(column.values) for column in table_of(open_bag(tmp_path / "bag"), "bench/cost").columns}
    assert table["estimated"] == ["a", "b", "c", "a"]
    assert table["estimated_error"] == [1.5, 2.5, 3.5, 4.5]
    assert table["wall_time"] == table["time"] == [0.03, 0.03, 0.03, 0.07]
    assert table["index"] == [0, 1, 2, 0]
    kind = "contact_msgs_defs/msg/Series"
    row = RecordedTopic("plugin/series", "/plugin/series", kind, definition(kind), type_hash(kind), "")
    with BagWriter(tmp_path / "own", (row,), reserve_bytes=0, background=False) as writer:
        series = Series(
            block=4, sample_period=0.002, names=("torque", "slide", "share"), units=("N m", "m/s", "1"), values=values
        )
        writer.write("plugin/series", 250_000_000, encode(series, 250_000_000))
    own = table_of(open_bag(tmp_path / "own"), "plugin/series")
    assert [column.header for column in own.columns] == [
        "time [s]", "block", "values.torque [N m]", "values.slide [m/s]", "values.share [1]",
    ]  # fmt: skip
    np.testing.assert_allclose(own.columns[0].values, 0.25 + 0.002 * np.arange(5))
    for column, expected in zip(own.columns[2:], values, strict=True):
        assert column.values.tolist() == expected.tolist()


def test_a_column_that_a_block_lacks_is_empty_there_and_full_beside_it(tmp_path):
    along, aside = np.random.default_rng(9).uniform(-9.0, 9.0, (2, 5)), np.array([1.5, -2.5, 3.5])
    with BagWriter(tmp_path / "bag", recorded_topics(("tire/axle",)), reserve_bytes=0, background=False) as writer:
        for stamp, own in ((0, {}), (10_000_000, {"lateral": aside})):
            force = along[int(stamp > 0)][: len(aside) if own else 5]
            axle = AxleForce(block=1, sample_period=0.002, longitudinal=force, vertical=2.0 * force, **own)
            writer.write("tire/axle", stamp, encode(axle, stamp))
    (path,) = export(open_bag(tmp_path / "bag"), "csv", (), tmp_path / "out")
    table = read(path)
    assert numbers(table["longitudinal [N]"]).tolist() == [*along[0], *along[1][:3]]
    assert table["lateral [N]"] == ["", "", "", "", "", "1.5", "-2.5", "3.5"]
    np.testing.assert_allclose(
        numbers(table["time [s]"]), [0.0, 0.002, 0.004, 0.006, 0.008, 0.01, 0.012, 0.014], atol=1e-15
    )


def test_a_foreign_topic_has_its_units_and_each_element_its_own_column(tmp_path):
    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    name, random = "geometry_msgs/msg/WrenchStamped", np.random.default_rng(6).uniform(-9.0, 9.0, (5, 6))
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/sensor/wrench", name, typestore=store)
        for number, row in enumerate(random):
            stamp = types["builtin_interfaces/msg/Time"](12 + number, 250_000_000 + number)
            vectors = [types["geometry_msgs/msg/Vector3"](*map(float, part)) for part in (row[:3], row[3:])]
            message = types[name](
                types["std_msgs/msg/Header"](stamp, "sensor"), types["geometry_msgs/msg/Wrench"](*vectors)
            )
            writer.write(connection, 99 * 10**9 + number, store.serialize_cdr(message, name))
    (path,) = export(open_bag(tmp_path / "bag"), "csv", (), tmp_path / "out")
    table = read(path)
    np.testing.assert_allclose(numbers(table["time [s]"]), 12.25 + np.arange(5) * (1.0 + 1e-9), rtol=1e-14)
    headers = [f"wrench.{part}.{axis} [{unit}]" for part, unit in (("force", "N"), ("torque", "N m")) for axis in "xyz"]
    assert [header for header in table if "wrench" in header] == headers
    for header, column in zip(headers, random.T, strict=True):
        assert numbers(table[header]).tolist() == column.tolist()


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
    assert (columns["time"].tolist(), columns["time_in_message"].tolist()) == ([2.0], [2.5])
    assert {*table["time"].tolist()} == {2.0}  # a row a volume
    assert {*table["time_in_message"].tolist()} == {2.5}
    assert bag.columns("roller/volumes", ("time_in_message",)).keys() == {"time_in_message"}


def roller_bag(folder):
    """One message, stamped 2 s, on an instant at 2.5 s."""
    values = dict.fromkeys(RollerVolumes._fields, 4.0) | {"volume": np.full(7, 3.0), "with_bending": np.zeros(0)}
    message = RollerVolumes(**values | {"block": 1, "time": 2.5})
    return write(folder / "bag", Content({}, [("roller/volumes", 2 * 10**9, encode(message, 2 * 10**9))]))
