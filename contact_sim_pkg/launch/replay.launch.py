"""A bag is published again: bytes, spacing, quality of service as they were recorded.

    ros2 launch contact_sim_pkg replay.launch.py bag:=bags/seat_ride rate:=2.0 topics:='seat/force seat/patch'

The arguments are those of `bench replay`. A refused bag or option, and a node that ends badly, end the launch with
status 1 and a sentence.
"""

from launch.actions import DeclareLaunchArgument, OpaqueFunction, SetEnvironmentVariable
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node

from contact_sim_pkg.requirements import packages_named
from launch import LaunchContext, LaunchDescription

with packages_named():
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.cli.launched import arguments_of, options_of, refuse_misspelt
    from contact_sim_pkg.cli.replay import command, parameters_of, rules_of
    from contact_sim_pkg.nodes.processes.children import how_ended
    from contact_sim_pkg.nodes.processes.environment import LAUNCHED_ENVIRONMENT

ARGUMENTS = arguments_of(command)


@packages_named()
def start_node(context: LaunchContext) -> list[Node]:
    """Start the node of the replay."""
    refuse_misspelt(context.launch_configurations, ARGUMENTS)
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    values = options_of(command, given)
    remappings = rules_of(values.pop("remapped"), open_bag(values["bag"]))
    return [
        Node(
            package="contact_sim_pkg",
            executable="bag_replay",
            name="bag_replay",
            namespace=given["namespace"],
            parameters=[{**parameters_of(**values), "use_sim_time": given["use_sim_time"].lower() == "true"}],
            remappings=remappings,
            output="screen",
            on_exit=on_exit,
        )
    ]


def on_exit(event: ProcessExited, context: LaunchContext) -> None:
    """A node that ends badly: an exception is what makes launch return another status than 0."""
    if event.returncode != 0 and not context.is_shutdown:
        raise RuntimeError(how_ended("bag_replay", event.returncode))


def generate_launch_description() -> LaunchDescription:
    """Description for `ros2 launch`."""
    declared = [
        DeclareLaunchArgument(
            name, default_value=each.default, description=each.text, choices=each.choices and list(each.choices)
        )
        for name, each in ARGUMENTS.items()
    ]
    kept = [
        SetEnvironmentVariable(name, EnvironmentVariable(name, default_value=value))
        for name, value in LAUNCHED_ENVIRONMENT.items()
    ]
    return LaunchDescription([*declared, *kept, OpaqueFunction(function=start_node)])
