"""One scene on nodes: the road and the vibration that it calls for, the simulator, the logger.

    ros2 launch contact_sim_pkg bench.launch.py scene:=seat_ride duration:=10.0 pace:=max

A refused scene or bag, and a node that ends badly, end the launch with status 1 (launch has no other)
and a sentence. `bench run` does the same where launch is not installed, and shows progress.
"""

import shutil
import tempfile
from pathlib import Path

from launch.actions import DeclareLaunchArgument, OpaqueFunction, RegisterEventHandler, SetEnvironmentVariable
from launch.event_handlers import OnShutdown
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node

from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.nodes.processes.run_plan import planned_nodes
from contact_sim_pkg.nodes.processes.scene_file import write_scene
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


def start_nodes(context: LaunchContext) -> list[Node | RegisterEventHandler]:
    """Resolve the scene once, and start the nodes that it needs; the first one that ends badly ends all."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    changes = [make(given[name]) for name, make in (("duration", set_duration), ("pace", set_pace)) if given[name]]
    scene = resolve(load_scene(given["scene"], changes))
    folder = Path(tempfile.mkdtemp(prefix="contact_bench_"))
    record, clock, sim_time = (given[name].lower() == "true" for name in SWITCHES)
    bag = Path(given["bag"]) if given["bag"] else None
    directory = new_directory(bag, str(scene.data["name"])) if record else None
    nodes = [
        Node(
            package="contact_sim_pkg",
            executable=node.name,
            name=node.name,
            namespace=given["namespace"],
            parameters=[{**node.parameters, "use_sim_time": sim_time}],
            output="screen",
            on_exit=end_if_failed,
        )
        for node in planned_nodes(scene, write_scene(scene, folder), directory, clock=clock)
    ]
    return [*nodes, RegisterEventHandler(OnShutdown(on_shutdown=lambda *_: shutil.rmtree(folder, ignore_errors=True)))]


def end_if_failed(event: ProcessExited, context: LaunchContext) -> None:
    """No node is started again: its state is gone, and the bits would differ.

    An exception is what makes launch end the other nodes and return another status than 0; a Shutdown would return 0.
    """
    ended_by_launch = context.is_shutdown and event.returncode < 0  # a signal, before the node had learnt to catch it
    if event.returncode and not ended_by_launch:
        raise RuntimeError(f"{event.process_name} ended with status {event.returncode}; the run has failed")


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
