"""The graph of compiled calls: what a law alone calls."""

from typing import NamedTuple

from contact_sim_pkg.compiled.call_graph import ABSENT, Call, called_with, graph_of, only_through, reached
from contact_sim_pkg.compiled.jit import calls_of, entry, kernel


class Stiff(NamedTuple):
    """Parameters of a law."""

    stiffness: float


class Body(NamedTuple):
    """A rig with a law, or without."""

    law: Stiff | None


@kernel
def squared(x):
    return x * x


@kernel
def common(x):
    return x + 1.0


@kernel
def force(law, x):
    if law is None:
        return 0.0
    return law.stiffness * squared(x)


@entry
def run(body, x):
    return force(body.law, x) + common(x)


def names(calls):
    return {call.name for call in calls}


def test_a_law_and_what_it_alone_calls_are_found_where_it_is_on_and_not_where_it_is_off():
    graph, roots = calls_of(lambda: run(Body(Stiff(2.0)), 3.0))
    assert names(roots) == {"run"}
    law = called_with(graph, "Stiff")
    assert names(law) == {"force"}
    assert names(only_through(graph, law, roots)) == {"force", "squared"}
    without, others = calls_of(lambda: run(Body(None), 3.0))
    assert called_with(without, "Stiff") == set()
    assert names(without) == {"run", "force", "common"}
    assert next(call for call in without if call.name == "force").arguments == (ABSENT, "")
    assert others != roots or names(others) == {"run"}


def test_a_function_that_others_reach_too_is_not_the_laws_own():
    root, law, shared, own = (Call("m", name, ()) for name in ("root", "law", "shared", "own"))
    graph = graph_of([(root, law), (root, shared), (law, shared), (law, own)], [root])
    assert only_through(graph, {law}, [root]) == {law, own}
    assert reached(graph, [root]) == {root, law, shared, own}
