"""The sentence that a value of the wrong type or outside its range is refused with."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable

from contact_sim_pkg.records.fields import LEAST
from contact_sim_pkg.scene.schema.catalog import Entry, show
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Node, ScalarNode

LONGEST_SHOWN = 60
VERY_NEAR = 0.7
"""Likeness of a key that is named beside another place where the one that was written stands."""
UNITS = {
    "m/s": {"km/h": 1.0 / 3.6, "kmh": 1.0 / 3.6, "kph": 1.0 / 3.6, "mph": 0.44704, "mm/s": 1e-3},
    "m": {"mm": 1e-3, "cm": 1e-2, "km": 1e3, "um": 1e-6, "µm": 1e-6, "in": 0.0254},
    "s": {"ms": 1e-3, "min": 60.0, "h": 3600.0},
    "kg": {"g": 1e-3, "t": 1e3},
    "N": {"kN": 1e3, "MN": 1e6},
    "Pa": {"kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "psi": 6894.757},
    "N/m": {"kN/m": 1e3, "N/mm": 1e3, "kN/mm": 1e6},
    "Hz": {"kHz": 1e3},
    "rad": {"deg": math.pi / 180.0, "degrees": math.pi / 180.0, "°": math.pi / 180.0},
    "rad/s": {"rpm": math.pi / 30.0, "1/min": math.pi / 30.0},
}
"""Unit of a key -> usual other units, and their size in it."""


def bad_value(entry: Entry, node: Node) -> str:
    """Why the value of `node` cannot stand for the key `entry`; shows it as it was written."""
    if entry.kind == "list":
        what = f"a list of {len(node.items)}" if isinstance(node, ListNode) else raw_text(node)
        return f"{what} cannot stand here; allowed are {entry.allowed}"
    if entry.kind in ("section", "kinds"):
        return f"{raw_text(node)} stands where a mapping of keys to values is needed"
    if not isinstance(node, ScalarNode):
        return f"{raw_text(node)} stands where one value is needed; {_allowed(entry)}"
    if entry.kind in ("number", "integer"):
        return _bad_number(entry, node)
    if entry.kind == "text":
        return _bad_text(entry, node)
    hint = suggestion(node.raw, entry.words)
    read = "" if isinstance(node.value, str) else f", read as {_type_name(node)},"
    return f"{raw_text(node)}{read} is not allowed; {_allowed(entry)}{hint}"


def too_near_zero(entry: Entry, node: Node | None) -> str:
    """Why a number, or a list that holds it, is too close to 0."""
    amount = f"{node.raw} {entry.unit}".rstrip() if isinstance(node, ScalarNode) else "a number in the list"
    return f"{amount} is too near to 0 to compute with; write 0, or at least {LEAST:g} in size; {_allowed(entry)}"


def missing(entry: Entry) -> str:
    """What is missing, and what it may be."""
    allowed = f"; {_allowed(entry)}" if entry.allowed else ""
    return f"is missing ({entry.help}){allowed}"


def unknown_key(key: str, known: Iterable[str], elsewhere: str = "") -> str:
    """Where the key has its place, and the nearest valid key; or else all of them."""
    names = list(known)
    hint = f"; {elsewhere}" + suggestion(key, names, VERY_NEAR) if elsewhere else suggestion(key, names)
    return "the key is unknown" + (hint or f"; known here: {', '.join(names) or 'none, write {}'}")


def suggestion(word: str, known: Iterable[str], cutoff: float = 0.5) -> str:
    """`; did you mean 'x'?`, or nothing where no known word is near."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=cutoff)
    return f"; did you mean '{near[0]}'?" if near else ""


def raw_text(node: Node) -> str:
    """The value as it was written, shortened."""
    if isinstance(node, MappingNode):
        return "a mapping"
    if isinstance(node, ListNode):
        return "a list"
    raw = node.raw if len(node.raw) <= LONGEST_SHOWN else node.raw[: LONGEST_SHOWN - 1] + "…"
    return repr(raw)


def _bad_number(entry: Entry, node: ScalarNode) -> str:
    value = node.value
    if isinstance(value, bool) or not isinstance(value, int | float):
        needed = f"a number is needed{_number_hint(entry, node)}"
        return f"{raw_text(node)} was read as {_type_name(node)}, {needed}; {_allowed(entry)}"
    if entry.kind == "integer" and isinstance(value, float):
        return f"{node.raw} is not a whole number; {_allowed(entry)}"
    amount = f"{node.raw} {entry.unit}".rstrip()
    if entry.high is not None and value > entry.high:
        return f"{amount} is above {_with_unit(entry.high, entry)}; {_allowed(entry)}"
    return f"{amount} is {'not above' if entry.above else 'below'} {_with_unit(entry.low, entry)}; {_allowed(entry)}"


def _bad_text(entry: Entry, node: ScalarNode) -> str:
    if not isinstance(node.value, str):
        return f"{raw_text(node)} was read as {_type_name(node)}; write it in quotes: '{node.raw}'"
    if entry.location[-1] == "name":
        cure = re.sub("[^A-Za-z0-9._-]+", "_", node.value).strip("._-")[:100] or "my_scene"
        needed = "allowed are 1 to 100 of A-Z a-z 0-9 . _ - with no . or - in front"
        return f"{raw_text(node)} is not a name; {needed}; write name: {cure}"
    if entry.location[-1] == "sha256":
        return f"{raw_text(node)} is not a checksum; allowed are 64 of 0-9 a-f"
    return f"{raw_text(node)} is too long or holds control characters"


def _number_hint(entry: Entry, node: ScalarNode) -> str:
    given = re.fullmatch(r"([-+]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?)\s*([^0-9\s].*)", node.raw.strip())
    sizes = {**UNITS.get(entry.unit, {}), entry.unit: 1.0}
    if given and given[2] in sizes:
        value = f"{float(given[1]) * sizes[given[2]]:.5g}"
        same = "" if given[2] == entry.unit else f"{given[1]} {given[2]} is {value} {entry.unit}, "
        return f" without its unit: {same}write {value}"
    if node.quoted:
        return " without quotes"
    plain = node.raw.replace("_", "")
    if re.fullmatch(r"[-+]?0*[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?", plain):
        return f", write {show(float(plain))}"
    if node.raw.lower().lstrip("+-.") in ("nan", "inf", "infinity"):
        return ", a finite one"
    return ""


def _type_name(node: ScalarNode) -> str:
    if node.value is None:
        return "no value"
    names = {bool: "true or false", int: "a whole number", float: "a number", str: "text"}
    return names[type(node.value)]


def _with_unit(bound: float | None, entry: Entry) -> str:
    return f"{show(bound)} {entry.unit or '(no unit)'}"


def _allowed(entry: Entry) -> str:
    joint = "allowed:" if entry.kind in ("choice", "flag") else "allowed are"
    return f"{joint} {entry.allowed}" if entry.allowed else "any text is allowed"
