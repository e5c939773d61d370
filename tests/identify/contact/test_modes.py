"""Friction and restitution of one contact: what its velocities and its impulse tell, and what they leave open."""

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from contact_sim_pkg.identify.contact.instant import REVERSED, SLIDE, STICK, classify
from contact_sim_pkg.identify.motion import geometry

FLAT = geometry.plane()
FRICTION, EFFORT = 0.3, 0.6


def mobility_of(random):
    """Velocity of a corner by its impulse: 1/m - [r] I0^-1 [r] of a slender body, symmetric and positive."""
    reach = numpy.array([*random.uniform(-0.1, 0.1, 2), -random.uniform(0.05, 0.15)])
    cross = numpy.cross(numpy.eye(3), reach)
    return numpy.eye(3) + cross.T @ numpy.diag(1.0 / random.uniform(1e-3, 8e-3, 3)) @ cross


def energetic_impact(mobility, before, planar):
    """Impulse of an impact whose slip obeys Coulomb at every instant and whose works restore e^2 (scipy, along c_n)."""
    kept = numpy.diag([1.0, 0.0, 1.0]) if planar else numpy.eye(3)

    def push(velocity):
        slip = velocity[:2]
        speed = numpy.hypot(*slip)
        return kept @ [*(-FRICTION * slip / speed), 1.0]

    def rate(_, state):
        return [*(kept @ mobility @ push(state)), *push(state), state[2]]

    def event(slope):
        def of(_, state):
            return slope(state)

        of.terminal, of.direction = True, 1.0
        return of

    def slow(_, state):
        return numpy.hypot(*state[:2]) - 1e-6

    slow.terminal = True
    state = numpy.array([*(kept @ before), 0.0, 0.0, 0.0, 0.0])
    pressed = solve_ivp(rate, (0, 50), state, "DOP853", rtol=1e-11, atol=1e-13, events=[event(lambda s: s[2]), slow])
    if pressed.t_events[1].size:
        return None
    state, work = pressed.y[:, -1], pressed.y[6, -1]
    ended = event(lambda s: s[6] - (1.0 - EFFORT**2) * work)
    opened = solve_ivp(rate, (0, 50), state, "DOP853", rtol=1e-11, atol=1e-13, events=[ended, slow])
    return None if opened.t_events[1].size else (opened.y[3:6, -1], opened.y[:3, -1])


def test_in_space_a_slip_that_turns_on_its_way_leaves_a_bound_and_not_mu():
    random, turned = numpy.random.default_rng(1), 0
    for _ in range(30):
        before = numpy.array([*random.uniform(-2.0, 2.0, 2), -random.uniform(0.5, 1.0)])
        found = energetic_impact(mobility_of(random), before, planar=False)
        if found is None:  # the slip ends on the way
            continue
        impulse, after = found
        mode = classify(impulse, before, after, 1e-9, FLAT, 1e-9)
        assert mode.friction_at_least <= FRICTION * (1.0 + 1e-9)
        if mode.friction is None:
            turned += 1
        else:
            assert mode.friction == pytest.approx(FRICTION, rel=1e-6)
    assert turned >= 5


def test_in_the_plane_an_energetic_slide_that_keeps_its_direction_gives_mu():
    random, decided = numpy.random.default_rng(2), 0
    for _ in range(20):
        before = numpy.array([random.uniform(-2.0, 2.0), 0.0, -random.uniform(0.5, 1.0)])
        found = energetic_impact(numpy.diag([3.0, 1.0, 1.0]) + 0.5 * mobility_of(random), before, planar=True)
        if found is None:
            continue
        mode = classify(found[0], before, found[1], 1e-9, FLAT, 1e-9)
        if mode.mode == SLIDE:
            decided += 1
            assert mode.friction == pytest.approx(FRICTION, rel=1e-9)
    assert decided >= 5


def test_a_reversed_slip_gives_no_friction_but_a_bound():
    """Friction 0.3 over the first 0.7 of c_n one way, over the last 0.3 the other way: |c_t|/c_n = 0.12."""
    mode = classify(
        numpy.array([-0.12, 0.0, 1.0]), numpy.array([0.5, 0, -1.0]), numpy.array([-0.2, 0, 0.5]), 1e-9, FLAT
    )
    assert mode.mode == REVERSED
    assert mode.friction is None
    assert mode.friction_at_least == pytest.approx(0.12)


def test_a_sticking_contact_bounds_friction_and_the_restitution_is_that_of_normal_speeds():
    mode = classify(numpy.array([-0.2, 0.0, 1.6]), numpy.array([0.5, 0, -1.0]), numpy.array([0.0, 0, 0.6]), 1e-9, FLAT)
    assert (mode.mode, mode.friction, mode.newton_restitution) == (STICK, None, 0.6)
    assert mode.friction_at_least == pytest.approx(0.125)


def test_an_impulse_along_the_slip_is_no_friction():
    mode = classify(numpy.array([0.3, 0.0, 1.0]), numpy.array([0.5, 0, -1.0]), numpy.array([0.4, 0, 0.6]), 1e-9, FLAT)
    assert (mode.mode, mode.friction) == (SLIDE, None)


def test_a_frictionless_slide_has_friction_zero():
    mode = classify(numpy.array([0.0, 0.0, 1.0]), numpy.array([0.5, 0, -1.0]), numpy.array([0.5, 0, 0.6]), 1e-9, FLAT)
    assert mode.friction == 0.0


@given(st.floats(-0.02, 0.02), st.floats(1e-4, 1e-2))
def test_a_turn_within_the_noise_does_not_hide_friction(turn, noise):
    """Friction against the slip before; the slip after is off by `turn` rad, three times less than its noise allows."""
    slip = 0.5 * numpy.array([numpy.cos(turn), numpy.sin(turn), 0.0])
    push = numpy.array([-0.3, 0.0, 1.0])
    mode = classify(push, slip - geometry.UP, slip + 0.5 * geometry.UP, noise, FLAT)
    within_noise = abs(turn) <= 3.0 * noise / 0.5
    assert (mode.friction is not None) == within_noise or abs(abs(turn) - 6.0 * noise) < 1e-3 * abs(turn)
