"""The three ways in, `docs/for_*.md`: short pages whose lines all run, in order, in a folder with the examples."""

import contextlib
import io
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST_COMMAND, PACKAGE, needs_ros

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.cli.launched import arguments_of
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.run import command as run_command

ROOT = Path(__file__).resolve().parents[2]
WAYS = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").glob("for_*.md"))}
MOST = 60  # lines
LEFT = {
    "for_engineers": ("bags/soft/report.html", "bags/soft/ride-transmissibility.png", "comparison.html"),
    "for_roboticists": ("bags/first/first_0.mcap", "bags/shaken/shaken_0.mcap"),
    "for_students": ("bags/drop/report.html", "figure_4.png"),
}
"""Files that a page leaves."""
OF_SET_UP = ("make setup", "source ros2_ws/setup.bash", "pip install ./contact_sim_pkg ./contact_sim_lab")


def lines_of(block):
    """Each line of a block, continued ones as one, with the exit code that its comment states."""
    for line in block.replace("\\\n", " ").splitlines():
        code = re.search(r"# .*exit code (\d)$", line)
        yield re.split(r"\s+# ", line)[0].strip(), int(code[1]) if code else 0


def blocks_of(text):
    """Language and content of each block of code."""
    return re.findall(r"^```(\w+)\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def check_ros2(words):
    """A line of `ros2`, which is not on PyPI, by the names in it."""
    match words[1:3]:
        case ["launch", "contact_sim_pkg"]:
            assert (PACKAGE / "launch" / words[3]).exists()
            assert {each.partition(":=")[0] for each in words[4:]} <= set(arguments_of(run_command, without=("json",)))
        case ["run", "contact_sim_pkg"]:
            assert (PACKAGE / "contact_sim_pkg" / "nodes" / f"{words[3]}.py").exists()
        case ["topic", "echo" | "hz"]:
            assert words[3].lstrip("/") in TOPICS
        case ["lifecycle", "set"]:
            assert (PACKAGE / "contact_sim_pkg" / "nodes" / f"{words[3].lstrip('/')}.py").exists()
            assert words[4] in ("activate", "deactivate")
        case ["service", "call"]:
            assert words[3] == "/bag_replay/pause"
        case _:
            pytest.fail(f"no check of {words}")


def run_block(block):
    """Run the lines of a block; those with an & end with it."""
    beside = []
    for line, code in filter(lambda each: each[0], lines_of(block)):
        words = shlex.split(line.removesuffix("&"))
        if line in OF_SET_UP:
            continue
        if words[0] == "ros2":
            check_ros2(words)
        elif words[0] == "bench":
            assert main(words[1:]) == code, line
        else:
            assert words[0] == "python", line
            process = subprocess.Popen([sys.executable, *words[1:]], env=ENVIRONMENT)
            beside.append(process)
            if not line.endswith("&"):
                assert [each.wait(LONGEST_COMMAND) for each in beside] == [0] * len(beside)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder as the checkout is to somebody who starts."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    (tmp_path / "bags").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_there_are_three_and_each_is_short():
    assert list(WAYS) == ["for_engineers", "for_roboticists", "for_students"]
    assert max(len(text.splitlines()) for text in WAYS.values()) <= MOST
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert all(f"(docs/{name}.md)" in readme for name in WAYS)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=needs_ros if name == "for_roboticists" else ()) for name in WAYS]
)
def test_every_line_runs(name, folder):
    found, names, printed = blocks_of(WAYS[name]), {}, ""
    assert len(found) >= 3
    for language, block in found:
        if language == "bash":
            run_block(block)
        elif language == "python":
            with contextlib.redirect_stdout(io.StringIO()) as said:
                exec(compile(block, name, "exec"), names)
            printed = said.getvalue()
        else:
            assert printed == block
    assert min((folder / name).stat().st_size for name in LEFT[name]) > 10_000
