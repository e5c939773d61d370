"""What is warned of before the numbers of a roller."""

import numpy
import pytest

from contact_sim_pkg.records.messages import RollerContact, RollerTrack
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.report.warnings import variation_above, warnings_of

CELLS, TURN = 256, 0.005  # [s]


def track(waves=2, amplitude=50.0, lowered=0.0, checked=0.0, error=0.0):
    load = 100.0 + amplitude * numpy.cos(2.0 * numpy.pi * waves * numpy.arange(CELLS) / CELLS)
    return RollerTrack(
        block=0,
        body="shaft",
        turns=10.0,
        cycles=1e4,
        turn_time=TURN,
        radius=0.005,
        height=numpy.zeros(CELLS),
        load=load,
        lowered=lowered,
        range=0.0,
        free=0.0,
        checked=checked,
        check_error=error,
    )


def warned(*tracks, rate=2000.0):
    contact = RollerContact(**dict.fromkeys(RollerContact._fields, numpy.zeros(4)) | {"block": 0, "period": 1.0 / rate})
    return warnings_of(RollerSeries(numpy.zeros(4), contact, list(tracks), [], []))


def test_a_run_whose_intervals_agree_is_not_warned_of():
    assert warned(track(checked=4.0, error=0.09)) == []


def test_a_time_acceleration_that_errs_is_reported_with_its_largest_error():
    (sentence,) = warned(track(checked=4.0, error=0.02), track(checked=4.0, error=0.5), track(checked=4.0, error=0.3))
    assert "2 of 3 intervals" in sentence
    assert "time acceleration of 1000" in sentence
    assert "at most 0.5" in sentence


def test_a_track_worn_far_is_reported_with_its_share_of_the_radius():
    (sentence,) = warned(track(lowered=1e-3))
    assert "20 % of its radius" in sentence


@pytest.mark.parametrize(("waves", "rate", "seen"), [(4, 2000.0, True), (11, 2000.0, False), (11, 5000.0, True)])
def test_waves_faster_than_half_the_rate_are_reported(waves, rate, seen):
    assert bool(warned(track(waves=waves), rate=rate)) is not seen


def test_the_variation_of_a_cosine_is_its_amplitude_over_the_root_of_two():
    total, above = variation_above(track(waves=11), 2000.0)
    assert total == pytest.approx(50.0 / 2.0**0.5, rel=1e-12)
    assert above == pytest.approx(total, rel=1e-12)
    assert variation_above(track(waves=11), 2300.0)[1] == pytest.approx(0.0, abs=1e-9)
