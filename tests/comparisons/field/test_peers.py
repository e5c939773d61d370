"""Run where the peers are installed: in `.compare-field/`, made by `make compare-field`."""

import numpy
import pytest

from comparisons.field.agreement import agreements
from comparisons.field.problems import tire
from comparisons.field.solver import Candidate, candidates

FOUND, MISSING = candidates()


def test_ours_is_always_there_and_what_is_missing_has_a_reason():
    assert FOUND[0].name == "ours"
    assert {one.name for one in FOUND} | set(MISSING) == {"ours", "tamaas", "ASPHER"}
    assert all(MISSING.values())


@pytest.fixture(params=["tamaas", "ASPHER"])
def peer(request) -> Candidate:
    if request.param in MISSING:
        pytest.skip(f"{request.param} is not installed here: {MISSING[request.param]}")
    return next(one for one in FOUND if one.name == request.param)


def test_a_peer_solves_the_same_discrete_problem(peer):
    assert all(one.difference < 1e-7 for one in agreements([peer]))


def test_a_peer_takes_its_shifted_field_as_a_start(peer):
    problem = tire("128x96", 1)
    solver = peer.make(problem, True)
    for step in range(2):
        field = solver.solve(problem.gap(step), 1 if step else 0, 1e-6)
    assert field.shape == (128, 96)
    assert field.sum() * problem.cell**2 == pytest.approx(4000.0, rel=1e-8)
    assert (numpy.asarray(field) >= 0.0).all()
