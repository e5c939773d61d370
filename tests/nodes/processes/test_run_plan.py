"""Which nodes a scene needs, and the launch file and parameter file that go with them."""

import ast
from pathlib import Path

import pytest
from ruamel.yaml import YAML
from tests.bench_process import PACKAGE, needs_ros, resolved

from contact_sim_pkg.nodes.processes.run_plan import in_processes, planned_nodes
from contact_sim_pkg.nodes.processes.scene_file import queue_depth, read_scene, write_scene

SCENE = Path("scene.resolved.yaml")


def names(scene, directory):
    return [node.name for node in planned_nodes(resolved(scene), SCENE, directory)]


def test_a_scene_without_a_road_has_no_road_node():
    assert names("seat_ride", Path("bag")) == ["bag_logger", "vibration", "contact_simulator"]


def test_a_scene_without_a_vibration_has_no_vibration_node():
    assert names("tire_bump", Path("bag")) == ["bag_logger", "road_profile", "contact_simulator"]


def test_a_car_has_both_and_no_logger_where_nothing_is_recorded():
    assert names("car_full_bench", None) == ["road_profile", "vibration", "contact_simulator"]


def test_both_excitation_nodes_share_a_process_of_the_supervisor():
    nodes = planned_nodes(resolved("car_full_bench"), SCENE, Path("bag"))
    processes = in_processes(nodes)
    assert [process.name for process in processes] == ["bag_logger", "excitation", "contact_simulator"]
    assert processes[1].parameters == nodes[1].parameters == nodes[2].parameters
    alone = planned_nodes(resolved("seat_ride"), SCENE, Path("bag"))
    assert in_processes(alone) == alone


def test_the_excitation_of_a_bag_is_a_parameter_of_the_excitation_nodes_alone():
    nodes = planned_nodes(resolved("car_full_bench"), SCENE, Path("bag"), Path("/bags/first"))
    asked = {node.name for node in nodes if node.parameters.get("from_bag") == "/bags/first"}
    assert asked == {"road_profile", "vibration"}


def test_excitation_made_inside_needs_no_node_of_its_own():
    nodes = planned_nodes(resolved("car_full_bench"), SCENE, Path("bag"), excitation="inside")
    assert [node.name for node in nodes] == ["bag_logger", "contact_simulator"]
    assert nodes[1].parameters["excitation"] == "inside"
    assert "excitation" not in planned_nodes(resolved("seat_ride"), SCENE, None)[-1].parameters


def test_the_clock_is_the_simulators_and_can_be_switched_off():
    for clock in (True, False):
        nodes = planned_nodes(resolved("seat_ride"), SCENE, None, clock=clock)
        assert {node.name: node.parameters.get("publish_clock") for node in nodes} == {
            "vibration": None,
            "contact_simulator": clock,
        }


def test_a_node_reads_the_scene_that_was_resolved_to_the_bit(tmp_path):
    scene = resolved("tire_belgian_block", "duration=0.37")
    again = read_scene(str(write_scene(scene, tmp_path)))
    assert again.data == scene.data
    assert again.files == scene.files
    assert again.blocks == 37


def test_queues_are_two_windows_of_the_fastest_single_messages_deep():
    assert queue_depth(resolved("car_full_bench", "outputs.field_rate=200")) == 2 * 24 * 2


@needs_ros
@pytest.mark.parametrize("node", ["contact_simulator", "bag_logger", "road_profile", "vibration", "bag_replay"])
def test_the_parameter_file_states_every_parameter_of_a_node_with_its_default(node):
    file = YAML(typ="safe").load((PACKAGE / "config" / "bench.yaml").read_text(encoding="utf-8"))
    stated = file[f"/**/{node}"]["ros__parameters"]
    assert stated == declared_parameters(node)


def declared_parameters(node: str) -> dict:
    """Name and default of each parameter that the node's modules declare, as the interpreter sees them."""
    import contact_sim_pkg.nodes.parameters as parameters

    module = __import__(f"contact_sim_pkg.nodes.{node}", fromlist=["main"])
    declared: dict = {}

    class Recorder:
        _parameter_overrides, _parameters = {}, {}  # rclpy's own: nothing was given

        def has_parameter(self, name):
            return False

        def declare_parameter(self, name, default, descriptor, ignore_override=False):
            assert descriptor.dynamic_typing or (descriptor.description and descriptor.read_only)
            declared[name] = default
            return type("Value", (), {"value": default})()

        def undeclare_parameter(self, name):
            del declared[name]

    recorder = Recorder()
    used = Path(module.__file__).read_text(encoding="utf-8")
    base = Path(module.__file__).with_name("excitation_node.py" if "ExcitationNode" in used else "bench_node.py")
    for source in (used, base.read_text(encoding="utf-8")):
        scope = {
            **vars(parameters),
            **vars(module),
            **vars(__import__("contact_sim_pkg.nodes." + base.stem, fromlist=["x"])),
        }
        for call in (entry for entry in ast.walk(ast.parse(source)) if isinstance(entry, ast.Call)):
            name = getattr(call.func, "id", "")
            if name == "declare":
                values = [
                    eval(compile(ast.Expression(argument), "declare", "eval"), scope) for argument in call.args[1:]
                ]
                parameters.declare(recorder, *values)
            elif name in ("declare_record", "declare_input_timeout"):
                getattr(parameters, name)(recorder)
            elif name == "declare_pace":
                parameters.declare_pace(recorder, "max")
            elif name == "declare_scene":
                declared["scene"] = ""
    return declared
