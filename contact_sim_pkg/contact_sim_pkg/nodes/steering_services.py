"""Services and action of `simulation_interfaces` 2.1 under the simulator's own name, onto `Steering`.

The executor calls them on the thread that computes, between two blocks. None waits: a service whose answer follows later
sends it then, and the action goes on from its future.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.service import Service
from rclpy.task import Future
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import SimulatorFeatures
from simulation_interfaces.srv import (
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
)

from contact_sim_pkg.steering.machine import Answer, Code, Command, Steering

FEATURES = (
    SimulatorFeatures.SIMULATION_RESET,
    SimulatorFeatures.SIMULATION_RESET_TIME,
    SimulatorFeatures.SIMULATION_RESET_STATE,
    SimulatorFeatures.SIMULATION_STATE_GETTING,
    SimulatorFeatures.SIMULATION_STATE_SETTING,
    SimulatorFeatures.SIMULATION_STATE_PAUSE,
    SimulatorFeatures.STEP_SIMULATION_SINGLE,
    SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
    SimulatorFeatures.STEP_SIMULATION_ACTION,
)
INFO = (
    "a step is a block of the scene; a reset of time or state resets both, and begins the next run with the next bag; "
    "live keys of the scene are parameters of this node"
)


class SteeringServices:
    """Five services and an action."""

    def __init__(
        self, node: Node, steering: Steering, follow: Callable[[], None], answered: Callable[[], None]
    ) -> None:
        """Offer them on a node.

        Args:
            node: the simulator.
            steering: what they ask.
            follow: brings the lifecycle of the node to the state of ``steering``, before the answer.
            answered: called at each answer.
        """
        self._node, self._steering, self._follow, self._answered = node, steering, follow, answered
        self._services = [
            node.create_service(GetSimulatorFeatures, "~/get_simulator_features", self._features),
            node.create_service(GetSimulationState, "~/get_simulation_state", self._state),
            self._deferred(
                SetSimulationState, "set_simulation_state", lambda given: steering.set_state(given.state.state)
            ),
            self._deferred(StepSimulation, "step_simulation", lambda given: steering.step(given.steps)),
            self._deferred(ResetSimulation, "reset_simulation", lambda given: steering.reset(given.scope)),
        ]
        self._action = ActionServer(
            node, SimulateSteps, "~/simulate_steps", self._simulate, cancel_callback=lambda _: CancelResponse.ACCEPT
        )

    def destroy(self) -> None:
        """Withdraw them."""
        self._action.destroy()
        for service in self._services:
            self._node.destroy_service(service)

    def _features(self, request: Any, response: Any) -> Any:
        response.features.features = list(FEATURES)
        response.features.custom_info = INFO
        return response

    def _state(self, request: Any, response: Any) -> Any:
        response.state.state = int(self._steering.state)
        response.result.result = int(Code.OK)
        return response

    def _deferred(self, kind: Any, name: str, command_of: Callable[[Any], Command]) -> Service:
        """A service that answers once its command has ended."""

        def ask(request: Any, response: Any) -> Any:
            command = command_of(request)
            self._follow()
            return command, response

        service: Any = self._node.create_service(kind, f"~/{name}", ask)
        send = service.send_response

        def send_later(pair: tuple[Command, Any], header: Any) -> None:
            command, response = pair

            def on_done(answer: Answer) -> None:
                self._answered()
                _fill(response, answer)
                send(response, header)

            command.when_done(on_done)

        service.send_response = send_later
        kept: Service = service
        return kept

    async def _simulate(self, goal: Any) -> Any:
        """The action; a request to cancel counts from the block on that is done next."""
        ended = Future()
        command: Command | None = None

        def on_step(done: int, left: int) -> None:
            goal.publish_feedback(SimulateSteps.Feedback(completed_steps=done, remaining_steps=left))
            if goal.is_cancel_requested and left and command is not None:
                self._steering.cancel(command)

        command = self._steering.step(goal.request.steps, on_step)
        command.when_done(ended.set_result)
        answer: Answer = await ended
        self._answered()
        if answer.code is Code.OK:
            goal.succeed()
        elif goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.abort()
        return _fill(SimulateSteps.Result(), answer)


def _fill(response: Any, answer: Answer) -> Any:
    response.result.result, response.result.error_message = int(answer.code), answer.sentence
    return response
