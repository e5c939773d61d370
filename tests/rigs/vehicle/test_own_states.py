"""States of elements' own, and masses that effects bring, at rest: closed forms by hand."""

from typing import NamedTuple

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.vehicle.acting import Acting, Joined
from contact_sim_pkg.rigs.vehicle.effects import bump_stop_kernel
from contact_sim_pkg.rigs.vehicle.model import build, standing_state
from contact_sim_pkg.rigs.vehicle.motion import elements
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.errors import SceneError

GRAVITY = 9.81


class Maxwell(NamedTuple):
    """A spring in row with a damper: ``F = k (x - s)``, ``c s' = F``, x the wheel over the body, s its own state."""

    wheel: int
    body: int
    own: int
    stiffness: float
    damping: float


@borrowing_kernel
def _pull(maxwell, ground, mode, state, out):
    force = maxwell.stiffness * (state[maxwell.wheel] - state[maxwell.body] - state[maxwell.own])
    out[maxwell.wheel + 1] -= force
    out[maxwell.body + 1] += force
    out[maxwell.own] = force / maxwell.damping
    return force * force / maxwell.damping, 0.0, 0.5 * force * force / maxwell.stiffness, 0.0


class Leveller(NamedTuple):
    """Lifts the body until it hangs by ``hangs`` [m]: ``F = K s``, ``s' = (hangs - x) / T``, x the body over the wheel."""

    wheel: int
    body: int
    own: int
    hangs: float
    stiffness: float
    time: float


@borrowing_kernel
def _lift(leveller, ground, mode, state, out):
    force, x = leveller.stiffness * state[leveller.own], state[leveller.body] - state[leveller.wheel]
    out[leveller.wheel + 1] -= force
    out[leveller.body + 1] += force
    out[leveller.own] = (leveller.hangs - x) / leveller.time
    return 0.0, force * (state[leveller.body + 1] - state[leveller.wheel + 1]), 0.0, 0.0


@pytest.fixture
def _two_of_a_test(monkeypatch):
    elements.register_element(Maxwell, _pull)
    elements.register_element(Leveller, _lift)
    yield
    for each in (Maxwell, Leveller):
        elements._KERNELS.pop(each)


@pytest.mark.usefixtures("_two_of_a_test")
def test_own_states_of_elements_are_at_rest_where_a_run_begins(monkeypatch, tmp_path):
    """A Maxwell element carries nothing at rest; a leveller carries what the suspension's spring leaves."""

    def bring(keys, chassis):
        wheel, body, first = chassis.wheel.place, chassis.body.place, chassis.first_state
        maxwell = Maxwell(wheel, body, first, 5e4, 2e3)
        leveller = Leveller(wheel, body, first + 1, -0.1, 3e4, 0.5)
        return Acting((maxwell, leveller), states=(0.01, 0.05))

    monkeypatch.setattr(bump_stop_kernel, "bump_stop", bring)
    model = build(resolved("tire_bump", "effects.tire.bump_stop={}", "road={kind: flat}"))
    state = standing_state(model, 0.0)
    wheel, body = state[0], state[2]
    assert body - wheel == pytest.approx(-0.1, abs=1e-9)
    first = model.quarter.states
    assert state[first] == pytest.approx(wheel - body, abs=1e-9)
    spring = model.quarter.suspension.stiffness * 0.1  # [N] that it carries
    assert 3e4 * state[first + 1] == pytest.approx(model.quarter.body.mass * GRAVITY - spring, rel=1e-7)


def hang(mass):
    """A mass on a spring below the body."""

    def bring(_keys, chassis):
        hung = Mass(chassis.first_state, mass)
        return Acting((Spring(chassis.body.place, hung.place, 4e4, 300.0),), (Joined("hung_z", hung, (0.1, 1.0)),))

    return bring


def test_the_body_of_a_scene_contains_the_masses_that_effects_bring(monkeypatch, tmp_path):
    monkeypatch.setattr(bump_stop_kernel, "bump_stop", hang(25.0))
    scene = resolved("tire_bump", "effects.tire.bump_stop={}", "road={kind: flat}", "duration=0.2")
    model = build(scene)
    assert model.quarter.body.mass == scene.data["tire"]["body_mass"] - 25.0
    run_offline(scene, tmp_path / "bag")
    load = open_bag(tmp_path / "bag").columns("tire/force", ("normal",))["normal"]
    weight = (scene.data["tire"]["wheel_mass"] + scene.data["tire"]["body_mass"]) * GRAVITY
    assert load[-1].max() == pytest.approx(weight, rel=1e-4)
    assert load[-1].min() == pytest.approx(weight, rel=1e-4)


def test_a_body_lighter_than_what_it_contains_is_refused(monkeypatch):
    monkeypatch.setattr(bump_stop_kernel, "bump_stop", hang(1e4))
    with pytest.raises(SceneError, match=r"bump_stop: makes 10000 kg of masses that the body contains"):
        build(resolved("tire_bump", "effects.tire.bump_stop={}"))
