"""Which ROS 2 is taken, and what of the caller's shell reaches the set-up."""

import sys
from pathlib import Path

import pytest

from set_up.errors import SetUpError
from set_up.layout import PROJECT
from set_up.underlay import Underlay, clean_environ, find_underlay


@pytest.fixture
def jazzy(tmp_path: Path) -> Path:
    """A folder that looks like a sourced ROS 2 of the system."""
    prefix = tmp_path / "jazzy"
    (prefix / "share/ament_index/resource_index/packages").mkdir(parents=True)
    (prefix / "share/ament_index/resource_index/packages/rclpy").touch()
    (prefix / "lib/python3.12/site-packages/rclpy").mkdir(parents=True)
    (prefix / "bin").mkdir()
    (prefix / "bin/python3.12").touch()
    return prefix


def test_without_a_sourced_ros_it_comes_from_pypi_on_the_running_python():
    underlay = find_underlay({"PATH": "/usr/bin"})
    assert underlay.prefix is None
    assert underlay.python.name.startswith("python3")
    assert Path(sys.base_prefix) in underlay.python.parents


def test_a_sourced_jazzy_is_taken_with_the_python_it_was_built_for(jazzy):
    underlay = find_underlay({"AMENT_PREFIX_PATH": f"/some/overlay:{jazzy}", "ROS_DISTRO": "jazzy"})
    assert underlay == Underlay(jazzy, jazzy / "bin/python3.12")


def test_the_projects_own_workspace_does_not_count_as_another_ros():
    sourced = f"{PROJECT}/ros2_ws/install/contact_sim_pkg:{PROJECT}/.ros2"
    assert find_underlay({"AMENT_PREFIX_PATH": sourced, "ROS_DISTRO": "jazzy"}).prefix is None


def test_another_distribution_is_refused_by_name(jazzy):
    with pytest.raises(SetUpError, match=r"'humble' from .*jazzy sourced.*fresh shell") as caught:
        find_underlay({"AMENT_PREFIX_PATH": str(jazzy), "ROS_DISTRO": "humble"})
    assert caught.value.status == 2


def test_the_pip_environment_of_another_project_is_refused(jazzy):
    (jazzy / "pyvenv.cfg").touch()
    with pytest.raises(SetUpError, match="not a Jazzy of the system"):
        find_underlay({"AMENT_PREFIX_PATH": str(jazzy), "ROS_DISTRO": "jazzy"})


def test_search_paths_of_other_environments_do_not_reach_a_pip_environment():
    caller = {"PYTHONPATH": "/a", "PYTHONHOME": "/b", "LD_LIBRARY_PATH": "/c", "PIP_USER": "1", "HTTPS_PROXY": "p"}
    cleaned = clean_environ(caller, Underlay(None, Path("/usr/bin/python3")))
    assert not {"PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH", "PIP_USER"} & set(cleaned)
    assert cleaned["HTTPS_PROXY"] == "p"


def test_search_paths_of_a_sourced_ros_stay(jazzy):
    caller = {"PYTHONPATH": "/a", "LD_LIBRARY_PATH": "/c", "PYTHONHOME": "/b"}
    cleaned = clean_environ(caller, Underlay(jazzy, jazzy / "bin/python3.12"))
    assert cleaned["PYTHONPATH"] == "/a"
    assert cleaned["LD_LIBRARY_PATH"] == "/c"
    assert "PYTHONHOME" not in cleaned
