"""`make check` compiles nothing, uses no ROS and starts no program; what needs none of these is in it by itself."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.conftest import LAST_DOMAIN, ros_domain

ROOT = Path(__file__).resolve().parents[1]
IN_A_TEST = """
import pytest

def start():
    {statement}

def test_a():
    with pytest.raises(Exception):
        start()
    try:
        start()
    except Exception:
        pass

def test_b():
    pass
"""


def check(*arguments: object) -> str:
    """What `pytest --check` prints."""
    command = [sys.executable, "-m", "pytest", "--check", "-p", "no:cacheprovider", "-c", ROOT / "pyproject.toml"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])}
    return subprocess.run(
        [*map(str, command), *map(str, arguments)],
        env=environment,
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    ).stdout


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ("import numba", "needs numba"),
        ("import rclpy", "needs rclpy"),
        ("import subprocess; subprocess.Popen(['true'])", "starts a program"),
        ("import os; os.fork()", "starts a program"),
        ("import os; os.posix_spawn('/bin/true', ['true'], {})", "starts a program"),
    ],
)
def test_a_test_that_needs_compiler_ros_or_program_is_skipped_whatever_it_catches(tmp_path, statement, told):
    inside, outside = tmp_path / "test_inside.py", tmp_path / "test_outside.py"
    inside.write_text(IN_A_TEST.format(statement=statement))
    outside.write_text(statement + "\ndef test_a(): pass\n")
    said = check("-p", "tests.conftest", "-rs", inside, outside)
    assert re.search(rf"SKIPPED \[2\] .*{told}: in `make test`", said), said
    assert "1 passed, 2 skipped" in said


def test_the_check_holds_the_tests_of_what_needs_no_kernel():
    folders = ("bag", "excitation", "nodes", "scene")
    collected = check("--collect-only", "-q", *(ROOT / "tests" / folder for folder in folders))
    found = re.findall(r"^tests/(\w+)/.*: (\d+)$", collected, re.MULTILINE)
    counts = {folder: sum(int(count) for each, count in found if each == folder) for folder in folders}
    assert min(counts.values()) > 50, counts


def test_workers_of_one_run_have_domains_of_their_own():
    domains = [ros_domain("run", f"gw{number}") for number in range(LAST_DOMAIN)]
    assert sorted(domains) == list(range(1, LAST_DOMAIN + 1))
    assert ros_domain("run", "") == ros_domain("run", "gw0")
