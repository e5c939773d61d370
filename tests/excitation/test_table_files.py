"""Files of data loggers give the columns that were written into them by other libraries."""

import math

import numpy
import pytest
from scipy.io import savemat, wavfile

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded import RecordedVibration
from contact_sim_pkg.excitation.table_files import read_recording

RATE, G = 500.0, 9.80665
TIME = numpy.arange(2000) / RATE
X = 0.4 * numpy.sin(2.0 * math.pi * 2.0 * TIME)
Z = 1.5 * numpy.sin(2.0 * math.pi * 4.0 * TIME + 0.2) + G


def check(path, tolerance=1e-12, **names):
    table = read_recording(path)
    for name, expected in {"time": TIME, "x": X, "z": Z, **names}.items():
        assert table.columns[name] == pytest.approx(expected, abs=tolerance), name
    read = RecordedVibration(path)
    assert read.rate == pytest.approx(RATE, rel=1e-6)
    assert read.acceleration(TIME[200:-200])[1] == pytest.approx(Z[200:-200] - Z.mean(), abs=max(1e-6, 3.0 * tolerance))


def test_a_mat_file_with_vectors_structures_and_a_matrix(tmp_path):
    content = {
        "time": TIME,
        "acc": {"x": X[:, None], "z": Z},
        "m": numpy.stack([X, Z], axis=1),
        "name": "ride",
        "rate": RATE,
    }
    savemat(tmp_path / "a.mat", content)
    check(tmp_path / "a.mat", m_1=X, m_2=Z)


def test_a_damaged_mat_file_is_refused_before_its_reader_ends_the_process(tmp_path):
    savemat(tmp_path / "a.mat", {"time": TIME, "z": Z})
    content = bytearray((tmp_path / "a.mat").read_bytes())
    content[176:180] = (57609).to_bytes(4, "little")  # type of the samples
    (tmp_path / "a.mat").write_bytes(content)
    with pytest.raises(ExcitationError, match=r"the element at byte [0-9]+ is damaged"):
        read_recording(tmp_path / "a.mat")


def test_a_wav_file_holds_shares_of_full_scale(tmp_path):
    full = 20.0
    samples = numpy.round(numpy.stack([X, Z], axis=1) / full * 2**15).astype(numpy.int16)
    wavfile.write(tmp_path / "a.wav", round(RATE), samples)
    table = read_recording(tmp_path / "a.wav")
    assert table.columns["ch2"] * full == pytest.approx(Z, abs=full / 2**15)
    assert table.columns["time"] == pytest.approx(TIME, abs=1e-12)
    wavfile.write(tmp_path / "f.wav", round(RATE), (Z / full).astype(numpy.float32))
    assert read_recording(tmp_path / "f.wav").columns["ch1"] * full == pytest.approx(Z, rel=1e-6)


def test_mat_7_3_is_read_by_h5py(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "a.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in {"time": TIME, "x": X, "z": Z}.items():
            file[name] = values[None]
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(128))
    check(path)


def test_mdf_is_read_by_asammdf(tmp_path):
    asammdf = pytest.importorskip("asammdf")
    file = asammdf.MDF(version="4.10")
    file.append([asammdf.Signal(X, TIME, "m/s^2", "x"), asammdf.Signal(Z / G, TIME, "g", "z")])
    file.save(tmp_path / "a.mf4")
    check(tmp_path / "a.mf4")


def test_tdms_is_read_by_nptdms(tmp_path):
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        step = {"wf_increment": 1.0 / RATE, "wf_start_offset": 0.0, "unit_string": "m/s^2"}
        writer.write_segment(
            [nptdms.ChannelObject("g", name, values, step) for name, values in {"x": X, "z": Z}.items()]
        )
    check(tmp_path / "a.tdms")


def test_uff_58_is_read_by_pyuff(tmp_path):
    pyuff = pytest.importorskip("pyuff")
    axes, kinds = (
        ("abscissa", "ordinate", "orddenom", "z_axis"),
        ("spec_data_type", "len_unit_exp", "force_unit_exp", "temp_unit_exp"),
    )
    units = {f"{axis}_{kind}": 0 for axis in axes for kind in kinds}
    for name, values in {"x": X, "z": Z}.items():
        pyuff.UFF(str(tmp_path / "a.uff")).write_sets(
            pyuff.prepare_58(
                binary=1, func_type=1, ver_num=0, load_case_id=0, rsp_ent_name="NONE", ref_ent_name="NONE", id1=name, x=TIME,
                data=values, abscissa_spacing=1, abscissa_inc=1.0 / RATE, abscissa_min=0.0, num_pts=len(values),
                ord_data_type=4, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, z_axis_value=0.0,
                ordinate_axis_units_lab="m/s^2", **units, return_full_dict=True,
            ),
            mode="add",
        )  # fmt: skip
    check(tmp_path / "a.uff", tolerance=1e-6)


def test_what_is_absent_damaged_or_uneven_is_refused_in_a_sentence(tmp_path, monkeypatch):
    for name in ("a.mat", "a.wav"):
        (tmp_path / name).write_bytes(bytes(range(200)))
        with pytest.raises(ExcitationError, match=r"cannot be read as \.|holds no columns"):
            read_recording(tmp_path / name)
    savemat(tmp_path / "b.mat", {"time": TIME, "z": Z[:-1]})
    with pytest.raises(
        ExcitationError, match=r"its columns differ in length \(time 2000, z 1999\); export those of one rate"
    ):
        read_recording(tmp_path / "b.mat")
    savemat(tmp_path / "c.mat", {"note": "nothing"})
    with pytest.raises(ExcitationError, match="holds no columns of samples"):
        read_recording(tmp_path / "c.mat")
    with pytest.raises(ExcitationError, match=r"cannot be read: No such file"):
        read_recording(tmp_path / "none.mat")
    (tmp_path / "a.tdms").write_bytes(b"TDSm")
    monkeypatch.setattr(
        "contact_sim_pkg.excitation.table_files.import_module", lambda name: __import__(f"absent_{name}")
    )
    with pytest.raises(
        ExcitationError, match=r"read by nptdms, which is not installed; pip install 'contact_sim_pkg\[daq\]'"
    ):
        read_recording(tmp_path / "a.tdms")


def test_a_bag_drives_a_rig_as_its_table_does(tmp_path):
    """√2 sin(2π 16 t) + g upwards at 100 Hz, in a folder of one file, by `--vibration` without a rate."""
    from tests.bag import foreign

    from contact_sim_pkg.scene.load import load_scene
    from contact_sim_pkg.scene.overrides import set_vibration
    from contact_sim_pkg.scene.resolve import resolve

    folder = foreign.sqlite(tmp_path)
    scene = resolve(load_scene("seat_ride", [set_vibration(folder)]))
    assert scene.data["vibration"]["file"].endswith("sqlite.db3")
    read = RecordedVibration(folder / "sqlite.db3")
    time = numpy.arange(200, 1400) / 100.0
    assert read.rate == pytest.approx(100.0)
    assert read.acceleration(time)[1] == pytest.approx(
        math.sqrt(2.0) * numpy.sin(2.0 * math.pi * 16.0 * time), abs=2e-3
    )
    from contact_sim_pkg.bag.errors import BagError

    note = foreign.mcap([row for row in foreign.ROWS if row[0] == "/note"], {"/note": foreign.TEXT})
    (tmp_path / "note.mcap").write_bytes(note)
    with pytest.raises(BagError, match=r"holds no Imu and no AccelStamped; .*bench export"):
        RecordedVibration(tmp_path / "note.mcap")
