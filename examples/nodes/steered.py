"""Steer a run by the standard services of a simulator: pause, step, play, change a parameter, begin anew.

bench run tire_bump --excitation inside --pace realtime       # in one shell
python examples/nodes/steered.py                              # in another
"""

import sys

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.node import Node
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import GetSimulatorFeatures, ResetSimulation, SetSimulationState, StepSimulation

SIMULATOR = "/contact_simulator"


class Steerer(Node):
    """A client of the simulator."""

    def __init__(self) -> None:
        """Nothing asked for yet."""
        super().__init__("steerer")
        self._action = ActionClient(self, SimulateSteps, f"{SIMULATOR}/simulate_steps")

    def call(self, kind, name, **values):
        """The response of a service."""
        client = self.create_client(kind, f"{SIMULATOR}/{name}")
        client.wait_for_service()
        answer = client.call_async(kind.Request(**values))
        rclpy.spin_until_future_complete(self, answer)
        self.destroy_client(client)
        return answer.result()

    def go_to(self, state):
        """Stop, play or pause."""
        self.check(self.call(SetSimulationState, "set_simulation_state", state=SimulationState(state=state)).result)

    def steps(self, count, cancel_at):
        """Blocks done of ``count`` that are cancelled once so many are done."""
        done, asked = [0], []
        self._action.wait_for_server()

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
        answer = self.call(SetParameters, "set_parameters", parameters=[Parameter(name=key, value=number)]).results[0]
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
    features = bench.call(GetSimulatorFeatures, "get_simulator_features").features
    print(f"{len(features.features)} features: {features.custom_info}")
    bench.go_to(SimulationState.STATE_PAUSED)
    bench.check(bench.call(StepSimulation, "step_simulation", steps=5).result)
    print("5 steps done")
    is_cancelled = 20 <= bench.steps(50, cancel_at=20) <= 50
    print(f"50 steps cancelled: {is_cancelled}")
    bench.go_to(SimulationState.STATE_PLAYING)
    bench.change("effects.tire.inflation.pressure", 180e3)
    print("inflation changed")
    bench.check(bench.call(ResetSimulation, "reset_simulation").result)
    bench.go_to(SimulationState.STATE_PLAYING)
    print("plays again")
    bench.destroy_node()
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
