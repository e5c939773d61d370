"""Travelling impulses of asperities: cases worked by hand."""

from __future__ import annotations

import math

import numpy
import pytest

from contact_sim_pkg.rigs.vehicle.tire.asperity_impulses import (
    AsperityImpulses,
    asperity_density,
    asperity_force,
    default_asperities,
    make_asperities,
    site_count,
)

UP = math.pi / 2


def three_sites(raised_cosine: bool = False) -> AsperityImpulses:
    """Sites at 1, 2, 3 m pushing 10, 20 sin 30 deg = 10, 40 N; contact 1.5 m long."""
    return make_asperities(1.0, 1.5, numpy.array([10.0, 20.0, 40.0]), numpy.array([UP, math.pi / 6, UP]), raised_cosine)


@pytest.mark.parametrize(
    ("travel", "force"),
    [
        (0.2, 0.0),  # 0.8 m away
        (0.25, 0.0),  # on the border: not yet
        (0.26, 10.0),  # single contact
        (1.2, 10.0),
        (1.3, 20.0),  # two at once: 1 and 2
        (1.5, 20.0),
        (1.8, 10.0),  # site 1 left at 1.75
        (2.5, 50.0),
        (3.7, 40.0),
        (3.75, 0.0),
        (1e9, 0.0),
        (-1e9, 0.0),
    ],
)
def test_the_resultant_of_three_sites(travel: float, force: float) -> None:
    assert asperity_force(three_sites(), travel) == pytest.approx(force, rel=1e-14)


def test_the_raised_cosine_is_twice_the_force_in_the_middle_and_none_at_the_border() -> None:
    assert asperity_force(three_sites(True), 1.0) == pytest.approx(20.0)  # site 2 is 1 m away
    assert asperity_force(three_sites(True), 0.625) == pytest.approx(
        10.0
    )  # a quarter of the length away: 1 + cos(pi/2)
    assert asperity_force(three_sites(True), 0.25 + 1e-6) == pytest.approx(0.0, abs=1e-8)
    # both at 0.5 m: 1 + cos(2 pi / 3) = 1/2
    assert asperity_force(three_sites(True), 1.5) == pytest.approx(10.0)


@pytest.mark.parametrize("raised_cosine", [False, True])
def test_each_site_gives_its_impulse(raised_cosine: bool) -> None:
    """Integral of the force over the travel: (10 + 10 + 40) N times 1.5 m."""
    step = 1e-3
    travel = numpy.arange(-1.0, 5.0, step) + 0.5 * step
    total = sum(asperity_force(three_sites(raised_cosine), s) for s in travel) * step
    assert total == pytest.approx(90.0, rel=1e-9)


def test_the_line_density_holds_the_force_of_each_cell() -> None:
    density = numpy.full(4, 7.0)
    asperity_density(three_sites(), 2.5, 1.5, 0.5, density)  # cells from 1.5, 2.0, 2.5, 3.0 m
    assert density == pytest.approx([0.0, 20.0, 0.0, 80.0])
    assert density.sum() * 0.5 == pytest.approx(asperity_force(three_sites(), 2.5))
    asperity_density(three_sites(), 2.5, 2.5, 0.5, density)  # site 2 lies before the cells
    assert density == pytest.approx([0.0, 80.0, 0.0, 0.0])


def test_without_data_the_active_sites_carry_a_tenth_of_the_load() -> None:
    flat = default_asperities(4000.0, 0.01, 0.1, numpy.zeros(100))
    assert asperity_force(flat, 0.505) == pytest.approx(400.0)
    # Sites at 0.15 and 0.25 m lie on the border, also where 0.25 - 0.2 is rounded to less than 0.05: 9 of 40 N
    assert asperity_force(flat, 0.2) == pytest.approx(360.0)
    smooth = default_asperities(4000.0, 0.01, 0.1, numpy.zeros(100), raised_cosine=True)
    for travel in (0.3, 0.3021, 0.3077, 0.55):
        assert asperity_force(smooth, travel) == pytest.approx(400.0, rel=1e-12)
    steep = default_asperities(4000.0, 0.01, 0.1, numpy.full(100, 0.75))  # sin(pi/2 - atan 3/4) = 4/5
    assert asperity_force(steep, 0.505) == pytest.approx(320.0)


@pytest.mark.parametrize(("length", "spacing", "sites"), [(0.3, 0.1, 3), (1.0, 0.3, 3), (0.05, 0.1, 0), (0.7, 0.1, 7)])
def test_the_last_site_of_a_whole_number_counts(length: float, spacing: float, sites: int) -> None:
    assert site_count(length, spacing) == sites


def test_a_road_without_sites_pushes_nothing() -> None:
    assert asperity_force(make_asperities(1.0, 1.0, numpy.zeros(0), numpy.zeros(0)), 1.0) == 0.0


def test_an_unknown_place_gives_an_unknown_force() -> None:
    density = numpy.zeros(3)
    asperity_density(three_sites(), math.nan, 0.0, 1.0, density)
    assert math.isnan(asperity_force(three_sites(), math.nan))
    assert numpy.all(numpy.isnan(density))
    assert asperity_force(three_sites(), math.inf) == asperity_force(three_sites(), -math.inf) == 0.0


def test_impossible_input_is_refused() -> None:
    one = numpy.ones(1)
    with pytest.raises(ValueError, match="spacing"):
        make_asperities(0.0, 1.0, one, one)
    with pytest.raises(ValueError, match="contact length"):
        make_asperities(1.0, math.nan, one, one)
    with pytest.raises(ValueError, match="one row"):
        make_asperities(1.0, 1.0, one, numpy.ones(2))
    with pytest.raises(ValueError, match="site 2"):
        make_asperities(1.0, 1.0, numpy.array([1.0, math.inf]), numpy.ones(2))
    with pytest.raises(ValueError, match="above 0"):
        site_count(1.0, 0.0)
