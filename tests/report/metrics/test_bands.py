"""Bands are chosen by what a run is, and no run gets one that was published for another."""

import math

import pytest

from contact_sim_pkg.records.metric import GOOD, MET, NO_BAND, OUTSIDE, USUAL, Band, judged
from contact_sim_pkg.report.metrics.bands import band_of, published_range
from contact_sim_pkg.report.metrics.maker import Maker, conditions_of, near


def test_a_band_holds_where_its_conditions_are_met():
    met = band_of("tire_stiffness", {"load_kN": 4.0, "inflation_kPa": 220.0})
    assert (met.band.low, met.band.high) == (180.0, 250.0)
    assert published_range("tire_stiffness") == (180.0, 250.0)


@pytest.mark.parametrize("run", [{}, {"load_kN": 4.0}, {"load_kN": 6.0, "inflation_kPa": 220.0}])
def test_elsewhere_it_is_named_and_not_applied(run):
    found = band_of("tire_stiffness", run)
    assert found.band is None
    assert found.reason == "no band here: published for about 4 kN at 200 to 240 kPa"


def test_a_run_on_another_speed_sees_the_bands_of_its_own_road():
    found = band_of("dynamic_load", {"road": "class C", "speed_m_s": 15.0})
    assert found.reason == "no band here: published for class C at 10 m/s, class C at 20 m/s, class C at 30 m/s"
    assert band_of("dynamic_load", {"road": "class C", "speed_m_s": 20.0}).band.holds(0.239)


def test_a_quantity_of_which_nothing_is_published_has_no_band():
    assert band_of("unheard_of", {}) == (None, "no band", ())


@pytest.mark.parametrize(
    ("value", "words"),
    [(0.2, "not uncomfortable"), (0.55, "a little uncomfortable to fairly uncomfortable"), (3.0, "extremely uncomfortable")],
)  # fmt: skip
def test_the_words_of_comfort_overlap_as_those_of_the_standard(value, words):
    assert band_of("weighted_rms", {}).word(value) == words


def test_verdicts():
    usual, limit = Band(1.0, 2.0, "usual", ""), Band(-math.inf, 2.0, "limit", "")
    assert [judged(value, usual) for value in (0.9, 1.0, 2.0, 2.1)] == [OUTSIDE, USUAL, USUAL, OUTSIDE]
    assert [judged(value, limit) for value in (-5.0, 2.1, math.nan)] == [GOOD, OUTSIDE, NO_BAND]
    assert judged(1.0, None) == NO_BAND
    assert judged(102.0, near(100.0, 0.05, "")) == MET


def test_a_difference_of_large_terms_is_judged_by_their_scale():
    assert judged(7.5e-14, near(0.0, 0.01, "", scale=10.0)) == MET
    assert judged(2e-8, near(0.0, 0.01, "", scale=10.0)) == OUTSIDE


def test_seat_isolates_below_100_per_cent_and_has_no_usual_band():
    make = Maker("seat", "bench/motion", (0.0, 60.0)).make
    below, above = (make("factor", "SEAT", value, "%", quantity="seat_factor") for value in (57.0, 131.0))
    assert (below.verdict, below.remark) == (GOOD, "isolates")
    assert (above.verdict, above.remark) == (OUTSIDE, "amplifies")


def test_conditions_come_from_the_road_of_the_scene():
    assert conditions_of({"road": {"kind": "iso8608", "roughness_class": "C"}}) == {"road": "class C"}
    assert conditions_of({"road": {"kind": "flat"}}) == {"road": "flat"}
    assert conditions_of({}) == {}
