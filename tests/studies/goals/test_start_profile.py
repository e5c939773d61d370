"""Where a first start goes: what a stack is called, and the samples of a process that ends by being killed."""

import json
import os
import subprocess
import sys
import threading
import time
from types import ModuleType

import pytest

from contact_sim_lab.goals import sampler
from contact_sim_lab.goals.start_profile import HOOK, SHOWN, sections

WORK = """
import sys, types
module = types.ModuleType("contact_sim_of_a_test")
exec('''
def work():
    while True:
        sum(range(1000))
''', module.__dict__)
module.work()
"""


def _labels(*modules):
    """What the stack is called in which modules of these names and texts run, each `call()` the next; a thread of its own has no
    frames of a test beyond.
    """
    found, rest = [], list(modules)

    def call():
        if rest:
            name, text = rest.pop(0)
            exec(compile(text, name, "exec"), ModuleType(name).__dict__ | {"call": call})
        else:
            found.append(sampler.label(sys._getframe(1)))

    thread = threading.Thread(target=call)
    thread.start()
    thread.join()
    return found


def test_a_stack_has_the_name_of_what_is_done():
    assert sampler.label(sys._getframe(), ("outer", "inner")) == "compile inner"
    assert _labels(("yaml.reader", "call()")) == ["import yaml"]
    assert _labels(("contact_sim_made.room", "call()")) == ["import contact_sim_made"]
    made = ModuleType("contact_sim_made")
    exec("class Rig:\n    def ready(self):\n        here()\n", made.__dict__)
    found = []
    made.here = lambda: found.append(sampler.label(sys._getframe(1)))
    thread = threading.Thread(target=made.Rig().ready)
    thread.start()
    thread.join()
    assert found == ["contact_sim_made.Rig.ready"]


def test_another_package_that_the_bench_imports_counts_as_itself():
    assert _labels(("contact_sim_made.room", "call()"), ("scipy.linalg", "call()")) == ["import scipy"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="/proc counts processor time of threads")
def test_samples_are_on_disk_before_the_process_is_killed(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(HOOK)
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-c", WORK], env={**os.environ, "PYTHONPATH": path, sampler.FOLDER: str(tmp_path)}
    )
    file, limit = tmp_path / f"{process.pid}.json", time.monotonic() + 60.0
    try:
        while not file.exists() or "contact_sim_of_a_test.work" not in json.loads(file.read_text()):
            assert process.poll() is None
            assert time.monotonic() < limit
            time.sleep(0.05)
    finally:
        process.kill()
        process.wait()
    counts = json.loads(file.read_text())
    # `work` calls nothing else that Python can see
    assert max(counts, key=counts.get) == "contact_sim_of_a_test.work"


def test_the_tables_lose_no_second():
    first = {"compile a.f": 2.0, "import numba": 1.0, "contact_sim_pkg.run": 0.5, "start and end of Python": 0.25}
    second = {"compile a.f": 1.0} | {f"compile a.f{number}": 0.125 for number in range(SHOWN + 4)}
    processes, functions = sections(9.0, [first, second])
    assert [row["sum [s]"] for row in processes.rows] == [3.75, 5.25]
    assert processes.rows[0] == {
        "process": 1,
        "import [s]": 1.0,
        "compile [s]": 2.0,
        "run [s]": 0.5,
        "start [s]": 0.25,
        "sum [s]": 3.75,
    }
    assert functions.rows[0] == {"what": "compile a.f", "s": 3.0}
    assert len(functions.rows) == SHOWN
    # 38 names: a.f, numba, run, start, and 34 alike, of which 26 are among the first 30
    assert functions.note.startswith("8 more take 1.0 s")
