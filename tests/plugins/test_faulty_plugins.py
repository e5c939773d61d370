"""What is wrong in one plug-in is a line that names it, and takes nothing else down."""

import json

import pytest
from tests.bench_process import needs_ros
from tests.plugins.bench_beside import Bench

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.plugin_check import RESERVED, faults_of_rig
from contact_sim_pkg.records.registry import contacts
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.rigs import PACKAGES
from contact_sim_pkg.scene.schema.scene import Scene

PRESS = """
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.records.topic import FORCE, WRENCH, ContactTopic

SPRING = Effect(name="spring", section="press_keys:Spring", help="spring", carries=True, feeds=("force",))
PLATE = Contact(
    name="plate", help="plate", section="press_keys:Plate", section_help="plate", effects=(SPRING,),
    topics=(FORCE, WRENCH),
)
RIGS = (Rig(name="press", help="press", contacts=(PLATE,), simulation="press_simulation:Press", scenes={}),)
"""
KEYS = """
from contact_sim_pkg.scene.schema.fields import Section, number


class Plate(Section):
    mass: float = number(1e-3, 1e4, "kg", "mass", default=1.0)


class Spring(Section):
    pass


class Open(Section):
    mass: float = number(1e-3, 1e4, "kg", "mass", example=1.0)


class Unknown(Section):
    mass: "Mass" = 1.0
"""
SIMULATION = """
import press_needs

class Press:
    def __init__(self, scene):
        pass
"""
SCENE = "rig: press\nduration: 0.02\neffects: {plate: {spring: {}}}\n"
OFFLINE = ("--offline", "--no-record")


@pytest.fixture
def bench(tmp_path):
    return Bench(tmp_path)


def press(bench, *changes, name="press_kit", rigs="press = press_kit:RIGS", **groups):
    """The package, with texts of its record replaced."""
    record = PRESS
    for old, new in changes:
        assert old in record
        record = record.replace(old, new)
    for module, text in (("press_keys", KEYS), ("press_simulation", SIMULATION), ("press_needs", "")):
        (bench.beside / f"{module}.py").write_text(text)
    bench.add(name, record, rigs=rigs, **groups)


def lines_of(text, package="press_kit"):
    return [line for line in text.splitlines() if f"plug-in {package} 1.2" in line]


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ("press_keys:Plate", "press_keys:Plates", "contact plate: section press_keys:Plates does not load (Attr"),
        ("press_keys:Plate", "absent_keys:Plate", "contact plate: section absent_keys:Plate does not load (ModuleNot"),
        ("press_keys:Plate", "press_keys:number", "contact plate: section press_keys:number is no class below Section"),
        ("press_keys:Spring", "press_keys:Sprung", "effect spring: section press_keys:Sprung does not load"),
        ("press_simulation:Press", "press_simulation:Pres", "rig press: press_simulation:Pres does not load (the module"),
        ("press_simulation:Press", "press_simulatio:Press", "(there is no module press_simulatio)"),
        ("press_simulation:Press", "absent.simulation:Press", "(ModuleNotFoundError: No module named 'absent')"),
        ('name="plate"', 'name="model_copy"', "contact model_copy: every section of a scene has a method of this name"),
        ('name="plate"', 'name="no/name"', "'no/name' is no name of ASCII letters"),
        ('name="spring"', 'name="a b"', "'a b' is no name of ASCII letters"),
        ("FORCE, WRENCH)", 'FORCE, ContactTopic("heat", "any/msg/Heat"))', "topic heat: the bench has no message type any/msg/H"),
        ("(SPRING,)", "(SPRING, SPRING)", "two effects have this name"),
        ("(SPRING,)", "SPRING", "its record cannot be read (TypeError"),
        ("scenes={}", 'scenes={"press_drop": 1}', "its scene press_drop is not there; put scenes/press_drop.yaml"),
        ("carries=True, ", "", "contact plate: none of its effects carries the load; set carries=True"),
        ("press_keys:Plate", "press_keys:Open", "contact plate: section press_keys:Open: its key mass needs a default"),
        ("press_keys:Plate", "press_keys:Unknown", "press_keys:Unknown does not load (PydanticUndefinedAnnotation"),
        ("carries=True", 'carries=True, observer="press_needs:Observer"', "effect spring: press_needs:Observer does not load"),
    ],
)  # fmt: skip
def test_what_it_names_is_there_or_it_is_left_out(bench, old, new, cause):
    press(bench, (old, new))
    text = bench("list")
    (line,) = lines_of(text)
    assert line.startswith("plug-in press_kit 1.2 is left out: ")
    assert cause in line
    assert "Traceback" not in text
    assert "tire_bump" in text


@pytest.mark.parametrize("package", PACKAGES)
def test_nothing_is_wrong_with_our_own_rigs(package):
    """So a rig that shares one of our contacts, or is built like ours, is let in."""
    faults = [fault for rig in load(f"{package}:RIGS") for fault in faults_of_rig(package, rig)]
    assert faults == []


def test_one_of_whom_nothing_is_wrong_brings_its_rig(bench):
    press(bench)
    (bench.work / "press.yaml").write_text(SCENE)
    text = bench("show", "press.yaml")
    assert "press_kit 1.2" in text
    assert "left out" not in text


EACH = """
import contextlib, io, json, sys
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records import plugins
plugins.LONGEST_IMPORT = 0.3
found = []
for arguments in json.loads({arguments!r}):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        found.append([main(arguments), out, err])
json.dump([[status, out.getvalue(), err.getvalue()] for status, out, err in found], sys.stdout)
"""


@pytest.mark.fault("G14")
def test_packages_that_are_broken_or_hostile_are_named_and_every_command_goes_on(bench):
    """Beside each other: two damaged descriptions, which numba and pydantic read too, and three that misbehave on import."""
    for name, content in (
        ("nottext", b"[contact_sim_pkg.rigs]\n\xff\xfe = a\n"),
        ("nosign", b"[contact_sim_pkg.rigs]\nx\n"),
    ):
        bench.add(name, "RIGS = ()\n", rigs="")
        (bench.beside / f"{name}-1.2.dist-info/entry_points.txt").write_bytes(content)
    bench.add("ender", "raise KeyboardInterrupt\n", rigs="a = ender")
    bench.add("talker", "print('{\"mine\": 1}')\nRIGS = ()\n", rigs="a = talker")
    bench.add("sleeper", "import time\ntime.sleep(1000)\n", rigs="a = sleeper")
    bench.add("ending_command", "raise KeyboardInterrupt\n", commands="ending = ending_command")
    calls = [
        ["list", "--json"], ["--help"], ["show", "tire_bump"], ["metrics", "--help"],
        ["run", "tire_bump", *OFFLINE, "--json", "--set", "duration=0.01", "--set", "effects.tire.contact_field=null"],
    ]  # fmt: skip
    printed, said = bench.python(EACH.format(arguments=json.dumps(calls)))
    answers = json.loads(printed)
    assert [status for status, _, _ in answers] == [0] * len(calls), answers
    assert len(json.loads(answers[0][1])["rows"]) > 20
    assert json.loads(answers[-1][1])["ended"] == "finished"
    causes = {
        "nottext": "its description is damaged (UnicodeDecodeError", "nosign": "its description is damaged (TypeError",
        "ender": "it does not load (KeyboardInterrupt)", "talker": "it prints where answers of commands are printed",
        "sleeper": "it did not end within 0.3 s", "ending_command": "command ending: ending_command:command does not load",
    }  # fmt: skip
    lines = [line for line in (said + "".join(err for _, _, err in answers)).splitlines() if "is left out" in line]
    assert len(lines) == len(causes), "\n".join(lines)
    for name, cause in causes.items():
        (line,) = [line for line in lines if name in line]
        assert cause in line
    assert "Traceback" not in said
    assert "ending " not in answers[1][1]  # what does not load is no command


@pytest.mark.parametrize("name", ["road", "rig", "duration", "effects", "plugins", "platform", "bench"])
def test_a_contact_takes_no_name_of_ours(bench, name):
    press(bench, ('name="plate"', f'name="{name}"'))
    text = bench("run", "tire_bump", *OFFLINE, "--set", "duration=0.01", "--set", "effects.tire.contact_field=null")
    (line,) = lines_of(text)
    assert f"contact {name}: the bench uses this name in every scene or topic; rename the contact" in line


def test_the_names_that_no_contact_takes_are_all_of_ours():
    """Keys of the schema and beginnings of topics, less those of the contacts themselves."""
    keys = set(Scene.model_fields)
    rooms = {name.partition("/")[0] for name in TOPICS if not name.startswith("/")}
    assert (keys | rooms) - set(contacts()) == RESERVED


def test_the_library_goes_on_too(bench):
    press(bench, ("press_keys:Plate", "press_keys:Plates"))
    printed, said = bench.python("from contact_sim_pkg import load_scene; print(load_scene('tire_bump').rig)")
    assert printed == "tire\n"
    assert said.count("\n") == 1
    assert "press_kit 1.2 is left out" in said


def test_nothing_but_records_and_keys_is_imported_to_check_them(bench):
    press(bench, commands="count = press_simulation:Press")
    program = (
        "import sys; from contact_sim_pkg.records.plugins import plugins; print(*plugins());"
        "print([name for name in ('press_keys', 'press_simulation', 'numba', 'scipy') if name in sys.modules])"
    )
    assert bench.python(program) == ("press_kit 1.2\n['press_keys']\n", "")


def test_a_record_that_needs_the_rigs_while_it_loads_is_left_out(bench):
    bench.add("early", "from contact_sim_pkg import open_bag\nRIGS = ()\n", rigs="a = early")
    text = bench("list")
    assert len(lines_of(text, "early")) == 1
    assert "needs the rigs while they are being found; import that where it is used" in text
    assert "tire_bump" in text


def test_a_command_that_is_not_there_leaves_bench_as_it_is(bench):
    bench.add("typo", "comand = None\n", commands="count = typo")
    text = bench("--help")
    (line,) = lines_of(text, "typo")
    assert "command count: typo:command does not load (the module typo has no command)" in line
    assert "Contact forces and pressure fields" in text


def test_a_command_that_does_not_load_refuses_and_is_named(bench):
    bench.add("broken", "import absent_thing\ncommand = None\n", commands="count = broken")
    text = bench("--help")
    assert "Of a plug-in; it does not load" in text
    assert "accuracy" in text
    cause = "plug-in broken 1.2: broken:command does not load (ModuleNotFoundError: No module named 'absent_thing')"
    text = bench("count", "x", "--y", status=2)
    assert text == f"bench: {cause}\n"
    assert cause in " ".join(bench("count", "--help").split())


def test_a_command_is_one_of_click(bench):
    bench.add("plain", "def command(): pass\n", commands="count = plain")
    assert "plain:command, is no click command" in bench("count", status=2)


def test_a_simulation_that_does_not_load_is_named_on_use(bench):
    press(bench)
    (bench.beside / "press_needs.py").write_text("import absent_thing\n")
    (bench.work / "press.yaml").write_text(SCENE)
    text = bench("run", "press.yaml", *OFFLINE, status=2)
    cause = "press_simulation:Press does not load (ModuleNotFoundError: No module named 'absent_thing')"
    assert f"bench: plug-in press_kit 1.2: {cause}" in text
    assert "pip install" not in text
    assert "Traceback" not in text


@needs_ros
def test_over_nodes_it_is_named_too(bench):
    press(bench)
    (bench.beside / "press_needs.py").write_text("import absent_thing\n")
    (bench.work / "press.yaml").write_text(SCENE)
    text = bench("run", "press.yaml", "--no-record", status=2)
    assert "plug-in press_kit 1.2: press_simulation:Press does not load (ModuleNotFoundError" in text
    assert "Traceback" not in text


def test_a_report_of_it_that_does_not_load_leaves_ours(bench):
    (bench.beside / "press_report.py").write_text("import absent_thing\nREPORT = None\n")
    press(bench, ("scenes={}", 'report=("press_report:REPORT",)'))
    bench("run", "tire_bump", "--offline", "--set", "duration=0.1", "--out", "bag",
          "--set", "effects.tire.contact_field=null")  # fmt: skip
    text = bench("report", "bag")
    assert "press_report:REPORT does not load" in text
    assert "its report is left out" in text
    assert (bench.work / "bag/report.html").is_file()


def test_equal_contacts_are_refused_with_both_rigs_and_plugins(bench):
    press(bench)
    press(bench, ('name="press"', 'name="press2"'), name="other", rigs="press = other:RIGS")
    text = bench("list", status=2)
    assert (
        "two contacts are named plate: that of the rig press2 of plug-in other 1.2 and that of the rig press of "
        in text
    )
    assert "plug-in press_kit 1.2; rename one" in text


def test_another_version_than_the_resolved_one_is_a_caution(bench):
    press(bench)
    (bench.work / "press.yaml").write_text("plugins: press_kit 1.1\n" + SCENE)
    text = bench("show", "press.yaml")
    cautions = [line for line in text.splitlines() if "resolved with" in line]
    assert cautions == [
        "the scene was resolved with the plug-in press_kit 1.1; it runs with press_kit 1.2, which may give other numbers"
    ]
    (bench.work / "press.yaml").write_text("plugins: Press-Kit 1.2\n" + SCENE)
    assert "resolved with" not in bench("show", "press.yaml")


def test_names_are_compared_as_pip_does(bench):
    press(bench)
    (bench.work / "press.yaml").write_text(SCENE)
    text = bench("show", "press.yaml", plugins="Press-kit")
    assert "press_kit 1.2" in text
    assert "no package of that name" not in text


SUM = """
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.topic import ContactTopic
from contact_sim_pkg.scene.schema.fields import Section


class NoKeys(Section):
    pass


SUM = Effect(
    name="sum", section="watcher:NoKeys", help="sum", feeds=("sum",), publishes="sum",
    topic=ContactTopic("sum", "contact_msgs_defs/msg/Series"), observer="watching:Sum",
)
EFFECTS = {"seat": (SUM,)}
"""
OBSERVER = """
import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.records.messages import Series


@entry
def total(force: "Vector") -> float:
    sum_of = 0.0
    for value in force:
        sum_of += value
    return sum_of


class Sum:
    def __init__(self, scene):
        pass

    def prepare(self):
        like = numpy.zeros(1)
        like.setflags(write=False)
        total(like)

    def observe(self, outputs):
        for output in outputs:
            if output.topic == "seat/force":
                force = output.record
                yield Output("seat/sum", output.stamp, Series(
                    block=force.block, sample_period=force.sample_period, names=("sum",), units=("N",),
                    values=numpy.full((1, len(force.normal)), total(force.normal)),
                ))
"""


def test_a_kernel_of_an_observer_takes_what_it_was_prepared_for(bench):
    """Samples that lie strided in the simulation come in one layout; their sum is that of the bag."""
    (bench.beside / "watching.py").write_text(OBSERVER)
    bench.add("watcher", SUM, effects="a = watcher:EFFECTS")
    bench("run", "seat_ride", "--offline", "--set", "duration=0.02", "--out", "bag", "--set", "effects.seat.sum={}")
    from contact_sim_pkg.bag.reader import open_bag

    bag = open_bag(bench.work / "bag")
    expected = bag.columns("seat/force", ("normal",))["normal"].sum(axis=1)
    found = [values[0] for values in bag.columns("seat/sum", ("values",))["values"]]
    assert found == pytest.approx(list(expected), rel=1e-12)
