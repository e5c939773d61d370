"""What a killed supervisor leaves is removed by the last of its processes, or at the next start; nothing else is."""

import fcntl
import subprocess
import sys
from pathlib import Path

import pytest

from contact_sim_pkg.nodes.processes import run_folder, shared_memory

SUPERVISES = """
import sys
from contact_sim_pkg.nodes.processes.run_folder import RunFolder
folder = RunFolder()
folder.keep_segments({"fastrtps_ours"})
print(folder.path, flush=True)
sys.stdin.read()
"""
TAKES_PART = """
import sys
from pathlib import Path
from contact_sim_pkg.nodes.processes import run_folder, shared_memory
shared_memory.FOLDER = Path(sys.argv[2])
run_folder.join(Path(sys.argv[1]))
print("in", flush=True)
sys.stdin.read()
run_folder.leave()
"""


@pytest.fixture
def root(tmp_path, monkeypatch):
    """Folders of runs in one place, shared memory in another."""
    memory = tmp_path / "shm"
    memory.mkdir()
    monkeypatch.setattr(run_folder.tempfile, "gettempdir", lambda: str(tmp_path))
    monkeypatch.setattr(run_folder.tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(shared_memory, "FOLDER", memory)
    for name in ("fastrtps_ours", "fastrtps_ours_el", "fastrtps_other"):
        (memory / name).touch()
    return tmp_path


@pytest.fixture
def started(root):
    """Starts a process whose first line is returned beside it; all are killed at the end."""
    processes = []

    def start(code: str, *arguments: object) -> tuple[subprocess.Popen[str], str]:
        process = subprocess.Popen(
            [sys.executable, "-c", code, *map(str, arguments)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env={**run_folder.os.environ, "TMPDIR": str(root)},
        )  # fmt: skip
        processes.append(process)
        return process, process.stdout.readline().strip()

    yield start
    for process in processes:
        process.kill()
        process.wait()


def left(root: Path) -> set[str]:
    return {entry.name for entry in (root / "shm").iterdir()}


def kill(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.wait()


def test_a_run_that_ends_leaves_no_folder(root):
    with run_folder.RunFolder() as folder:
        assert folder.path.parent == root
    assert not folder.path.exists()


def test_the_next_start_removes_what_a_killed_run_left_and_nothing_else(root, started):
    (root / "contact_bench_of_a_launch").mkdir()
    supervisor, folder = started(SUPERVISES)
    kill(supervisor)
    with run_folder.RunFolder():
        assert not Path(folder).exists()
    assert left(root) == {"fastrtps_other"}
    assert (root / "contact_bench_of_a_launch").exists()


def test_a_run_under_way_is_left_alone_by_the_next_start(root, started):
    _, folder = started(SUPERVISES)
    with run_folder.RunFolder():
        assert Path(folder, "lock").exists()
    assert "fastrtps_ours" in left(root)


def test_the_last_process_of_a_killed_supervisor_removes_what_is_left(root, started):
    supervisor, folder = started(SUPERVISES)
    first, second = (started(TAKES_PART, folder, root / "shm")[0] for _ in range(2))
    kill(supervisor)
    first.communicate()
    assert Path(folder).exists()
    assert "fastrtps_ours" in left(root)
    second.communicate()
    assert not Path(folder).exists()
    assert left(root) == {"fastrtps_other"}


def test_processes_of_a_killed_supervisor_that_end_together_leave_nothing(root, started):
    supervisor, folder = started(SUPERVISES)
    processes = [started(TAKES_PART, folder, root / "shm")[0] for _ in range(3)]
    kill(supervisor)
    for process in processes:
        process.stdin.close()
    for process in processes:
        process.wait()
    assert not Path(folder).exists()
    assert left(root) == {"fastrtps_other"}


def test_a_segment_whose_owner_has_its_lock_is_left_alone(root):
    with (root / "shm" / "fastrtps_ours_el").open("r+b") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        assert shared_memory.remove_unused({"fastrtps_ours"}) == []
    assert shared_memory.remove_unused({"fastrtps_ours"}) == ["fastrtps_ours", "fastrtps_ours_el"]


def test_names_that_are_no_segments_of_the_middleware_are_never_removed(root):
    (root / "shm" / "database").touch()
    assert shared_memory.remove_unused({"database", "fastrtps_ours"}) == ["fastrtps_ours", "fastrtps_ours_el"]
    assert (root / "shm" / "database").exists()
