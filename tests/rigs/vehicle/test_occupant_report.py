"""Apparent mass and seat-to-head transmissibility of a recorded ride, against those of the linear model."""

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.seat.report.figures_occupant import occupant_pictures
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import occupant_signals, summary_numbers
from contact_sim_pkg.rigs.vehicle.seat.report.section import ride_sections
from contact_sim_pkg.run.offline import run_offline

NOISE = "vibration={kind: noise, low: 0.5, high: 20, rms: 1.0}"
LINEAR = (
    "effects.seat={normal_elastic: {coefficient: 5e4, exponent: 1}, "
    "general_dissipative: {coefficient: 500, approach_exponent: 0, rate_exponent: 1}}"
)


def recording(folder, *values):
    run_offline(resolved("seat_ride", NOISE, LINEAR, "duration=60", *values), folder / "bag")
    return read_recording(open_bag(folder / "bag"))


@pytest.fixture(scope="module")
def chain(tmp_path_factory):
    return recording(tmp_path_factory.mktemp("chain"), "seat.occupant.model=boileau_rakheja")


def test_the_summary_has_the_peaks_of_the_published_model(chain):
    occupant = summary_numbers(chain)["occupant"]
    assert occupant["model"] == "boileau_rakheja"
    assert occupant["mass_kg"] == pytest.approx(55.2)
    assert occupant["apparent_mass_peak_kg"] == pytest.approx(1.639 * 55.2, rel=0.03)
    assert occupant["apparent_mass_peak_hz"] == pytest.approx(4.57, abs=0.25)
    assert occupant["seat_to_head_peak"] == pytest.approx(1.781, rel=0.03)
    assert occupant["seat_to_head_peak_hz"] == pytest.approx(4.68, abs=0.25)
    assert occupant["h_point_over_cushion_m"] == pytest.approx(0.098 - 55.2 * GRAVITY / 5e4, abs=3e-4)


def test_the_page_shows_apparent_mass_and_the_way_to_the_head_beside_the_vibration(chain):
    with style():
        titles = [section.title for section in ride_sections(chain)]
        pictures = occupant_pictures(occupant_signals(chain))
    assert titles == ["Seat vibration", "Occupant"]
    assert [each.description.split(":")[0] for each in pictures] == [
        "Apparent mass of the occupant",
        "Transmissibility from seat to head",
    ]


def test_an_occupant_without_a_head_has_its_apparent_mass_alone(tmp_path):
    occupant = summary_numbers(recording(tmp_path, "seat.occupant.percentile=95"))["occupant"]
    assert occupant["apparent_mass_peak_kg"] == pytest.approx(113.5, rel=0.03)
    assert "seat_to_head_peak" not in occupant
