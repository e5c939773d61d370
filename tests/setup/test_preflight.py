"""What set-up says about a machine that lacks something, before it downloads anything."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from set_up import preflight

PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture
def whole(tmp_path: Path) -> preflight.Facts:
    """A machine that lacks nothing."""
    (tmp_path / "Python.h").touch()
    return preflight.Facts(
        system="Linux",
        machine="x86_64",
        glibc=(2, 28),
        python=Path("/somewhere/python3"),
        python_version=(3, 11),
        headers=tmp_path,
        has_venv=True,
        c_compiler="cc",
        cxx_compiler="c++",
        ros_from_pip=True,
        project=Path("/somewhere/contact-bench"),
        free_bytes=int(1e11),
        is_writable=True,
    )


def test_a_whole_machine_has_no_faults(whole):
    assert preflight.faults(whole) == []


@pytest.mark.parametrize(
    ("lacking", "said"),
    [
        ({"machine": "aarch64"}, ["aarch64", "x86-64 only", "apt"]),
        ({"glibc": (2, 27)}, ["glibc 2.27", "2.28", "distribution of 2019"]),
        ({"glibc": None}, ["another C library", "2.28"]),
        ({"python_version": (3, 10)}, ["Python 3.10", "3.11 to 3.14", "PYTHON="]),
        ({"python_version": (3, 15)}, ["Python 3.15", "3.11 to 3.14", "PYTHON="]),
        ({"has_venv": False}, ["no venv module", "apt install python3.11-venv"]),
        ({"headers": Path("/nowhere")}, ["no Python.h in /nowhere", "apt install python3.11-dev"]),
        ({"c_compiler": None}, ["no C compiler", "cc, gcc, clang", "apt install gcc"]),
        ({"cxx_compiler": None}, ["no C++ compiler", "c++, g++, clang++", "apt install g++"]),
        ({"project": Path("/home/a b/bench")}, ["'/home/a b/bench'", "blank", "move the project"]),
        ({"project": Path("/home/Müller/bench")}, ["'/home/Müller/bench'", "beyond ASCII", "move the project"]),
        ({"is_writable": False}, ["/somewhere/contact-bench cannot be written", "copy of your own"]),
        ({"free_bytes": int(5e8)}, ["0.5 GB are free", "2 GB are needed"]),
        ({"system": "Darwin"}, ["Darwin", "Linux", "pip install ./contact_sim_pkg"]),
    ],
)
def test_each_lack_is_one_sentence_with_its_cure(whole, lacking, said):
    found = preflight.faults(whole._replace(**lacking))
    assert len(found) == 1
    assert all(words in found[0] for words in said), found[0]
    assert "\n" not in found[0]


def test_all_lacks_are_said_at_once(whole):
    found = preflight.faults(whole._replace(machine="riscv64", headers=Path("/nowhere"), c_compiler=None))
    assert len(found) == 3


def test_a_sourced_ros_needs_no_particular_processor(whole):
    assert preflight.faults(whole._replace(machine="aarch64", ros_from_pip=False)) == []


def test_a_compiler_without_its_headers_is_named(whole):
    broken = whole._replace(c_compiler="false", cxx_compiler="true")
    found = preflight.compiler_faults(broken, os.environ)
    assert len(found) == 1
    assert "the compiler false cannot translate" in found[0]


def test_without_any_python_the_script_says_so_and_ends_with_2(tmp_path):
    for tool in ("dirname", "basename", "cat"):
        (tmp_path / tool).symlink_to(Path("/usr/bin") / tool)
    # A python3 that is too old, as the script sees it: its question is answered with no.
    for name in ("python3", "python3.14", "python3.13", "python3.12", "python3.11"):
        (tmp_path / name).write_text("#!/bin/sh\nexit 1\n")
        (tmp_path / name).chmod(0o755)
    copy = tmp_path / "project" / "ros2_ws"
    copy.mkdir(parents=True)
    script = (PROJECT / "ros2_ws" / "set_up.sh").read_text().replace("/usr/bin/python3", "")
    (copy / "set_up.sh").write_text(script)
    result = subprocess.run(
        ["/bin/sh", str(copy / "set_up.sh")], env={"PATH": str(tmp_path)}, capture_output=True, text=True, check=False
    )
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith("set-up: no Python of 3.11 to 3.14 found")
    assert result.stderr.count("\n") == 1


def test_a_named_python_that_does_not_fit_is_refused():
    result = subprocess.run(
        ["/bin/sh", str(PROJECT / "ros2_ws" / "set_up.sh")],
        env={"PATH": os.environ["PATH"], "PYTHON": "false"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 2
    assert result.stderr == "set-up: PYTHON=false is not a Python of 3.11 to 3.14: name one that is.\n"


def test_what_a_python_that_cannot_start_says_is_shown(tmp_path):
    shim = tmp_path / "python3.13"
    shim.write_text("#!/bin/sh\necho 'pyenv: version 3.13.9 is not installed' >&2\necho 'set by x' >&2\nexit 127\n")
    shim.chmod(0o755)
    result = subprocess.run(
        ["/bin/sh", str(PROJECT / "ros2_ws" / "set_up.sh")],
        env={"PATH": os.environ["PATH"], "PYTHON": str(shim)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 2
    assert result.stderr.endswith(f"name one that is. ({shim}: pyenv: version 3.13.9 is not installed set by x)\n")


def test_a_folder_that_cannot_be_used_is_refused_before_anything_is_made(tmp_path):
    """The whole set-up, in a project whose path CMake's generators cannot carry."""
    project = tmp_path / "Prüfstand"
    shutil.copytree(PROJECT / "ros2_ws" / "set_up", project / "ros2_ws" / "set_up")
    for name in ("set_up.sh", "requirements.txt", "requirements-build-tools.txt", "colcon_defaults.yaml"):
        shutil.copy(PROJECT / "ros2_ws" / name, project / "ros2_ws" / name)
    before = sorted(project.rglob("*"))
    result = subprocess.run(
        ["/bin/sh", str(project / "ros2_ws" / "set_up.sh")],
        env={"PATH": os.environ["PATH"], "HOME": str(tmp_path), "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 2, result.stderr
    assert "Prüfstand" in result.stderr
    assert "beyond ASCII" in result.stderr
    assert sorted(project.rglob("*")) == before
