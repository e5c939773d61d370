"""A package that is missing, or of another version than needed: one sentence with the cure, status 2, no traceback."""

import re
import subprocess
import sys

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST, PACKAGE, needs_ros

from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.requirements import package_sentence

ABSENT = """
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == {name!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
"""
NODES = ("bag_logger", "bag_replay", "bench_view", "contact_simulator", "road_profile", "vibration")
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
    if package in ("rclpy", "contact_msgs_defs"):
        assert sentence in said.splitlines()[-1]
        assert ("--offline" in said) == (arguments[0] == "run"), "a replay without ROS there is not"
    else:
        *_, last, venv, pip = said.splitlines()
        assert sentence in last
        assert venv.strip().startswith("python3 -m venv --system-site-packages ")
        assert re.fullmatch(rf"  pip install '{package}[<>=].+'", pip), "its bounds, and nothing else"


@pytest.mark.parametrize("node", NODES)
def test_a_node_after_plain_pip_names_what_it_lacks(tmp_path, node):
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name="rclpy"))
    said = run(tmp_path, START, node)
    assert said == f"{node}: rclpy cannot be imported; source ros2_ws/setup.bash\n"


@needs_ros
@pytest.mark.parametrize(
    ("node", "package"), [("contact_simulator", "numba"), ("bag_logger", "rosbags"), ("vibration", "pydantic")]
)
def test_a_node_where_ros_is_names_a_package_that_is_missing(tmp_path, node, package):
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name=package))
    *_, sentence, venv, pip = run(tmp_path, START, node, "--ros-args", "-p", "scene:=seat_ride").splitlines()
    assert sentence.startswith(f"{node}: {package}")
    assert venv.strip().startswith("python3 -m venv --system-site-packages ")
    assert re.fullmatch(rf"  pip install '{package}[<>=].+'", pip)


def test_ros_that_is_there_but_not_sourced_has_the_same_cure():
    error = ImportError("librcl_action.so: cannot open shared object file", name="_rclpy_pybind11")
    assert "source ros2_ws/setup.bash" in package_sentence(error)


def put_old_pydantic(folder, content="BaseModel = object\n"):
    (folder / "pydantic.py").write_text(content)
    (folder / "pydantic-1.10.2.dist-info").mkdir()
    (folder / "pydantic-1.10.2.dist-info" / "METADATA").write_text("Name: pydantic\nVersion: 1.10.2\n")


@pytest.mark.parametrize("content", ["BaseModel = object\n", "from pydantic_core import nothing_of_that_name\n"])
def test_an_old_pydantic_is_named_with_the_versions_that_do(tmp_path, content):
    put_old_pydantic(tmp_path, content)
    for program, arguments, name in ((RUN, (*SHORT, "--offline"), "bench"), (RUN, ("list",), "bench")):
        sentence, venv, pip = run(tmp_path, program, *arguments).splitlines()
        assert sentence.startswith(f"{name}: pydantic is 1.10.2, 2.6 to below 3 is needed; ")
        assert venv.strip().startswith("python3 -m venv --system-site-packages ")
        assert pip == "  pip install 'pydantic<3,>=2.6'"


@needs_ros
@pytest.mark.parametrize("node", ["contact_simulator", "vibration"])
def test_a_node_with_an_old_pydantic_says_so_whatever_it_was_doing(tmp_path, node):
    """The simulator imports it while it is configured, the vibration while it is made."""
    put_old_pydantic(tmp_path)
    *_, sentence, venv, pip = run(tmp_path, START, node, "--ros-args", "-p", "scene:=seat_ride").splitlines()
    assert "pydantic is 1.10.2, 2.6 to below 3 is needed; " in sentence
    assert venv.strip().startswith("python3 -m venv --system-site-packages ")
    assert pip == "  pip install 'pydantic<3,>=2.6'"


def test_a_node_started_as_a_module_names_what_it_lacks(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name="rclpy"))
    environment = {**ENVIRONMENT, "PYTHONPATH": f"{tmp_path}:{ENVIRONMENT['PYTHONPATH']}"}
    ended = subprocess.run(
        python_command("contact_sim_pkg.nodes.bench_view"),
        env=environment, capture_output=True, text=True, timeout=LONGEST,
    )  # fmt: skip
    assert ended.returncode == 2
    assert ended.stderr == ("bench: rclpy cannot be imported; source ros2_ws/setup.bash\n")


@pytest.mark.parametrize("use", ["bench.load_scene", "bench.run('seat_ride')", "bench.series"])
def test_the_library_raises_an_error_that_holds_the_sentence(tmp_path, use):
    put_old_pydantic(tmp_path)
    (tmp_path / "user.py").write_text(
        "import contact_sim_pkg as bench\nfrom contact_sim_pkg import run\nbench.run = run\n"
        f"try:\n    {use}\nexcept ImportError as error:\n    raise SystemExit(str(error))\n"
    )
    environment = {**ENVIRONMENT, "PYTHONPATH": f"{tmp_path}:{ENVIRONMENT['PYTHONPATH']}"}
    ended = subprocess.run(
        [sys.executable, str(tmp_path / "user.py")], env=environment, capture_output=True, text=True, timeout=LONGEST
    )
    sentence, _venv, pip = ended.stderr.splitlines()
    assert sentence.startswith("pydantic is 1.10.2, 2.6 to below 3 is needed; ")
    assert pip == "  pip install 'pydantic<3,>=2.6'"


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


def test_every_bound_of_setup_py_is_stated_and_what_lies_below_is_named(monkeypatch):
    """Each package in turn is of the release before its lower bound, at it, or missing."""
    from contact_sim_pkg import requirements

    stated = requirements._in_setup(PACKAGE / "setup.py")
    assert len(stated) > 10
    lowest = {}
    for text in stated:
        name, low, high = re.fullmatch(r"([\w.-]+)>=([\d.]+),<([\d.]+)", text).groups()
        assert [int(part) for part in low.split(".")] < [int(part) for part in high.split(".")]
        lowest[name] = low
    monkeypatch.setattr(requirements, "requires", lambda _: stated)
    for name, low in lowest.items():
        *major, last = low.split(".")
        below = ".".join([*major, str(int(last) - 1), "9"]) if last != "0" else "0.0.1"
        for found in (low, below, ""):
            versions = {**lowest, name: found}
            monkeypatch.setattr(requirements, "_version", versions.__getitem__)
            sentence = package_sentence(AttributeError("something"))
            expected = f"{name} is {found or 'missing'}, {low} to below "
            assert sentence.startswith(expected) == (found != low), (name, found)
            assert requirements.is_met(name) == (found == low)


def test_a_checkout_without_metadata_knows_the_bounds_too(monkeypatch):
    from contact_sim_pkg import requirements

    def absent(_):
        raise requirements.PackageNotFoundError

    monkeypatch.setattr(requirements, "requires", absent)
    assert dict(requirements._needed())["pydantic"] == ">=2.6,<3"
    assert package_sentence(AttributeError("something")) == ""
    monkeypatch.setattr(requirements, "_version", lambda name: "1.10.14" if name == "pydantic" else "999")
    assert "pydantic is 1.10.14, 2.6 to below 3 is needed" in package_sentence(AttributeError("something"))
