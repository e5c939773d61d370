"""Processes are watched, named and ended, and what a killed one left in shared memory is removed (FAULTS F2)."""

import os
import sys
import time
from pathlib import Path

import pytest

from contact_sim_pkg.nodes.processes import shared_memory
from contact_sim_pkg.nodes.processes.children import Children, ErrorLines

CATCHES = """
import signal, sys, time
signal.signal(signal.SIGTERM, lambda *_: (print(sys.argv[1], file=sys.stderr, flush=True), sys.exit(0)))
print("up", file=sys.stderr, flush=True)
time.sleep(60)
"""
IGNORES = "import signal, sys, time\nsignal.signal(15, signal.SIG_IGN)\nprint('up', file=sys.stderr, flush=True)\ntime.sleep(60)"


@pytest.fixture
def printed():
    return []


@pytest.fixture
def children(printed):
    started = Children(os.environ, printed.append)
    yield started
    started.end(grace=0.0)


def until(condition):
    limit = time.monotonic() + 100.0
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.01)


def test_a_process_that_fails_is_named_with_its_status_and_its_last_line(children):
    code = "import sys; print('first', file=sys.stderr); print('the road ends', file=sys.stderr); sys.exit(4)"
    child = children.start("road_profile", [sys.executable, "-c", code])
    until(lambda: children.first_failed() is not None)
    assert child.describe_end() == "road_profile ended with status 4; it said last: the road ends"


def test_a_killed_process_is_named_with_its_signal(children):
    child = children.start(
        "vibration", [sys.executable, "-c", "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"]
    )
    until(lambda: children.first_failed() is not None)
    assert child.describe_end().startswith("vibration was ended by SIGKILL")


def test_a_process_that_ends_well_has_not_fallen(children):
    children.start("vibration", [sys.executable, "-c", ""])
    until(children.all_ended)
    assert children.first_failed() is None


def test_processes_are_ended_in_reverse_order(children, printed):
    for name in ("first", "second", "third"):
        children.start(name, [sys.executable, "-c", CATCHES, name])
    until(lambda: printed.count("up") == 3)
    assert children.end() == []
    until(lambda: len(printed) == 6)  # the last words come through a pipe
    assert printed[3:] == ["third", "second", "first"]


def test_a_process_that_does_not_end_is_killed_and_named(children, printed):
    children.start("deaf", [sys.executable, "-c", IGNORES])
    until(lambda: printed == ["up"])
    assert children.end(grace=0.1) == ["deaf"]
    assert children.all_ended()


def test_only_the_segments_that_nobody_uses_are_removed(monkeypatch):
    folder = Path(f"/dev/shm/contact_bench_test_{os.getpid()}")
    folder.mkdir()
    try:
        monkeypatch.setattr(shared_memory, "FOLDER", folder)
        for name in ("fastrtps_used", "fastrtps_used_el", "fastrtps_left", "fastrtps_left_el", "fastrtps_other"):
            (folder / name).write_bytes(b"\0" * 4096)
        code = f"import mmap, sys\nf = open({str(folder / 'fastrtps_used')!r}, 'r+b')\nm = mmap.mmap(f.fileno(), 0)\n{CATCHES}"
        lines: list[str] = []
        holder = Children(os.environ, lines.append)
        child = holder.start("holder", [sys.executable, "-c", code, "end"])
        until(lambda: lines == ["up"])
        assert shared_memory.mapped_segments(child.process.pid) == {"fastrtps_used"}
        assert shared_memory.remove_unused({"fastrtps_used", "fastrtps_left"}) == ["fastrtps_left", "fastrtps_left_el"]
        holder.end()
        assert sorted(entry.name for entry in folder.iterdir()) == [
            "fastrtps_other",
            "fastrtps_used",
            "fastrtps_used_el",
        ]
    finally:
        for entry in folder.iterdir():
            entry.unlink()
        folder.rmdir()


@pytest.mark.parametrize(
    ("failure", "expected"),
    [
        ("", ["INFO a: begun", "ERROR a: no block 3", "[FATAL] [1.0] [b]: lost"]),
        ("no block 3", ["INFO a: begun", "[FATAL] [1.0] [b]: lost"]),
        ("a ended with status 1; it said last: ERROR a: no block 3", ["INFO a: begun", "[FATAL] [1.0] [b]: lost"]),
        ("no block 3; bench recover BAG", ["INFO a: begun", "[FATAL] [1.0] [b]: lost"]),
        ("another", ["INFO a: begun", "ERROR a: no block 3", "[FATAL] [1.0] [b]: lost"]),
    ],
)
def test_an_error_that_is_the_failure_of_the_run_is_not_printed_twice(failure, expected):
    printed: list[str] = []
    lines = ErrorLines(printed.append)
    for line in ("ERROR a: no block 3", "INFO a: begun", "[FATAL] [1.0] [b]: lost"):
        lines.add(line)
    lines.release(failure)
    assert printed == expected
