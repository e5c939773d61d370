"""A recording imported as a bag holds what the file holds, read by another library, and every command takes it."""

import math

import numpy
import pytest
from rosbags.highlevel import AnyReader

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.standard.imported import ImportChoice, import_recording

G, RATE, COUNT = 9.80665, 200.0, 2345
TIME = numpy.arange(COUNT) / RATE
X = 0.4 * numpy.sin(2.0 * math.pi * 2.0 * TIME)
Z = 1.5 * numpy.sin(2.0 * math.pi * 4.0 * TIME) + G
FORCE = 100.0 + 10.0 * numpy.sin(TIME)


def table(path, z=Z, header="time [ms],a_x [g],acc_z [m/s²],force [kN],label"):
    rows = zip(1e3 * (TIME + 7.0), X / G, z, FORCE / 1e3, strict=True)
    path.write_text(
        "\n".join([header, *(",".join([*(f"{v:.9f}" for v in row), "a b"]) for row in rows)]), encoding="utf-8"
    )
    return path


def test_an_imported_file_is_what_another_library_reads(tmp_path):
    source = table(tmp_path / "a.csv")
    summary, notes = import_recording(source, tmp_path / "bag")
    assert summary.complete
    assert notes == ["200 Hz by the time column."]
    with AnyReader([tmp_path / "bag"]) as reader:
        by_topic = {row.topic: [] for row in reader.connections}
        for row, time, data in reader.messages():
            by_topic[row.topic].append((time, reader.deserialize(data, row.msgtype)))
    imu = by_topic["/acceleration"]
    assert len(imu) == COUNT
    assert [m.linear_acceleration.z for _, m in imu] == pytest.approx(Z, abs=1e-8)
    assert [m.linear_acceleration.x for _, m in imu] == pytest.approx(X, abs=1e-8)
    assert all(math.isnan(m.linear_acceleration.y) for _, m in imu)
    assert all(m.orientation_covariance[0] == m.angular_velocity_covariance[0] == -1.0 for _, m in imu[:3])
    assert [time / 1e9 for time, _ in imu] == pytest.approx(TIME, abs=1e-8)
    series = [m for _, m in by_topic["/series"]]
    assert [list(m.names) for m in series] == [["force"]] * 3
    assert (series[0].units[0], series[0].sample_period) == ("N", pytest.approx(1.0 / RATE))
    assert numpy.concatenate([m.values for m in series]) == pytest.approx(FORCE, abs=1e-5)
    kept = open_bag(tmp_path / "bag").metadata
    assert kept["imported_from"] == "a.csv"
    assert len(kept["imported_sha256"]) == 64


def test_every_command_takes_an_imported_bag(tmp_path, capsys):
    import_recording(table(tmp_path / "a.csv"), tmp_path / "bag")
    assert main(["metrics", str(tmp_path / "bag")]) == 1  # a ride beyond a limit
    said = capsys.readouterr()
    assert "y not recorded" in said.err
    assert main(["export", str(tmp_path / "bag"), "--csv", "--out", str(tmp_path / "out")]) == 0
    assert main(["recover", str(tmp_path / "bag"), str(tmp_path / "again")]) == 0


def test_what_is_not_known_is_refused_with_the_option_that_says_it(tmp_path):
    source = table(tmp_path / "g.csv", z=Z / G, header="time [ms],force,z,more,label")
    with pytest.raises(BagError, match=r"gravity in g and not in m/s\^2 .*--unit g"):
        import_recording(source, tmp_path / "bag")
    import_recording(source, tmp_path / "bag", ImportChoice(unit="g"))
    (tmp_path / "n.csv").write_text("z\n" + "9.8\n" * 50)
    with pytest.raises(BagError, match=r"no time column, so its sampling rate must be stated \(--rate\)"):
        import_recording(tmp_path / "n.csv", tmp_path / "none")
    assert not (tmp_path / "none").exists()
    import_recording(tmp_path / "n.csv", tmp_path / "rated", ImportChoice(rate=50.0))
    assert main(["import", str(source), "--out", str(tmp_path / "x"), "--axes", "up=z"]) == 2
    with pytest.raises(BagError, match=r"there is no column 'acc'"):
        import_recording(source, tmp_path / "y", ImportChoice(axes={"z": "acc"}))
