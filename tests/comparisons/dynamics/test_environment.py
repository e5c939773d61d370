import json
import re
import subprocess
import types

from comparisons.dynamics import environment


def pins(path):
    lines = (line.strip() for line in path.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def test_everything_is_pinned_and_what_measuring_needs_is_as_in_the_lock():
    lock = set(pins(environment.ROOT / "ros2_ws" / "requirements.txt"))
    assert set(pins(environment.REQUIREMENTS / "requirements.txt")) <= lock
    for path in environment.REQUIREMENTS.glob("requirements*.txt"):
        assert all(re.fullmatch(r"[\w.-]+==[\w.]+(; .*)?", pin) for pin in pins(path))


def test_no_peer_is_a_dependency_of_the_project():
    lock = "\n".join(pins(environment.ROOT / "ros2_ws" / "requirements.txt"))
    package = (environment.ROOT / "contact_sim_pkg" / "setup.py").read_text(encoding="utf-8")
    assert not re.search("|".join(environment.PEERS), lock + package, re.IGNORECASE)


def test_a_peer_that_cannot_be_installed_is_left_out_with_the_reason(tmp_path, monkeypatch):
    monkeypatch.setattr(environment, "ENVIRONMENT", tmp_path / ".compare-dynamics")

    def run(command, **_options):
        (tmp_path / ".compare-dynamics").mkdir(exist_ok=True)
        failed = any("mujoco" in part for part in command)
        return types.SimpleNamespace(returncode=int(failed), stderr="note\nERROR: no wheel\n" if failed else "")

    monkeypatch.setattr(subprocess, "run", run)
    environment.make_current(lambda _text: None, {})
    left_out = json.loads((tmp_path / ".compare-dynamics" / environment.LEFT_OUT).read_text())
    assert left_out == {"mujoco": "pip ended with 1: ERROR: no wheel"}
