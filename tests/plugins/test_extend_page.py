"""What `docs/extend.md` shows is the code of the example, the fields of the records, or works as it stands."""

import ast
import dataclasses
import inspect
import itertools
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from tests.bench_process import ENVIRONMENT

from contact_sim_lab.cases import RigStudies
from contact_sim_lab.records.hard_case import HardCase
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.plugins import VARIABLE
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.records.topic import ContactTopic
from contact_sim_pkg.run.block_simulation import BlockResult, BlockSimulation
from contact_sim_pkg.run.observers import Observer

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples/plugin_rig"
BLOCKS = [
    textwrap.dedent(text)
    for text in re.findall(
        r"^ *```(?:python|text)\n(.*?)^ *```", (ROOT / "docs/extend.md").read_text(), re.DOTALL | re.MULTILINE
    )
]
RECORDS = (Rig, Contact, Effect, ContactTopic, RigStudies, HardCase, Output, BlockResult)
PROTOCOLS = (BlockSimulation, Observer)
CASES, TOPIC, OUTPUT = (
    next(block for block in BLOCKS if start in block)
    for start in ("CASES = ", 'ContactTopic("heat"', 'Output("foot/heat"')
)


def shows_signatures(block):
    return any(re.search(rf"^{each.__name__}\([^=]*: ", block, re.MULTILINE) for each in RECORDS) or "Protocol" in block


def test_its_code_is_that_of_the_example():
    code = [textwrap.dedent(path.read_text()) for path in EXAMPLE.rglob("*.py")]
    flat = ["\n".join(line.strip() for line in text.splitlines()) for text in code]
    shown = [block for block in BLOCKS if block not in (CASES, TOPIC, OUTPUT) and not shows_signatures(block)]
    assert len(shown) == 11
    for block in shown:
        lines = "\n".join(line.strip() for line in block.strip().splitlines())
        assert any(lines in text for text in flat), block


def signature(name, block):
    """Names of the parameters of ``name(...)`` in a block."""
    text = re.sub(r"#.*", "", block)
    start = re.search(rf"^{name}\(", text, re.MULTILINE).end()
    depth = list(itertools.accumulate({"(": 1, ")": -1}.get(letter, 0) for letter in text[start:]))
    return parameters(ast.parse(f"def {name}({text[start : start + depth.index(-1)]}): ...").body[0])


def parameters(function):
    return [each.arg for each in function.args.args]


@pytest.mark.parametrize("record", RECORDS)
def test_its_signatures_are_those_of_the_records(record):
    block = next(block for block in BLOCKS if re.search(rf"^{record.__name__}\([^=]*: ", block, re.MULTILINE))
    fields = [each.name for each in dataclasses.fields(record)] if dataclasses.is_dataclass(record) else record._fields
    assert sorted(signature(record.__name__, block)) == sorted(fields)


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_its_protocols_have_the_methods_that_the_bench_calls(protocol):
    block = next(block for block in BLOCKS if f"class {protocol.__name__}(Protocol)" in block)
    shown = next(node for node in ast.parse(block).body if isinstance(node, ast.ClassDef))
    methods = {node.name: parameters(node) for node in shown.body if isinstance(node, ast.FunctionDef)}
    for name, function in inspect.getmembers(protocol, inspect.isfunction):
        if not name.startswith("_"):
            assert methods[name] == list(inspect.signature(function).parameters)


@pytest.fixture
def example(tmp_path):
    """A copy of the example, changed as the sections on a topic and on a study say, not installed."""
    package = tmp_path / "bouncer_rig"
    shutil.copytree(EXAMPLE / "bouncer_rig", package)
    (package / "hard_cases.py").write_text(CASES)
    for name, old, new in (
        ("__init__", "    topics=(FORCE, WRENCH),\n", TOPIC),
        ("simulation", '            Output("bench/motion"', f'{OUTPUT}            Output("bench/motion"'),
        ("simulation", "import BodyMotion, ContactForce", "import BodyMotion, ContactForce, Series"),
    ):
        path = package / f"{name}.py"
        assert path.read_text().count(old) == 1
        path.write_text(path.read_text().replace(old, new))
    described = tmp_path / "bouncer_rig-0.1.0.dist-info"
    described.mkdir()
    (described / "METADATA").write_text("Metadata-Version: 2.1\nName: bouncer_rig\nVersion: 0.1.0\n")
    (described / "entry_points.txt").write_text(
        "[contact_sim_pkg.rigs]\nbouncer = bouncer_rig:RIGS\n"
        "[contact_sim_pkg.studies]\nbouncer = bouncer_rig.hard_cases:STUDIES\n"
    )
    return tmp_path


def printed_by(program, folder):
    kept = {name: value for name, value in ENVIRONMENT.items() if name != VARIABLE}
    environment = {**kept, "PYTHONPATH": f"{folder}:{ENVIRONMENT['PYTHONPATH']}"}
    command = [sys.executable, "-c", program]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True).stdout


def test_its_topic_is_recorded_and_its_study_found(example):
    """The heat of the first impact is what the bounce lacks: 1 kg from 0.1 m, at most 0.98 J."""
    topic = printed_by(
        "from contact_sim_pkg import run, load_scene, series\n"
        "found = series(run(load_scene('bouncer_drop', 'duration=0.2')), 'foot/heat')\n"
        "print(len(found), found.units['values.dissipated'], 0.0 < found['values.dissipated'][-1] < 0.98)\n",
        example,
    )
    assert topic == "200 J True\n"
    study = printed_by(
        "from contact_sim_lab.cases import modules_of_rigs, objects\n"
        "names = [name for name in modules_of_rigs('hard_cases') if name.startswith('bouncer')]\n"
        "print([case.find().margin > 0.0 for case in objects(names, 'CASES')])\n",
        example,
    )
    assert study == "[True]\n"
