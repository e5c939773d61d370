"""A package of somebody else brings a rig, an effect and a command: known to all parts, without an edit of ours."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import numpy
import pytest
import scipy.signal
from tests.bench_process import messages, needs_ros
from tests.plugins.bench_beside import Bench
from tests.report.synthetic_bag import seat_bag

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.plugins import OFF, VARIABLE
from contact_sim_pkg.report.reading import read_recording

EXAMPLE = Path(__file__).parents[2] / "examples/plugin_rig"
OUTSIDE = 1  # exit code: a metric of so short a run lies outside its band


@pytest.fixture
def bench(tmp_path):
    return Bench(tmp_path)


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """With the example, installed from a copy as its page says."""
    folder = tmp_path_factory.mktemp("example")
    bench = Bench(folder)
    source = shutil.copytree(EXAMPLE, folder / "source")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps", "--target"]
    subprocess.run([*pip, bench.beside, source], check=True, capture_output=True)
    bench("run", "bouncer_drop", "--offline", "--out", "bag")
    return bench


def test_its_scene_is_listed_and_its_command_counts_the_impacts(example):
    assert "bouncer_drop" in example("list")
    assert example("bounces", "bag") == "11 impacts\n"
    example("report", "bag")
    assert "foot" in (example.work / "bag/report.html").read_text()
    assert "bounces" in example("--help")


def test_its_first_bounce_is_that_of_a_damped_oscillator(example):
    """m x'' + c x' + k x = -m g from x = 0: the largest force of the contact by scipy's own integration, to 1e-3."""
    mass, stiffness, damping, gravity, height = 1.0, 1e5, 20.0, 9.80665, 0.1
    fall, speed = math.sqrt(2.0 * height / gravity), math.sqrt(2.0 * gravity * height)

    def rates(_time, state):
        return state[1], -gravity - (stiffness * state[0] + damping * state[1]) / mass

    forces = open_bag(example.work / "bag").columns("foot/force", ("normal",))["normal"].ravel()
    times = numpy.arange(len(forces)) * 1e-3
    first = (times > fall) & (times < fall + 0.0095)
    found = scipy.integrate.solve_ivp(
        rates, (0.0, 0.01), (0.0, -speed), t_eval=times[first] - fall, rtol=1e-10, atol=1e-13
    )
    expected = numpy.maximum(0.0, -stiffness * found.y[0] - damping * found.y[1])
    assert abs(forces[first] - expected).max() < 1e-3 * expected.max()


def test_its_effect_looks_at_our_tire_and_changes_no_bit(example):
    """The rate of the smoothed force by scipy's filter of first order."""
    common = ("run", "tire_bump", "--offline", "--set", "duration=0.2", "--set", "effects.tire.contact_field=null")
    example(*common, "--out", "without")
    example(*common, "--out", "with", "--set", "effects.tire.load_change={time: 0.02}")
    seen, plain = messages(example.work / "with"), messages(example.work / "without")
    own = [each for each in seen if each[0] == "/tire/load_change"]
    excepted = ("/bench/scene", "/tire/load_change")
    assert [each for each in seen if each[0] not in excepted] == [each for each in plain if each[0] not in excepted]
    assert len(own) == 20
    bag = open_bag(example.work / "with")
    force = bag.columns("tire/force", ("normal",))["normal"].ravel()
    share = -math.expm1(-1e-3 / 0.02)
    smooth, _ = scipy.signal.lfilter([share], [1.0, share - 1.0], force, zi=[(1.0 - share) * force[0]])
    rates = numpy.concatenate(list(bag.columns("tire/load_change", ("values",))["values"]))
    assert rates == pytest.approx((force - smooth) / 0.02, rel=1e-9, abs=1e-6)


def test_its_snubber_acts_between_wheel_and_body_of_our_tire(example):
    """Engaged at rest it carries a part of the body, by the balance of two linear springs, and over the bump its energy
    stands in the ledger.
    """
    keys = "effects.tire.snubber={travel: -0.02, stiffness: 40000}"
    common = ("run", "tire_bump", "--offline", "--set", "effects.tire.contact_field=null", "--set", keys)
    example(*common, "--set", "duration=0.2", "--set", "road={kind: flat}", "--out", "flat")
    bag = open_bag(example.work / "flat")
    assert "plugins: bouncer_rig 0.1.0" in bag.metadata["scene"]
    position = read_recording(bag).motion.position
    above = position["wheel_z"] - position["body_z"]
    weight, spring, snubber = 300.0 * 9.81, 2e4, 4e4
    expected = (weight + snubber * (weight / spring - 0.02)) / (spring + snubber)
    assert above[0] == pytest.approx(expected, abs=1e-9)
    assert above == pytest.approx(above[0], abs=1e-6)
    example(*common, "--set", "duration=1.2", "--out", "snubbed")
    ledger = read_recording(open_bag(example.work / "snubbed")).ledger
    assert abs(ledger.residual).max() < 1e-4 * abs(ledger.stored).max()


WRITERS = """
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.scene.schema.fields import Section


class NoKeys(Section):
    pass


class Careless:
    def __init__(self, scene):
        pass

    def prepare(self):
        pass

    def observe(self, outputs):
        for output in outputs:
            if output.topic == "tire/force":
                output.record.normal[:] = 0.0
        return ()


class Stubborn(Careless):
    def observe(self, outputs):
        for output in outputs:
            for value in output.record:
                try:
                    value[...] = 0.0
                except (TypeError, ValueError):
                    pass
        return ()


def effect(name):
    return Effect(name=name.lower(), section="writers:NoKeys", help="writes", feeds=("force",), observer=f"writers:{name}")


EFFECTS = {"tire": (effect("Careless"), effect("Stubborn"))}
"""


def test_one_that_writes_to_what_it_observes_changes_no_bit(bench):
    bench.add("writers", WRITERS, effects="a = writers")
    common = ("run", "tire_bump", "--offline", "--set", "duration=0.05", "--set", "effects.tire.contact_field=null")
    text = bench(*common, "--set", "effects.tire.careless={}", "--out", "careless", status=1)
    assert "effects.tire.careless writes to an output of block 0 that it observes; an observer only reads" in text
    assert "Traceback" not in text
    bench(*common, "--out", "plain")
    bench(*common, "--set", "effects.tire.stubborn={}", "--out", "stubborn")
    seen, plain = (messages(bench.work / name) for name in ("stubborn", "plain"))
    assert [each for each in seen if each[0] != "/bench/scene"] == [each for each in plain if each[0] != "/bench/scene"]


def test_a_bag_of_it_is_refused_by_name_where_it_is_missing(example):
    text = example("run", "--from-bag", "bag", "--offline", "--no-record", plugins=OFF, status=2)
    assert "uses the plug-in bouncer_rig 0.1.0, which is not installed" in text
    assert "uses the plug-in bouncer_rig 0.1.0, which is not installed" in example(
        "accuracy", "bag", plugins=OFF, status=2
    )
    assert "there is no such scene" in example("run", "bouncer_drop", "--offline", plugins=OFF, status=2)


def test_a_bag_of_it_is_read_where_it_is_missing(example):
    bag = shutil.copytree(example.work / "bag", example.work / "read", ignore=shutil.ignore_patterns("*.html"))
    assert len(open_bag(bag).columns("foot/force", ("normal",))["normal"]) > 0  # these tests hide all plug-ins
    example("report", "read", plugins=OFF)
    assert "foot" in (bag / "report.html").read_text()
    example("metrics", "read", plugins=OFF)
    example("compare", "read", "bag", plugins=OFF)


def test_a_bag_of_another_version_of_it_is_read(example):
    """What it then computes may differ; the scene is resolved with the version that is there."""
    shutil.copytree(example.work / "bag", example.work / "older")
    program = (
        "from contact_sim_pkg.bag.reader import open_bag; from contact_sim_pkg.scene.resolve import read_resolved;"
        "text = open_bag('older').metadata['scene'].replace('bouncer_rig 0.1.0', 'bouncer_rig 0.0.9');"
        "assert '0.0.9' in text; print(read_resolved(text).data['plugins'])"
    )
    printed, said = example.python(program)
    assert printed == "bouncer_rig 0.1.0\n"
    assert "resolved with the plug-in bouncer_rig 0.0.9; it runs with bouncer_rig 0.1.0" in said


def test_its_errors_are_our_sentences(example):
    text = example("run", "bouncer_drop", "--offline", "--set", "foot.mass=-1", status=2)
    assert "foot.mass" in text
    assert "0.001 to 10000 kg" in text


@needs_ros
def test_over_nodes_it_gives_the_same_bits(example):
    example("run", "bouncer_drop", "--out", "nodes")
    assert messages(example.work / "nodes") == messages(example.work / "bag")


def test_one_that_does_not_load_is_a_line_and_left_out(bench):
    bench.add("broken", "import nothing_of_this_name\n", rigs="broken = broken:RIGS")
    text = bench("list")
    assert text.count("broken") == 1 + text.count("broken:RIGS")
    assert "plug-in broken 1.2 is left out" in text
    assert "tire_bump" in text


RIG = """
from contact_sim_pkg.records.rig import Rig
RIGS = (Rig(name="{}", help="none", contacts=(), simulation=f"{{__name__}}:Rig"),)
"""


@pytest.mark.parametrize(("name", "other"), [("impact", "contact_sim_pkg.rigs.impact"), ("twice", "plug-in first 1.2")])
def test_equal_names_are_refused_and_both_named(bench, name, other):
    bench.add("first", RIG.format("twice"), rigs="a = first")
    bench.add("second", RIG.format(name), rigs="a = second")
    text = bench("list", status=2)
    assert f"two rigs are named {name}" in text
    assert other in text
    assert "plug-in second 1.2" in text
    assert "Traceback" not in text
    assert "tire_bump" in bench("list", plugins=OFF)


def test_only_the_named_ones_are_let_in(bench):
    bench.add("first", RIG.format("twice"), rigs="a = first")
    bench.add("second", RIG.format("twice"), rigs="a = second")
    assert "tire_bump" in bench("list", plugins="second")


def test_a_command_of_ours_is_never_replaced(bench):
    bench.add("greedy", "command = None\n", commands="run = greedy:command")
    assert "two commands are named run" in bench("unheard_of", status=2)


def test_no_plug_in_is_looked_for_where_a_scene_uses_none():
    """The nodes of our own scenes start without reading what is installed."""
    from contact_sim_pkg.nodes.processes.environment import plugin_environment
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

    assert plugin_environment(ResolvedScene({})) == {VARIABLE: OFF}
    assert plugin_environment(ResolvedScene({"plugins": "a 1.0, b 2.1"})) == {VARIABLE: "a,b"}


@pytest.fixture(scope="module")
def washboard(example):
    """A run of our tire over its road."""
    example(
        "run", "tire_bump", "--offline", "--out", "washboard", "--set", "road={kind: washboard, wavelength: 0.5}",
        "--set", "duration=0.05", "--set", "effects.tire.contact_field=null",
    )  # fmt: skip
    return example


def test_its_road_is_the_sine_that_it_says(washboard):
    bag = open_bag(washboard.work / "washboard")
    seen = 0
    for _time, patch in bag.decoded("road/patch"):
        height = numpy.reshape(patch.height, (-1, patch.cols))
        x = (patch.first_row + numpy.arange(len(height))) * patch.cell_x
        expected = (0.005 * numpy.exp(4j * math.pi * x)).imag
        assert height == pytest.approx(numpy.repeat(expected[:, None], patch.cols, axis=1), abs=1e-9)
        seen += 1
    assert seen == 5
    assert "plugins: bouncer_rig 0.1.0" in bag.metadata["scene"]


def test_its_metric_and_its_format_are_those_of_the_bench(washboard):
    assert "tire.impacts" in washboard("metrics", "washboard", "--json", status=OUTSIDE)
    assert "impacts" in washboard("metrics", "washboard", "--all", status=OUTSIDE)
    washboard("export", "washboard", "--format", "md", "--topic", "tire/force", "--out", "tables")
    header, rule, *rows = (washboard.work / "tables/tire_force.md").read_text().splitlines()
    assert header.startswith("| time [s] | ")
    assert set(rule) <= set("|- ")
    normal = open_bag(washboard.work / "washboard").columns("tire/force", ("normal",))["normal"].ravel()
    assert len(rows) == len(normal)
    column = header.split(" | ").index("normal [N]")
    assert [float(row.split(" | ")[column].strip("| ")) for row in rows] == normal.tolist()
    assert "there is no format mat; formats are csv, parquet, md" in washboard(
        "export", "washboard", "--format", "mat", status=2
    )


def test_its_vibration_is_the_one_that_it_says(example):
    printed, _said = example.python(
        "import math; from contact_sim_pkg.run.sources import make_vibration\n"
        "from contact_sim_pkg.scene.resolve import load_resolved\n"
        "scene = load_resolved('seat_slap', 'vibration={kind: knock, amplitude: 3.0, frequency: 7.0, decay: 0.2, axis: x}')\n"
        "block = make_vibration(scene).block(4)\n"
        "t = [0.04 + i / 1000 for i in range(len(block.acceleration_x))]\n"
        "wave = [3.0 * math.exp(-each / 0.2) * math.sin(14.0 * math.pi * each) for each in t]\n"
        "print(max(abs(a - b) for a, b in zip(wave, block.acceleration_x)) < 1e-12, block.acceleration_z.any())\n"
        "print(scene.data['plugins'])\n"
    )
    assert printed == "True False\nbouncer_rig 0.1.0\n"


@pytest.mark.parametrize(
    ("road", "sentence"),
    [
        ("{kind: washboard, amplitude: 0.2}", "road.amplitude: 0.2 m is above 0.1 m; allowed are 0 to 0.1 m"),
        (
            "{kind: washboard, amplitude: 0.1, wavelength: 0.1}",
            "slopes of 6.3, at most 0.5 is allowed; take longer waves",
        ),
        ("{kind: washbord}", "'washbord' is not a kind of road; allowed: bump"),
    ],
)
def test_bad_values_of_its_road_are_refused_in_a_sentence(example, road, sentence):
    text = example("run", "tire_bump", "--offline", "--no-record", "--set", f"road={road}", status=2)
    assert sentence in text
    assert "Traceback" not in text


def test_without_it_its_road_is_unknown(washboard):
    text = washboard("show", "tire_bump", "--set", "road={kind: washboard}", plugins=OFF, status=2)
    assert "'washboard' is not a kind of road; allowed: bump, cleat" in text
    assert "washboard" not in text.partition("allowed: ")[2]
    again = washboard("run", "--from-bag", "washboard", "--offline", "--no-record", plugins=OFF, status=2)
    assert "uses the plug-in bouncer_rig 0.1.0, which is not installed" in again
    assert "impacts" not in washboard("metrics", "washboard", "--all", plugins=OFF, status=OUTSIDE)


KIND = """
from typing import Literal
from contact_sim_pkg.excitation.kinds import RoadKind

class Mud(RoadKind):
    kind: Literal["{}"]
    {}

KIND = Mud
"""
SURFACE = "def surface(self, setting): return self"


@pytest.mark.parametrize(
    ("module", "cause"),
    [
        (KIND.format("mud", "pass"), "road mud: mud:KIND has no surface"),
        (KIND.format("dirt", SURFACE), 'road mud: mud:KIND needs the key kind: Literal["mud"]'),
        ("KIND = 3", "road mud: mud:KIND is no class below RoadKind"),
        ("import nothing_of_this_name", "road mud: mud:KIND does not load (ModuleNotFoundError"),
    ],
)
def test_a_kind_that_is_none_is_a_line_and_left_out(bench, module, cause):
    bench.add("mud", module, roads="mud = mud")
    text = bench("show", "tire_bump")
    assert text.count("plug-in mud 1.2 is left out") == 1
    assert cause in text


def test_kinds_metrics_and_formats_of_equal_names_are_refused_and_both_named(bench):
    bench.add("first", KIND.format("flat", SURFACE), roads="flat = first")
    text = bench("show", "tire_bump", status=2)
    assert "two roads are named flat: the bench's own and that of plug-in first 1.2" in text
    assert "Traceback" not in text
    assert "kind: bump" in bench("show", "tire_bump", plugins=OFF)


def test_a_metric_that_fails_is_a_line_and_left_out(bench, tmp_path):
    bag = seat_bag(tmp_path / "seat").path
    bench.add("spoilt", "def metrics(recording):\n    raise KeyError('gone')\n", metrics="spoilt = spoilt")
    text = bench("metrics", bag, status=OUTSIDE)
    assert text.count("the metrics spoilt of a plug-in, spoilt:metrics, are left out: 'gone'") == 1
    assert "SEAT" in text


SPOILT = """
from typing import Literal
from contact_sim_pkg.excitation.kinds import RoadKind

class Mud(RoadKind):
    kind: Literal["{}"]
    {}

    def describe(self):
        return {{}}

    def heights(self, x, y):
        {}
"""


@pytest.mark.parametrize(
    ("surface", "heights", "cause"),
    [
        ("def surface(self, setting): raise RuntimeError('no logs')", "return x", "RuntimeError: no logs"),
        (
            "def surface(self, setting): return 3",
            "return x",
            "AttributeError: 'int' object has no attribute 'describe'",
        ),
        (SURFACE, "return x[:, None]", "TypeError: heights at 2 x and 3 y have the shape (2, 1), not (2, 3)"),
    ],
)
def test_a_road_that_fails_is_refused_and_named(bench, surface, heights, cause):
    bench.add("mud", SPOILT.format("mud", surface, heights), roads="mud = mud:Mud")
    text = bench("run", "tire_bump", "--offline", "--no-record", "--set", "road={kind: mud}", status=2)
    assert f"road mud of the plug-in mud fails: {cause}" in text
    assert "Traceback" not in text


HUM = """
from typing import Literal
from contact_sim_pkg.excitation.kinds import VibrationKind

class Hum(VibrationKind):
    kind: Literal["hum"]
    {}

    def describe(self):
        return {{}}

    def acceleration(self, t):
        return t, t[:1]
"""


@pytest.mark.parametrize(
    ("signal", "cause"),
    [
        ("def signal(self, setting): raise RuntimeError('no hum')", "RuntimeError: no hum"),
        (
            "def signal(self, setting): return self",
            "TypeError: acceleration does not give two arrays of one value a time",
        ),
    ],
)
def test_a_vibration_that_fails_is_refused_and_named(bench, signal, cause):
    bench.add("hum", HUM.format(signal), vibrations="hum = hum:Hum")
    text = bench("run", "seat_ride", "--offline", "--no-record", "--set", "vibration={kind: hum}", status=2)
    assert f"vibration hum of the plug-in hum fails: {cause}" in text
    assert "Traceback" not in text
