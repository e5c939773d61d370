"""Comparisons in environments of their own: pinned, outside of the project's dependencies, and honest about what is missing."""

import json
import os
import re
import subprocess
import sys

import pytest

from comparisons import environment
from comparisons.dynamics.environment import ENVIRONMENT as DYNAMICS
from comparisons.field.environment import ENVIRONMENT as FIELD

LOCK = environment.ROOT / "ros2_ws" / "requirements.txt"
BOTH = pytest.mark.parametrize("own", [FIELD, DYNAMICS], ids=lambda each: each.folder.name)


def pins(path):
    lines = (line.strip() for line in path.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


@BOTH
def test_everything_is_pinned_and_what_measuring_needs_is_as_in_the_lock(own):
    assert set(pins(own.requirements / "requirements.txt")) <= set(pins(LOCK))
    for path in own.requirements.glob("requirements*.txt"):
        assert all(re.fullmatch(r"[\w.-]+==[\w.]+(; .*)?", pin) for pin in pins(path))


@BOTH
def test_no_peer_is_a_dependency_of_the_project(own):
    lock = "\n".join(pins(LOCK))
    package = (environment.ROOT / "contact_sim_pkg" / "setup.py").read_text(encoding="utf-8")
    assert not re.search("|".join(own.peers), lock + package, re.IGNORECASE)


def test_the_environment_has_one_thread_and_no_path_from_outside():
    kept = environment.clean({"PATH": "/bin", "PYTHONPATH": "/elsewhere", "PYTHONHOME": "/x", "OMP_NUM_THREADS": "8"})
    assert kept["PATH"] == "/bin"
    assert kept["OMP_NUM_THREADS"] == kept["NUMBA_NUM_THREADS"] == "1"
    assert "/elsewhere" not in kept["PYTHONPATH"]
    assert "PYTHONHOME" not in kept


@pytest.mark.parametrize("module", ["comparisons.field.run", "comparisons.dynamics.run"])
def test_what_measures_is_found_by_the_variables_of_the_environment(module):
    command, kept = [sys.executable, "-c", f"import {module}"], environment.clean(dict(os.environ))
    ran = subprocess.run(command, env=kept, cwd=environment.ROOT, capture_output=True, text=True, timeout=120)
    assert ran.returncode == 0, ran.stderr


@pytest.fixture
def empty(tmp_path):
    """A requirements folder that needs nothing, so that making an environment needs no network."""
    (tmp_path / "requirements.txt").write_text("# nothing\n", encoding="utf-8")
    (tmp_path / "requirements_absent.txt").write_text("no-such-peer==1.0\n", encoding="utf-8")
    return tmp_path


def test_a_peer_that_cannot_be_installed_is_left_out_with_the_reason(empty):
    def absent(own, log):
        return own.pip(log, "--no-index", "-r", own.pins("requirements_absent.txt"))

    own = environment.Environment(empty / ".compare", empty, {"gone": absent, "there": lambda _own, _log: 0})
    told = []
    own.make_current(told.append)
    reasons = json.loads((own.folder / environment.LEFT_OUT).read_text(encoding="utf-8"))
    assert list(reasons) == ["gone"]
    assert re.fullmatch(
        r"pip ended with 1: ERROR: No matching distribution found for no-such-peer==1\.0 \(all of it: \.compare/gone\.log\)",
        reasons["gone"],
    )
    own.make_current(told.append)
    assert told == ["making .compare/", "installing gone", "installing there"], "the second call makes nothing"


def test_an_environment_that_cannot_be_made_ends_with_2_and_the_cure(empty, capfd):
    (empty / "requirements.txt").write_text("no-such-package==1.0\n", encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PIP_NO_INDEX", "1")
        status = environment.Environment(empty / ".compare", empty, {}).run("platform", [])
    assert status == 2
    assert "what measuring needs could not be installed" in capfd.readouterr().err


def test_a_module_runs_in_the_environment_with_its_arguments(empty, capfd):
    assert environment.Environment(empty / ".compare", empty, {}).run("this", []) == 0
    assert "Zen" in capfd.readouterr().out


def test_what_is_left_out_is_read_where_it_runs(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    assert environment.left_out() == {}
    (tmp_path / environment.LEFT_OUT).write_text(json.dumps({"MuJoCo": "no wheel"}), encoding="utf-8")
    assert environment.left_out() == {"MuJoCo": "no wheel"}
