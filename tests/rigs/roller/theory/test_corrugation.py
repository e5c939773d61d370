"""Waves that grow on the track, or die out."""

import math
from types import SimpleNamespace

import numpy
import pytest
from tests.rigs.roller.theory.test_heave import CELLS, HEAVE, TURN

from contact_sim_pkg.rigs.roller.theory.corrugation import growth_of_wave, make_track, moving_mean, run_intervals, wear
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.heave import natural_frequency
from contact_sim_pkg.rigs.roller.wear import BodyTrack, hardness_round, track_under

APPROACH, WIDTH = 4.011056e-6, 2 * 1.168e-4
LOADS = numpy.linspace(0.0, 400.0, 4001)


def track(gain, shares=None, turn=TURN, width=WIDTH):
    table = (LOADS, (LOADS / 100.0) ** 3 if shares is None else shares)
    return make_track(0.005, turn, CELLS, width, gain, APPROACH, table)


def growth(waves, gain=5e-3, turn=TURN, turns=200, width=WIDTH):
    """Measured a turn, of a wave of 0.1 nm, after the heave has settled."""
    heights = 1e-10 * numpy.cos(2.0 * math.pi * waves * numpy.arange(CELLS) / CELLS)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    run_intervals(HEAVE, track(0.0, turn=turn, width=width), 1, 200, heights, state, loads, numpy.zeros((CELLS, 2)))
    first = abs(numpy.fft.rfft(heights)[waves])
    run_intervals(HEAVE, track(gain, turn=turn, width=width), 1, turns, heights, state, loads, numpy.zeros((CELLS, 2)))
    return math.log(abs(numpy.fft.rfft(heights)[waves]) / first) / turns


@pytest.mark.parametrize(("waves", "sheet"), [(1, 0.00020), (2, 0.00264), (3, -0.00183)])
def test_small_waves_grow_as_the_theory_says(waves, sheet):
    """Sheet of the paper: share (F/F_N)^3, gain 5e-3, 200 turns a second."""
    theory = growth_of_wave(HEAVE, track(5e-3), waves, 3.0, CELLS)
    assert theory == pytest.approx(sheet, abs=1e-5)
    assert growth(waves) == pytest.approx(theory, rel=0.01)


@pytest.mark.parametrize("share", [0.95, 1.05])
def test_a_wave_grows_if_it_is_slower_than_the_natural_frequency(share):
    """Omega < kappa sqrt(1 - 4 zeta^2)."""
    omega = share * natural_frequency(HEAVE) * math.sqrt(1.0 - 4.0 * 0.05**2)
    turn = 2.0 * math.pi * 2 / omega
    assert (growth_of_wave(HEAVE, track(5e-3, turn=turn), 2, 3.0, CELLS) > 0.0) is (share < 1.0)
    assert (growth(2, turn=turn) > 0.0) is (share < 1.0)


def mean_of_straight_segments(heights, place, width):
    """By the trapezoidal rule over all bends of the track between both ends."""
    low, high = place - 0.5 * width, place + 0.5 * width
    places = numpy.unique([low, *range(math.ceil(low), math.floor(high) + 1), high])
    values = numpy.interp(places, numpy.arange(-40, 100), numpy.take(heights, numpy.arange(-40, 100), mode="wrap"))
    return numpy.trapezoid(values, places) / width


@pytest.mark.parametrize("width", [0.3, 1.0, 1.9, 2.0, 2.1, 7.0, 21.5, 60.0])
def test_the_moving_mean_is_the_mean_over_the_length_whole_cells_or_not(width):
    heights, out = numpy.random.default_rng(3).standard_normal(60), numpy.empty(61)
    moving_mean(heights, width, out)
    wanted = [mean_of_straight_segments(heights, place, width) for place in range(60)]
    assert out[:60] == pytest.approx(wanted, abs=1e-13)
    assert out[60] == out[0]


def test_a_contact_without_length_takes_the_height_itself():
    heights, out = numpy.random.default_rng(3).standard_normal(60), numpy.empty(60)
    moving_mean(heights, 0.0, out)
    assert (out == heights).all()


@pytest.mark.parametrize("cells", [256, 268, 300, 1024])
def test_the_mean_of_a_wave_does_not_hang_on_the_cells(cells):
    """Wave of 20 under a contact of 0.2337 mm: `sin(x) / x` at half the contact, 0.963; the cells take about phase^2 / 12 more."""
    length, turn = 2.337e-4, 2.0 * math.pi * 0.005
    half = math.pi * 20 * length / turn
    out, wave = numpy.empty(cells), numpy.cos(2.0 * math.pi * 20 * numpy.arange(cells) / cells)
    moving_mean(wave, length / (turn / cells), out)
    assert out[0] == pytest.approx(math.sin(half) / half, abs=(2.0 * math.pi * 20 / cells) ** 2 / 10.0)


def test_the_moving_mean_takes_its_part_of_the_growth():
    """Over 21.5 cells the wave of 6 grows by its mean, here by the trapezoidal rule, less; in the ride as in the closed form."""
    wide = 21.5 * 2.0 * math.pi * 0.005 / CELLS
    theory = growth_of_wave(HEAVE, track(5e-3, width=wide, turn=6 * TURN), 6, 3.0, CELLS)
    narrow = growth_of_wave(HEAVE, track(5e-3, width=0.0, turn=6 * TURN), 6, 3.0, CELLS)
    places = numpy.array([-10.75, *range(-10, 11), 10.75])
    ends = numpy.interp([10.75], [10, 11], numpy.cos(2.0 * math.pi * 6 / CELLS * numpy.array([10.0, 11.0])))
    values = numpy.array([ends[0], *numpy.cos(2.0 * math.pi * 6 / CELLS * places[1:-1]), ends[0]])
    assert theory / narrow == pytest.approx(numpy.trapezoid(values, places) / 21.5, rel=1e-12)
    assert growth(6, width=wide, turn=6 * TURN) == pytest.approx(theory, rel=0.02)


def test_without_gain_the_track_stays_as_it_is():
    heights = 1e-6 * numpy.random.default_rng(1).standard_normal(CELLS)
    before, state, loads = heights.copy(), numpy.zeros(2), numpy.zeros(CELLS)
    found = run_intervals(HEAVE, track(0.0), 1, 20, heights, state, loads, numpy.zeros((CELLS, 2)))
    assert (heights == before).all()
    assert found.lowered == 0.0


def test_a_share_that_is_even_lowers_the_whole_track_and_is_reported_separately():
    heights, state, loads = numpy.zeros(CELLS), numpy.zeros(2), numpy.zeros(CELLS)
    found = run_intervals(
        HEAVE, track(0.05, numpy.full(4001, 0.5)), 3, 10, heights, state, loads, numpy.zeros((CELLS, 2))
    )
    assert abs(heights).max() < 1e-20
    assert found.lowered == pytest.approx(0.05 * APPROACH * 30 * 0.5)


def test_the_wave_saturates_where_the_roller_leaves_the_track():
    heights = 1e-9 * numpy.random.default_rng(4).standard_normal(CELLS)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    found = run_intervals(HEAVE, track(2e-2), 1, 3000, heights, state, loads, numpy.zeros((CELLS, 2)))
    assert found.free > 0.0
    assert found.lowest_load == 0.0
    assert 1e-6 < found.range < 1e-4
    assert not found.ended


def test_a_track_that_is_used_up_ends_the_run():
    heights, state, loads = numpy.zeros(CELLS), numpy.zeros(2), numpy.zeros(CELLS)
    heights[0] = 0.2 * 0.005
    assert run_intervals(HEAVE, track(1e-3), 1, 5, heights, state, loads, numpy.zeros((CELLS, 2))).ended


def test_a_table_that_does_not_rise_is_refused():
    with pytest.raises(ValueError, match="rise from 0 N"):
        make_track(0.005, TURN, CELLS, WIDTH, 0.1, APPROACH, (numpy.array([1.0, 2.0]), numpy.array([0.0, 1.0])))
    with pytest.raises(ValueError, match="at least 8"):
        make_track(0.005, TURN, 4, WIDTH, 0.1, APPROACH, (LOADS, LOADS))


def test_a_harder_cell_wears_as_a_body_with_higher_limits():
    """By dangerous volumes with all limits twice as high, under 100 N and 200 N."""
    from tests.rigs.roller.bench import CURVATURES, MODULUS

    from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
    from contact_sim_pkg.rigs.roller.theory.volumes import dangerous_volumes

    def volume(load, hardness):
        contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, load)
        limits = (2.6e8 * hardness, 1.5e8 * hardness)
        return dangerous_volumes(contact, 0.3, limits, (12, 12, 10)).any / 1e-12

    loads = numpy.array([0.0, 12.5, 25.0, 100.0, 200.0])
    shares = numpy.array([0.0, *(volume(load, 1.0) for load in loads[1:])])
    hardness = numpy.where(numpy.arange(CELLS) < 128, 1.0, 2.0)
    hard = make_track(0.005, TURN, CELLS, WIDTH, 1.0, 1.0, (loads, shares), hardness)
    for load in (100.0, 200.0):
        heights = numpy.zeros(CELLS)
        lowered = wear(hard, 1.0, numpy.full(CELLS, load), heights).lowered
        assert lowered - heights[0] == pytest.approx(volume(load, 1.0))
        assert lowered - heights[-1] == pytest.approx(volume(load, 2.0))
    with pytest.raises(ValueError, match=r"hardness: shape \(3,\), \[256\] is needed"):
        make_track(0.005, TURN, CELLS, WIDTH, 1.0, 1.0, (loads, shares), numpy.ones(3))


def test_a_track_lies_under_the_whole_length_of_the_contact_with_its_own_hardness():
    """Semi-axes and hardness that differ: the length is twice the semi-axis along the track."""
    hardness = numpy.linspace(0.8, 1.3, 24)
    table = (numpy.array([0.0, 50.0, 90.0]), numpy.array([0.0, 0.1, 0.4]))
    body = BodyTrack(
        "shaft", 0.007, 0.031, 3, numpy.zeros(24), hardness, table, track(0.0), numpy.zeros(24), numpy.zeros(0)
    )
    found = track_under(body, RollingContact(3.1e-4, 1.7e-4, 0.1, 1e9, 5e-6, 70.0), 0.37)
    assert found.contact_cells == pytest.approx(3.4e-4 * 24 / (2.0 * math.pi * 0.007), rel=1e-12)
    assert (found.turn_time, found.gain, found.approach) == (0.031, 0.37, 5e-6)
    assert found.hardness.tolist() == hardness.tolist()
    assert (found.table_loads.tolist(), found.table_shares.tolist()) == ([0.0, 50.0, 90.0], [0.0, 0.1, 0.4])


@pytest.mark.parametrize("body", ["shaft", "roller"])
def test_the_hardness_goes_on_from_the_last_place_to_the_first(body):
    given = {"shaft": [1.0, 1.4, 0.8], "roller": [1.1, 0.7]}
    damage = SimpleNamespace(hardness=given["shaft"], roller_hardness=given["roller"])
    places = len(given[body])
    expected = numpy.interp(numpy.arange(30) / 30 * places, range(places), given[body], period=places)
    assert hardness_round(damage, body, 30) == pytest.approx(expected, rel=1e-12)
    assert expected[-1] != pytest.approx(given[body][-1], rel=0.02)
    assert hardness_round(None, body, 4).tolist() == [1.0] * 4
