"""Processes that share a cache and need the same kernels."""

import os
import subprocess
import sys
import time

import pytest

from contact_sim_pkg.compiled import claims

LIMIT = 100.0  # [s]

PROGRAM = """
import sys, time
sys.path[:] = {path!r}
import numpy
from pathlib import Path
from contact_sim_pkg.compiled import claims, linking
from contact_sim_pkg.compiled.jit import compiled_kernels
from contact_sim_pkg.pressure.closed_form.lame import fit_patch
linking.make_at_once()
claims.LONGEST = {limit}
Path(sys.argv[1]).touch()
while not Path(sys.argv[2]).exists():
    time.sleep(0.001)
fit_patch(numpy.ones((8, 8)), 1.0, 1.0, 0.0, 0.0)
print(compiled_kernels())
"""

HOLD = """
import sys, time
sys.path[:] = {path!r}
from pathlib import Path
from contact_sim_pkg.compiled import claims
claims.claim(Path(sys.argv[1]))
print("claimed", flush=True)
time.sleep({limit})
"""


def compiled_by(folder, count):
    """Kernels compiled by each of some processes that begin at the same moment with an empty cache."""
    folder.mkdir()
    begin = folder / "begin"
    environment = dict(os.environ, CONTACT_BENCH_CACHE=str(folder / "cache"))
    program = PROGRAM.format(path=sys.path, limit=LIMIT)
    running = [
        subprocess.Popen(
            [sys.executable, "-c", program, str(folder / f"ready{number}"), str(begin)],
            stdout=subprocess.PIPE, text=True, env=environment,
        )
        for number in range(count)
    ]  # fmt: skip
    limit = time.monotonic() + LIMIT
    while len(list(folder.glob("ready*"))) < count and time.monotonic() < limit:
        time.sleep(0.01)
    begin.touch()
    return [int(each.communicate(timeout=LIMIT)[0]) for each in running]


def test_two_processes_compile_no_kernel_twice(tmp_path):
    (alone,) = compiled_by(tmp_path / "one", 1)
    both = compiled_by(tmp_path / "two", 2)
    assert alone > 5
    assert sum(both) == alone


@pytest.fixture
def kernel(tmp_path):
    (tmp_path / "directory").mkdir()
    path = tmp_path / "directory" / "kernel"
    yield path
    claims.release(path)


@pytest.fixture
def holder(kernel):
    """Another process that has claimed the kernel."""
    program = HOLD.format(path=sys.path, limit=LIMIT)
    process = subprocess.Popen([sys.executable, "-c", program, str(kernel)], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "claimed\n"
    yield process
    process.kill()
    process.wait()
    process.stdout.close()


def test_what_nobody_has_is_claimed_at_once(kernel):
    assert not claims.claim(kernel)


def test_the_claim_of_a_process_that_dies_ends(kernel, holder, monkeypatch):
    monkeypatch.setattr(claims, "LONGEST", LIMIT)
    holder.kill()
    began = time.monotonic()
    claims.claim(kernel)
    assert time.monotonic() - began < 0.5 * LIMIT


def test_nobody_waits_for_ever_for_one_that_was_suspended(kernel, holder, monkeypatch):
    monkeypatch.setattr(claims, "LONGEST", 0.2)
    assert claims.claim(kernel)


def test_another_kernel_is_free(kernel, holder):
    assert not claims.claim(kernel.with_name("another"))
    claims.release(kernel.with_name("another"))


def is_free(kernel):
    """For another process."""
    program = f"import sys; sys.path[:] = {sys.path!r}\nfrom pathlib import Path\nfrom contact_sim_pkg.compiled import claims\n"
    program += "claims.LONGEST = 0.05\nprint(claims.claim(Path(sys.argv[1])))"
    found = subprocess.run([sys.executable, "-c", program, str(kernel)], capture_output=True, text=True, check=True)
    return found.stdout.strip() == "False"


def test_a_failed_compilation_gives_its_claim_back_and_no_other(kernel):
    caller = kernel.with_name("caller")
    claims.claim(caller)
    claims.claim(kernel)
    with pytest.raises(ValueError, match="typing"), claims.given_back_on_failure():
        raise ValueError("typing")
    assert is_free(kernel)
    assert not is_free(caller)
    claims.release(caller)
    assert is_free(caller)


def test_what_a_kernel_calls_is_given_back_with_it(kernel):
    callee = kernel.with_name("callee")
    claims.claim(kernel)
    claims.claim(callee)  # compiled and never kept
    claims.release(kernel)
    assert is_free(callee)


def test_without_locks_each_compiles(kernel, monkeypatch):
    def refuse(*_arguments):
        raise OSError("no locks available")

    monkeypatch.setattr(claims.fcntl, "lockf", refuse)
    assert not claims.claim(kernel)
