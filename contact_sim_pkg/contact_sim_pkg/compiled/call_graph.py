"""Which compiled functions call which, by the types of their arguments.

A law that is off is ``None``, and numba leaves out by type what only it would call. Whether that is
so can be read here: from the calls that were compiled, not from the text of machine code, where a
function that was linked into its caller has no name any more.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

__all__ = [
    "ABSENT",
    "Call",
    "CallGraph",
    "call_of",
    "called_with",
    "edges_between",
    "graph_of",
    "only_through",
    "reached",
]

ABSENT = "None"


class Call(NamedTuple):
    """A function as it is compiled for one combination of argument types."""

    module: str
    name: str
    arguments: tuple[str, ...]  # class of each parameter tuple, `ABSENT`, or empty for a number or an array

    @property
    def function(self) -> tuple[str, str]:
        """Module and name."""
        return self.module, self.name


CallGraph = dict[Call, set[Call]]


def call_of(overload: Any) -> Call:
    """The call of a `linking.Overload`."""
    module, name, _is_entry = overload.function
    return Call(module, name, tuple(_class_of(each) for each in overload.types))


def _class_of(argument: Any) -> str:
    """Of a numba type."""
    kind = type(argument).__name__
    if kind == "NoneType":
        return ABSENT
    return str(argument.instance_class.__name__) if kind in ("NamedTuple", "NamedUniTuple") else ""


def called_with(graph: Mapping[Call, Iterable[Call]], parameters: str) -> set[Call]:
    """Calls that take the parameter tuple of a law."""
    return {call for call in graph if parameters in call.arguments}


def only_through(graph: Mapping[Call, Iterable[Call]], law: set[Call], roots: Iterable[Call]) -> set[Call]:
    """Calls that the roots reach through a law alone, and the law itself."""
    without = reached({call: set(called) - law for call, called in graph.items() if call not in law}, set(roots) - law)
    return reached(graph, roots) - without


def reached(graph: Mapping[Call, Iterable[Call]], roots: Iterable[Call]) -> set[Call]:
    """Calls that the roots make, directly or not, and the roots."""
    found, waiting = set(), list(roots)
    while waiting:
        call = waiting.pop()
        if call not in found:
            found.add(call)
            waiting += graph.get(call, ())
    return found


def graph_of(edges: Iterable[tuple[Call, Call]], roots: Iterable[Call]) -> CallGraph:
    """The graph of some edges."""
    graph: CallGraph = {root: set() for root in roots}
    for caller, called in edges:
        graph.setdefault(caller, set()).add(called)
        graph.setdefault(called, set())
    return graph


def edges_between(libraries: Iterable[Any]) -> Iterator[tuple[Call, Call]]:
    """Calls between kernels and what they call, of libraries that can be imported."""
    for library in libraries:
        if library.overload is not None:
            for each in library.callees:
                yield call_of(library.overload), call_of(each.overload)
