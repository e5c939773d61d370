"""Samples with few decimals: the error of a spin that is constant in a flight is the same in all of its samples."""

import numpy
import pytest
from tests.identify import motions

from contact_sim_pkg.identify.contact.noise import shared_rounding
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.states import BodyStates

STEP = 1e-3
ROUNDING = STEP / numpy.sqrt(12.0)
DRAWS = 20


def slowed(states, factor):
    """The same motion under gravity over factor^2: another one that is exact, whose speeds round otherwise."""
    return BodyStates(
        factor * states.time,
        states.position,
        states.rotation,
        states.velocity / factor,
        states.angular_velocity / factor,
    )


def rounded(states, decimals):
    fields = (states.position, states.velocity, states.angular_velocity)
    position, velocity, spin = (numpy.round(field, decimals) for field in fields)
    return BodyStates(states.time, position, states.rotation, velocity, spin)


@pytest.mark.parametrize("decimals", [3, 4, 5, 6])
def test_the_deviation_of_rounded_samples_is_that_of_their_rounding(decimals):
    """20 motions; of their root mean square four of its own deviations, 4 / sqrt(40). It was 2.5 to 4.2."""
    exact, off = motions.states_of(motions.planar()), []
    for factor in numpy.random.default_rng(decimals).uniform(0.8, 1.25, DRAWS):
        states = rounded(slowed(exact, factor), decimals)
        found = identify(states, Setup(geometry.box([motions.SIDE] * 3), gravity=9.81 / factor**2))
        inertia = found.parameters[0]
        assert inertia.identified
        assert found.warnings == []
        off.append((inertia.value - motions.SIDE**2 / 6.0) / inertia.deviation)
    assert 0.4 < numpy.sqrt(numpy.mean(numpy.square(off))) < 1.0 + 4.0 / numpy.sqrt(2.0 * DRAWS)
    assert max(numpy.abs(off)) < 4.5


@pytest.mark.parametrize(
    ("rate", "alike"),
    [(0.0, True), (1000.0 * STEP, True), (1000.0 * STEP * numpy.sqrt(2.0), False)],
    ids=["constant", "whole steps", "other steps"],
)
def test_errors_of_rounding_that_all_samples_share_do_not_average_out(rate, alike):
    """Root mean square error of the mean of 100 samples over 400 lines of one slope, beside what is told of it."""
    time, count, draws = numpy.arange(100) * 1e-3, 100, 400
    lines = numpy.random.default_rng(0).uniform(size=draws) + rate * time[:, None]
    values = STEP * numpy.round(lines / STEP)
    error = float(numpy.sqrt(numpy.mean((values - lines).mean(axis=0) ** 2)))
    told = shared_rounding(values, ROUNDING) / numpy.sqrt(count)
    assert 0.9 * error < told.min()
    assert told.max() < (1.1 * error if alike else 0.12 * ROUNDING)


def test_exact_samples_share_no_rounding():
    assert not shared_rounding(numpy.random.default_rng(0).normal(size=(10, 3)), 0.0).any()


@pytest.mark.parametrize(
    "channels", [("position",), ("position", "velocity", "angular_velocity")], ids=["one", "three"]
)
def test_rough_samples_beside_exact_rotations_tell_all_of_the_inertia(channels):
    """In space, 10 motions. Of rounded positions alone it was 4000 deviations off; of three channels its size was not told.

    Up to 1e-8 of it may be left by the roots of gaps, which are taken as linear in the errors of positions: 0.3 mm.
    """
    exact = motions.states_of(motions.spatial())
    truth = [*numpy.diag(motions.SPATIAL_INERTIA), 0.0, 0.0, 0.0]
    for factor in numpy.random.default_rng(0).uniform(0.8, 1.25, 10):
        slow = slowed(exact, factor)
        states = slow._replace(**{name: numpy.round(getattr(slow, name), 3) for name in channels})
        found = identify(states, Setup(geometry.box(motions.LENGTHS), gravity=9.81 / factor**2))
        assert found.rank == 6
        assert found.warnings == []
        for each, value in zip(found.parameters, truth, strict=True):
            assert abs(each.value - value) < max(4.5 * each.deviation, 1e-8 * numpy.trace(motions.SPATIAL_INERTIA))


def test_spins_of_three_flights_are_seen_to_be_rounded():
    states = motions.states_of(motions.planar(), 0.55)
    spin = numpy.round(states.angular_velocity, 2)
    assert len(numpy.unique(spin[:, 1])) == 3
    found = identify(states._replace(angular_velocity=spin), Setup(geometry.box([motions.SIDE] * 3)))
    assert abs(found.parameters[0].value - motions.SIDE**2 / 6.0) < 4.5 * found.parameters[0].deviation
    assert found.warnings == []
