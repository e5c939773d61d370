"""Parameters of the nodes: any number is a number; a wrong type or value is one sentence."""

import math
import subprocess

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST, needs_ros

from contact_sim_pkg.python_process import python_command

pytestmark = needs_ros


@pytest.fixture(scope="module")
def node_with():
    """Makes a node with arguments of the command line."""
    import rclpy
    from rclpy.node import Node
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
    made = []

    def make(*assignments):
        arguments = [part for each in assignments for part in ("-p", each)]
        made.append(Node("tried", context=context, cli_args=["--ros-args", *arguments], enable_rosout=False))
        return made[-1]

    yield make
    for node in made:
        node.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize(
    ("assignment", "expected"),
    [("pace:=0.3", 0.3), ("pace:=2", 2.0), ("pace:=max", math.inf), ("pace:=1e-2", 0.01), ("other:=1", 1.0)],
)
def test_any_number_or_word_is_a_pace(node_with, assignment, expected):
    from contact_sim_pkg.nodes.parameters import declare_pace

    assert declare_pace(node_with(assignment), "realtime") == expected


def test_a_whole_number_is_a_number_of_its_declared_type_range_and_text(node_with):
    from contact_sim_pkg.nodes.parameters import declare_input_timeout

    node = node_with("input_timeout:=5")
    value = declare_input_timeout(node)
    assert (value, type(value)) == (5.0, float)
    assert (node.get_parameter("input_timeout").value, node.describe_parameter("input_timeout").read_only) == (
        5.0,
        True,
    )
    assert node.describe_parameter("input_timeout").floating_point_range[0].to_value == 3600.0


@pytest.mark.parametrize(
    ("default", "text", "sentence"),
    [
        (5.0, "'5'", "parameter x is '5', it takes a number"),
        (5.0, "true", "parameter x is True, it takes a number"),
        (5.0, "[1.0]", "it takes a number"),
        (5.0, "0", "parameter x is 0, allowed are 1 to 10"),
        (5.0, ".nan", "parameter x is nan, allowed are 1 to 10"),
        (True, "1", "parameter x is 1, it takes true or false"),
        (0, "1.5", "parameter x is 1.5, it takes a whole number"),
        ("", "2026", "parameter x is 2026, it takes a text; write -p x:="),
    ],
)
def test_a_wrong_type_or_value_is_refused_in_one_sentence(node_with, default, text, sentence):
    from contact_sim_pkg.nodes.parameters import declare
    from contact_sim_pkg.nodes.protocol.states import REFUSED, NodeError

    allowed = (1.0, 10.0) if type(default) is float else None
    with pytest.raises(NodeError) as refused:
        declare(node_with(f"x:={text}"), "x", default, "For the test.", allowed)
    assert sentence in str(refused.value)
    assert refused.value.exit_status == REFUSED


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["-p", "rate:=fast"], "parameter rate is 'fast', it takes a number"),
        (["-p", "use_sim_time:=5"], "'use_sim_time'"),
        (["-p", "bag:="], "the arguments after --ros-args cannot be read: Couldn't parse parameter override rule"),
        (["--nonsense"], "the arguments after --ros-args cannot be read: ['--nonsense']"),
    ],
)
def test_a_node_with_bad_arguments_ends_with_status_2_and_no_traceback(arguments, sentence):
    command = python_command("contact_sim_pkg.nodes.bag_replay", "--ros-args", *arguments)
    ended = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST)
    assert (ended.returncode, "Traceback" in ended.stderr) == (2, False)
    assert sentence in ended.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    ("node", "assignment", "meant"),
    [("bench_view", "rat:=10.0", "rate"), ("vibration", "scen:=seat_ride", "scene"),
     ("contact_simulator", "pase:=max", "pace")],
)  # fmt: skip
def test_a_misspelt_parameter_is_refused_with_the_one_that_it_resembles(node, assignment, meant):
    given = ["-p", "scene:=seat_ride", "-p", "robot:=of_another_node", "-p", assignment]
    ended = subprocess.run(
        python_command(f"contact_sim_pkg.nodes.{node}", "--ros-args", *given),
        env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST,
    )  # fmt: skip
    name = assignment.partition(":")[0]
    assert ended.returncode == 2
    assert f"parameter {name} is none of this node; did you mean {meant}?" in ended.stderr
