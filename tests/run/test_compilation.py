"""Reports while kernels are compiled."""

import itertools
import time

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.run import compilation


@pytest.fixture(autouse=True)
def _often(monkeypatch):
    monkeypatch.setattr(compilation, "PERIOD", 0.01)


def test_the_number_of_compiled_kernels_is_reported_as_it_grows(monkeypatch):
    counted = itertools.chain([5, 5, 7], itertools.repeat(9))
    monkeypatch.setattr(compilation, "_kernels", lambda: next(counted))
    lines: list[str] = []
    with compilation.reported_compilation(resolved("block_fall"), lines.append):
        limit = time.monotonic() + 100.0
        while len(lines) < 2 and time.monotonic() < limit:
            time.sleep(0.01)
    assert [line.rpartition(", ")[0] for line in lines] == [
        f"compiling kernels, once: {number} of about 290" for number in (2, 4)
    ]


def test_nothing_is_reported_where_all_kernels_come_from_the_disk(monkeypatch):
    looks = itertools.count()
    monkeypatch.setattr(compilation, "_kernels", lambda: (next(looks), 3)[1])
    lines: list[str] = []
    with compilation.reported_compilation(resolved("seat_slap"), lines.append):
        while next(looks) < 10:
            time.sleep(0.01)
    assert lines == []


def test_what_is_computed_beside_compiling_is_reported_while_it_lasts(monkeypatch):
    monkeypatch.setattr(compilation, "_kernels", lambda: 3)
    lines: list[str] = []
    with compilation.reported_compilation(resolved("seat_slap"), lines.append):
        compilation.note_computation("computing a table, once: 40 %")
        limit = time.monotonic() + 100.0
        while not lines and time.monotonic() < limit:
            time.sleep(0.01)
        compilation.note_computation("")
    assert lines
    assert {line.rpartition(", ")[0] for line in lines} == {"computing a table, once: 40 %"}


@pytest.mark.fault("H7")
def test_a_cache_that_is_emptied_meanwhile_holds_no_kernels(monkeypatch, tmp_path):
    monkeypatch.setattr(compilation, "cache_directory", lambda: tmp_path / "gone")
    assert compilation._kernels() == 0
    (tmp_path / "gone").mkdir()
    (tmp_path / "gone" / "one").touch()
    assert compilation._kernels() == 1
