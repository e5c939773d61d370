"""The view of whatever runs or is replayed, and RViz with its layout where that is asked for.

    ros2 launch contact_sim_pkg view.launch.py rviz:=true

A view that ends badly, and `rviz:=true` without RViz, end the launch with status 1 and a sentence. The view ends with
the launch.
"""

import os
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from launch.actions import DeclareLaunchArgument, OpaqueFunction, SetEnvironmentVariable
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node

from contact_sim_pkg.requirements import packages_named
from launch import LaunchContext, LaunchDescription

with packages_named():
    from contact_sim_pkg.cli.launched import SWITCH, refuse_misspelt
    from contact_sim_pkg.nodes.processes.children import how_ended
    from contact_sim_pkg.python_process import SETTINGS

ARGUMENTS = {
    "rate": ("20.0", "messages of a topic a second, at most", None),
    "rviz": ("false", "RViz with the layout of the bench", SWITCH),
    "use_sim_time": ("true", "RViz follows /clock of the run", SWITCH),
    "namespace": ("", "namespace of the bench that is shown", None),
}


@packages_named()
def start_nodes(context: LaunchContext) -> list[Node]:
    """Start the view, and RViz where it is wanted and there."""
    refuse_misspelt(context.launch_configurations, ARGUMENTS)
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    view = Node(
        package="contact_sim_pkg",
        executable="bench_view",
        namespace=given["namespace"],
        parameters=[{"rate": number("rate", given["rate"]), "supervisor": os.getpid()}],
        output="screen",
        on_exit=on_exit,
    )
    return [view, rviz(given["use_sim_time"])] if given["rviz"].lower() == "true" else [view]


def number(name: str, text: str) -> float:
    """The value of an argument; ValueError where it is no number."""
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{name}:={text} is no number; write one such as {name}:={ARGUMENTS[name][0]}") from None


def rviz(use_sim_time: str) -> Node:
    """RViz with the layout of the bench; RuntimeError where it is not installed."""
    try:
        get_package_share_directory("rviz2")
    except PackageNotFoundError:
        raise RuntimeError(
            "rviz:=true needs rviz2, which is not installed or not sourced; sudo apt install ros-jazzy-rviz2, "
            "or leave rviz:=true out"
        ) from None
    layout = Path(get_package_share_directory("contact_sim_pkg")) / "config" / "bench.rviz"
    return Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", str(layout)],
        parameters=[{"use_sim_time": use_sim_time.lower() == "true"}],
    )


def on_exit(event: ProcessExited, context: LaunchContext) -> None:
    """A view that ends badly: an exception is what makes launch return another status than 0."""
    if event.returncode != 0 and not context.is_shutdown:
        raise RuntimeError(how_ended("bench_view", event.returncode))


def generate_launch_description() -> LaunchDescription:
    """Description for `ros2 launch`."""
    declared = [
        DeclareLaunchArgument(name, default_value=value, description=text, choices=choices and list(choices))
        for name, (value, text, choices) in ARGUMENTS.items()
    ]
    kept = [
        SetEnvironmentVariable(name, EnvironmentVariable(name, default_value=value)) for name, value in SETTINGS.items()
    ]
    return LaunchDescription([*declared, *kept, OpaqueFunction(function=start_nodes)])
