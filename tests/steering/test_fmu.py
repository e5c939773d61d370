"""Units of FMI 2.0: FMPy and a plain host of C step them with the bits of a run, and what is wrong is a sentence."""

import os
import shutil
import signal
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg import ContactBench, load_scene, run
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.definitions import definition_of
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.run.scene_outputs import outputs_of as outputs_of_run
from contact_sim_pkg.steering.fmu.description import SWITCH, base_units, model_identifier
from contact_sim_pkg.steering.fmu.export import export_fmu
from contact_sim_pkg.steering.fmu.last_row import BEFORE
from contact_sim_pkg.steering.fmu.variables import variable_name

fmpy = pytest.importorskip("fmpy", reason="FMPy, which is in the lock, is not installed")
validate_fmu = pytest.importorskip("fmpy.validation").validate_fmu
needs_compiler = pytest.mark.skipif(not shutil.which("cc"), reason="there is no compiler of C")
pytestmark = needs_compiler

SOURCES = Path(export_fmu.__code__.co_filename).parent
HOST = Path(__file__).with_name("fmu_host.c")
RIGS = {
    "tire_braking": 0.06, "seat_ride": 0.4, "car_full_bench": 0.05, "seat_ride_full": 0.1, "block_fall": 0.4,
    "roller_flutter": 0.4, "seat_slap": 0.3, "impact_rubber_drop": 0.4,
}  # fmt: skip
"""One scene of each rig, with its duration [s]."""


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    """Units by scene, each exported once."""
    folder, made = tmp_path_factory.mktemp("units"), {}

    def unit(scene, *values):
        if (scene, *values) not in made:
            path = folder / f"{len(made)}_{scene}.fmu"
            export_fmu(load_scene(scene, *values), path)
            made[scene, *values] = path
        return made[scene, *values]

    return unit


@pytest.fixture
def seat(units):
    return units("seat_ride", "duration=0.4")


class Instance:
    """An instance of a unit in this process, and all that it reported."""

    def __init__(self, path, folder, said):
        from fmpy.fmi2 import (
            FMU2Slave,
            fmi2CallbackAllocateMemoryTYPE,
            fmi2CallbackFreeMemoryTYPE,
            fmi2CallbackFunctions,
            fmi2CallbackLoggerTYPE,
        )

        self.folder = Path(fmpy.extract(str(path), unzipdir=str(folder)))
        self.description = fmpy.read_model_description(str(path))
        self.references = {each.name: each.valueReference for each in self.description.modelVariables}
        self.said = said  # FMPy's proxy of the logger calls that of the instance made last
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda *given: self.said.append(given[4].decode()))
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(fmpy.free)
        # FMPy's own proxy writes the arguments of the message into it
        from ctypes import byref

        from fmpy.logging import addLoggerProxy

        addLoggerProxy(byref(callbacks))
        self.callbacks = callbacks
        self.unit = FMU2Slave(
            guid=self.description.guid, unzipDirectory=str(self.folder), instanceName="unit",
            modelIdentifier=self.description.coSimulation.modelIdentifier,
        )  # fmt: skip
        self.unit.instantiate(callbacks=callbacks)

    def start(self, begin=0.0, stop=None, inputs=False):
        self.unit.setupExperiment(startTime=begin, stopTime=stop)
        self.unit.enterInitializationMode()
        if inputs:
            self.unit.setBoolean([0], [True])
        self.unit.exitInitializationMode()
        return self

    def step(self, begin, length=0.01):
        self.unit.doStep(currentCommunicationPoint=begin, communicationStepSize=length)
        return self.values()

    def values(self):
        count = len(self.description.outputs)
        return numpy.array(self.unit.getReal(list(range(count))))

    def __getitem__(self, name):
        return self.unit.getReal([self.references[name]])[0]

    def refused(self, call, *arguments, **named):
        """The status of a call that is not OK, and its last sentence."""
        with pytest.raises(fmpy.fmi1.FMICallException) as caught:
            call(*arguments, **named)
        return caught.value.status, self.said[-1]


@pytest.fixture
def instance(tmp_path):
    made, said = [], []

    def start(path):
        made.append(Instance(path, tmp_path / str(len(made)), said))
        return made[-1]

    yield start
    for each in made:
        each.unit.freeInstance()


def bits(values):
    """Numbers that are equal where the doubles have the same bits; all nan are one."""
    values = numpy.asarray(values, dtype=numpy.float64)
    return numpy.where(numpy.isnan(values), numpy.nan, values).view(numpy.uint64)


def expected(bag, blocks):
    """By name of the output, its values at the end of each block: rows of the bag's tables, block by block."""
    found = {}
    for topic in bag.topics.values():
        if (
            topic.name.strip("/") in ("bench/cost", "bench/scene", "road/patch", "platform/vibration")
            or "Wrench" in topic.type
        ):
            continue
        definition = definition_of(topic.type.rpartition("/")[2])
        sizes = {field.name for field in definition.fields} - {
            field.name for field in definition.record_fields
        }  # of maps
        columns = {each.name: each.values for each in table_of(bag, topic.name).columns if each.name not in sizes}
        if not columns:  # it never came
            continue
        last = numpy.searchsorted(columns["block"], numpy.arange(blocks), side="right") - 1
        for name, values in columns.items():
            if name == "index" or values.dtype.kind not in "iuf":
                continue
            before = BEFORE if name == "time" else 0.0
            found[variable_name(topic.name.strip("/"), name)] = [
                before,
                *(values[row] if row >= 0 else before for row in last),
            ]
    return found


@pytest.mark.parametrize("scene", RIGS)
def test_fmpy_finds_no_fault_and_has_the_bits_of_a_run(units, tmp_path, scene):
    path = units(scene, f"duration={RIGS[scene]}")
    assert validate_fmu(str(path)) == []
    bag = run(load_scene(scene, f"duration={RIGS[scene]}"), tmp_path / "bag", progress=False)
    description = fmpy.read_model_description(str(path))
    length = float(description.defaultExperiment.stepSize)
    blocks = round(RIGS[scene] / length)
    simulated = fmpy.simulate_fmu(str(path), output=[each.variable.name for each in description.outputs],
                                  stop_time=RIGS[scene], output_interval=length)  # fmt: skip
    assert len(simulated) == blocks + 1
    wanted = expected(bag, blocks)
    assert len(wanted) > 20
    for name, values in wanted.items():
        assert bits(simulated[name]).tolist() == bits(values).tolist(), name
    # beyond that: topics that have not come, and arrays that none of their messages held
    for name in set(simulated.dtype.names) - {"time", *wanted}:
        assert not any(simulated[name] > 0.0), name


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    """A host of C, compiled with the declarations of the unit."""
    program = tmp_path_factory.mktemp("host") / "host"
    subprocess.run(["cc", "-std=c11", "-D_GNU_SOURCE", f"-I{SOURCES}", "-o", program, HOST, "-ldl"], check=True)
    return program


@pytest.mark.parametrize("scene", RIGS)
def test_a_plain_host_saves_and_goes_on_with_the_bits_of_a_run(units, tmp_path, host, scene):
    """In the process that saved, and in another one, from a file; no Python is in the host."""
    path = units(scene, f"duration={RIGS[scene]}")
    description = fmpy.read_model_description(str(path))
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "a unit")
    length, names = float(description.defaultExperiment.stepSize), [each.variable.name for each in description.outputs]
    steps = round(RIGS[scene] / length)
    library = tmp_path / "a unit" / "binaries" / "linux64" / f"{model_identifier(scene)}.so"
    resources = (tmp_path / "a unit" / "resources").as_uri()  # with %20

    def lines(state):
        ended = subprocess.run(
            [host, library, description.guid, resources, str(len(names)), repr(length), str(steps), state],
            capture_output=True, text=True, timeout=300, check=False,
        )  # fmt: skip
        assert (ended.returncode, ended.stderr) == (0, "")
        return [[float.fromhex(each) for each in line.split()] for line in ended.stdout.splitlines()]

    found = lines(str(tmp_path / "state"))
    assert bits(found[steps:]).tolist() == bits(found[steps // 2 : steps]).tolist()
    assert bits(lines(f"-{tmp_path / 'state'}")).tolist() == bits(found[steps:]).tolist()
    bag = run(load_scene(scene, f"duration={RIGS[scene]}"), tmp_path / "bag", progress=False)
    whole = numpy.array(found[:steps])
    for name, values in expected(bag, steps).items():
        assert bits(whole[:, names.index(name)]).tolist() == bits(values[1:]).tolist(), name


def test_declarations_are_those_of_the_standard(tmp_path):
    """Each function has the type that the standard's own header gives it."""
    headers = Path(fmpy.__file__).parent / "c-code"
    options = ["-std=c11", "-D_GNU_SOURCE", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{headers}"]
    subprocess.run(["cc", *options, "-include", headers / "fmi2Functions.h", SOURCES / "fmi2.c"], check=True)
    subprocess.run(["cc", *options[:-1], SOURCES / "fmi2.c"], check=True)


def test_a_floor_at_rest_carries_the_weight_and_a_ramp_is_that_of_the_library(instance, seat):
    """Masses times 9.81 m/s²; then 0.3 m/s² and 50 m/s³ for a block, 0.8 m/s² held for two."""
    unit = instance(seat).start(inputs=True)
    occupant = load_scene("seat_ride").data["seat"]["occupant"]
    mass = occupant["frame_mass"] + sum(occupant["masses"])
    for block in range(5):
        unit.step(0.01 * block)
        assert unit["seat.force.normal"] == pytest.approx(mass * 9.81, rel=1e-9)
    up = unit.references["platform.vibration.acceleration_z"]
    unit.unit.setReal([up], [0.3])
    unit.unit.setRealInputDerivatives([up], [1], [50.0])
    ramped = [unit.step(0.05)]
    unit.unit.setReal([up], [0.8])
    ramped.append(unit.step(0.06, 0.02))

    bench = ContactBench("seat_ride", "duration=0.4")
    rate = bench.scene.vibration.sample_rate
    samples = round(0.01 * rate)
    bench.step(0.05, vibration=numpy.zeros(5 * samples))
    place = list(unit.references).index("seat.force.normal")
    ramp = 0.3 + 50.0 * (numpy.arange(samples + 1) / rate)
    assert bench.step(vibration=ramp)["seat/force"]["normal"][-1] == ramped[0][place]
    assert bench.step(0.02, vibration=numpy.full(2 * samples, 0.8))["seat/force"]["normal"][-1] == ramped[1][place]


def test_inputs_do_nothing_until_they_are_switched_on(instance, seat):
    unit, other = instance(seat).start(), instance(seat).start()
    unit.unit.setReal([unit.references["platform.vibration.acceleration_z"]], [5.0])
    assert bits(unit.step(0.0)).tolist() == bits(other.step(0.0)).tolist()
    assert unit.references[SWITCH] == 0


def test_whole_blocks_are_steps_and_others_are_discarded(instance, seat):
    from fmpy.fmi2 import fmi2Discard, fmi2Error, fmi2LastSuccessfulTime, fmi2Terminated

    unit, other = instance(seat).start(begin=3.0), instance(seat).start()
    for length in (0.005, 0.015, 0.0, -0.01, float("nan")):
        status, said = unit.refused(unit.step, 3.0, length)
        assert status == fmi2Discard
        assert "whole blocks of 0.01 s" in said
        assert not unit.unit.getBooleanStatus(fmi2Terminated)
    whole = unit.step(3.0, 0.05)
    assert unit.unit.getRealStatus(fmi2LastSuccessfulTime) == pytest.approx(3.05)
    for block in range(5):
        last = other.step(0.01 * block)
    assert bits(whole).tolist() == bits(last).tolist()
    status, said = unit.refused(unit.step, 3.07)
    assert (status, said) == (fmi2Error, "a step begins at 3.07 s; the unit is at 3.05 s")
    status, said = unit.refused(unit.step, 3.05, 0.4)
    assert (status, said) == (fmi2Discard, "a step is discarded; the scene ends at 0.4 s")
    assert unit.unit.getBooleanStatus(fmi2Terminated)
    status, said = unit.refused(unit.unit.setupExperiment, stopTime=0.5)
    assert (status, said) == (fmi2Error, "the scene lasts 0.4 s, 0.5 s are wanted; export it with a longer duration")


def test_a_reset_is_the_start_again(instance, seat):
    unit = instance(seat).start()
    first = [unit.step(0.01 * block) for block in range(3)]
    unit.unit.reset()
    assert unit["seat.force.time"] == BEFORE
    unit.start()
    assert [bits(unit.step(0.01 * block)).tolist() for block in range(3)] == [bits(each).tolist() for each in first]


def test_a_damaged_state_is_refused_and_the_run_goes_on(instance, seat):
    """Every seventh byte of the head, and some further on; a state of another scene too."""
    unit, other = instance(seat).start(), instance(seat).start()
    for each in (unit, other):
        each.step(0.0)
    saved = unit.unit.serializeFMUstate(unit.unit.getFMUstate())
    wanted = bits(other.step(0.01)).tolist()
    places = [*range(0, 200, 7), len(saved) // 2, len(saved) - 1]
    damaged = [bytes(saved[:place]) + bytes([saved[place] ^ 4]) + bytes(saved[place + 1 :]) for place in places]
    for content in (b"", bytes(saved[:40]), bytes(saved[:-1]), *damaged):
        state = unit.unit.deSerializeFMUstate(content)
        _, said = unit.refused(unit.unit.setFMUstate, state)
        assert "no state of the unit, or were changed" in said
        unit.unit.freeFMUstate(state)
    assert bits(unit.step(0.01)).tolist() == wanted
    unit.unit.setFMUstate(state := unit.unit.deSerializeFMUstate(bytes(saved)))
    assert bits(unit.step(0.01)).tolist() == wanted
    unit.unit.freeFMUstate(state)


def children_of(pid):
    return [
        int(each) for task in Path(f"/proc/{pid}/task").iterdir() for each in (task / "children").read_text().split()
    ]


def test_a_process_that_is_gone_is_an_error_with_its_reason(instance, seat):
    from fmpy.fmi2 import fmi2Error

    before = set(children_of(os.getpid()))
    unit = instance(seat).start()
    (child,) = set(children_of(os.getpid())) - before
    unit.step(0.0)
    os.kill(child, signal.SIGKILL)
    for _ in range(2):
        status, said = unit.refused(unit.step, 0.01)
        assert (status, said) == (fmi2Error, "the process of the bench has ended by signal 9")


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        ("echo first >&2; echo 'no seat is free ' >&2; echo >&2; exit 3", "has ended: no seat is free "),
        ("exit 3", "has ended with status 3"),
        (None, "/nowhere/bench cannot be started"),
        ("printf 'h\\004\\0\\0\\0\\0\\0\\0\\0abcd'; sleep 1", "is no bench of this version"),
    ],
)
def test_a_bench_that_does_not_start_is_an_error_with_its_last_line(
    instance, seat, tmp_path, monkeypatch, script, reason
):
    command = tmp_path / "bench"
    command.write_text(f"#!/bin/sh\n{script}\n")
    command.chmod(0o755)
    monkeypatch.setenv("CONTACT_BENCH_COMMAND", "/nowhere/bench" if script is None else str(command))
    said = []
    with pytest.raises(Exception, match="instantiate"):
        Instance(seat, tmp_path / "unit", said)
    assert reason in said[-1]


def test_a_unit_holds_its_files_and_says_which_are_gone(instance, tmp_path, capsys):
    floor = tmp_path / "floor.csv"
    floor.write_text("z\n" + "".join(f"{each}\n" for each in numpy.sin(numpy.arange(400) / 7.0)))
    given = ["vibration.file=" + str(floor), "vibration.sample_rate=1000", "duration=0.2"]
    sets = [part for each in given for part in ("--set", each)]
    assert main(["export", "--fmu", "seat_ride", *sets, "--out", str(tmp_path / "own.fmu")]) == 0
    assert "FMI 2.0" in capsys.readouterr().out
    whole = outputs_of_run("seat_ride", 0.2, *given[:2])
    floor.unlink()
    unit = instance(tmp_path / "own.fmu").start()
    unit.step(0.0, 0.2)
    (*_, last) = (each.record for each in whole if each.topic == "seat/force")
    assert unit["seat.force.normal"] == last.normal[-1]
    next((unit.folder / "resources" / "files").iterdir()).unlink()
    assert main(["serve", str(unit.folder / "resources")]) == 2


def test_what_is_in_the_way_is_a_sentence_and_status_2(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def refused(*arguments):
        assert main(["export", *arguments]) == 2
        printed, said = capsys.readouterr()
        assert printed == ""
        return said

    with monkeypatch.context() as patch:
        patch.setenv("PATH", str(tmp_path))
        assert "needs a compiler of C, and none of cc, gcc, clang is there" in refused("--fmu", "seat_ride")
        patch.setenv("CC", "/nowhere/cc -m64")
        assert "/nowhere/cc, as CC says, is not there" in refused("--fmu", "seat_ride")
    monkeypatch.setenv("CC", "cc -include /nowhere.h")
    assert "does not compile the library of the FMU" in refused("--fmu", "seat_ride")
    theirs = tmp_path / "seat_ride.fmu"
    theirs.write_text("a week's work")
    assert "exists already" in refused("--fmu", "seat_ride")
    assert theirs.read_text() == "a week's work"
    for name, reason in (
        ("a\nb.fmu", "give another name"),
        ("a" * 300, "give a shorter one"),
        ("b/c.fmu", "make it first"),
    ):
        assert reason in refused("--fmu", "seat_ride", "--out", name)
    assert "no such scene" in refused("--fmu", "seat_rides")
    assert "--fmi needs --fmu" in refused("a_bag", "--csv", "--fmi", "2")
    assert "--set needs --fmu" in refused("a_bag", "--csv", "--set", "duration=1")
    assert "exclude each other" in refused("--fmu", "seat_ride", "--topic", "seat/force")
    assert "exclude each other" in refused("--fmu", "seat_ride", "--skip-bad")
    assert [entry.name for entry in tmp_path.iterdir()] == ["seat_ride.fmu"]


def test_a_folder_that_holds_no_unit_is_refused(tmp_path, capsys):
    (tmp_path / "scene.yaml").write_text("name: a\n")
    for content in ("{", "[]", "{}", '{"guid": "a", "outputs": [["a"]], "files": {}, "inputs": []}'):
        (tmp_path / "model.json").write_text(content)
        assert main(["serve", str(tmp_path)]) == 2
        assert "holds no unit of the bench" in capsys.readouterr().err


def test_units_are_those_of_the_si():
    newton = {"kg": 1, "m": 1, "s": -2}
    assert base_units("N") == newton
    assert base_units("N m") == base_units("J") == {"kg": 1, "m": 2, "s": -2}
    assert base_units("m/s^2") == {"m": 1, "s": -2}
    assert base_units("m^2/s^3") == {"m": 2, "s": -3}
    assert base_units("N/m") == {"kg": 1, "s": -2}
    assert base_units("1/s") == base_units("Hz") == {"s": -1}
    assert base_units("m/m") == {}
    assert base_units("N·m") is base_units("furlong") is None


def test_every_output_has_the_unit_of_its_column(units):
    with zipfile.ZipFile(units("seat_ride", "duration=0.4")) as archive:
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    found = {
        each.get("name"): each.find("Real").get("unit")
        for each in root.iter("ScalarVariable")
        if each.find("Real") is not None
    }
    assert found["seat.force.normal"] == "N"
    assert found["bench.motion.acceleration.seat_frame_z"] == "m/s^2"
    assert found["bench.energy.residual"] == "J"
    assert found["platform.vibration.acceleration_z"] == "m/s^2"
    assert "seat.wrench.wrench" not in found
    assert root.find("CoSimulation").get("needsExecutionTool") == "true"


def test_names_are_those_of_structured_naming():
    assert variable_name("tire/force", "normal") == "tire.force.normal"
    assert variable_name("my/own", "values.rim 1's") == r"my.own.values.'rim 1\'s'"
    assert model_identifier("2 masses.a") == "_2_masses_a"
