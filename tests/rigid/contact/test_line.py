"""The part of a line within a friction cone, against a search by scipy along the line."""

import math

import numpy
import pytest
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from contact_sim_pkg.rigid.contact.line import contact_arm, reach_in_cone


def rows_of(axes, arm):
    """Rows of a contact with ``axes`` in its rows at ``arm``."""
    return numpy.hstack([axes, numpy.cross(arm, axes)])


@pytest.mark.parametrize("seed", range(6))
def test_the_arm_of_a_contact_is_found_in_its_rows(seed):
    axes = Rotation.random(random_state=seed).as_matrix()
    arm = numpy.random.default_rng(seed).normal(size=3)
    assert contact_arm(rows_of(axes, arm), 0) == pytest.approx(arm, abs=1e-15)


@pytest.mark.parametrize("seed", range(200))
def test_a_force_reaches_the_edge_of_its_cone_at_both_ends(seed):
    random = numpy.random.default_rng(seed)
    J = rows_of(Rotation.random(random_state=seed).as_matrix(), random.normal(size=3))
    force, friction = numpy.array([1.0, *random.normal(size=2)]), random.uniform(0.1, 2.0)
    line = random.normal(size=3)
    line /= numpy.linalg.norm(line)
    gain = J[:, :3] @ line

    def inside(way):
        moved = force + way * gain
        return friction * moved[0] - math.hypot(moved[1], moved[2])

    room, low, high = reach_in_cone(J, force, friction, 0, *line)
    if friction * abs(gain[0]) >= math.hypot(gain[1], gain[2]):
        end, other = (low, high) if gain[0] > 0.0 else (high, low)
        assert (room, other) == (math.inf, math.copysign(math.inf, gain[0]))
        scale = 1.0 + abs(end)
        assert abs(inside(end)) <= 1e-12 * scale**2
        assert (
            inside(end + math.copysign(1e-3 * scale, gain[0]))
            > 0.0
            > inside(end - math.copysign(1e-3 * scale, gain[0]))
        )
        return
    best = minimize_scalar(lambda way: -inside(way), bracket=(-1.0, 1.0), options={"xtol": 1e-12})
    assert room == pytest.approx(-best.fun, abs=1e-9)
    assert math.isnan(low) == (room < 0.0)
    if room >= 0.0:
        scale = 1.0 + max(abs(low), abs(high))
        assert max(abs(inside(low)), abs(inside(high))) <= 1e-12 * scale
        assert low <= best.x + 1e-5 * scale
        assert best.x <= high + 1e-5 * scale
