"""Pressure mats: load, centre and times by closed forms, what is not known refused with its cure, mutants never a traceback."""

import math
import random

import numpy
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore
from scipy import ndimage

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags
from contact_sim_pkg.standard.imported_mats import FRONTS, import_mat
from contact_sim_pkg.standard.mat_files import is_mat, read_mat

QUARTER = """
10.424,20.304,28.336
28.336,55.191,77.025
55.191,107.497,150.024
77.025,150.024,209.376
"""
"""A corner [kPa] of a mat of 8 by 6 cells of 10.16 mm that carries 400 N, even in both directions."""
ROWS, COLS, PITCH = 10, 7, 0.0127
MMHG = 133.322387415
"""[Pa] conventional millimetre of mercury, ISO 80000-4"""


def bump(row, col, peak=20e3):
    """A paraboloid of pressure [Pa] whose top lies at a row and column."""
    i, j = numpy.mgrid[0:ROWS, 0:COLS]
    return numpy.maximum(0.0, peak * (1.0 - ((i - row) / 4.0) ** 2 - ((j - col) / 3.0) ** 2))


FRAMES = [bump(4.3, 2.6), bump(4.0, 3.0, 24e3), bump(4.6, 3.4, 22e3)]


def cells(frame, separator=",", form="{:.4f}", quote=""):
    return "\n".join(separator.join(f"{quote}{form.format(v)}{quote}" for v in row) for row in frame)


def tekscan(frames=FRAMES, unit="kPa", factor=1e3, head="", first=1, tail=""):
    keys = [
        "DATA_TYPE MOVIE", "VERSION Tekscan 7", "TIME 01/02/2020 10:11:12", f"ROWS {ROWS}", f"COLS {COLS}", "ROW_SPACING 12.7 mm",
        "COL_SPACING 1.27 cm", "SENSEL_AREA 161.29 mm2", "SECONDS_PER_FRAME 0.02", f"UNITS {unit}", f"END_FRAME {len(frames)}",
        *([head] if head else []), "COMMENTS drawn: by hand, twice", "ASCII_DATA @@", "",
    ]  # fmt: skip
    blocks = [f"Frame {first + place}\n{cells(frame / factor)}\n" for place, frame in enumerate(frames)]
    return "\n".join([*(f"{key}{tail}" for key in keys), *blocks, "@@", ""])


def xsensor(frames=FRAMES, unit="mmHg", factor=MMHG, comma=False, **changed):
    """Keys before each frame, as its text export has them; with decimal commas every number is quoted."""
    text = "FILE NAME:,drive.xsn\n"
    for place, frame in enumerate(frames):
        keys = {
            "Frame": place + 1, "Date": "2020-02-01", "Time": f'"10:11:{12.5 + 0.25 * place:06.3f}"', "Sensor": "PX100",
            "Rows": ROWS, "Columns": COLS, "Sensel Width (cm)": '"1,27"' if comma else "1.27", "Sensel Height (cm)": "1.27",
            "Average Pressure (mmHg)": 1.0, "COP Row": 4.0, "Units": unit,
        }  # fmt: skip
        keys = {key: value for key, value in (keys | changed).items() if value is not None}
        rows = cells(frame / factor, quote='"').replace(".", ",") if comma else cells(frame / factor)
        text += "".join(f"{key}:,{value}\n" for key, value in keys.items()) + rows + "\n\n"
    return text


def written(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path


VARIANTS = {
    "tekscan": (tekscan(), 0.02), "psi": (tekscan(unit="PSI", factor=6894.757293168), 0.02),
    "trailing commas": (tekscan(tail=",,,,,,"), 0.02), "mpa": (tekscan(unit="N/cm2", factor=1e4), 0.02),
    "xsensor": (xsensor(), 0.25), "decimal commas": (xsensor(comma=True), 0.25), "semicolons": (xsensor().replace(",", ";"), 0.25),
}  # fmt: skip


@pytest.mark.parametrize("name", VARIANTS)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_each_maker_s_file_gives_pressures_and_times(tmp_path, name, encoding):
    text, period = VARIANTS[name]
    source = written(tmp_path / "mat.csv", text, encoding)
    assert is_mat(source)
    mat = read_mat(source)
    assert mat.frames == pytest.approx(numpy.stack(FRAMES), abs=1.0)  # four digits of a kPa, an mmHg or N/cm²
    assert mat.times == pytest.approx(period * numpy.arange(len(FRAMES)))
    assert (mat.row_pitch, mat.col_pitch) == pytest.approx((PITCH, PITCH))


def test_a_bag_of_a_mat_is_what_another_library_reads(tmp_path):
    source = written(tmp_path / "mat.csv", tekscan())
    import_mat(source, tmp_path / "bag")
    store = get_typestore(Stores.ROS2_JAZZY)
    with AnyReader([tmp_path / "bag"], default_typestore=store) as reader:
        found = [(time, reader.deserialize(data, row.msgtype)) for row, time, data in reader.messages()]
    assert [time for time, _ in found] == [0, 20_000_000, 40_000_000]
    for (_, message), frame in zip(found, FRAMES, strict=True):
        assert (message.rows, message.cols) == (ROWS, COLS)
        assert message.pressure.reshape(ROWS, COLS) == pytest.approx(frame, abs=0.1)
        assert message.load == pytest.approx(frame.sum() * PITCH**2, rel=1e-5)
        assert math.isnan(message.approach)
        middle = ndimage.center_of_mass(frame)
        assert (message.centre_x, message.centre_y) == pytest.approx(
            (PITCH * (middle[0] - 4.5), PITCH * (middle[1] - 3.0)), abs=1e-6
        )
    kept = open_bag(tmp_path / "bag").metadata
    assert kept["imported_from"] == "mat.csv"
    assert "3 frames of 10 by 7 cells of 12.7 by 12.7 mm, pressures in kPa, at 50 Hz." in kept["imported_as"]


def test_metrics_of_a_mat_are_those_of_its_mean_map(tmp_path, capsys):
    source = written(tmp_path / "mat.csv", tekscan())
    assert main(["import", str(source), "--out", str(tmp_path / "bag")]) == 0
    found = {each.key: each for each in metrics_of_bags([tmp_path / "bag"]).metrics}
    average = numpy.mean(FRAMES, axis=0)
    middle = ndimage.center_of_mass(average)
    assert found["seat.map_load"].value == pytest.approx(average.sum() * PITCH**2, rel=1e-5)
    assert found["seat.map_area"].value == pytest.approx(1e4 * PITCH**2 * (average > 1.0).sum())
    assert found["seat.centre_x"].value == pytest.approx(1e3 * PITCH * (middle[0] - 4.5), abs=1e-3)
    assert f"row {middle[0]:.4g} of" in found["seat.centre_x"].remark
    assert f"column {middle[1]:.4g} of" in found["seat.centre_y"].remark
    above = average[average > 5e3]
    found = {each.key: each.value for each in metrics_of_bags([tmp_path / "bag"], loaded=5e3).metrics}
    assert found["seat.map_area"] == pytest.approx(1e4 * PITCH**2 * above.size)
    assert found["seat.map_mean"] == pytest.approx(1e-3 * above.mean(), rel=1e-5)
    assert found["seat.map_spd"] == pytest.approx(25.0 * (above.std() / above.mean()) ** 2, rel=1e-4)
    capsys.readouterr()
    assert main(["metrics", str(tmp_path / "bag")]) == 0
    assert "pressures in kPa" in capsys.readouterr().err


def test_the_front_says_how_the_map_lies(tmp_path):
    """A cell at row 1, column 2 of the file goes to the front, to its left, behind it or to its right."""
    frame = numpy.zeros((ROWS, COLS))
    frame[1, 2] = 1e3
    source = written(
        tmp_path / "mat.csv", tekscan([frame], head="x").replace("COL_SPACING 1.27 cm", "COL_SPACING 10 mm")
    )
    places = {"bottom": (1, 2), "left": (COLS - 3, 1), "top": (ROWS - 2, COLS - 3), "right": (2, ROWS - 2)}
    for front in FRONTS:
        import_mat(source, tmp_path / front, front=front)
        columns = open_bag(tmp_path / front).columns("/seat/patch", ("rows", "cols", "cell_x", "cell_y", "pressure"))
        shape = int(columns["rows"][0]), int(columns["cols"][0])
        assert tuple(numpy.argwhere(columns["pressure"][0].reshape(shape) > 0.0)[0]) == places[front], front
        assert (columns["cell_x"][0], columns["cell_y"][0]) == (
            (PITCH, 0.01) if front in ("bottom", "top") else (0.01, PITCH)
        )
    import_mat(source, tmp_path / "back", contact="backrest")
    assert (
        numpy.argmax(open_bag(tmp_path / "back").columns("/backrest/patch", ("pressure",))["pressure"][0])
        == (ROWS - 2) * COLS + COLS - 3
    )


def test_what_the_cells_hold_beside_pressures_is_said(tmp_path):
    text = (
        tekscan(head="SATURATION_PRESSURE 23.9 kPa").replace("\n0.0000,", "\nB,", 2).replace("\n0.0000,", "\n-0.1,", 2)
    )
    text = text.replace("Frame 3", "Frame 5").replace("END_FRAME 3", "END_FRAME 9").replace("161.29", "100.0")
    source = written(tmp_path / "mat.csv", text)
    notes = " ".join(read_mat(source).notes)
    assert "none of the sensor (B): taken as unloaded" in notes
    assert "2 values lie below 0" in notes
    assert "announces frames up to 9, the last one is 5" in notes
    assert "missing at 1 places" in notes
    assert "1 values are saturated (23.9 kPa): load and peak are larger" in notes
    assert "A cell has 100.0 mm2, its pitch says 161.3 mm²" in notes
    import_mat(source, tmp_path / "bag")
    for metric in metrics_of_bags([tmp_path / "bag"]).metrics:
        assert [text[:6] for text in metric.broken] == ["A cell", "1 valu"], metric.key


REFUSED = {
    "raw": (tekscan(unit="RAW"), {}, r"holds RAW, and counts are no pressures; calibrate"),
    "no unit": (xsensor(Units=None), {}, r"states no unit, .* --unit Pa\|kPa"),
    "force": (tekscan(unit="N"), {}, r"'N' is no unit of a pressure"),
    "two units": (tekscan(), {"unit": "psi"}, r"--unit is psi, the file states kPa"),
    "no pitch": (xsensor(**{"Sensel Width (cm)": None}), {}, r"distance of its cells \(col_pitch\); state it by --pitch MM"),
    "other pitch": (tekscan(), {"pitch": 0.01}, r"--pitch is 10 mm, the file states 12.7 mm"),
    "pitch without unit": (tekscan().replace("12.7 mm", "12.7"), {}, r"row_pitch is '12.7' .* a length of 0.1 mm to 1 m"),
    "no times": (xsensor(Time=None), {}, r"frames have no times; state their rate by --rate HZ"),
    "same times": (xsensor(Time="10:11:12"), {}, r"line \d+: frame 2 is not later .* --rate HZ"),
    "time in words": (xsensor(Time="noon"), {}, r"'noon' is no time of day"),
    "cut": (tekscan().rsplit("\n", 7)[0], {}, r"ends in frame 3, after 6 of 10 rows; export it again"),
    "cut in a row": (tekscan()[:-60], {}, r"'' is no pressure|\d cells in a row"),
    "short row": (tekscan().replace("\n0.0000,", "\n", 1), {}, r"line 16: 6 cells in a row, 7 columns are stated"),
    "word": (tekscan().replace("0.0000,", "x,", 1), {}, r"frame 1 has 9 of 10 rows"),
    "nan": (tekscan().replace("\n0.0000,", "\nnan,", 1), {}, r"frame 1|'nan' is no pressure"),
    "missing row": (tekscan().replace(cells(FRAMES[0] / 1e3).split("\n")[4] + "\n", ""), {}, r"frame 1 has 9 of 10 rows"),
    "two sensors": (xsensor(FRAMES[:1]) + xsensor(FRAMES[:1], Sensor="PX200"), {}, r"sensor is 'PX200' and was 'PX100'"),
    "no frame": (tekscan([]), {}, r"holds no frame"),
    "no rows": (tekscan().replace(f"ROWS {ROWS}", "ROWS many"), {}, r"rows is 'many'"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_known_is_refused_with_its_cure(tmp_path, name):
    text, options, words = REFUSED[name]
    with pytest.raises(BagError, match=words) as found:
        read_mat(written(tmp_path / "mat.csv", text), **options)
    assert "mat.csv" in str(found.value)


def test_options_say_what_the_file_does_not_and_others_are_named(tmp_path, capsys):
    bare = xsensor(Units=None, Time=None, **{"Sensel Width (cm)": None, "Sensel Height (cm)": None})
    source = written(tmp_path / "mat.csv", bare)
    stated = ["--unit", "mmHg", "--pitch", "12.7", "--rate", "10", "--front", "top"]
    assert main(["import", str(source), "--out", str(tmp_path / "bag"), *stated]) == 0
    assert "mmHg as stated, at 10 Hz" in capsys.readouterr().err
    for options, words in (
        (["--axes", "z=a"], "--axes does not apply"),
        (["--unit", "g"], "--unit g is no unit of what"),
    ):
        assert main(["import", str(source), "--out", str(tmp_path / "no"), *options]) == 2
        assert words in capsys.readouterr().err
    table = written(tmp_path / "a.csv", "time,z\n" + "".join(f"{0.01 * k},{9.8 + 0.01 * k}\n" for k in range(50)))
    for options, words in ((["--pitch", "10"], "--pitch does not apply"), (["--unit", "kPa"], "--unit kPa is no unit")):
        assert main(["import", str(table), "--out", str(tmp_path / "no"), *options]) == 2
        assert words in capsys.readouterr().err
    assert not (tmp_path / "no").exists()


def test_a_mat_of_400_newtons_has_its_peak_and_centre_in_its_middle(tmp_path):
    corner = numpy.array([[float(v) for v in line.split(",")] for line in QUARTER.split()])
    whole = numpy.block([[corner, corner[:, ::-1]], [corner[::-1], corner[::-1, ::-1]]])
    text = "DATA_TYPE MOVIE\nROWS 8\nCOLS 6\nROW_SPACING 10.16 mm\nCOL_SPACING 10.16 mm\nUNITS KPa\nASCII_DATA @@\n\nFrame 1\n"
    import_mat(written(tmp_path / "mat.csv", text + cells(whole, form="{:.3f}") + "\n"), tmp_path / "bag")
    found = {each.key: each for each in metrics_of_bags([tmp_path / "bag"]).metrics}
    assert found["seat.map_load"].value == pytest.approx(400.0, rel=1e-4)
    assert found["seat.map_peak"].value == pytest.approx(209.376)
    assert "row 3.5, column 2.5" in found["seat.map_peak"].remark
    assert (found["seat.centre_x"].value, found["seat.centre_y"].value) == pytest.approx((0.0, 0.0), abs=1e-6)
    assert "row 3.5 of" in found["seat.centre_x"].remark
    assert "column 2.5 of" in found["seat.centre_y"].remark


def mutant(text, seed):
    """A file that was cut, mistyped or merged somewhere."""
    chance = random.Random(seed)
    lines = text.split("\n")
    place = chance.randrange(len(lines))
    kind = chance.randrange(7)
    if kind == 0:
        return text[: chance.randrange(len(text))]
    if kind == 1:
        del lines[place]
    elif kind == 2:
        lines.insert(place, lines[chance.randrange(len(lines))])
    elif kind == 3:
        lines[place] = "".join(chance.sample(lines[place], len(lines[place])))
    elif kind == 4:
        lines[place] = lines[place].replace(
            chance.choice("0123456789.,"), chance.choice(["", "x", "-", "nan", "1e999", ";", '"', "_"])
        )
    elif kind == 5:
        lines[place] += chance.choice([",", ",9", "é", "\0", '"'])
    else:
        first, second = sorted((place, chance.randrange(len(lines))))
        lines[first:second] = lines[first:second][::-1]
    return "\n".join(lines)


def test_a_damaged_mat_is_read_whole_or_refused_by_name(tmp_path):
    """Whatever is read has whole frames of finite pressures; nothing else than a refusal is raised."""
    read, refused = 0, []
    for seed in range(200):
        source = written(tmp_path / "mat.csv", mutant(tekscan() if seed % 2 else xsensor(), seed))
        try:
            mat = read_mat(source)
        except BagError as error:
            refused.append(str(error))
            continue
        read += 1
        assert mat.frames.shape[1:] == (ROWS, COLS)
        assert numpy.isfinite(mat.frames).all()
        assert (mat.frames >= 0.0).all()
        if len(mat.frames) < len(FRAMES):
            assert any("frame" in note.lower() for note in mat.notes)
    assert all("mat.csv" in text and "\n" not in text for text in refused)
    assert min(read, len(refused)) > 20


def test_a_table_whose_logger_counts_rows_and_columns_is_no_mat(tmp_path):
    rows = "".join(f"{0.01 * k:.2f},{9.8 + 0.01 * (k % 7):.2f}\n" for k in range(50))
    assert not is_mat(written(tmp_path / "a.csv", f"Rows: 50\nColumns: 2\ntime [s],z [m/s^2]\n{rows}"))
    assert not is_mat(tmp_path)
    assert not is_mat(tmp_path / "none.csv")
