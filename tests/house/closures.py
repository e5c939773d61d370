"""What one must carry to use or to change one thing: modules that are reached from some roots, by imports and by names.

A record names what it takes long to load as text, ``module:name`` or ``f"{__name__}.module:name"``; such a text counts as
an import. The list of our rigs does not: a closure has those rigs that are among its roots.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from tests.house.source import PACKAGE, Module, circles, imports

RUN = ("cli.main", "cli.run", "cli.report", "cli.replay")
NODES = tuple(
    f"nodes.{name}"
    for name in ("road_profile", "vibration", "contact_simulator", "bag_logger", "bag_replay", "excitation")
)
FRAME = (*RUN, *NODES, "excitation.roads", "excitation.vibrations")
"""Roots of what runs, reports and replays, without a rig."""
LISTS_RIGS = "rigs"
VEHICLE = (
    ("motion", "field", "travel_report"), ("acting", "rest"), ("seat",), ("tire",), ("effects",), ("model", "work"),
    ("outputs",), ("run",), ("simulation",), ("other_half",),
    ("machines",),
)  # fmt: skip
"""Layers of `rigs/vehicle`: a room imports from those before it, and from none beside it."""
FOLDERS_OF_KINDS = ("excitation.roads", "excitation.vibrations")
"""Each module in them is a kind, found by its place."""


def closure(found: dict[str, Module], roots: Iterable[str], package: str = PACKAGE.name) -> set[str]:
    """Names of the modules that are reached from ``roots``. A module brings the `__init__` of the folders that it lies in,
    and what that imports; what that names it brings only where the folder itself is imported or named.
    """
    edges = imports(found, package)
    reached: dict[str, bool] = {}  # whether with what it names
    ahead = [(name, True) for name in roots]
    while ahead:
        name, whole = ahead.pop()
        if name not in found or reached.get(name, False) or (name in reached and not whole):
            continue
        reached[name] = whole
        ahead += ((target, True) for target in edges[name])
        if name in FOLDERS_OF_KINDS:
            ahead += ((each, True) for each in found if each.startswith(f"{name}."))
        ahead += ((".".join(name.split(".")[:depth]), False) for depth in range(1, name.count(".") + 1))
        if whole and name != LISTS_RIGS:
            ahead += ((target, True) for target in named(found[name], package))
    return set(reached)


def named(module: Module, package: str = PACKAGE.name) -> Iterator[str]:
    """Modules, below the package, that a module names as text."""
    for node in ast.walk(module.tree):
        text = _text(node, f"{package}.{module.name}")
        name = text.removeprefix(f"{package}.").partition(":")[0]
        if name and name != text:
            yield name


def _text(node: ast.AST, own_name: str) -> str:
    """A text, with the module's own name put in; empty for one with anything else to put in."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else ""
    if not isinstance(node, ast.JoinedStr):
        return ""
    parts = []
    for part in node.values:
        if isinstance(part, ast.FormattedValue):
            if ast.unparse(part.value) != "__name__":
                return ""
            parts.append(own_name)
        else:
            parts.append(str(getattr(part, "value", "")))
    return "".join(parts)


def code_of(found: dict[str, Module], names: Iterable[str]) -> int:
    """Lines of code of some modules."""
    return sum(found[name].code_lines() for name in names)


def folder_circles(edges: dict[str, set[str]]) -> list[list[str]]:
    """Groups of neighbours in one folder, at least one of them a folder, that import each other."""
    levels: dict[str, dict[str, set[str]]] = {}
    folders = {name.rpartition(".")[0] for name in edges}
    for name, targets in edges.items():
        for target in targets:
            one, other = name.split("."), target.split(".")
            depth = next((at for at, pair in enumerate(zip(one, other, strict=False)) if pair[0] != pair[1]), None)
            if depth is not None:
                beside = levels.setdefault(".".join(one[:depth]), {})
                first, second = ".".join(one[: depth + 1]), ".".join(other[: depth + 1])
                beside.setdefault(first, set()).add(second)
                beside.setdefault(second, set())
    found = [group for beside in levels.values() for group in circles(beside)]
    return [group for group in found if any(name in folders for name in group)]


def arrows_back(edges: dict[str, set[str]], folder: str, layers: tuple[tuple[str, ...], ...]) -> list[str]:
    """Imports between the rooms of a folder that go up or sideways; what the folder's own `__init__` lists is left out.

    KeyError: a room without a layer.
    """
    rank = {room: at for at, rooms in enumerate(layers) for room in rooms}
    return sorted(
        f"{name} <- {target}"
        for name, targets in edges.items()
        for target in targets
        if name.startswith(f"{folder}.") and target.startswith(f"{folder}.")
        for one, other in [(name[len(folder) + 1 :].partition(".")[0], target[len(folder) + 1 :].partition(".")[0])]
        if one != other and rank[other] >= rank[one]
    )
