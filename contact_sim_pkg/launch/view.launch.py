"""The view of whatever runs or is replayed, and RViz with its layout where that is asked for.

ros2 launch contact_sim_pkg view.launch.py rviz:=true
"""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

ARGUMENTS = {
    "rate": ("20.0", "messages of a topic a second, at most"),
    "rviz": ("false", "RViz with the layout of the bench"),
    "use_sim_time": ("true", "RViz follows /clock of the run"),
    "namespace": ("", "namespace of the bench that is shown"),
}


def generate_launch_description() -> LaunchDescription:
    """Description for `ros2 launch`."""
    declared = [
        DeclareLaunchArgument(name, default_value=value, description=text) for name, (value, text) in ARGUMENTS.items()
    ]
    given = {name: LaunchConfiguration(name) for name in ARGUMENTS}
    layout = Path(get_package_share_directory("contact_sim_pkg")) / "config" / "bench.rviz"
    view = Node(
        package="contact_sim_pkg",
        executable="bench_view",
        namespace=given["namespace"],
        parameters=[{"rate": ParameterValue(given["rate"], value_type=float)}],
        output="screen",
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", str(layout)],
        parameters=[{"use_sim_time": ParameterValue(given["use_sim_time"], value_type=bool)}],
        condition=IfCondition(given["rviz"]),
    )
    return LaunchDescription([*declared, view, rviz])
