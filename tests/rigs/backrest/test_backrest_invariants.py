"""What must hold of a back on its seat back, however it is shaken and slid."""

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.rigs.backrest.backrest_runs import GRAVITY, driven, one_mass, sine

from contact_sim_lab.laws.one_mass import runs as free
from contact_sim_pkg.laws.parameters import FoamElastic, Friction, GeneralDissipative, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.backrest import entries as columns

TOLERANCE = 1e-8
shaking = st.tuples(st.floats(0.0, 8.0), st.floats(3.0, 8.0))  # [g], [Hz]
losses = st.floats(0.0, 20.0)  # [s/m]
rubbing = st.floats(0.01, 2.0)
sliding = st.floats(0.0, 0.03)  # [m]


def shaken(at, loss, mu, slide):
    rig = one_mass(loss=NormalDissipative(loss), friction=Friction(3.19e4, 619.0, mu, mu), amplitude=slide)
    return driven(rig, sine(at[0] * GRAVITY, at[1]), 0.8, TOLERANCE)


@pytest.mark.fault("D9")
@settings(max_examples=15)
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


@settings(max_examples=8)
@given(at=shaking, loss=losses)
def test_without_friction_what_is_lost_never_comes_back(at, loss):
    """The loss of Hunt and Crossley is positive both ways; a force that is clipped at zero leaves its spring's energy behind."""
    lost = driven(one_mass(loss=NormalDissipative(loss)), sine(at[0] * GRAVITY, at[1]), 0.8, TOLERANCE).states[:, -1]
    assert numpy.diff(lost).min() >= -1e2 * TOLERANCE * max(lost[-1], 1.0)


@settings(max_examples=5)
@given(at=shaking, mu=rubbing)
def test_the_same_shaking_gives_the_same_bits(at, mu):
    one, other = (shaken(at, 2.0, mu, 0.01) for _ in range(2))
    assert one.states.tobytes() == other.states.tobytes()
    assert one.points.tobytes() == other.points.tobytes()


@settings(max_examples=10)
@given(
    at=st.tuples(st.floats(0.0, 1.5), st.floats(3.0, 8.0)),
    loss=losses,
    low=st.floats(-6.0, -3.0),
    high=st.floats(-9.0, -6.0),
)
def test_two_accuracies_differ_by_no_more_than_both_report(at, loss, low, high):
    """Above 1.5 g slaps double their period and any error grows; below, ten times the tolerance is what the study finds."""
    coarse, fine = (
        driven(one_mass(loss=NormalDissipative(loss)), sine(at[0] * GRAVITY, at[1]), 0.8, 10.0**power)
        for power in (low, high)
    )
    motion = [each.states[:, 0] for each in (coarse, fine)]
    assert numpy.abs(motion[0] - motion[1]).max() <= 10.0 * (10.0**low + 10.0**high) * 0.015


@settings(max_examples=10)
@given(at=shaking, foam=st.booleans(), exponent=st.floats(0.0, 1.5), rate=st.floats(1.0, 2.0))
def test_foam_and_the_general_law_close_the_energy_too(at, foam, exponent, rate):
    elastic = FoamElastic(0.05, 0.08, 3.0e4, 5.0e3, 1.0e3, 3.0) if foam else NormalElastic(2.457e5, 1.5)
    rig = one_mass(elastic, GeneralDissipative(400.0, exponent, rate, 0.0, 0.0))
    found = driven(rig, sine(at[0] * GRAVITY, at[1]), 0.8, TOLERANCE)
    assert (found.forces[:, columns.NORMAL] >= 0.0).all()
    lost = found.states[:, -1]
    turned_over = numpy.abs(numpy.diff(found.states[:, -2])).sum() + lost[-1] - lost[0]
    assert abs(found.residual) <= 1e2 * TOLERANCE * max(turned_over, 45.6 * GRAVITY * 0.015)


def restitution(mass, law, speed, product):
    """Of a free impact with the damping `product` / `speed`, from event to event."""
    depth = (0.5 * mass * speed**2 * (law.exponent + 1.0) / law.coefficient) ** (1.0 / (law.exponent + 1.0))
    rig = free.free_impact(mass, law, product / speed)
    end = free.impact_speeds(rig, speed, depth, 1e-10, 0.1 * depth, 12.0 * depth / speed * (1.0 + product))
    assert end.states[-1, 0] > 0.0, "the impact is over"
    return end.states[-1, 1] / speed


@settings(max_examples=15)
@given(
    mass=st.floats(1e-3, 1e3), coefficient=st.floats(1e3, 1e10), exponent=st.floats(1.0, 2.5), speed=st.floats(1e-3, 10.0),
    products=st.lists(st.floats(0.01, 3.0), min_size=2, max_size=4, unique=True),
)  # fmt: skip
def test_restitution_depends_on_damping_times_speed_alone_and_falls_with_it(
    mass, coefficient, exponent, speed, products
):
    ascending = sorted(products)
    found = [restitution(mass, NormalElastic(coefficient, exponent), speed, each) for each in ascending]
    assert found == [
        pytest.approx(restitution(1.0, NormalElastic(1e6, 1.5), 1.0, each), rel=1e-8) for each in ascending
    ]
    for less, more, before, after in zip(ascending, ascending[1:], found, found[1:], strict=False):
        assert before > after or more - less < 1e-6
