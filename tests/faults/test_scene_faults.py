"""Part A of docs/faults.md: scenes and settings. Each test carries the number of its row."""

import os
import subprocess
import sys
import time
import tracemalloc
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies
from tests.excitation import crg_file

import contact_sim_pkg
from contact_sim_pkg.excitation import recorded_csv
from contact_sim_pkg.excitation.opencrg import payload as opencrg_payload
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.schema.validate import validate
from contact_sim_pkg.scene.yaml.document import LARGEST_FILE, parse_document

BAD = sorted((Path(__file__).parent / "scenes" / "bad").glob("*.yaml"))
PACKAGE = str(Path(contact_sim_pkg.__file__).resolve().parents[1])
GOOD = """rig: seat
duration: 1
vibration: {kind: sine, frequency: 4, amplitude: 1}
effects: {seat: {normal_elastic: {}}}
"""


def refusal(path):
    with pytest.raises(SceneError) as caught:
        load_scene(path)
    return caught.value


def written(folder, text):
    path = folder / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def expected(path):
    """The lines `# expect LINE:COLUMN: text` at the top of a bad scene."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.removeprefix("# expect ") for line in lines if line.startswith("# expect ")]


def test_a1_there_are_bad_scenes():
    assert len(BAD) >= 15


@pytest.mark.parametrize("path", BAD, ids=lambda path: path.stem)
def test_a1_a_bad_scene_is_refused_with_exactly_the_faults_it_announces(path):
    assert str(refusal(path)).splitlines() == [f"{path}:{line}" for line in expected(path)]


@pytest.mark.parametrize("path", BAD, ids=lambda path: path.stem)
def test_a1_nothing_is_created_by_a_refusal(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refusal(path)
    assert list(tmp_path.iterdir()) == []


def test_a1_an_empty_file_is_refused(tmp_path):
    assert "1:1: is empty" in str(refusal(written(tmp_path, "")))


def test_a1_a_directory_is_refused(tmp_path):
    assert "is a directory" in str(refusal(tmp_path))


@pytest.mark.parametrize("content", [b"\x00\x01\x02", b"\xff\xfe\x00", b"MCAP0\r\n\x00", b"\x7fELF\x02\x01\x01\x00"])
def test_a1_a_binary_file_is_refused_at_a_line(tmp_path, content):
    path = tmp_path / "scene.yaml"
    path.write_bytes(content)
    fault = refusal(path).faults[0]
    assert fault.line >= 1
    assert fault.sentence


@pytest.mark.parametrize("cut", range(1, len(GOOD), 7))
def test_a1_a_scene_cut_anywhere_loads_or_is_refused(tmp_path, cut):
    path = written(tmp_path, GOOD[:cut])
    try:
        load_scene(path)
    except SceneError as error:
        assert error.faults  # noqa: PT017
    else:
        assert cut > GOOD.index("normal_elastic")


@pytest.mark.parametrize(
    "tag", ["!!python/object/apply:os.mkdir", "!!python/object/new:os.mkdir", "!!python/name:os.mkdir"]
)
def test_a2_a_tag_that_would_run_code_is_refused_and_does_not_run(tmp_path, tag):
    marker = tmp_path / "marker"
    error = refusal(written(tmp_path, GOOD + f"description: {tag} ['{marker}']\n"))
    assert "a scene holds plain data only" in str(error)
    assert not marker.exists()


def alias_bomb():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 9)]
    return "\n".join(lines)


@pytest.mark.fault("A3")
@pytest.mark.parametrize(
    ("text", "told"),
    [
        (alias_bomb(), "more than"),
        ("a: &a [*a]", "inside or before its own anchor"),
        ("a: " + "[" * 9_000, "nested deeper than 20"),
        ("a: " + "[\n" * 20_000, "nested deeper than 20"),
        ("a: " + "{b: " * 2_000, "nested deeper than 20"),
        ("".join(f"{'  ' * n}a:\n" for n in range(60)), "nested deeper than 20"),
        ("a: [" + "1,\n" * 100_000 + "]", "more than 10000"),
        ("a: " + "x" * 900_000, "at most 10000"),
    ],
    ids=[
        "alias bomb",
        "alias of itself",
        "brackets in a line",
        "20000 brackets",
        "braces",
        "indents",
        "long list",
        "long line",
    ],
)
def test_a3_a_bomb_is_refused_early_and_small(tmp_path, text, told):
    path = written(tmp_path, text)
    before = time.process_time()
    refusal(path)
    assert time.process_time() - before < 1.0  # [s] of this process, whatever else the machine does
    tracemalloc.start()
    error = refusal(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert told in str(error)
    assert peak < 50e6


@pytest.mark.fault("A3")
def test_a3_a_file_of_a_gigabyte_is_refused_unread(tmp_path):
    path = tmp_path / "huge.yaml"
    with path.open("wb") as stream:
        stream.truncate(1 << 30)
    tracemalloc.start()
    error = refusal(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert f"at most {LARGEST_FILE} bytes" in str(error)
    assert peak < 10e6


def with_mass(raw):
    return GOOD + f"seat: {{occupant: {{frame_mass: {raw}}}}}\n"


@pytest.mark.parametrize(("raw", "mass"), [("5e0", 5.0), ("5.0e0", 5.0), ("5.0e+0", 5.0), ("5", 5.0), ("0.5E1", 5.0)])
def test_a4_every_json_form_of_a_number_is_a_number(tmp_path, raw, mass):
    assert load_scene(written(tmp_path, with_mass(raw))).seat.occupant.frame_mass == mass


@pytest.mark.parametrize("raw", ["5e6", "5.0e6", "5.0e+6"])
def test_a4_a_stiffness_in_any_form_is_the_same_number(tmp_path, raw):
    text = GOOD.replace("normal_elastic: {}", f"normal_elastic: {{coefficient: {raw}}}")
    assert load_scene(written(tmp_path, text)).effects.seat.normal_elastic.coefficient == 5.0e6


@pytest.mark.parametrize(
    ("raw", "cure"),
    [
        ("010", "write 10"), ("1_000", "write 1000"), ("60:30", ""), ("on", ""), ("off", ""), ("yes", ""), ("no", ""),
        (".nan", "a finite one"), (".inf", "a finite one"), ("-.inf", "a finite one"), ("'5'", "without quotes"),
        ("true", ""), ("5 kg", ""), ("0x10", ""),
    ],
)  # fmt: skip
def test_a5_what_is_no_number_is_refused_with_its_raw_text_and_what_it_was_read_as(tmp_path, raw, cure):
    (fault,) = refusal(written(tmp_path, with_mass(raw))).faults
    assert f"'{raw.strip(chr(39))}' was read as {'true or false' if raw == 'true' else 'text'}" in fault.sentence
    assert cure in fault.sentence
    assert fault.line == 5


@pytest.mark.parametrize("raw", ["on", "yes", "1"])
def test_a5_a_switch_is_true_or_false(tmp_path, raw):
    text = GOOD.replace(
        "{kind: sine, frequency: 4, amplitude: 1}", f"{{kind: recorded, file: x, rate: 1, correct_tilt: {raw}}}"
    )
    faults = refusal(written(tmp_path, text)).faults
    assert any(f"'{raw}'" in fault.sentence and "true, false" in fault.sentence for fault in faults)


def test_a6_a_repeated_section_is_refused_with_both_lines(tmp_path):
    text = GOOD + "seat: {cushion_poisson: 0.3}\noutputs: {force_rate: 1000}\nseat: {cushion_poisson: 0.4}\n"
    (fault,) = refusal(written(tmp_path, text)).faults
    assert (fault.line, fault.where) == (7, "seat")
    assert "in line 5 and in line 7" in fault.sentence


def test_a7_a_misspelt_effect_is_refused_with_the_nearest(tmp_path):
    text = GOOD.replace("normal_elastic: {}", "normal_elastic: {}, frcition: {}")
    (fault,) = refusal(written(tmp_path, text)).faults
    assert fault.sentence == "the key is unknown; did you mean 'friction'?"


@pytest.mark.fault("A8")
@pytest.mark.parametrize(
    ("mass", "told"),
    [
        ("6700", "6700 kg is above 1000 kg"),
        ("-1", "-1 kg is below 0 kg"),
        ("0.05", "0.05 kg is below 0.1 kg"),
        ("1e400", "read as text"),
    ],
)
def test_a8_a_value_out_of_range_names_bound_and_unit(tmp_path, mass, told):
    (fault,) = refusal(written(tmp_path, with_mass(mass))).faults
    assert told in fault.sentence


BUMP = """rig: tire
duration: 1
travel: {speed: 10}
effects: {tire: {normal_elastic: {}}}
road: {kind: bump, position: 5, height: NUMBER, length: 0.5}
"""
LEANING = """rig: backrest
duration: 1
vibration: {kind: sine, axis: x, frequency: 4, amplitude: 1}
backrest: {mass: NUMBER}
effects: {backrest: {normal_elastic: {}}}
"""
PLACES = {  # key -> scene, lowest and highest value
    "backrest.mass": (LEANING, 0.1, 1000.0),
    "vibration.amplitude": (GOOD.replace("amplitude: 1", "amplitude: NUMBER"), 0.0, 1000.0),
    "road.height": (
        BUMP, -0.5, 0.5,
    ),
}  # fmt: skip


@pytest.mark.fault("A8")
@given(number=strategies.floats() | strategies.integers(), place=strategies.sampled_from(sorted(PLACES)))
@settings(max_examples=150)
def test_a8_any_number_validates_or_is_refused_by_key_bound_and_unit(number, place):
    text, lowest, highest = PLACES[place]
    raw = repr(number).replace("inf", ".inf").replace("nan", ".nan")
    document = parse_document("name: any\n" + text.replace("NUMBER", raw), "any.yaml")
    try:
        validate(document.root, "any.yaml", document.faults)
    except SceneError as error:
        (fault,) = error.faults
        assert fault.where == place
        assert f"allowed are {lowest:g} to {highest:g} " in fault.sentence
        assert not lowest <= number <= highest or 0.0 < abs(number) < 1e-30  # so near to 0 nothing is meant
    else:
        assert lowest <= number <= highest


@pytest.mark.fault("A8")
def test_a8_millimetres_for_metres_are_caught(tmp_path):
    text = """rig: tire
duration: 1
travel: {speed: 10}
road: {kind: bump, position: 5, height: 30, length: 600}
effects: {tire: {normal_elastic: {radius_rolling: 300}, contact_field: {length: 200}}}
"""
    assert [fault.where for fault in refusal(written(tmp_path, text)).faults] == [
        "road.height", "road.length", "effects.tire.normal_elastic.radius_rolling", "effects.tire.contact_field.length",
    ]  # fmt: skip


def test_a12_five_faults_give_five_lines_in_order(tmp_path):
    text = """rig: seat
duration: 1.005
seed: -1
vibration: {kind: recorded, file: nowhere.csv, rate: 100}
effects:
  seat: {normal_elastic: {}, frcition: {}}
  tire: {normal_elastic: {}}
"""
    faults = refusal(written(tmp_path, text)).faults
    assert [(fault.line, fault.where) for fault in faults] == [
        (2, "duration"), (3, "seed"), (4, "vibration.file"), (6, "effects.seat.frcition"), (7, "effects.tire"),
    ]  # fmt: skip
    assert len(str(refusal(tmp_path / "scene.yaml")).splitlines()) == 5


@pytest.mark.parametrize("length", ["0", "-0.01", "1e-10", "0.0100000001", "0.01000000001"])
def test_c5_a_block_length_that_cannot_be_is_refused_with_the_allowed_values(tmp_path, length):
    (fault,) = refusal(written(tmp_path, GOOD + f"block_length: {length}\n")).faults
    assert fault.where == "block_length"
    assert "allowed are" in fault.sentence


def test_a9_an_effect_without_what_it_needs_names_both_and_the_cure(tmp_path):
    text = BUMP.replace("NUMBER", "0.03").replace("normal_elastic: {}", "normal_elastic: {}, brush: {}")
    (fault,) = refusal(written(tmp_path, text)).faults
    assert fault.sentence == "brush needs contact_field, which the scene does not name; add it or remove brush"


def test_a10_settings_that_contradict_each_other_are_refused_not_mended(tmp_path):
    text = GOOD.replace("kind: sine, frequency: 4, amplitude: 1", "kind: noise, low: 20, high: 10, rms: 1")
    (fault,) = refusal(written(tmp_path, text)).faults
    assert (fault.where, fault.sentence) == ("vibration.low", "20 Hz is not below high (10 Hz)")


BILLION_CELLS = """
import resource, sys
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
import ruamel.yaml
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (64 << 20), used + (64 << 20)))
try:
    load_scene(sys.argv[1])
except SceneError as error:
    print(error)
"""


@pytest.mark.fault("A11")
@pytest.mark.parametrize(
    ("key", "change", "told"),
    [
        ("outputs.force_rate", "duration: 3600\noutputs: {force_rate: 1000000}", "samples, limit 1e+09"),
        ("vibration.file", "vibration: {kind: recorded, file: big.csv, rate: 100}", "big.csv needs 0.0"),
        ("road.file", "rig: tire\ntravel: {speed: 1}\nroad: {kind: opencrg, file: big.crg}", "big.crg needs 0.0"),
    ],
)
def test_a11_samples_and_files_are_refused_by_estimate_before_they_are_read(tmp_path, monkeypatch, key, change, told):
    (tmp_path / "big.csv").write_text("x,z\n" + "1,9.8\n" * 30_000)
    crg_file.write(tmp_path / "big.crg", table=[[0.5] * 4] * 20_000, rows=20_000)
    for reader in (recorded_csv, opencrg_payload):
        monkeypatch.setattr(reader, "read_table" if reader is recorded_csv else "read_payload", None)
    lines = {line.split(":")[0]: line for line in [*GOOD.splitlines(), *change.splitlines(), "limits: {memory: 0.001}"]}
    if "road" in lines:
        lines = {**lines, "effects": "effects: {tire: {normal_elastic: {}}}"}
        lines.pop("vibration")
    (fault,) = refusal(written(tmp_path, "\n".join(lines.values()))).faults
    assert fault.where == key
    assert told in fault.sentence
    assert key == "outputs.force_rate" or "limit 0.001 GiB (limits.memory)" in fault.sentence


@pytest.mark.fault("A11")
def test_a11_a_billion_cells_are_refused_by_estimate_where_memory_is_scarce(tmp_path):
    text = GOOD.replace("normal_elastic: {}", "normal_elastic: {}, contact_field: {rows: 32000, cols: 32000}")
    command = [sys.executable, "-c", BILLION_CELLS, str(written(tmp_path, text))]
    done = subprocess.run(
        command, capture_output=True, text=True, check=True, env={**os.environ, "PYTHONPATH": PACKAGE}
    )
    assert "32000 × 32000 cells need" in done.stdout
    assert "limit 1 GiB (limits.memory)" in done.stdout
