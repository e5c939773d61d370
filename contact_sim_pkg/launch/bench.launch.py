"""One scene on nodes: the road and the vibration that it calls for, the simulator, the logger.

    ros2 launch contact_sim_pkg bench.launch.py scene:=seat_ride duration:=10.0 pace:=max

The arguments are the options of `bench run`, less two: `offline`, which is without nodes, and `json`, for the output
of launch is its log. A refused scene, bag or option, and a node that ends badly, end the launch with status 1 (launch
has no other) and a sentence, which the bag keeps. `bench run` does the same where launch is not installed, and shows
progress.
"""

import atexit
from collections.abc import Callable
from pathlib import Path

from launch.actions import DeclareLaunchArgument, ExecuteProcess, LogInfo, OpaqueFunction, SetEnvironmentVariable
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node

from contact_sim_pkg.requirements import packages_named
from launch import Action, LaunchContext, LaunchDescription

with packages_named():
    from contact_sim_pkg.cli.launched import LaunchedRun, arguments_of, options_of, refuse_misspelt
    from contact_sim_pkg.cli.run import command, refuse_two_sources, refuse_without_bag
    from contact_sim_pkg.cli.run_scene import prepare
    from contact_sim_pkg.cli.scene_options import SceneOptions
    from contact_sim_pkg.nodes.processes.environment import LAUNCHED_ENVIRONMENT, plugin_environment
    from contact_sim_pkg.nodes.processes.run_folder import RunFolder
    from contact_sim_pkg.nodes.processes.run_plan import planned_nodes
    from contact_sim_pkg.nodes.processes.scene_file import write_scene
    from contact_sim_pkg.python_process import python_command

ARGUMENTS = arguments_of(command, without=("offline", "json"))
FIRST_SCENE = "car_full_bench"  # where neither a scene nor a bag is given
RENAMED = {"bag": "out", "record": "no_record", "publish_clock": "clock"}


@packages_named()
def start_nodes(context: LaunchContext) -> list[Node]:
    """Resolve the scene once, and start the nodes that it needs; the first one that ends badly ends all."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    for old, new in RENAMED.items():
        if old in context.launch_configurations:
            raise ValueError(f"{old}:= is now {new}:=, as in `bench run`")
    refuse_misspelt(context.launch_configurations, ARGUMENTS)
    if not given["scene"] and not given["from_bag"]:
        given["scene"] = FIRST_SCENE
    values = options_of(command, given)
    refuse_without_bag(**{name: values[name] for name in ("no_record", "out", "strict", "check")})
    refuse_two_sources(**{name: values[name] for name in ("excitation", "from_bag")})
    options = SceneOptions(**{name: values[name] for name in SceneOptions.__dataclass_fields__})
    run = prepare(
        options, out=values["out"], from_bag=values["from_bag"],
        record=not values["no_record"], allow_long=values["allow_long"],
    )  # fmt: skip
    folder = RunFolder()
    atexit.register(folder.remove)  # not at the shutdown: the logger reads there why its run has ended
    path = write_scene(run.scene, folder.path)
    nodes = planned_nodes(
        run.scene, path, run.directory, values["from_bag"], clock=values["clock"], excitation=values["excitation"]
    )
    ended = LaunchedRun(path, run.directory, [node.name for node in nodes])
    return [
        Node(
            package="contact_sim_pkg",
            executable=node.name,
            name=node.name,
            namespace=given["namespace"],
            parameters=[{**node.parameters, "use_sim_time": given["use_sim_time"].lower() == "true"}],
            output="screen",
            additional_env=plugin_environment(run.scene),
            on_exit=end_of(node.name, ended, run.directory, check=values["check"], strict=values["strict"]),
        )
        for node in nodes
    ]


def end_of(
    node: str, run: LaunchedRun, bag: Path | None, *, check: bool = False, strict: bool = False
) -> Callable[[ProcessExited, LaunchContext], list[Action]]:
    """What is done at the end of a node, and of the last one. No node is started again: its state is gone, and the bits
    would differ.

    An exception is what makes launch end the other nodes and return another status than 0; a Shutdown would return 0.
    """

    def verdict(*_: object) -> None:
        if strict:
            run.refuse_inaccurate()

    def on_exit(event: ProcessExited, context: LaunchContext) -> list[Action]:
        hint = run.on_end(node, event.returncode, is_shutdown=context.is_shutdown)
        if hint:
            return [LogInfo(msg=hint)]
        if run.finished and check:
            command = python_command("contact_sim_pkg.cli.main", "accuracy", str(bag))
            return [ExecuteProcess(cmd=command, output="screen", on_exit=verdict)]
        if run.finished:
            verdict()
        return []

    return on_exit


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
    return LaunchDescription([*declared, *kept, OpaqueFunction(function=start_nodes)])
