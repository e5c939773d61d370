"""Packages of ROS 2 that PyPI lacks are built where the underlay has them not, and only there."""

from set_up.layout import ABSENT
from set_up.workspace import absent_packages


def test_a_package_is_built_where_nobody_has_it(tmp_path):
    assert absent_packages({}) == [ABSENT / "tf2_msgs"]
    assert absent_packages({"AMENT_PREFIX_PATH": str(tmp_path)}) == [ABSENT / "tf2_msgs"]


def test_that_of_a_sourced_ros_wins(tmp_path):
    (tmp_path / "share" / "tf2_msgs").mkdir(parents=True)
    assert absent_packages({"AMENT_PREFIX_PATH": f"/nowhere:{tmp_path}"}) == []
