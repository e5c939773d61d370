"""Compile options and the kernel cache on disk. Each start is a process of its own, on a small package with kernels."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numba
import numpy
import pytest

from contact_sim_pkg.compiled import jit, kernel_cache, linking
from contact_sim_pkg.pressure.closed_form import hertz, lame
from contact_sim_pkg.pressure.field import halfspace, patch
from contact_sim_pkg.pressure.field import solver as field_solver

PACKAGE = Path(kernel_cache.__file__).parents[1]

HELPER = """
from contact_sim_pkg.compiled.jit import kernel

@kernel
def factor(x):
    return 2.0 * x
"""

CALLER = """
from contact_sim_pkg.laws.helper import factor
from contact_sim_pkg.compiled.jit import entry

@entry
def total(values):
    result = 0.0
    for i in range(values.size):
        result += factor(values[i])
    return result
"""

PROGRAM = """
import json
import numpy
from contact_sim_pkg.compiled import kernel_cache
from contact_sim_pkg.laws.caller import total
value = total(numpy.ones(3))
directory = kernel_cache.cache_directory()
print(json.dumps({
    "value": value,
    "directory": str(directory) if directory else None,
    "hits": sum(total.stats.cache_hits.values()),
}))
"""


class Start:
    """A small package with kernels, started as often as a test needs."""

    def __init__(self, folder: Path) -> None:
        self.package = folder / "source" / "contact_sim_pkg"
        self.laws = self.package / "laws"
        for room in (self.laws, self.package / "compiled"):
            room.mkdir(parents=True)
            (room / "__init__.py").touch()
        for name in (
            "assembler.py",
            "call_graph.py",
            "claims.py",
            "companion.py",
            "compiler.py",
            "held.py",
            "held_reference.py",
            "jit.py",
            "kernel_cache.py",
            "linking.py",
            "outside.py",
            "sources.py",
            "tested.py",
        ):
            shutil.copy(PACKAGE / "compiled" / name, self.package / "compiled" / name)
        shutil.copy(PACKAGE / "python_process.py", self.package)
        (self.laws / "helper.py").write_text(HELPER)
        (self.laws / "caller.py").write_text(CALLER)
        self.cache = folder / "cache"
        self.log = ""
        self.name = kernel_cache.fingerprint(self.package)

    def environment(self, **more: str) -> dict[str, str]:
        kept = {key: value for key, value in os.environ.items() if not key.startswith("NUMBA_")}
        source = str(self.package.parent)
        # Python takes bytecode of an edit within the same second for that of the file before it
        fresh = {"PYTHONDONTWRITEBYTECODE": "1"}
        return {**kept, "PYTHONPATH": source, "CONTACT_BENCH_CACHE": str(self.cache), **fresh, **more}

    def command(self, before: str = "") -> list[str]:
        return [sys.executable, "-c", before + PROGRAM]

    def __call__(self, before: str = "", **environment: str) -> dict[str, Any]:
        done = subprocess.run(
            self.command(before),
            env=self.environment(**environment),
            cwd=self.package,
            capture_output=True,
            text=True,
            check=True,
        )
        self.log = done.stderr
        answer: dict[str, Any] = json.loads(done.stdout)
        return answer

    def directory(self) -> Path:
        """The directory that a start without special settings uses."""
        return self.cache / self.name

    def warnings(self) -> list[str]:
        return [line for line in self.log.splitlines() if line.strip()]


@pytest.fixture
def start(tmp_path: Path) -> Start:
    """An empty cache."""
    return Start(tmp_path)


@pytest.fixture(scope="module")
def warm(tmp_path_factory: pytest.TempPathFactory) -> Start:
    """A cache that is filled, and whole again after each test; starting takes about a second, so it is shared."""
    warm = Start(tmp_path_factory.mktemp("warm"))
    assert warm()["hits"] == 0
    return warm


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The cache root of this process, not yet made."""
    monkeypatch.setenv("CONTACT_BENCH_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_h1_an_edited_helper_in_another_file_is_never_served_stale(start: Start) -> None:
    assert start()["value"] == 6.0
    (start.laws / "helper.py").write_text(HELPER.replace("2.0", "5.0"))
    assert start()["value"] == 15.0


@pytest.mark.parametrize("damage", ["empty", "short", "noise", "flipped"])
def test_h2_a_damaged_cache_is_removed_and_compiled_again_with_one_warning(warm: Start, damage: str) -> None:
    files = list(warm.directory().iterdir())
    assert files
    for path in files:
        content = path.read_bytes()
        middle = len(content) // 2
        flipped = content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]
        noise = numpy.random.default_rng(1).bytes(len(content))
        path.write_bytes({"empty": b"", "short": content[:100], "noise": noise, "flipped": flipped}[damage])
    answer = warm()
    assert (answer["value"], answer["hits"]) == (6.0, 0)
    assert len(warm.warnings()) == 1
    assert "damaged" in warm.log


def test_h3_an_unusable_directory_means_one_line_and_a_run_without_cache(start: Start, tmp_path: Path) -> None:
    (tmp_path / "a_file").touch()
    answer = start(CONTACT_BENCH_CACHE=str(tmp_path / "a_file" / "cache"))
    assert (answer["value"], answer["directory"]) == (6.0, None)
    assert len(start.warnings()) == 1
    assert "not kept on disk" in start.log


@pytest.mark.skipif(os.getuid() == 0, reason="root may write into read-only directories")
def test_h3_a_read_only_directory_is_refused(root: Path) -> None:
    kernel_cache.open_cache_directory("name").chmod(0o500)
    with pytest.raises(PermissionError, match="cannot be written"):
        kernel_cache.open_cache_directory("name")


def test_h3_a_full_disk_means_one_line_and_a_run_without_cache(start: Start) -> None:
    answer = start(before="import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))\n")
    assert answer["value"] == 6.0
    assert len(start.warnings()) == 1
    assert "not kept on disk" in start.log


def test_h4_the_number_of_files_stays_and_every_later_start_hits(warm: Start) -> None:
    files = sorted(warm.directory().iterdir())
    assert [warm()["hits"], warm()["hits"]] == [1, 1]
    assert warm.log == ""
    assert sorted(warm.directory().iterdir()) == files


def make_used(root: Path, hours: dict[str, float]) -> None:
    """Directories of other fingerprints that were last used these hours ago."""
    root.mkdir(mode=0o700, exist_ok=True)
    for name, ago in hours.items():
        (root / name).mkdir(mode=0o700, exist_ok=True)
        os.utime(root / name, (time.time() - 3600.0 * ago,) * 2)


def test_h4_older_fingerprints_are_pruned_to_two(root: Path) -> None:
    make_used(root, {"older": 40.0, "old": 39.0, "recent": 38.0, "newest": 37.0})
    kernel_cache.open_cache_directory("current")
    assert {path.name for path in root.iterdir()} == {"recent", "newest", "current"}


def test_h7_what_was_used_within_a_day_or_is_in_use_stays(root: Path) -> None:
    """Three other fingerprints start beside a run that has lasted two days."""
    make_used(root, {"old": 25.0, "day": 23.0, "hour": 1.0, "now": 0.0})
    kernel_cache.open_cache_directory("running")
    make_used(root, {"running": 48.0})
    for name in ("second", "third", "fourth"):
        kernel_cache.open_cache_directory(name)
    assert {path.name for path in root.iterdir()} == {"day", "hour", "now", "running", "second", "third", "fourth"}


@pytest.mark.parametrize("what", ["cache_directory()", "cache_directory().parent"])
def test_h7_a_folder_that_vanishes_is_no_error(start: Start, what: str) -> None:
    gone = (
        "import shutil\nfrom contact_sim_pkg.compiled import kernel_cache\nfrom contact_sim_pkg.laws.caller import total\n"
        f"shutil.rmtree(kernel_cache.{what})\n"
    )
    assert start(before=gone)["value"] == 6.0
    assert start.log == ""
    assert start()["hits"] == 1  # what it compiled was kept all the same


def test_h5_processes_that_compile_at_once_all_succeed(start: Start) -> None:
    running = [
        subprocess.Popen(start.command(), env=start.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for _ in range(4)
    ]
    answers = [process.communicate() for process in running]
    assert [json.loads(out)["value"] for out, _ in answers] == [6.0] * 4
    assert [error for _, error in answers] == [b""] * 4
    assert start()["hits"] == 1


def test_another_path_to_the_same_package_finds_its_kernels(warm: Start, tmp_path: Path) -> None:
    """As the workspace of ROS has it: links to the sources."""
    (tmp_path / "linked").symlink_to(warm.package.parent)
    shutil.copytree(warm.package.parent, tmp_path / "copied")
    assert [warm(PYTHONPATH=str(tmp_path / way))["hits"] for way in ("linked", "copied")] == [1, 1]


def test_h6_another_processor_gets_a_directory_of_its_own(warm: Start) -> None:
    generic = warm(NUMBA_CPU_NAME="generic", NUMBA_CPU_FEATURES="")
    assert generic["directory"] != str(warm.directory())
    assert (generic["value"], generic["hits"]) == (6.0, 0)


@pytest.mark.parametrize(("setting", "value"), [("BOUNDSCHECK", 1), ("OPT", 0), ("CPU_NAME", "generic")])
def test_compiler_settings_change_the_fingerprint(monkeypatch: pytest.MonkeyPatch, setting: str, value: object) -> None:
    before = kernel_cache.fingerprint(PACKAGE)
    assert kernel_cache.fingerprint(PACKAGE) == before
    monkeypatch.setattr(numba.config, setting, value)
    assert kernel_cache.fingerprint(PACKAGE) != before


def test_g3_directories_are_private(root: Path) -> None:
    directory = kernel_cache.open_cache_directory("name")
    assert directory.stat().st_mode & 0o777 == 0o700
    assert root.stat().st_mode & 0o777 == 0o700


def test_g3_nothing_is_loaded_from_a_directory_open_to_others(warm: Start) -> None:
    directory = warm.directory()
    directory.chmod(0o777)
    answer = warm()
    directory.chmod(0o700)
    assert (answer["value"], answer["directory"], answer["hits"]) == (6.0, None, 0)
    assert len(warm.warnings()) == 1
    assert str(directory) in warm.log


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o707])
@pytest.mark.parametrize("which", ["fingerprint", "root", "parent"])
def test_g3_a_directory_open_to_others_is_refused(root: Path, which: str, mode: int) -> None:
    directory = kernel_cache.open_cache_directory("name")
    opened = {"fingerprint": directory, "root": root, "parent": root.parent}[which]
    opened.chmod(mode)
    with pytest.raises(PermissionError, match=f"{opened} is open to other users"):
        kernel_cache.open_cache_directory("name")


@pytest.mark.parametrize("which", ["fingerprint", "root"])
def test_g3_the_sticky_bit_does_not_make_an_open_directory_trusted(root: Path, which: str) -> None:
    """Others cannot remove our files there, but they can add files of their own, which numba would load."""
    directory = kernel_cache.open_cache_directory("name")
    {"fingerprint": directory, "root": root}[which].chmod(0o1777)
    with pytest.raises(PermissionError, match="is open to other users"):
        kernel_cache.open_cache_directory("name")


@pytest.mark.skipif(os.getuid() != 0, reason="only root can give a directory to another user")
@pytest.mark.parametrize("which", ["fingerprint", "root", "parent"])
def test_g3_a_directory_of_another_user_is_refused(root: Path, which: str) -> None:
    directory = kernel_cache.open_cache_directory("name")
    os.chown({"fingerprint": directory, "root": root, "parent": root.parent}[which], 12345, 12345)
    with pytest.raises(PermissionError, match="belongs to user 12345"):
        kernel_cache.open_cache_directory("name")


FOREIGN = {"mode": lambda path: path.chmod(0o666), "owner": lambda path: os.chown(path, 12345, 12345)}


@pytest.mark.parametrize("which", FOREIGN)
def test_g9_a_file_that_others_own_or_may_write_is_not_read_but_compiled_anew(warm: Start, which: str) -> None:
    if which == "owner" and os.getuid() != 0:
        pytest.skip("only root can give a file to another user")
    for path in warm.directory().iterdir():
        FOREIGN[which](path)
    answer = warm()
    assert (answer["value"], answer["hits"]) == (6.0, 0)
    assert len(warm.warnings()) == 1
    assert "it is not read, and compiled again" in warm.log
    assert warm()["hits"] == 1  # what was compiled has taken its place
    assert warm.log == ""


def test_g3_a_link_in_place_of_the_directory_is_refused(root: Path) -> None:
    directory = kernel_cache.open_cache_directory("name")
    directory.rename(root / "elsewhere")
    directory.symlink_to(root / "elsewhere")
    with pytest.raises(PermissionError, match="not a directory of its own"):
        kernel_cache.open_cache_directory("name")


def test_without_override_the_cache_is_in_the_user_s_cache_directory(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("CONTACT_BENCH_CACHE", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert kernel_cache.cache_root() == tmp_path / "xdg" / "contact_bench"
    for ignored in ("", "relative/path"):
        monkeypatch.setenv("XDG_CACHE_HOME", ignored)
        assert kernel_cache.cache_root() == tmp_path / ".cache" / "contact_bench"


def test_d2_no_compiled_function_uses_fastmath_and_all_follow_the_numpy_error_model() -> None:
    functions = jit.compiled_functions()
    modules = {function.py_func.__module__ for function in functions}
    assert {module.__name__ for module in (field_solver, halfspace, hertz, lame, patch)} <= modules
    for function in functions:
        assert function.targetoptions["fastmath"] is False
        assert function.targetoptions["error_model"] == "numpy"
        assert function.targetoptions["nogil"] is True


@jit.entry
def count_bad_cells(values: Any) -> int:
    bad = 0
    for i in range(values.size):
        bad += 0 if numpy.isfinite(values[i]) else 1
    return bad


MANY = numpy.full(1 << 18, 7.0)


@jit.entry
def first_of_many() -> float:
    return MANY[0]


@jit.entry
def compensated_sum(values: Any) -> float:
    total, lost = 0.0, 0.0
    for i in range(values.size):
        value = values[i] - lost
        moved = total + value
        lost = (moved - total) - value
        total = moved
    return total


@jit.entry
def reciprocal(value: float) -> float:
    return 1.0 / value


def test_d2_a_guard_sees_poisoned_cells() -> None:
    assert count_bad_cells(numpy.array([1.0, numpy.nan, 2.0, numpy.inf, -3.0])) == 2


def test_d2_a_compensated_sum_keeps_its_correction() -> None:
    values = numpy.concatenate([[1.0], numpy.full(100_000, 1e-16)])
    assert compensated_sum(values) == pytest.approx(1.0 + 1e-11, rel=1e-15)


def test_h2_a_function_that_numba_declines_to_cache_is_no_damage() -> None:
    """A large global array is one reason; all that is kept beside it stays."""
    directory = kernel_cache.cache_directory()
    assert directory is not None
    count_bad_cells(numpy.zeros(3))
    root = directory.parent  # the kernels of tests lie in a directory of their own
    kept = set(root.glob("*/*"))
    with pytest.warns(numba.NumbaWarning, match="Cannot cache"):
        assert first_of_many() == 7.0
    assert kept
    assert kept <= set(root.glob("*/*"))


@pytest.mark.fault("D6")
def test_a_division_by_zero_is_infinite_instead_of_an_exception() -> None:
    assert reciprocal(0.0) == numpy.inf


@pytest.mark.fault("C4")
def test_while_compilation_is_closed_a_new_type_raises_at_once_and_known_types_go_on() -> None:
    count_bad_cells(numpy.ones(3))
    with jit.closed():
        assert count_bad_cells(numpy.array([numpy.nan])) == 1
        with pytest.raises(TypeError, match="No matching definition"):
            count_bad_cells(numpy.ones(3, dtype=numpy.float32))
        assert len(count_bad_cells.signatures) == 1
    assert count_bad_cells(numpy.ones(3, dtype=numpy.float32)) == 0


@pytest.mark.fault("C4")
def test_while_compilation_is_closed_an_integer_for_a_float_does_not_compile() -> None:
    reciprocal(4.0)
    before = len(reciprocal.signatures)
    with jit.closed():
        assert reciprocal(4) == 0.25
        assert len(reciprocal.signatures) == before


@pytest.mark.parametrize(
    ("old", "new", "small_is_machine_code"),
    [
        ("LARGEST_LINKED = 60_000", "LARGEST_LINKED = 60_000", False),
        ("LARGEST_LINKED = 60_000", "LARGEST_LINKED = 0", True),  # every kernel is called by its symbol
        ('TESTED = ("0.66.", "0.67.", "0.68.")', 'TESTED = ("0.0.",)', None),  # numba's own way
    ],
)
def test_a_small_kernel_is_linked_and_a_large_one_called(
    start: Start, old: str, new: str, small_is_machine_code: bool | None
) -> None:
    (edited,) = (path for path in (start.package / "compiled").glob("*.py") if old in path.read_text())
    edited.write_text(edited.read_text().replace(old, new))
    look = """
import atexit
from contact_sim_pkg.laws import helper
def show():
    bare, = helper.factor.get_overload.__self__.overloads.values()
    print(getattr(bare.library, "is_machine_code", None), file=open("kind.txt", "w"))
atexit.register(show)
"""
    answers = [start(look) for _ in range(2)]
    assert [answer["value"] for answer in answers] == [6.0, 6.0]
    assert [answer["hits"] for answer in answers] == [0, 1]


def test_kernel_overloads_are_chosen_by_type() -> None:
    def weight(body: Any) -> float:
        raise NotImplementedError

    @jit.kernel_overload(weight)
    def _weight(body):  # type: ignore[no-untyped-def]
        return (lambda body: 9.81 * body) if body == numba.float64 else None

    @jit.entry
    def call(body: float) -> float:
        return weight(body)

    assert call(2.0) == pytest.approx(19.62)


def test_a_kernel_that_borrows_its_arrays_may_not_make_one():
    @jit.borrowing_kernel
    def doubled(values):
        return (2.0 * values)[0]

    with pytest.raises(numba.core.errors.NumbaError, match="NRT required"):
        doubled(numpy.ones(3))


@pytest.mark.parametrize("lend", [lambda values: values, lambda values: (values, 1.0)], ids=["array", "tuple"])
def test_a_kernel_that_borrows_its_arrays_may_not_return_one(lend):
    """The caller would give back a reference that nobody took: freed memory in use, without a word."""
    borrowed = jit.borrowing_kernel(lend)

    @jit.entry
    def call(values):
        return borrowed(values)

    with pytest.raises(numba.core.errors.NumbaError, match="must return no array"):
        call(numpy.ones(3))


def test_machine_code_that_was_given_up_is_made_when_it_is_needed() -> None:
    """As after an interrupt in the middle of a compilation, and a next scene in the same process."""

    @jit.entry
    def doubled(value: float) -> float:
        return 2.0 * value

    submit = linking._assembler.submit

    def submitted_and_stopped(bitcode: bytes) -> Any:
        awaited = submit(bitcode)
        linking.stop()
        return awaited

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(linking._assembler, "submit", submitted_and_stopped)
        assert doubled(4.0) == 8.0


LENDER = """
from contact_sim_pkg.laws.helper import factor
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry

@borrowing_kernel
def lend(values):
    return factor(values[0])

@entry
def lent(values):
    return lend(values)
"""


def test_code_that_another_process_compiled_with_other_flags_is_compiled_again(start: Start, tmp_path: Path) -> None:
    """numba takes the flags of a kernel from its first caller; symbols have them in their names."""
    linking_file = start.package / "compiled" / "linking.py"
    linking_file.write_text(linking_file.read_text().replace("LARGEST_LINKED = 60_000", "LARGEST_LINKED = 0"))
    (start.laws / "lender.py").write_text(LENDER)
    assert start()["value"] == 6.0
    folder = kernel_cache.fingerprint(start.package)
    first, second = start.cache / folder, tmp_path / "other" / folder
    lend = "import numpy\nfrom contact_sim_pkg.laws.lender import lent\nassert lent(numpy.ones(3)) == 2.0\n"
    assert start(lend, CONTACT_BENCH_CACHE=str(tmp_path / "other"))["value"] == 6.0
    for path in second.glob("helper.factor*"):
        shutil.copy(path, first / path.name)
    assert start()["value"] == 6.0
    assert start.warnings() == []
