"""A second process that compiles beside the first."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from contact_sim_pkg.compiled import companion
from contact_sim_pkg.compiled.kernel_cache import _CheckedFiles

LIMIT = 100.0  # [s]


def note_process_and_wait(path):
    """What the second process does in these tests."""
    Path(path).with_suffix(".new").write_text(str(os.getpid()))
    Path(path).with_suffix(".new").rename(path)
    time.sleep(LIMIT)


WAITING = f"{__name__}:{note_process_and_wait.__name__}"


def process_in(path):
    limit = time.monotonic() + LIMIT
    while not path.exists() and time.monotonic() < limit:
        time.sleep(0.01)
    return int(path.read_text())


def has_ended(process):
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return True
    return state == "Z"  # ended; its parent has not asked yet


@pytest.fixture(autouse=True)
def _two_cores(monkeypatch):
    monkeypatch.setattr(companion.os, "sched_getaffinity", lambda _process: {0, 1})


def test_the_first_compilation_starts_it_and_it_ends_with_the_block(tmp_path):
    noted = tmp_path / "noted"
    with companion.accompanied(WAITING, str(noted)):
        assert not companion._running
        companion.begin()
        companion.begin()
        assert len(companion._running) == 1
        process = process_in(noted)
        assert not has_ended(process)
    assert has_ended(process)


def test_nothing_is_started_where_nothing_is_compiled(tmp_path):
    with companion.accompanied(WAITING, str(tmp_path / "noted")):
        pass
    companion.begin()
    assert not companion._running


def test_a_single_core_works_alone(tmp_path, monkeypatch):
    monkeypatch.setattr(companion.os, "sched_getaffinity", lambda _process: {0})
    with companion.accompanied(WAITING, str(tmp_path / "noted")):
        companion.begin()
        assert not companion._running


def test_it_ends_with_a_first_process_that_is_killed(tmp_path):
    noted = tmp_path / "noted"
    program = f"""
import sys, time
sys.path[:] = {sys.path!r}
from contact_sim_pkg.compiled import companion
companion.os.sched_getaffinity = lambda _process: {{0, 1}}
with companion.accompanied({WAITING!r}, {str(noted)!r}):
    companion.begin()
    time.sleep({LIMIT})
"""
    first = subprocess.Popen([sys.executable, "-c", program])
    try:
        second = process_in(noted)
    finally:
        first.send_signal(signal.SIGKILL)
        first.wait()
    limit = time.monotonic() + LIMIT / 2
    while not has_ended(second) and time.monotonic() < limit:
        time.sleep(0.01)
    assert has_ended(second)


def test_what_two_processes_save_of_one_function_at_once_is_both_there(tmp_path):
    """With numba's own files each would take the number 1 for its overload."""
    one, other = _CheckedFiles(str(tmp_path), "module.function"), _CheckedFiles(str(tmp_path), "module.function")
    one.save(("int64",), "machine code for integers")
    other.save(("float64",), "machine code for floats")
    for files in (one, other):
        assert files.load(("int64",)) == "machine code for integers"
        assert files.load(("float64",)) == "machine code for floats"
        assert files.load(("complex128",)) is None


def test_a_file_of_another_key_is_not_taken(tmp_path, monkeypatch):
    files = _CheckedFiles(str(tmp_path), "module.function")
    monkeypatch.setattr(_CheckedFiles, "path", lambda _self, _key: tmp_path / "same")
    files.save(("int64",), "machine code for integers")
    assert files.load(("float64",)) is None
