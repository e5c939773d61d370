"""A package that is missing, or of another version than needed: one sentence with the cure, status 2, no traceback."""

import subprocess
import sys

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST

from contact_sim_pkg.requirements import package_sentence

ABSENT = """
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == {name!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
"""
NODES = ("bag_logger", "bag_replay", "contact_simulator", "road_profile", "vibration")
RUN = "import sys; from contact_sim_pkg.cli.main import main; sys.exit(main(sys.argv[1:]))"
START = "import sys; from contact_sim_pkg.nodes import start; sys.exit(getattr(start, sys.argv.pop(1))())"
SHORT = ("run", "seat_ride", "--duration", "0.02", "--no-record")


def run(folder, program, *arguments):
    """The sentence of a program that finds the modules of `folder` first."""
    environment = {**ENVIRONMENT, "PYTHONPATH": f"{folder}:{ENVIRONMENT['PYTHONPATH']}"}
    ended = subprocess.run(
        [sys.executable, "-c", program, *arguments], env=environment, capture_output=True, text=True, timeout=LONGEST
    )
    assert ended.returncode == 2, ended.stderr
    assert "Traceback" not in ended.stderr
    assert ended.stdout == ""
    return ended.stderr


@pytest.mark.parametrize(
    ("package", "arguments", "sentence"),
    [
        ("numba", (*SHORT, "--offline"), "numba cannot be imported"),
        ("numba", SHORT, "numba cannot be imported"),
        ("rosbags", (*SHORT, "--offline"), "rosbags"),
        ("rosbags", ("report", "bag"), "rosbags"),
        ("pydantic", ("list",), "pydantic"),
        ("rclpy", SHORT, "rclpy cannot be imported; source ros2_ws/setup.bash (`bench run --offline` needs no ROS)"),
        ("rclpy", ("replay", "bag"), "rclpy cannot be imported; source ros2_ws/setup.bash"),
        ("contact_msgs_defs", SHORT, "contact_msgs_defs cannot be imported; source ros2_ws/setup.bash"),
    ],
)
def test_a_command_names_a_package_that_is_missing(tmp_path, package, arguments, sentence):
    if package == "numba" and "--offline" not in arguments:
        pytest.importorskip("rclpy")
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name=package))
    said = run(tmp_path, RUN, *arguments)
    assert sentence in said.splitlines()[-1]
    assert "pip install ./contact_sim_pkg" in said or package in ("rclpy", "contact_msgs_defs")


@pytest.mark.parametrize("node", NODES)
def test_a_node_after_plain_pip_names_what_it_lacks(tmp_path, node):
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name="rclpy"))
    said = run(tmp_path, START, node)
    assert said == (
        f"{node}: rclpy cannot be imported; source ros2_ws/setup.bash (`bench run --offline` needs no ROS)\n"
    )


def test_ros_that_is_there_but_not_sourced_has_the_same_cure():
    error = ImportError("librcl_action.so: cannot open shared object file", name="_rclpy_pybind11")
    assert "source ros2_ws/setup.bash" in package_sentence(error)


@pytest.mark.parametrize("content", ["BaseModel = object\n", "from pydantic_core import nothing_of_that_name\n"])
def test_an_old_pydantic_is_named_with_the_versions_that_do(tmp_path, content):
    (tmp_path / "pydantic.py").write_text(content)
    (tmp_path / "pydantic-1.10.2.dist-info").mkdir()
    (tmp_path / "pydantic-1.10.2.dist-info" / "METADATA").write_text("Name: pydantic\nVersion: 1.10.2\n")
    sentence = "pydantic is 1.10.2, <3,>=2.6 is needed; pip install 'pydantic<3,>=2.6'"
    assert run(tmp_path, RUN, *SHORT, "--offline") == f"bench: {sentence}\n"


@pytest.mark.parametrize(
    "error", [AttributeError("a"), TypeError("b"), RuntimeError("c"), ValueError("d"), KeyError("e")]
)
def test_an_error_of_our_own_stays_what_it_is(error):
    """Every package is here and of a version that does."""
    assert package_sentence(error) == ""
    assert package_sentence(ImportError("f", name="contact_sim_pkg.none")) == ""


@pytest.mark.parametrize(
    ("version", "fits"),
    [
        ("2.6", True),
        ("2.6.0", True),
        ("2.13.1", True),
        ("2.5.9", False),
        ("3", False),
        ("3.0rc1", False),
        ("10", False),
    ],
)
def test_versions_are_compared_by_their_numbers(monkeypatch, version, fits):
    from contact_sim_pkg import requirements

    monkeypatch.setattr(requirements, "requires", lambda _: ["pydantic<3,>=2.6", "pytest; extra == 'test'"])
    monkeypatch.setattr(requirements, "version", lambda _: version)
    assert (package_sentence(TypeError("g")) == "") == fits
