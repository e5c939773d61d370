"""Friction of a point that may slide in any direction."""

import math

from hypothesis import example, given
from hypothesis import strategies as st

from contact_sim_pkg.laws.friction import STICK, friction_force
from contact_sim_pkg.laws.parameters import Friction
from contact_sim_pkg.laws.point_friction import point_friction, point_stick_event

LAW = Friction(2e4, 30.0, 0.4, 0.4)
component = st.floats(-1.0, 1.0)


def test_a_point_that_sticks_pulls_as_the_friction_of_one_direction_does():
    force = point_friction(LAW, 50.0, 3e-4, 0.0, 0.1, 0.0)
    assert force == (friction_force(LAW, STICK, 50.0, 3e-4, 0.1), 0.0, 0.1, 0.0)
    assert point_stick_event(LAW, 50.0, 3e-4, 0.0, 0.1, 0.0) == 0.4 * 50.0 - (2e4 * 3e-4 + 30.0 * 0.1)


def test_in_steady_slip_the_force_is_the_limit_along_the_slip_and_the_spring_stands():
    v_1, v_2, limit = 3.0, 4.0, 0.4 * 10.0
    s_1, s_2 = limit * 0.6 / LAW.stiffness, limit * 0.8 / LAW.stiffness
    found = point_friction(LAW, 10.0, s_1, s_2, v_1, v_2)
    assert max(abs(a - b) for a, b in zip(found, (0.6 * limit, 0.8 * limit, 0.0, 0.0), strict=True)) < 1e-12


@given(st.floats(0.0, 100.0), component, component, component, component)
@example(6.7005661984150906e-161, 6.7005661984150906e-161, 0.0, 0.0, 0.0)
def test_the_force_stays_in_the_cone_and_never_gives_energy(normal, s_1, s_2, v_1, v_2):
    deflection = (1e-2 * s_1, 1e-2 * s_2)
    f_1, f_2, rate_1, rate_2 = point_friction(LAW, normal, *deflection, v_1, v_2)
    assert math.hypot(f_1, f_2) <= 0.4 * normal * (1.0 + 1e-14) + 1e-300  # below it numbers lose digits
    spring = LAW.stiffness * (deflection[0] * rate_1 + deflection[1] * rate_2)
    assert f_1 * v_1 + f_2 * v_2 - spring >= -1e-9


def test_stick_and_slip_meet_without_a_jump():
    below, above = (
        point_friction(LAW, normal, 1e-4, 2e-4, 0.05, 0.0)
        for normal in (math.hypot(3.5, 4.0) / 0.4 * (1.0 + d) for d in (1e-9, -1e-9))
    )
    assert max(abs(a - b) for a, b in zip(below, above, strict=True)) < 1e-7
    assert point_stick_event(LAW, math.hypot(3.5, 4.0) / 0.4 * (1.0 + 1e-9), 1e-4, 2e-4, 0.05, 0.0) > 0.0


def test_without_a_normal_force_the_spring_runs_back_by_itself():
    assert point_friction(LAW, 0.0, 1e-3, 0.0, 5.0, 0.0) == (0.0, 0.0, -2e4 * 1e-3 / 30.0, 0.0)
