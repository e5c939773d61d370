"""Packages of ROS 2 that PyPI lacks are built where the underlay has them not, and only there."""

from set_up.layout import ABSENT, ON_USE, ON_USE_FOLDER
from set_up.stamps import on_use_key, workspace_key
from set_up.workspace import absent_packages, is_there


def test_a_package_is_built_where_nobody_has_it(tmp_path):
    assert absent_packages({}) == [ABSENT / "tf2_msgs"]
    assert absent_packages({"AMENT_PREFIX_PATH": str(tmp_path)}) == [ABSENT / "tf2_msgs"]


def test_that_of_a_sourced_ros_wins(tmp_path):
    (tmp_path / "share" / "tf2_msgs").mkdir(parents=True)
    assert absent_packages({"AMENT_PREFIX_PATH": f"/nowhere:{tmp_path}"}) == []


def test_what_is_built_on_first_use_costs_a_set_up_nothing():
    assert {path.name for path in ABSENT.glob("*")} == {"tf2_msgs", *ON_USE}
    assert workspace_key("environment") == workspace_key("environment")
    assert on_use_key("simulation_interfaces", "environment") != on_use_key("simulation_interfaces", "another")


def test_an_installed_package_is_there_and_our_own_build_is_not_one(tmp_path):
    (tmp_path / "share" / "simulation_interfaces").mkdir(parents=True)
    assert is_there("simulation_interfaces", {"AMENT_PREFIX_PATH": str(tmp_path)})
    own = ON_USE_FOLDER / "simulation_interfaces" / "install" / "simulation_interfaces"
    assert not is_there("simulation_interfaces", {"AMENT_PREFIX_PATH": str(own)})
