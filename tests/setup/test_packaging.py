"""Lists and numbers that stand in more than one file of the packaging agree."""

import ast
import configparser
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, PathDistribution, requires
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement

from contact_sim_pkg.nodes import start
from set_up import preflight
from set_up.environment import system_requirements

PROJECT = Path(__file__).resolve().parents[2]
MESSAGES = PROJECT / "contact_msgs_defs"
PACKAGE = PROJECT / "contact_sim_pkg"
LOCK = PROJECT / "ros2_ws" / "requirements.txt"
PIN = re.compile(
    r"(?P<name>[A-Za-z0-9._-]+)(\[[a-z]+\])?==(?P<version>[0-9][0-9a-z.]*)(; python_version (==|>=|<) \"3\.\d+\")?"
)


def pins() -> list[str]:
    lines = [line.strip() for line in LOCK.read_text().splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def package_xml(folder: Path) -> ElementTree.Element:
    return ElementTree.parse(folder / "package.xml").getroot()


def test_every_name_in_the_lock_is_pinned_to_one_version():
    unpinned = [line for line in pins() if not PIN.fullmatch(line)]
    assert unpinned == []


def test_no_name_is_locked_twice_for_the_same_python():
    seen = [re.sub(r"==[^;]+", "", line).lower().replace("_", "-") for line in pins()]
    assert sorted(seen) == sorted(set(seen))


def test_the_lock_holds_all_102_wheels_of_ros():
    assert sum(line.startswith("ros-") for line in pins()) == 102


def test_the_lock_holds_all_that_its_packages_ask_for():
    """Installers look for nothing beyond it; of pytest's plug-ins colcon needs none to build, and the module lark comes
    with lark-parser.
    """
    pytest.importorskip("colcon_core", reason="only the environment of `make setup` has all that the lock names")
    asked = set()
    locked = {re.split(r"[\[=]", line)[0].lower().replace("_", "-") for line in pins()}
    for name in locked:
        with suppress(PackageNotFoundError):  # of another version of Python
            asked |= {text for text in requires(name) or [] if "extra ==" not in text and applies(text)}
    names = {re.split(r"[ \[<>=!~;(]", text)[0].lower().replace("_", "-") for text in asked}
    assert len(names) > 50
    assert names - locked == {"lark", "pytest-cov", "pytest-repeat", "pytest-rerunfailures"}


def test_every_dependency_of_setup_py_is_locked():
    declared = [re.split(r"[<>=]", text)[0] for text in setup_py_value("install_requires")]
    locked = {PIN.fullmatch(line)["name"].lower() for line in pins()}
    assert len(declared) > 10
    assert {name for name in declared if name not in locked} == set()


def test_setuptools_is_older_than_the_one_that_breaks_symlink_installs():
    (line,) = [line for line in pins() if line.startswith("setuptools==")]
    assert int(line.removeprefix("setuptools==").split(".")[0]) < 80


def test_message_dependencies_stand_in_cmake_and_package_xml():
    used = set()
    for path in (MESSAGES / "msg").glob("*.msg"):
        used |= set(re.findall(r"^(\w+)/\w+", path.read_text(), re.MULTILINE))
    cmake = (MESSAGES / "CMakeLists.txt").read_text()
    declared = {node.text for node in package_xml(MESSAGES).findall("depend")}
    assert used == declared == set(re.search(r"DEPENDENCIES (.+)\n", cmake)[1].split())


def test_versions_are_the_same_everywhere():
    written = re.search(r'^__version__ = "(.+)"$', (PACKAGE / "contact_sim_pkg/__init__.py").read_text(), re.MULTILINE)
    versions = {package_xml(folder).findtext("version") for folder in (MESSAGES, PACKAGE)}
    assert versions == {written[1]}


def test_changelogs_start_with_forthcoming_or_the_version():
    for folder in (MESSAGES, PACKAGE):
        first = re.search(r"^(\S+).*\n-{5,}$", (folder / "CHANGELOG.rst").read_text(), re.MULTILINE)[1]
        assert first in ("Forthcoming", package_xml(folder).findtext("version"))


def test_every_ros_package_imported_by_the_nodes_is_declared():
    declared = {node.text for node in package_xml(PACKAGE).findall("exec_depend")}
    others = {"contact_sim_pkg", "ruamel", "numpy"}  # ours, and those that stand in setup.py
    imported = set()
    for folder in ("contact_sim_pkg/nodes", "launch"):
        for path in (PACKAGE / folder).rglob("*.py"):
            imported |= top_level_imports(path) - sys.stdlib_module_names - others
    assert imported - declared == set()


ROSDEP_KEYS = {  # those of rosdep/python.yaml that the packages use; one that is not there refuses the whole workspace
    "python3-click", "python3-jinja2", "python3-matplotlib", "python3-numpy", "python3-pydantic", "python3-pytest",
    "python3-rich", "python3-rosbags-pip", "python3-ruamel.yaml", "python3-scipy",
}  # fmt: skip


@pytest.mark.parametrize(
    "folder", [MESSAGES, PACKAGE, PACKAGE.with_name("contact_sim_lab")], ids=lambda each: each.name
)
def test_every_python_dependency_of_a_package_is_a_key_of_rosdep(folder):
    """mpmath has none, and neither have numba, mcap and zstandard: they stand in setup.py."""
    listed = {
        each.text for kind in ("depend", "exec_depend", "test_depend") for each in package_xml(folder).findall(kind)
    }
    assert {each for each in listed if each.startswith("python3-")} - ROSDEP_KEYS == set()


def test_every_console_script_names_a_module_that_exists():
    text = (PACKAGE / "setup.py").read_text()
    (nodes,) = [
        ast.literal_eval(node.value)
        for node in ast.parse(text).body
        if isinstance(node, ast.Assign) and node.targets[0].id == "NODES"
    ]
    missing = [name for name in nodes if not (PACKAGE / "contact_sim_pkg" / "nodes" / f"{name}.py").exists()]
    assert missing == []
    assert [name for name in nodes if not callable(getattr(start, name))] == []
    assert (PACKAGE / "contact_sim_pkg" / "cli" / "main.py").exists()


def test_the_message_folder_of_the_package_is_a_relative_link_to_the_definitions():
    link = PACKAGE / "contact_sim_pkg" / "msg"
    assert link.is_symlink()
    assert not link.readlink().is_absolute()
    assert link.resolve() == (MESSAGES / "msg").resolve()


@pytest.mark.parametrize("package", ["contact_msgs_defs", "contact_sim_pkg"])
def test_the_workspace_links_to_both_packages(package):
    link = PROJECT / "ros2_ws" / "src" / package
    assert not link.readlink().is_absolute()
    assert link.resolve() == (PROJECT / package).resolve()


def test_a_sourced_ros_keeps_its_own_numpy_and_generators():
    lock = ["ros-rclpy==7.1.6", "numpy==2.2.6", "empy==4.2.1", "numba==0.68.1", "colcon-core==0.21.3"]
    assert system_requirements(lock, system_has_colcon=True) == ["numba==0.68.1"]
    assert system_requirements(lock, system_has_colcon=False) == ["numba==0.68.1", "colcon-core==0.21.3"]


def test_the_page_of_the_wheel_is_complete(tmp_path):
    """What PyPI shows, from the metadata that setuptools makes of setup.py."""
    folder = tmp_path / "contact_sim_pkg"
    for name in ("setup.py", "setup.cfg", "README.md", "LICENSE", "contact_sim_pkg/__init__.py"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes((PACKAGE / name).read_bytes())
    make = "import sys; from setuptools import build_meta; build_meta.prepare_metadata_for_build_wheel(sys.argv[1])"
    subprocess.run([sys.executable, "-c", make, str(tmp_path)], cwd=folder, check=True, capture_output=True)
    made = PathDistribution(next(tmp_path.glob("*.dist-info")))
    page = made.metadata
    assert page["Description-Content-Type"] == "text/markdown"
    assert "bench run tire_bump --offline" in (page.get_payload() or page["Description"])
    assert [page.get_all("Project-URL"), page["Home-page"]] == [None, None]  # there is no site
    pythons = [text.rpartition(" ")[2] for text in page.get_all("Classifier") if "Python :: 3." in text]
    assert pythons == supported_pythons()
    assert page.get_all("License-File") == ["LICENSE"]
    assert set(page.get_all("Provides-Extra")) == {"cluster", "daq", "fatigue", "parquet", "test", "view"}
    assert len([text for text in made.requires if "extra ==" not in text]) == len(setup_py_value("install_requires"))


def supported_pythons() -> list[str]:
    """By `python_requires`."""
    first, beyond = re.fullmatch(r">=3\.(\d+),<3\.(\d+)", setup_py_value("python_requires")).groups()
    return [f"3.{minor}" for minor in range(int(first), int(beyond))]


def test_every_place_states_the_same_versions_of_python():
    oldest, *_, newest = pythons = supported_pythons()
    words = f"{oldest} to {newest}"
    places = {
        "README.md": f"Python {words} ",
        "CONTRIBUTING.md": f"| Python | {', '.join(pythons)} |",
        "Makefile": f"({words})",
        "contact_sim_pkg/README.md": f"Python {words}",
        "contact_sim_pkg/QUALITY_DECLARATION.md": f"Python {words}",
        "contact_sim_lab/setup.py": f'python_requires="{setup_py_value("python_requires")}"',
        "docs/decisions/0002-dependencies-and-lock.md": f"CPython {words}",
        "pyproject.toml": f'target-version = "py{oldest.replace(".", "")}"',
        "ros2_ws/requirements.txt": f"CPython {words} ",
        "ros2_ws/set_up.sh": " ".join(f"python{each}" for each in pythons[::-1]),
        ".github/workflows/ubuntu-24.04-jazzy.yml": f'python: ["{oldest}", "{newest}"]',
    }
    texts = {path: " ".join((PROJECT / path).read_text().split()) for path in places}
    assert [path for path, said in places.items() if said not in texts[path]] == []
    assert [f"{major}.{minor}" for major, minor in (preflight.PYTHON_OLDEST, preflight.PYTHON_NEWEST)] == [
        oldest,
        newest,
    ]
    asked = f"{preflight.PYTHON_OLDEST} <= sys.version_info[:2] <= {preflight.PYTHON_NEWEST}"
    assert asked in texts["ros2_ws/set_up.sh"]
    assert f'python_version = "{oldest}"' in texts["pyproject.toml"]


@pytest.mark.parametrize("package", ["contact_msgs_defs", "contact_sim_pkg", "contact_sim_lab"])
def test_package_xml_has_what_an_index_shows(package):
    described = package_xml(PROJECT / package)
    assert described.findall("url") == []  # there is no site
    assert described.find("author") is not None
    assert (PROJECT / package / described.find("license").get("file")).resolve() == PROJECT / "LICENSE"


def test_the_tests_of_colcon_are_there_and_their_marks_are_those_of_the_repository():
    given = configparser.ConfigParser()
    given.read(PACKAGE / "pytest.ini")
    paths = given["pytest"]["testpaths"].split()
    assert [path for path in paths if not (PACKAGE / path).exists()] == []
    assert {path.split("/")[2] for path in paths if path.startswith("..")} == {
        "records",
        "scene",
        "laws",
        "bag",
        "nodes",
    }


def test_no_unneeded_bag_or_build_product_is_tracked():
    ignored = (PROJECT / ".gitignore").read_text().splitlines()
    assert {"/.ros2/", "/ros2_ws/build/", "/ros2_ws/install/", "/ros2_ws/log/", "/bags/*"} <= set(ignored)


def applies(text: str) -> bool:
    marker = Requirement(text).marker
    return marker is None or marker.evaluate()


def top_level_imports(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            names.add(node.module.split(".")[0])
    return names


def setup_py_value(argument: str) -> Any:
    for node in ast.walk(ast.parse((PACKAGE / "setup.py").read_text())):
        if isinstance(node, ast.keyword) and node.arg == argument:
            return ast.literal_eval(node.value)
    raise AssertionError(f"setup.py has no {argument}")
