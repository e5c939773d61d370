"""Exported tables read back equal the bag."""

import csv
import importlib.util

import numpy as np
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.messages import ContactEpisodes
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
