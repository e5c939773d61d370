"""A contact under weight: loaded and released phases against scipy, energy, the sphere that comes to rest."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.contact import (
    LOADED,
    PARTED,
    RELEASED,
    ContactLaw,
    next_phase,
    sample,
    static_depth,
    stored,
    touch,
)
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact

SPHERE = Sphere(0.02, 0.01)


def law_of(loss_tangent, speed, gravity, end="force", modulus=8e6):
    impact = solve_impact(SPHERE, Material(modulus, loss_tangent), speed, end)
    return ContactLaw(SPHERE.mass, gravity, impact.elastic, impact.viscous, end), impact


def phases_of(law, speed, most=200):
    found = [touch(law, speed)]
    while found[-1].next_kind != PARTED and len(found) < most:
        found.append(next_phase(found[-1]))
    return found


def by_scipy(law, speed):
    """Depth, speed, duration at the loss of force, and the speed where the overlap ends, by Radau-free integration in time."""

    def rate(_t, y):
        x = max(y[0], 0.0)
        force = max(0.0, law.elastic * x**1.5 + law.viscous * math.sqrt(x) * y[1])
        return [y[1], law.gravity - force / law.mass]

    def lost(_t, y):
        return law.elastic * max(y[0], 0.0) + law.viscous * y[1] if y[1] < 0.0 else 1.0

    lost.terminal, lost.direction = True, -1
    start = 1e-9  # s of free motion: the root in the force has no derivative at the touch
    return solve_ivp(rate, (start, 0.1), [speed * start, speed], method="DOP853", events=lost, rtol=1e-11, atol=1e-15)


@pytest.mark.parametrize(("loss_tangent", "speed", "gravity"), [(0.2, 2.0, 9.81), (0.05, 0.2, 9.81), (0.7, 2.0, 30.0)])
def test_duration_and_rebound_under_weight_are_those_of_a_slow_integration(loss_tangent, speed, gravity):
    law, _impact = law_of(loss_tangent, speed, gravity)
    slow, first = by_scipy(law, speed), touch(law, speed)
    assert first.next_kind == RELEASED
    assert first.duration == pytest.approx(slow.t_events[0][0], rel=2e-7)
    assert first.last_speed == pytest.approx(slow.y_events[0][0][1], rel=2e-7)
    assert first.last_depth == pytest.approx(slow.y_events[0][0][0], rel=2e-7)


def test_without_weight_it_is_the_free_impact():
    law, impact = law_of(0.2, 2.0, 0.0)
    first = touch(law, 2.0)
    assert first.duration == pytest.approx(impact.duration, rel=1e-13)
    assert -first.last_speed / 2.0 == pytest.approx(impact.restitution, rel=1e-13)
    assert first.turns.depth == pytest.approx(impact.depth, rel=1e-13)
    assert first.turns.peak_force == pytest.approx(impact.peak_force, rel=1e-13)
    times = numpy.linspace(0.0, impact.duration, 7)
    free = course(impact, times)
    depth, speed, _heat = sample(first, times)
    assert depth == pytest.approx(free.depth, rel=1e-11, abs=1e-16)
    assert speed == pytest.approx(free.speed, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("end", ["force", "gap"])
@pytest.mark.parametrize("loss_tangent", [0.0, 0.01, 0.2, 0.39])
@pytest.mark.parametrize("speed", [3.0, 0.08])
def test_energy_before_is_energy_after_and_heat(end, loss_tangent, speed):
    law, _impact = law_of(loss_tangent, speed, 9.81, end)
    found = phases_of(law, speed)
    heat = math.fsum(phase.heat for phase in found)
    last = found[-1]
    after = 0.5 * law.mass * last.last_speed**2 + stored(law, last.last_depth) - law.mass * 9.81 * last.last_depth
    assert heat + after == pytest.approx(0.5 * law.mass * speed**2, rel=1e-12)
    assert all(phase.heat >= -1e-18 for phase in found)


def test_a_slow_sphere_comes_to_rest_where_the_weight_holds_it():
    law, _impact = law_of(0.2, 0.005, 9.81)
    last = phases_of(law, 0.005, most=12)[-1]
    assert last.kind == LOADED
    assert last.next_kind == LOADED
    assert last.last_depth == pytest.approx(static_depth(law), rel=1e-9)
    assert static_depth(law) == pytest.approx((0.02 * 9.81 / law.elastic) ** (2 / 3), rel=1e-14)


def test_a_sphere_that_falls_back_into_the_overlap_is_caught_where_the_law_pushes_again():
    law, _impact = law_of(0.2, 0.02, 9.81)
    found = phases_of(law, 0.02, most=12)
    caught = [phase for phase in found if phase.kind == RELEASED and phase.next_kind == LOADED]
    for phase in caught:
        pushes = law.elastic * phase.last_depth + law.viscous * phase.last_speed
        assert phase.last_depth > 0.0
        assert pushes == pytest.approx(0.0, abs=1e-9 * law.elastic * phase.last_depth)
    assert found[-1].next_kind in (LOADED, PARTED)
