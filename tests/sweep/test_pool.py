"""Processes that run cases, and what becomes of those of a process that is killed."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from contact_sim_pkg.sweep.case import Task
from contact_sim_pkg.sweep.pool import Workers, run_all

DEADLY, ONCE = 3, 5


def tasks(folder, count=8):
    return [Task(number, "", (), str(folder), False, "") for number in range(count)]


def work(task):
    return {"number": task.number, "outcome": "finished", "metrics": [], "threads": os.environ["NUMBA_NUM_THREADS"]}


def deadly_work(task):
    """Case `DEADLY` always ends its process, case `ONCE` the first time."""
    mark = Path(task.folder) / "once"
    if task.number == DEADLY or (task.number == ONCE and not mark.exists()):
        mark.touch() if task.number == ONCE else None
        os.kill(os.getpid(), signal.SIGKILL)
    return work(task)


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_case_that_ends_its_process_is_one_row_and_takes_none_with_it(tmp_path, jobs):
    found = {row["number"]: row for row in run_all(tasks(tmp_path), jobs, deadly_work)}
    assert sorted(found) == list(range(8))
    assert [number for number, row in found.items() if row["outcome"] != "finished"] == [DEADLY]
    assert "killed" in found[DEADLY]["sentence"]


def test_a_process_that_ends_between_two_cases_costs_none(tmp_path):
    """As in a fit, or while a row is written."""
    with Workers(2, work) as workers:
        found = []
        for row in workers.run(tasks(tmp_path)):
            if row["number"] == 2:
                os.kill(next(iter(workers._pool._processes)), signal.SIGKILL)
                time.sleep(0.5)  # the pool has noticed
            found.append((row["number"], row["outcome"]))
    assert sorted(found) == [(number, "finished") for number in range(8)]


def test_no_process_outlives_the_one_that_began_it(tmp_path):
    """Which is killed while they wait for a case: they would do so for ever, 200 MB each."""
    program = (
        "import os, signal\nfrom tests.sweep.test_pool import tasks, work\nfrom contact_sim_pkg.sweep.pool import Workers\n"
        "with Workers(2, work) as workers:\n"
        f"    list(workers.run(tasks({str(tmp_path)!r})))\n"
        "    print(*workers._pool._processes, flush=True)\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    root = Path(__file__).parents[2]
    ended = subprocess.run([sys.executable, "-c", program], cwd=root, stdout=subprocess.PIPE, text=True, check=False)
    begun = [int(each) for each in ended.stdout.split()]
    assert begun
    until = time.monotonic() + 60.0
    while any(_is_there(each) for each in begun) and time.monotonic() < until:
        time.sleep(0.05)
    assert not any(_is_there(each) for each in begun)


def _is_there(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_a_process_has_one_thread(tmp_path):
    assert [row["threads"] for row in run_all(tasks(tmp_path, 1), 1, work)] == ["1"]


def test_a_program_without_a_guard_is_not_run_again_by_its_workers(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "from contact_sim_pkg.sweep.pool import run_all\n"
        "from tests.sweep.test_pool import tasks, work\n"
        "print(len(list(run_all(tasks('.', 2), 2, work))))\n"
    )
    places = os.pathsep.join(each for each in [str(Path(__file__).parents[2]), *sys.path] if each)
    found = subprocess.run(
        [sys.executable, str(program)], env={**os.environ, "PYTHONPATH": places}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (found.stdout, found.returncode) == ("2\n", 0), found.stderr
