"""What must hold of a back on its seat back, however it is shaken and slid (SEEDS 13: 1, 2 and 14)."""

import numpy
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.core.parameters import Friction, NormalDissipative
from contact_sim_pkg.core.rigs import backrest_entries as columns

from ..core.rigs.backrest_runs import GRAVITY, driven, one_mass, sine

TOLERANCE = 1e-8
shaking = st.tuples(st.floats(0.0, 8.0), st.floats(3.0, 8.0))  # [g], [Hz]
losses = st.floats(0.0, 20.0)  # [s/m]
rubbing = st.floats(0.01, 2.0)
sliding = st.floats(0.0, 0.03)  # [m]


def shaken(at, loss, mu, slide):
    rig = one_mass(loss=NormalDissipative(loss), friction=Friction(3.19e4, 619.0, mu, mu), amplitude=slide)
    return driven(rig, sine(at[0] * GRAVITY, at[1]), 0.8, TOLERANCE)


@settings(max_examples=15, deadline=None)
@given(at=shaking, loss=losses, mu=rubbing, slide=sliding)
def test_force_never_pulls_friction_keeps_its_limit_and_the_energy_closes(at, loss, mu, slide):
    found = shaken(at, loss, mu, slide)
    point = found.points[:, 0]
    normal = point[:, columns.POINT_NORMAL]
    assert (normal >= 0.0).all()
    assert (normal[point[:, columns.POINT_APPROACH] <= 0.0] == 0.0).all()
    excess = numpy.abs(point[:, columns.POINT_TANGENTIAL]) - mu * normal
    assert excess.max() <= 1e-6 * mu * max(normal.max(), 1.0)
    lost = found.states[:, -1]
    turned_over = numpy.abs(numpy.diff(found.states[:, -2])).sum() + lost[-1] - lost[0]
    assert abs(found.residual) <= 1e2 * TOLERANCE * max(turned_over, 45.6 * GRAVITY * 0.015)


@settings(max_examples=8, deadline=None)
@given(at=shaking, loss=losses)
def test_without_friction_what_is_lost_never_comes_back(at, loss):
    """The loss of Hunt and Crossley is positive both ways; a force that is clipped at zero leaves its spring's energy behind."""
    lost = driven(one_mass(loss=NormalDissipative(loss)), sine(at[0] * GRAVITY, at[1]), 0.8, TOLERANCE).states[:, -1]
    assert numpy.diff(lost).min() >= -1e2 * TOLERANCE * max(lost[-1], 1.0)


@settings(max_examples=5, deadline=None)
@given(at=shaking, mu=rubbing)
def test_the_same_shaking_gives_the_same_bits(at, mu):
    one, other = (shaken(at, 2.0, mu, 0.01) for _ in range(2))
    assert one.states.tobytes() == other.states.tobytes()
    assert one.points.tobytes() == other.points.tobytes()
