"""Live keys of the scene as parameters of the simulator: `ros2 param set` changes the run between two blocks."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.node import Node
from rclpy.parameter import Parameter

from contact_sim_pkg.run.live_parameters import Parameter as Key
from contact_sim_pkg.run.live_parameters import ParameterError


class FixedKeyError(ParameterNotDeclaredException):
    """A key of the scene that holds for the whole run; the text says why."""

    def __init__(self, reason: str) -> None:
        """Of a ``reason``, which is what rclpy answers with."""
        Exception.__init__(self, reason)


class LiveParameters:
    """Declares the live keys, with unit and range, and hands changes on: all of a request, or none.

    `ros2 param set` makes a request a key; `set_parameters_atomically` takes several.
    """

    def __init__(
        self, node: Node, keys: Callable[[], Mapping[str, Key]], change: Callable[[Mapping[str, float]], None]
    ) -> None:
        """Declare them on a node.

        Args:
            node: the simulator.
            keys: every key of the scene, with its present value.
            change: makes a change; raises ParameterError, and then nothing has changed.
        """
        self._node, self._keys, self._change = node, keys, change
        self._live = {name: key for name, key in keys().items() if key.live}
        self._shows = False  # sets parameters to what the run has already
        for name, key in self._live.items():
            node.declare_parameter(name, float(key.value), _descriptor(key), ignore_override=True)
        node.add_pre_set_parameters_callback(self._as_numbers)
        node.add_on_set_parameters_callback(self._on_set)

    def show(self) -> None:
        """Show the values that the run has, which a reset has changed back."""
        values = self._keys()
        given = [Parameter(name, value=float(values[name].value)) for name in self._live]
        self._shows = True
        try:
            self._node.set_parameters(given)
        finally:
            self._shows = False

    def destroy(self) -> None:
        """Undeclare them."""
        self._node.remove_on_set_parameters_callback(self._on_set)
        self._node.remove_pre_set_parameters_callback(self._as_numbers)
        for name in self._live:
            self._node.undeclare_parameter(name)

    def _as_numbers(self, given: list[Parameter]) -> list[Parameter]:
        """Whole numbers as the numbers that they are meant as. Raises FixedKeyError for what is no parameter."""
        found = []
        for each in given:
            if not self._node.has_parameter(each.name):
                key = self._keys().get(each.name)
                raise FixedKeyError(
                    key.reason if key else f"no parameter {each.name}; live are {', '.join(self._live)}"
                )
            is_whole = each.name in self._live and each.type_ is Parameter.Type.INTEGER
            found.append(Parameter(each.name, value=float(each.value)) if is_whole else each)
        return found

    def _on_set(self, given: list[Parameter]) -> SetParametersResult:
        values = {each.name: each.value for each in given if each.name in self._live}
        if not values or self._shows:
            return SetParametersResult(successful=True)
        try:
            self._change(values)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        except Exception as error:  # noqa: BLE001  # the boundary of a request: the run is as it was
            self._node.get_logger().error("".join(traceback.format_exception(error)))
            return SetParametersResult(successful=False, reason=f"unexpected {type(error).__name__}: {error}")
        return SetParametersResult(successful=True)


def _descriptor(key: Key) -> ParameterDescriptor:
    text = f"Live key of the scene, acts on the {key.live}" + (f" [{key.unit}]." if key.unit else ".")
    low = -float("inf") if key.low is None else float(key.low)
    high = float("inf") if key.high is None else float(key.high)
    bounds = [FloatingPointRange(from_value=low, to_value=high, step=0.0)]
    return ParameterDescriptor(description=text, floating_point_range=bounds)
