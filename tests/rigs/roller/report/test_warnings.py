"""What is warned of before the numbers of a roller."""

from types import SimpleNamespace

import numpy
import pytest

from contact_sim_pkg.records.messages import RollerContact, RollerTrack
from contact_sim_pkg.report.ranges import FIRST_YIELD
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.report.warnings import roller_warnings, variation_above, warnings_of

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
        axial=numpy.zeros(0),
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


def recording(pressure, strength):
    """One that holds a roller and what its scene states."""
    time = 0.1 * numpy.arange(len(pressure))
    contact = RollerContact(**dict.fromkeys(RollerContact._fields, 0.0 * time) | {"block": 0, "period": 0.1})
    series = RollerSeries(time, contact._replace(peak_pressure=1e6 * numpy.array(pressure)), [], [], [])
    scene = {"roller": {} if strength is None else {"yield_strength": strength}}
    return SimpleNamespace(scene=scene, series={"roller": series})


def test_a_contact_beyond_first_yield_is_reported_with_where_it_begins_and_how_far_it_goes():
    """1100 MPa: a circular Hertz contact yields first at 1760 MPa."""
    (sentence,) = roller_warnings(recording([1223.0, 1541.0, 1763.0, 3731.0], 1.1e9))
    for part in ("1760 MPa", "1.6 times roller.yield_strength", "at 0.2 s", "3731 MPa"):
        assert part in sentence
    assert roller_warnings(recording([1223.0, 1541.0, 1759.0], 1.1e9)) == []
    assert roller_warnings(recording([1223.0, 3731.0], None)) == []


def test_first_yield_is_where_the_shear_on_the_axis_of_a_circle_is_half_the_strength():
    """On the axis of a unit circle of unit pressure (Johnson 3.45): sz = -1/(1 + z^2), sr = -(1 + nu) (1 - z atan(1/z)) - sz/2;
    Tresca and von Mises are the same there.
    """
    z = numpy.linspace(0.2, 1.0, 8001)
    deep = -1.0 / (1.0 + z**2)
    radial = -(1.0 + 0.3) * (1.0 - z * numpy.arctan(1.0 / z)) - 0.5 * deep
    assert 1.0 / numpy.abs(deep - radial).max() == pytest.approx(FIRST_YIELD, rel=0.01)
