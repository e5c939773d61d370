"""Ours against the closed forms of the six problems; the others where they are installed (`make compare-dynamics`)."""

import importlib

import pytest

from comparisons.dynamics.problems import PROBLEMS, measure
from comparisons.dynamics.with_ours import Ours

BOUNDS = {  # the block of the impact starts 0.1 um above the ground and turns a little before it touches
    "restitution": 1e-9, "block impact": 1e-6, "slope creep": 1e-14, "slide to a stop": 1e-9, "elastic energy": 1e-10,
    "box on four contacts": 1e-9,
}  # fmt: skip


@pytest.mark.parametrize("problem", PROBLEMS)
def test_ours_solves_each_problem_to_its_closed_form(problem):
    assert measure(problem, Ours(5e-3), 5e-3).error <= BOUNDS[problem]


@pytest.fixture(params=[("with_mujoco", "MuJoCo"), ("with_pybullet", "PyBullet")], ids=["mujoco", "pybullet"])
def peer(request):
    name, engine = request.param
    try:
        module = importlib.import_module(f"comparisons.dynamics.{name}")
    except ImportError as error:
        pytest.skip(f"{engine} is not installed here: {error}")
    return getattr(module, engine)


def test_a_peer_lets_a_box_slide_about_as_far_as_coulomb_says(peer):
    assert measure("slide to a stop", peer(1e-3), 1e-3).error < 0.05


def test_a_peer_carries_the_weight_of_a_box_by_its_corners(peer):
    outcome = measure("box on four contacts", peer(1e-3), 1e-3)
    assert outcome.simulated == 1.0
    assert outcome.error < 4.0
