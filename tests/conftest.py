"""What all tests share: a ROS domain of their own, one thread a process, one cache of kernels, the same draws in every run;
and `pytest --check`, `pytest --random`.
"""

import gc
import importlib.util
import os
import sys
import zlib
from collections.abc import Generator, Sequence
from importlib.abc import MetaPathFinder
from types import ModuleType

import pytest
from hypothesis import settings
from hypothesis.internal.conjecture import providers

LAST_DOMAIN = 100  # 101, the last that needs no other ports than the system keeps free, is for one test alone
REFUSED = ("numba", "rclpy")  # modules of the compiler and of ROS
PROGRAM_STARTS = ("subprocess.Popen", "os.posix_spawn", "os.fork", "os.exec", "os.system")  # audit events


def ros_domain(run: str, worker: str) -> int:
    """A domain, 1 to 100, of one worker (`gw3`, or nothing) of one run of the tests: workers of a run never share one."""
    return 1 + (zlib.crc32(f"{__file__} {run}".encode()) + int(worker.removeprefix("gw") or 0)) % LAST_DOMAIN


# Set before anything imports ROS or numba. A domain of the caller's is not used: tests must not meet a running bench.
os.environ["ROS_DOMAIN_ID"] = str(
    ros_domain(os.environ.get("PYTEST_XDIST_TESTRUNUID", str(os.getpid())), os.environ.get("PYTEST_XDIST_WORKER", ""))
)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["CONTACT_BENCH_PLUGINS"] = "off"  # what else is installed here is no part of the tests
os.environ["CONTACT_BENCH_PROGRESS"] = "off"  # on a busy machine any command may last a second
os.environ.setdefault("NUMBA_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Every test with `@given` draws the same in every run; `pytest --random` draws anew.
settings.register_profile("same", derandomize=True, deadline=None, database=None)
settings.register_profile("random", deadline=None, database=None, print_blob=True)
settings.load_profile("same")

gc.set_threshold(20_000, 50, 1000)  # a compiler makes many objects that stay: 5 % of its time went into looking at them


class NoCompilerNoRos(MetaPathFinder):
    """Skips the test, or the file of tests, that imports a refused module."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> None:
        if name in REFUSED:
            pytest.skip(f"needs {name}: in `make test`", allow_module_level=True)


def skip_programs(event: str, arguments: tuple[object, ...]) -> None:
    """Audit hook: skips the test that starts a program."""
    if event in PROGRAM_STARTS:
        pytest.skip("starts a program: in `make test`", allow_module_level=True)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--check", action="store_true", help="skip what compiles kernels, uses ROS or starts a program")
    parser.addoption(
        "--random", action="store_true", help="only tests with `@given` and tables of properties, drawn anew"
    )


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("random"):
        settings.load_profile("random")
    else:  # hypothesis mixes in constants of the modules imported so far: draws would change with the tests before
        providers.HypothesisProvider._local_constants = providers.Constants()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """With `--dist loadfile`: every other worker takes its files from the end of the list.

    Neighbours in the tree call the same kernels. Workers that come from both ends seldom compile one at the same time.
    """
    from xdist.scheduler import LoadFileScheduling

    class FromBothEnds(LoadFileScheduling):
        def _assign_work_unit(self, node: object) -> None:
            if self.nodes.index(node) % 2:
                self.workqueue.move_to_end(next(reversed(self.workqueue)), last=False)
            super()._assign_work_unit(node)

    return FromBothEnds(config, log) if config.getoption("dist") == "loadfile" else None


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Tests of ROS are skipped by `--check` and where it is not sourced; files that start commands stand in the middle.

    Workers that come from both ends have compiled in themselves by then what a command would wait for.
    """
    if config.getoption("random"):
        items[:] = [item for item in items if hasattr(item.obj, "hypothesis") or _takes_from("tests.properties", item)]
    if config.getoption("check"):
        reason = "uses ROS: in `make test`"
    elif any(importlib.util.find_spec(name) is None for name in ("rclpy", "contact_msgs_defs")):
        reason = "rclpy or contact_msgs_defs cannot be imported: ROS 2 is not sourced"
    else:
        reason = ""
    for item in items:
        if reason and item.get_closest_marker("ros"):
            item.add_marker(pytest.mark.skip(reason))
    files = list(dict.fromkeys(item.path for item in items))
    place = {path: 0 if number < len(files) / 2 else 2 for number, path in enumerate(files)}
    starting = {item.path for item in items if _takes_from("tests.bench_process", item)}
    items.sort(key=lambda item: 1 if item.path in starting else place[item.path])


def _takes_from(module: str, item: pytest.Item) -> bool:
    """Whether the file of a test takes anything from a module."""
    names = vars(item.getparent(pytest.Module).obj).values()
    return any(getattr(each, "__module__", None) == module for each in names)


def pytest_collection(session: pytest.Session) -> None:
    # The first process of several starts the others, and runs no test.
    if session.config.getoption("check") and not session.config.getoption("numprocesses", None):
        sys.meta_path.insert(0, NoCompilerNoRos())
        sys.addaudithook(skip_programs)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """A file that was skipped half-way is not left behind as a module, where another file would find half of it."""
    report = yield
    if report.skipped:
        for name in [
            name for name, module in sys.modules.items() if getattr(module, "__file__", "") == str(collector.path)
        ]:
            del sys.modules[name]
    return report


@pytest.fixture(autouse=True)
def _no_participants_left(request: pytest.FixtureRequest) -> Generator[None, None, None]:
    """What a test leaves of ROS in this process is collected behind it.

    A participant that is still there keeps its place, and discovery on the local host looks at the first 32 places alone: nodes
    of the tests behind it would wait for each other for ever.
    """
    yield
    if request.node.get_closest_marker("ros"):
        gc.collect()


pytest_plugins = ["tests.report_bags", "tests.scene_maker"]
