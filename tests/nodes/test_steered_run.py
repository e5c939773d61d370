"""A run that others steer by services, action, parameters and lifecycle of the simulator: the bits of any other run."""

import json
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST, Nodes, bench, messages, needs_ros, resolved
from tests.nodes.services import connect

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.nodes.processes.on_use import provide
from contact_sim_pkg.nodes.protocol.states import RunState
from contact_sim_pkg.run.live_parameters import Change
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.steering.machine import Code, SteeringState

pytestmark = needs_ros

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "nodes" / "steered.py"
SETUP = EXAMPLE.parents[2] / "ros2_ws" / "setup.bash"
STOPPED, PLAYING, PAUSED, QUITTING = SteeringState
INFLATION = "effects.tire.inflation.pressure"


@pytest.fixture(scope="module", autouse=True)
def interfaces():
    assert provide("simulation_interfaces") == ""


class Steerer:
    """Asks the simulator's services."""

    def __init__(self, one):
        from lifecycle_msgs.srv import ChangeState, GetState
        from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters, SetParametersAtomically
        from rclpy.action import ActionClient
        from simulation_interfaces.action import SimulateSteps
        from simulation_interfaces.srv import (
            GetSimulationState,
            GetSimulatorFeatures,
            ResetSimulation,
            SetSimulationState,
            StepSimulation,
        )

        self.one, self.spin_until = one, one.spin_until
        self.kinds = {
            "get_simulator_features": GetSimulatorFeatures, "get_simulation_state": GetSimulationState,
            "set_simulation_state": SetSimulationState, "reset_simulation": ResetSimulation,
            "step_simulation": StepSimulation, "set_parameters": SetParameters,
            "set_parameters_atomically": SetParametersAtomically, "describe_parameters": DescribeParameters,
            "get_parameters": GetParameters, "change_state": ChangeState, "get_state": GetState,
        }  # fmt: skip
        self.clients = {}
        self.goal = SimulateSteps.Goal
        self.action = ActionClient(one.node, SimulateSteps, "contact_simulator/simulate_steps")

    def ask(self, name, **values):
        """Start a call; its future."""
        kind = self.kinds[name]
        if name not in self.clients:
            self.clients[name] = self.one.node.create_client(kind, f"contact_simulator/{name}")
            connect(self.spin_until, self.clients[name], self._harmless(name))
        return self.clients[name].call_async(kind.Request(**values))

    def _harmless(self, name):
        from lifecycle_msgs.msg import Transition

        request = self.kinds[name].Request()
        if name == "change_state":
            request.transition = Transition(id=99)
        elif name == "set_simulation_state":
            request.state.state = 99
        elif name == "reset_simulation":
            request.scope = 4
        elif name == "step_simulation":
            request.steps = 0
        return request

    def call(self, name, **values):
        """The response."""
        answer = self.ask(name, **values)
        self.spin_until(answer.done)
        return answer.result()

    def go_to(self, state):
        """The result of SetSimulationState."""
        from simulation_interfaces.msg import SimulationState

        return self.call("set_simulation_state", state=SimulationState(state=int(state))).result

    @property
    def state(self):
        answer = self.call("get_simulation_state")
        assert answer.result.result == Code.OK
        return SteeringState(answer.state.state)

    def step(self, count):
        return self.call("step_simulation", steps=count).result

    def reset(self, scope=255):
        return self.call("reset_simulation", scope=scope).result

    def change(self, transition):
        from lifecycle_msgs.msg import Transition

        return self.call("change_state", transition=Transition(label=transition)).success

    @property
    def life(self):
        return self.call("get_state").current_state.label

    def set(self, *, together=False, **values):
        """Results of setting parameters, whose dots are written as __."""
        from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue

        def value(given):
            if isinstance(given, float):
                return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=given)
            if isinstance(given, int):
                return ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=given)
            return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=given)

        given = [Parameter(name=name.replace("__", "."), value=value(each)) for name, each in values.items()]
        if together:
            return self.call("set_parameters_atomically", parameters=given).result
        return self.call("set_parameters", parameters=given).results

    def value(self, name):
        return self.call("get_parameters", names=[name]).values[0].double_value

    @property
    def block(self):
        return self.one.progress.block

    def wait_for(self, state, block=-1, run=0):
        self.spin_until(
            lambda: (
                self.one.progress is not None
                and (RunState(self.one.progress.state), self.one.progress.run) == (state, run)
                and self.block >= block
            )
        )


@pytest.fixture
def steerer():
    from tests.nodes.stand_in import StandIn

    with StandIn("steerer", "backrest/force") as one:
        yield Steerer(one)


class Steered(Nodes):
    """Simulator and logger of a run that is steered."""

    def begin(self, **parameters):
        self.start("bag_logger")
        self.start("contact_simulator", excitation="inside", **parameters)

    def bags(self):
        return sorted(path.name for path in self.bag.parent.glob("bag*"))

    def clean(self):
        return [line for line in self.printed if "Traceback" in line or "ERROR" in line] == []


@pytest.fixture
def steered(tmp_path):
    made = []

    def begin(scene, **parameters):
        made.append(Steered(scene, tmp_path))
        made[-1].begin(**parameters)
        return made[-1]

    yield begin
    for nodes in made:
        nodes.end()


def test_the_definitions_are_those_of_2_1_0():
    """The hashes were made from the definitions of the release by ROS's own generator."""
    import simulation_interfaces

    found = {}
    prefix = next(each for each in Path(simulation_interfaces.__file__).parents if (each / "share").is_dir())
    for path in (prefix / "share" / "simulation_interfaces").rglob("*.json"):
        for each in json.loads(path.read_text(encoding="utf-8"))["type_hashes"]:
            found[each["type_name"].removeprefix("simulation_interfaces/")] = each["hash_string"][:15]
    assert {
        "msg/Result": "RIHS01_cf43a306", "msg/SimulationState": "RIHS01_bb9f87cc", "msg/SimulatorFeatures": "RIHS01_8b101c85",
        "srv/GetSimulatorFeatures": "RIHS01_abb9439c", "srv/GetSimulationState": "RIHS01_3362dceb",
        "srv/SetSimulationState": "RIHS01_a868b916", "srv/StepSimulation": "RIHS01_913fe065",
        "srv/ResetSimulation": "RIHS01_4ce285d7", "action/SimulateSteps": "RIHS01_f0837c89",
    }.items() <= found.items()  # fmt: skip


@pytest.mark.parametrize("scene", ["car_full_bench", "seat_ride", "impact_rubber_drop"])
def test_excitation_made_inside_gives_the_bits_of_offline(tmp_path, scene):
    values = ("duration=0.3", "pace=max")
    options = [part for value in values for part in ("--set", value)]
    ended = bench("run", scene, *options, "--excitation", "inside", "--out", tmp_path / "nodes")
    assert ended.returncode == 0, ended.stderr
    run_offline(resolved(scene, *values), tmp_path / "offline")
    assert messages(tmp_path / "nodes") == messages(tmp_path / "offline")
    assert open_bag(tmp_path / "nodes").complete


def test_the_example_steers_a_run_whose_second_bag_is_that_of_offline(tmp_path, steered):
    scene = resolved("tire_bump", "duration=3", "pace=realtime")
    nodes = steered(scene)
    # the definitions may have been built a moment ago: a shell that is set up now has them on its paths
    command = ["bash", "-c", '. "$0" && exec "$1" "$2"', SETUP, sys.executable, EXAMPLE]
    ended = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert ended.returncode == 0, ended.stderr
    said = ended.stdout.splitlines()
    assert said[0].startswith("9 features: a step is a block of the scene")
    assert 20 <= int(said[2].partition(" ")[0]) <= 50
    assert [said[1], *said[3:]] == ["5 steps done", "inflation changed", "plays again"]
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0}
    assert nodes.clean()
    assert nodes.bags() == ["bag", "bag_2"]
    run_offline(scene, tmp_path / "offline")
    assert messages(tmp_path / "bag_2") == messages(tmp_path / "offline")
    first = open_bag(nodes.bag)
    assert (first.complete, first.metadata["ended"], first.metadata["failure"]) == (True, "stopped", "")


def test_every_feature_that_is_claimed_acts_and_no_other_does(tmp_path, steered, steerer):
    """Also: a pause of 12 s with an input_timeout of 5 s, after which nothing is caught up."""
    scene = resolved("seat_ride", "duration=20", "pace=realtime")
    nodes = steered(scene, input_timeout="5.0")
    features = steerer.call("get_simulator_features").features
    assert sorted(features.features) == [20, 21, 22, 24, 25, 26, 31, 32, 33]
    assert not features.spawn_formats
    steerer.wait_for(RunState.RUNNING, 10)
    # state getting, setting, pause
    assert steerer.state is PLAYING
    assert steerer.go_to(PLAYING).result == Code.ALREADY
    assert steerer.step(1).result == Code.FAILED
    assert steerer.go_to(PAUSED).result == Code.OK
    assert (steerer.state, steerer.life) == (PAUSED, "inactive")
    steerer.wait_for(RunState.PAUSED)
    before, since = steerer.block, time.monotonic()
    steerer.spin_until(lambda: time.monotonic() - since > 12.0)
    assert steerer.block == before
    # steps: one, several, by the action
    assert steerer.step(1).result == Code.OK
    steerer.wait_for(RunState.PAUSED, before + 1)
    assert steerer.step(5).result == Code.OK
    steerer.wait_for(RunState.PAUSED, before + 6)
    assert steerer.block == before + 6
    assert steerer.step(0).result == Code.FAILED
    assert steerer.step(10_000).error_message == f"steps is 10000; the scene has blocks for 1 to {2000 - before - 7}"
    seen, asked = [], []

    def on_feedback(message):
        seen.append((message.feedback.completed_steps, message.feedback.remaining_steps))
        if len(seen) >= 20 and accepted.done() and not asked:
            asked.append(accepted.result().cancel_goal_async())

    accepted = steerer.action.send_goal_async(steerer.goal(steps=1000), feedback_callback=on_feedback)
    steerer.spin_until(accepted.done)
    ended = accepted.result().get_result_async()
    steerer.spin_until(ended.done)
    status, result = ended.result().status, ended.result().result.result
    assert (status, result.result) == (5, Code.FAILED)  # cancelled
    done = int(result.error_message.removeprefix("cancelled after ").partition(" ")[0])
    assert 20 <= done < 1000
    assert seen == sorted({(number, 1000 - number) for number, _ in seen})  # a busy client hears not of each
    steerer.wait_for(RunState.PAUSED, before + 6 + done)
    assert steerer.block == before + 6 + done
    # on at the pace: what was paused and stepped is not caught up, nor waited for
    block, since = steerer.block, time.monotonic()
    assert steerer.go_to(PLAYING).result == Code.OK
    steerer.wait_for(RunState.RUNNING, block + 100)
    assert time.monotonic() - since > 0.7
    # resets of time, of state, of both; what is not claimed
    for scope in (4, 7, 254):
        refused = steerer.reset(scope)
        assert (refused.result, bool(refused.error_message)) == (Code.UNSUPPORTED, True)
    for state in (4, 5):
        refused = steerer.go_to(state)
        assert (refused.result, bool(refused.error_message)) == (Code.UNSUPPORTED, True)
    assert steerer.go_to(7).result == Code.INCORRECT_TRANSITION
    for number, scope in enumerate((1, 2, 0, 255), start=1):
        assert steerer.reset(scope).result == Code.OK
        steerer.wait_for(RunState.PAUSED, run=number)
        assert (steerer.state, steerer.block, steerer.life) == (STOPPED, -1, "inactive")
        assert steerer.reset(scope).result == Code.OK  # at its start already
        assert steerer.go_to(PAUSED).result == Code.OK
        assert steerer.step(number).result == Code.OK
    assert steerer.go_to(STOPPED).result == Code.OK
    steerer.wait_for(RunState.PAUSED, run=5)
    assert steerer.go_to(PAUSED).result == Code.OK
    assert steerer.step(5).result == Code.OK
    assert steerer.go_to(QUITTING).result == Code.OK
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0}
    assert nodes.clean()
    bags = [open_bag(tmp_path / name) for name in nodes.bags()]
    assert [each.complete for each in bags] == [True] * 6
    assert [each.count("bench/energy") for each in bags[1:]] == [1, 2, 3, 4, 5]
    run_offline(scene, tmp_path / "offline")
    offline = messages(tmp_path / "offline")
    for each in bags:
        found = messages(each.path)
        assert found == offline[: len(found)]


def test_live_keys_are_parameters_and_a_bag_with_changes_gives_its_bytes_again(tmp_path, steered, steerer):
    scene = resolved("tire_bump", "duration=1", "pace=max")
    nodes = steered(scene, autostart="false")
    assert steerer.change("configure")
    steerer.wait_for(RunState.PAUSED)
    assert steerer.state is STOPPED
    described = steerer.call("describe_parameters", names=[INFLATION]).descriptors[0]
    bounds = described.floating_point_range[0]
    assert "[Pa]" in described.description
    assert bounds.from_value < 180e3 < bounds.to_value
    started = steerer.value(INFLATION)
    # before the first block, between blocks, all or none
    assert steerer.set(tire__wheel_mass=31.0)[0].successful
    assert steerer.go_to(PAUSED).result == Code.OK
    assert steerer.step(10).result == Code.OK
    assert steerer.set(effects__tire__inflation__pressure=180_000)[0].successful  # a whole number
    assert steerer.step(20).result == Code.OK
    together = steerer.set(together=True, travel__speed=12.0, tire__wheel_mass=-1.0)
    assert (together.successful, bool(together.reason)) == (False, True)
    assert steerer.value("travel.speed") != 12.0
    assert steerer.set(together=True, travel__speed=12.0, tire__suspension_damping=1400.0).successful
    # refused, with the reason
    for name, value, reason in (
        ("effects__tire__inflation__pressure", 1e9, "out of range"),
        ("effects__tire__inflation__pressure", float("nan"), ""),
        ("effects__tire__inflation__pressure", "180", ""),
        ("block_length", 0.02, "block_length is fixed in a run: "),
        ("seed", 3, "seed is fixed in a run: "),
        ("no__such__key", 3.0, "no.such.key"),
    ):
        answer = steerer.set(**{name: value})[0]
        assert not answer.successful, name
        assert reason in answer.reason
    assert steerer.value(INFLATION) == 180e3
    assert steerer.go_to(PLAYING).result == Code.OK
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0}
    assert nodes.clean()
    changes = (
        Change(0, "tire.wheel_mass", 31.0), Change(10, INFLATION, 180e3),
        Change(30, "travel.speed", 12.0), Change(30, "tire.suspension_damping", 1400.0),
    )  # fmt: skip
    run_offline(scene, tmp_path / "offline", changes=changes)
    steered_bag = messages(nodes.bag)
    assert started != 180e3
    assert steered_bag == messages(tmp_path / "offline")
    assert Counter(topic for topic, _, _ in steered_bag)["/bench/steering"] == 4
    again = bench("run", "--offline", "--from-bag", nodes.bag, "--out", tmp_path / "again")
    assert again.returncode == 0, again.stderr
    assert messages(tmp_path / "again") == steered_bag


def test_a_reset_takes_parameters_back(tmp_path, steered, steerer):
    scene = resolved("tire_bump", "duration=0.5", "pace=max")
    nodes = steered(scene, autostart="false")
    assert steerer.change("configure")
    steerer.wait_for(RunState.PAUSED)
    started = steerer.value(INFLATION)
    for number, blocks in enumerate((0, 10), start=1):  # a change alone makes a run another one
        assert steerer.go_to(PAUSED).result == Code.OK
        assert steerer.set(effects__tire__inflation__pressure=180e3)[0].successful
        assert not blocks or steerer.step(blocks).result == Code.OK
        assert steerer.reset().result == Code.OK
        steerer.wait_for(RunState.PAUSED, run=number)
        assert steerer.value(INFLATION) == started
    assert steerer.go_to(PLAYING).result == Code.OK
    assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0}
    assert nodes.clean()
    run_offline(scene, tmp_path / "offline")
    assert messages(tmp_path / "bag_3") == messages(tmp_path / "offline")


def test_the_lifecycle_is_the_same_machine_twenty_times(tmp_path, steered, steerer):
    scene = resolved("seat_ride", "duration=20", "pace=realtime")
    nodes = steered(scene, autostart="false")
    endpoints = []
    names = steerer.one.node.get_topic_names_and_types, steerer.one.node.get_service_names_and_types_by_node
    for number in range(20):
        assert steerer.change("configure")
        steerer.wait_for(RunState.PAUSED, run=number)
        assert (steerer.state, steerer.life) == (STOPPED, "inactive")
        assert steerer.change("activate")
        assert (steerer.state, steerer.life) == (PLAYING, "active")
        steerer.wait_for(RunState.RUNNING, 3, run=number)
        assert not steerer.change("cleanup")
        assert steerer.change("deactivate")
        assert (steerer.state, steerer.life) == (PAUSED, "inactive")
        endpoints.append((len(names[0]()), len(names[1]("contact_simulator", "/"))))
        steerer.spin_until(lambda: steerer.one.recorded >= 3)
        assert steerer.change("cleanup")
        assert steerer.life == "unconfigured"
        for name in ("get_simulation_state", "get_parameters"):
            client = steerer.clients.pop(name, None)
            if client is not None:
                steerer.one.node.destroy_client(client)
    assert len(set(endpoints)) == 1
    assert steerer.change("shutdown")
    assert nodes.wait("contact_simulator") == {"contact_simulator": 0}
    nodes.wait()
    assert nodes.clean()
    bags = [open_bag(tmp_path / name) for name in nodes.bags() if (tmp_path / name / "metadata.yaml").exists()]
    assert len(bags) == 20
    assert all(each.complete and each.count("bench/energy") >= 4 for each in bags)
