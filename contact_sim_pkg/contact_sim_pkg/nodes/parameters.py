"""Declaration of the nodes' parameters, read-only, each with text, unit and range; live keys are in `live_parameters.py`."""

from __future__ import annotations

from typing import Any, TypeVar

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node

from contact_sim_pkg.nodes.misspelt import misspelt
from contact_sim_pkg.nodes.protocol.pacing import parse_pace
from contact_sim_pkg.nodes.protocol.states import REFUSED, NodeError

Value = TypeVar("Value", bool, int, float, str)
_KINDS: dict[type, str] = {bool: "true or false", int: "a whole number", float: "a number", str: "a text"}


def declare(node: Node, name: str, default: Value, text: str, allowed: tuple[float, float] | None = None) -> Value:
    """The value of a parameter that is fixed for the life of the node; `allowed` is the range of a
    number, in the unit that `text` names ([s], or dimensionless).

    A whole number is accepted for a decimal one. Raises NodeError (refused) for another
    type or beyond the range.
    """
    given = _given(node, name, default)
    return _declare_fixed(node, name, _checked(name, given, default, allowed), text, allowed)


def _given(node: Node, name: str, default: Any) -> Any:
    """The value given to the node, of whatever type, or the default: rclpy itself accepts no 5 for
    a 5.0.
    """
    value = node.declare_parameter(name, default, ParameterDescriptor(dynamic_typing=True)).value
    node.undeclare_parameter(name)
    return value


def _declare_fixed(node: Node, name: str, value: Value, text: str, allowed: tuple[float, float] | None = None) -> Value:
    descriptor = ParameterDescriptor(description=text, read_only=True)
    if allowed is not None and type(value) is int:
        descriptor.integer_range = [IntegerRange(from_value=int(allowed[0]), to_value=int(allowed[1]), step=1)]
    elif allowed is not None:
        descriptor.floating_point_range = [FloatingPointRange(from_value=allowed[0], to_value=allowed[1], step=0.0)]
    node.declare_parameter(name, value, descriptor, ignore_override=True)
    return value


def _checked(name: str, given: Any, default: Value, allowed: tuple[float, float] | None) -> Value:
    kind = type(default)
    if type(given) is not kind and not (kind is float and type(given) is int):
        cure = f"; write -p {name}:=\"'{given}'\"" if kind is str else ""
        raise NodeError(f"parameter {name} is {given!r}, it takes {_KINDS[kind]}{cure}", REFUSED)
    if allowed is not None and not allowed[0] <= float(given) <= allowed[1]:  # not a number is in no range
        raise NodeError(f"parameter {name} is {given!r}, allowed are {allowed[0]:g} to {allowed[1]:g}", REFUSED)
    value: Value = kind(given)
    return value


def refuse_misspelt(node: Node) -> None:
    """Raise NodeError (refused) for a parameter that was given, that the node has not declared, and that resembles one
    that it has. Any other may be meant for other nodes, as in a file of parameters for all of them.
    """
    given, declared = node._parameter_overrides, node._parameters  # rclpy has no public name for them
    for name, meant in misspelt(given, declared).items():
        raise NodeError(f"parameter {name} is none of this node; did you mean {meant}?", REFUSED)


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
    """Pace as simulated seconds per second [1]; the scene's own where the parameter is empty."""
    text = "Pace: realtime, max, or simulated seconds per second, 0.001 to 1000. Empty: that of the scene."
    if node.has_parameter("pace"):  # the node is configured again
        pace = str(node.get_parameter("pace").value)
    else:
        pace = _declare_fixed(node, "pace", str(_given(node, "pace", "")), text)
        refuse_misspelt(node)  # again, with `pace`
    try:
        return parse_pace(pace or of_scene)
    except ValueError as error:
        raise NodeError(f"parameter {error}", REFUSED) from None


def declare_input_timeout(node: Node) -> float:
    """Longest wait for a missing block, [s]."""
    text = "Time of the steady clock, in s, after which a block that does not come ends the run."
    return declare(node, "input_timeout", 5.0, text, (0.1, 3600.0))
