"""Declaration of the nodes' parameters: all read-only, each with text, unit and range."""

from __future__ import annotations

from typing import TypeVar

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node

from .pacing import parse_pace
from .protocol import REFUSED, NodeError

Value = TypeVar("Value", bool, int, float, str)


def declare(node: Node, name: str, default: Value, text: str, allowed: tuple[float, float] | None = None) -> Value:
    """The value of a parameter that is fixed for the life of the node; `allowed` is the range of a number."""
    ranges = [FloatingPointRange(from_value=allowed[0], to_value=allowed[1], step=0.0)] if allowed else []
    descriptor = ParameterDescriptor(description=text, read_only=True, floating_point_range=ranges)
    value: Value = node.declare_parameter(name, default, descriptor).value
    return value


def declare_scene(node: Node) -> str:
    """The scene that a node works on."""
    scene = declare(node, "scene", "", "Scene: its name, the path of its YAML file, or the path of a resolved scene.")
    if not scene:
        raise NodeError("parameter scene is empty; give the name of a scene or the path of its YAML file", REFUSED)
    return scene


def declare_record(node: Node) -> bool:
    """Whether the run has a logger whose answers count."""
    return declare(node, "record", True, "A bag_logger takes part in the run, and its answers are waited for.")


def declare_pace(node: Node, of_scene: str | float) -> float:
    """Simulated seconds per second; the scene's own where the parameter is empty."""
    text = "Pace: realtime, max, or simulated seconds per second, 0.001 to 1000. Empty: what the scene says."
    pace = declare(node, "pace", "", text)
    try:
        return parse_pace(pace or of_scene)
    except ValueError as error:
        raise NodeError(f"parameter {error}", REFUSED) from None


def declare_input_timeout(node: Node) -> float:
    """How long a missing block is waited for."""
    text = "Time of the steady clock, in s, after which a block that does not come ends the run."
    return declare(node, "input_timeout", 5.0, text, (0.1, 3600.0))
