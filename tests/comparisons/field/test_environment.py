import re

from comparisons.field import environment


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
    assert not re.search(r"tamaas|aspher", lock + package, re.IGNORECASE)


def test_the_environment_has_one_thread_and_no_path_from_outside():
    kept = environment.clean({"PATH": "/bin", "PYTHONPATH": "/elsewhere", "PYTHONHOME": "/x", "OMP_NUM_THREADS": "8"})
    assert kept["PATH"] == "/bin"
    assert kept["OMP_NUM_THREADS"] == kept["NUMBA_NUM_THREADS"] == "1"
    assert "/elsewhere" not in kept["PYTHONPATH"]
    assert "PYTHONHOME" not in kept


def test_the_reason_of_a_failed_installation_is_its_last_error(tmp_path):
    log = tmp_path / "log"
    log.write_text("Collecting aspher\nERROR: no compiler\nnote: see above\n", encoding="utf-8")
    assert environment._last_error(log) == "ERROR: no compiler"


def test_a_peer_that_cannot_be_installed_is_left_out_with_the_reason(tmp_path, monkeypatch):
    monkeypatch.setattr(environment, "ENVIRONMENT", tmp_path / ".compare-field")
    monkeypatch.setattr(environment, "ROOT", tmp_path)
    monkeypatch.setattr(
        environment, "_must", lambda _command, _what: (tmp_path / ".compare-field").mkdir(exist_ok=True)
    )
    monkeypatch.setattr(environment, "_install_tamaas", lambda _log: 0)

    def fail(log):
        log.write_text("CMake Error: no C++ compiler\n", encoding="utf-8")
        return 1

    monkeypatch.setattr(environment, "_install_aspher", fail)
    told = []
    left_out = environment.make_current(told.append)
    assert left_out == {
        "ASPHER": "pip ended with 1: CMake Error: no C++ compiler (all of it: .compare-field/ASPHER.log)"
    }
    assert environment.make_current(told.append) == left_out
    assert len(told) == 3  # the second call makes nothing
