"""Steer a run by the standard services of a simulator: pause, step, play, change a parameter, begin anew.

make interfaces && source ros2_ws/setup.bash                  # once, where ROS 2 has no simulation_interfaces
bench run tire_bump --excitation inside --pace realtime       # in one shell
python examples/nodes/steered.py                              # in another
"""

import sys
import time

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.node import Node
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import GetSimulatorFeatures, ResetSimulation, SetSimulationState, StepSimulation

SIMULATOR = "/contact_simulator"
SERVICES = {
    "get_simulator_features": GetSimulatorFeatures,
    "set_simulation_state": SetSimulationState,
    "step_simulation": StepSimulation,
    "reset_simulation": ResetSimulation,
    "set_parameters": SetParameters,
}


class Steerer(Node):
    """A client of the simulator."""

    def __init__(self) -> None:
        """Nothing asked for yet."""
        super().__init__("steerer")
        self._action = ActionClient(self, SimulateSteps, f"{SIMULATOR}/simulate_steps")
        self._services_asked = {
            name: self.create_client(kind, f"{SIMULATOR}/{name}") for name, kind in SERVICES.items()
        }
        for each in self._services_asked.values():
            each.wait_for_service()
        self._action.wait_for_server()
        time.sleep(1.0)  # for the simulator to discover this node too: it drops an answer to whom it does not know

    def call(self, name, **values):
        """The response of a service."""
        answer = self._services_asked[name].call_async(SERVICES[name].Request(**values))
        rclpy.spin_until_future_complete(self, answer)
        return answer.result()

    def go_to(self, state):
        """Stop, play or pause."""
        self.check(self.call("set_simulation_state", state=SimulationState(state=state)).result)

    def steps(self, count, cancel_at):
        """Blocks done of ``count``, which are cancelled once so many are: what is done meanwhile counts too."""
        done, asked = [0], []

        def on_feedback(message):
            done.append(message.feedback.completed_steps)
            if done[-1] >= cancel_at and accepted.done() and not asked:
                asked.append(accepted.result().cancel_goal_async())

        accepted = self._action.send_goal_async(SimulateSteps.Goal(steps=count), feedback_callback=on_feedback)
        rclpy.spin_until_future_complete(self, accepted)
        ended = accepted.result().get_result_async()
        rclpy.spin_until_future_complete(self, ended)
        return done[-1]

    def change(self, key, value):
        """Change a live key of the scene."""
        number = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        answer = self.call("set_parameters", parameters=[Parameter(name=key, value=number)]).results[0]
        if not answer.successful:
            raise RuntimeError(answer.reason)

    @staticmethod
    def check(result):
        """Raise where a command has failed."""
        if result.result != Result.RESULT_OK:
            raise RuntimeError(f"{result.result}: {result.error_message}")


def main() -> int:
    """The path of a user."""
    rclpy.init()
    bench = Steerer()
    features = bench.call("get_simulator_features").features
    print(f"{len(features.features)} features: {features.custom_info}")
    bench.go_to(SimulationState.STATE_PAUSED)
    bench.check(bench.call("step_simulation", steps=5).result)
    print("5 steps done")
    print(f"{bench.steps(50, cancel_at=20)} of 50 steps done when they were cancelled")
    bench.go_to(SimulationState.STATE_PLAYING)
    bench.change("effects.tire.inflation.pressure", 180e3)
    print("inflation changed")
    bench.check(bench.call("reset_simulation").result)
    bench.go_to(SimulationState.STATE_PLAYING)
    print("plays again")
    bench.destroy_node()
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
