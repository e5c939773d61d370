"""What lies in the folder that a command is started in: it is not imported, loaded, obeyed, or even opened (G8, G11)."""

import ctypes
import json
import os
import re
import struct
import subprocess
import sys
from pathlib import Path

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST_COMMAND, needs_ros

from contact_sim_pkg.cli.main import COMMANDS, LABORATORY
from contact_sim_pkg.python_process import READ_THERE, SETTINGS, drop_empty_entries, python_command
from set_up.shell_files import write_shell_files
from set_up.underlay import Underlay

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "contact_sim_pkg" / "contact_sim_pkg"
MODULES = (
    "numpy", "numba", "rclpy", "click", "runpy", "sitecustomize", "usercustomize", "contact_sim_pkg", "matplotlib", "yaml",
)  # fmt: skip
PROFILE = """<?xml version="1.0"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><log><use_default>FALSE</use_default><consumer>
<class>FileConsumer</class><property><name>filename</name><value>{marker}</value></property>
<property><name>append</name><value>FALSE</value></property></consumer></log></dds>
"""
NO_SETTINGS = b"\xff\xfe no: [text of any kind\n"
OTHERS = (  # of tools and libraries that a new version, or another choice, may read
    "setup.cfg", "pyproject.toml", "uv.toml", "pip.conf", "colcon_defaults.yaml", ".env", ".pdbrc", "fonts.conf", "a.pth",
    "USER_QOS_PROFILES.xml", "DEFAULT_FASTDDS_PROFILES.xml", "cyclonedds.xml", "libfastrtps.so", "seat_ride", "tire_bump",
)  # fmt: skip


class HostileFolder:
    """A folder, as one may unpack it, that leaves a mark outside where anything in it is obeyed, and sees what is opened in it."""

    OPENED = 0x20  # event of inotify

    def __init__(self, outside: Path) -> None:
        self.path, self.mark = outside / "unpacked", outside / "mark"
        (self.path / "share/ament_index").mkdir(parents=True)
        for name in MODULES:
            (self.path / f"{name}.py").write_text(f"open({str(outside / 'ran_')!r} + {name!r}, 'w').close()\n")
        for name in (".numba_config.yaml", "matplotlibrc", *OTHERS):
            (self.path / name).write_bytes(NO_SETTINGS)
        (self.path / "DEFAULT_FASTRTPS_PROFILES.xml").write_text(PROFILE.format(marker=self.mark))
        self.mark.write_text("untouched")
        libc = ctypes.CDLL(None, use_errno=True)
        self._watch = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        assert libc.inotify_add_watch(self._watch, bytes(self.path), self.OPENED) > 0, os.strerror(ctypes.get_errno())

    def opened(self) -> set[str]:
        """What any process has opened since the last look, by inotify."""
        names = set()
        try:
            while events := os.read(self._watch, 1 << 16):
                while events:
                    length = struct.unpack_from("iIII", events)[3]
                    name, events = events[16 : 16 + length].rstrip(b"\0").decode(), events[16 + length :]
                    if name:  # else the folder itself
                        names.add(name)
        except BlockingIOError:
            return names
        return names

    def marks(self) -> list[str]:
        """What was imported or obeyed."""
        touched = ["the profile of Fast DDS"] if self.mark.read_text() != "untouched" else []
        return touched + sorted(path.name for path in self.path.parent.glob("ran_*"))

    def run(self, command: list[str], **environment: str) -> subprocess.CompletedProcess[str]:
        """A program started in the folder, to its end, without what `setup.bash` has set against it."""
        plain = {name: value for name, value in ENVIRONMENT.items() if name not in SETTINGS}
        return subprocess.run(
            command,
            cwd=self.path,
            env={**plain, **environment},
            capture_output=True,
            text=True,
            timeout=LONGEST_COMMAND,
        )


@pytest.fixture
def hostile(tmp_path):
    return HostileFolder(tmp_path)


def test_the_folder_holds_all_that_the_list_names_and_the_settings_are_those_of_the_list(hostile):
    for pattern, said in READ_THERE.items():
        assert list(hostile.path.glob(pattern)), pattern
        for name, value in re.findall(r"([A-Z_]+)=(\w+)", said):
            assert SETTINGS[name] == value


@needs_ros
@pytest.mark.fault("G11")
def test_the_folder_of_these_tests_is_obeyed_by_who_does_not_take_care(hostile):
    tries = "\n".join(f"try:\n    import {name}\nexcept Exception: pass" for name in ("numba", "matplotlib"))
    ros = "import rclpy; rclpy.init(args=[]); rclpy.create_node('careless')"
    hostile.run([sys.executable, "-c", f"import sys; del sys.path[0]\n{tries}\n{ros}"])
    assert hostile.opened() == {".numba_config.yaml", "matplotlibrc", "DEFAULT_FASTRTPS_PROFILES.xml"}
    assert hostile.marks() == ["the profile of Fast DDS"]
    hostile.run([sys.executable, "-m", "contact_sim_pkg.cli.main"])
    assert hostile.marks()[1:] == ["ran_contact_sim_pkg"]


@pytest.mark.fault("G8")
def test_a_module_that_is_started_imports_nothing_from_the_current_folder(hostile, monkeypatch):
    command = python_command("contact_sim_pkg.cli.main", "run", "seat_ride", "--bad")
    for name in ("PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.setenv(name, os.pathsep.join(["", ENVIRONMENT.get(name, ""), ""]))
    drop_empty_entries()
    cleaned = {name: os.environ[name] for name in ("PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH")}
    assert "" not in [entry for value in cleaned.values() if value for entry in value.split(os.pathsep)]
    done = hostile.run(command, **cleaned)
    assert (done.returncode, "No such option" in done.stderr) == (2, True), done.stderr
    assert (hostile.marks(), hostile.opened()) == ([], set())


@pytest.mark.fault("G8")
def test_the_command_bench_leaves_out_empty_entries_that_were_added_after_sourcing(hostile, tmp_path):
    (tmp_path / "bin").mkdir()
    python = tmp_path / "bin/python"
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    write_shell_files(tmp_path, Underlay(None, python))
    for path in (f":{ENVIRONMENT['PYTHONPATH']}:", f"{ENVIRONMENT['PYTHONPATH']}::"):
        done = hostile.run([str(tmp_path / "bin/bench"), "--version"], PYTHONPATH=path)
        assert (done.returncode, done.stdout[:6]) == (0, "bench,"), done.stderr
    assert (hostile.marks(), hostile.opened()) == ([], set())


@needs_ros
@pytest.mark.fault("G8", "G11")
def test_a_run_on_nodes_takes_nothing_from_the_current_folder(hostile, tmp_path):
    """Nodes, and the processes that compile: the cache of kernels is empty, and the first block needs some. And a replay."""
    bag = str(tmp_path / "bag")
    arguments = ("run", "seat_ride", "--pace", "max", "--duration", "0.1", "--out", bag)
    for command in (arguments, ("replay", bag, "--rate", "100", "--delay", "0")):
        command = python_command("contact_sim_pkg.cli.main", *command)
        done = hostile.run(command, CONTACT_BENCH_CACHE=str(tmp_path / "cache"))
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
    assert (hostile.marks(), hostile.opened()) == ([], set())


EACH = """
import contextlib, io, json, sys
from contact_sim_pkg.cli.main import main
found = []
for arguments in json.loads(sys.argv[1]):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main(arguments)
    found.append([arguments, status, out.getvalue(), err.getvalue()])
print(json.dumps(found))
"""


@pytest.mark.fault("G11")
def test_every_command_takes_nothing_from_the_current_folder(hostile, tmp_path):
    """In one process: what each needs is imported on its first use. The shipped scenes stay what they are, too."""
    bag, table, page = (str(tmp_path / name) for name in ("bag", "table", "page.html"))
    real = [
        ["list", "--json"], ["run", "seat_ride", "--offline", "--duration", "0.1", "--out", bag], ["show", "tire_bump"],
        ["report", bag, "--out", page], ["metrics", bag, "--json"], ["export", bag, "--csv", "--out", table],
        ["compare", bag, bag], ["recover", bag, f"{bag}_again"],
    ]  # fmt: skip
    helped = [[name, "--help"] for name in (*COMMANDS, *LABORATORY)]
    program = "import sys; del sys.path[0]" + EACH
    done = hostile.run([sys.executable, "-c", program, json.dumps(real + helped)])
    assert done.returncode == 0, done.stderr
    for arguments, status, printed, said in json.loads(done.stdout):
        assert status == 0, (arguments, said)
        assert printed or said, arguments
    assert (hostile.marks(), hostile.opened()) == ([], set())


@pytest.mark.fault("G8")
def test_modules_are_started_in_one_place_alone():
    """Whatever starts Python by `-m` goes through `python_command`; `-c` of the compiler sets its path first."""
    started = re.compile(r'sys\.executable, "-m"')
    found = [path.name for path in PACKAGE.rglob("*.py") if started.search(path.read_text())]
    assert found == []
    programs = [path for path in PACKAGE.rglob("*.py") if 'sys.executable, "-c"' in path.read_text()]
    assert {path.name for path in programs} == {"assembler.py", "companion.py"}
    assert all(re.search(r'_PROGRAM = """\nimport sys\n[^\n]*sys\.path\[:\] = ', path.read_text()) for path in programs)
