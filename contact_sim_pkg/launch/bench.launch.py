"""One scene on nodes: the road and the vibration that it calls for, the simulator, the logger.

    ros2 launch contact_sim_pkg bench.launch.py scene:=seat_ride duration:=10.0 pace:=max

A refused scene or bag, and a node that ends badly, end the launch with status 1 (launch has no other)
and a sentence, which the bag keeps. `bench run` does the same where launch is not installed, and shows progress.
"""

import atexit
from collections.abc import Callable
from pathlib import Path

from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction, SetEnvironmentVariable
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node

from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.bag.unfinished import leave_metadata
from contact_sim_pkg.nodes.processes.children import how_ended
from contact_sim_pkg.nodes.processes.environment import plugin_environment
from contact_sim_pkg.nodes.processes.run_folder import RunFolder
from contact_sim_pkg.nodes.processes.run_plan import planned_nodes
from contact_sim_pkg.nodes.processes.scene_file import read_reason, write_reason, write_scene
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_duration, set_pace
from contact_sim_pkg.scene.resolve import resolve
from launch import LaunchContext, LaunchDescription

ARGUMENTS = {
    "scene": ("car_full_bench", "name of a shipped scene, or path of a scene file"),
    "duration": ("", "simulated time in s; empty: that of the scene"),
    "pace": ("", "realtime, max or a factor; empty: that of the scene"),
    "record": ("true", "write a bag"),
    "publish_clock": ("true", "simulated time on /clock, unless another node publishes it"),
    "bag": ("", "directory of the bag, which must not exist; empty: bags/SCENE_TIME_RANDOM"),
    "use_sim_time": ("false", "clock of the nodes; stamps are simulated time, pacing is the steady clock in any case"),
    "namespace": ("", "namespace of all nodes and topics"),
}
SWITCHES = ("record", "publish_clock", "use_sim_time")
DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"


def start_nodes(context: LaunchContext) -> list[Node]:
    """Resolve the scene once, and start the nodes that it needs; the first one that ends badly ends all."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    changes = [make(given[name]) for name, make in (("duration", set_duration), ("pace", set_pace)) if given[name]]
    scene = resolve(load_scene(given["scene"], changes))
    record, clock, sim_time = (given[name].lower() == "true" for name in SWITCHES)
    bag = Path(given["bag"]) if given["bag"] else None
    directory = new_directory(bag, str(scene.data["name"])) if record else None
    folder = RunFolder()
    atexit.register(folder.remove)  # not at the shutdown: the logger reads there why its run has ended
    path = write_scene(scene, folder.path)
    return [
        Node(
            package="contact_sim_pkg",
            executable=node.name,
            name=node.name,
            namespace=given["namespace"],
            parameters=[{**node.parameters, "use_sim_time": sim_time}],
            output="screen",
            additional_env=plugin_environment(scene),
            on_exit=end_of(node.name, path, directory),
        )
        for node in planned_nodes(scene, path, directory, clock=clock)
    ]


def end_of(node: str, scene: Path, bag: Path | None) -> Callable[[ProcessExited, LaunchContext], list[LogInfo]]:
    """What is done at the end of a node. No node is started again: its state is gone, and the bits would differ.

    An exception is what makes launch end the other nodes and return another status than 0; a Shutdown would return 0.
    """

    def on_exit(event: ProcessExited, context: LaunchContext) -> list[LogInfo]:
        sentence = how_ended(node, event.returncode)
        ended_by_launch = (
            context.is_shutdown and event.returncode < 0
        )  # a signal, before the node had learnt to catch it
        failed = event.returncode != 0 and not ended_by_launch
        if failed:
            write_reason(scene, sentence)  # the logger, which ends last, keeps it
        hint = ""
        if node == "bag_logger" and bag is not None:
            hint = leave_metadata(bag, {"ended": "failed", "failure": read_reason(str(scene)) or sentence})
        if failed:
            raise RuntimeError("; ".join(filter(None, [sentence, "the run has failed", hint])))
        return [LogInfo(msg=hint)] if hint else []

    return on_exit


def generate_launch_description() -> LaunchDescription:
    """Description for `ros2 launch`."""
    declared = [
        DeclareLaunchArgument(
            name,
            default_value=value,
            description=text,
            choices=["true", "false", "True", "False"] if name in SWITCHES else None,
        )
        for name, (value, text) in ARGUMENTS.items()
    ]
    local = SetEnvironmentVariable(DISCOVERY, EnvironmentVariable(DISCOVERY, default_value="LOCALHOST"))
    return LaunchDescription([*declared, local, OpaqueFunction(function=start_nodes)])
