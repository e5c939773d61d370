"""Apparent mass and seat-to-head transmissibility of a recorded ride, against those of the linear model."""

from types import SimpleNamespace

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.output.outcome import print_outcome
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.report import facts
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.signal.spectrum import Transmissibility
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.rigs.vehicle.seat.report.figures_occupant import occupant_pictures
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import peak_sentence
from contact_sim_pkg.rigs.vehicle.seat.report.metrics import seat_metrics
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import occupant_signals
from contact_sim_pkg.rigs.vehicle.seat.report.response import peak_of
from contact_sim_pkg.rigs.vehicle.seat.report.section import ride_sections
from contact_sim_pkg.run.offline import run_offline

GIVEN = {"excitation": {}, "real_time_factor": None, "scene": "ride", "simulated_s": 2.0, "startup_s": 0.0, "bag": None}
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


def values_of(found):
    return {each.key.partition(".")[2]: each.value for each in seat_metrics(found)}


def test_the_metrics_have_the_peaks_of_the_published_model(chain):
    occupant = values_of(chain)
    assert occupant["apparent_mass"] == pytest.approx(1.639 * 55.2, rel=0.03)
    assert occupant["apparent_mass_frequency"] == pytest.approx(4.57, abs=0.25)
    assert occupant["to_head"] == pytest.approx(1.781, rel=0.03)
    assert occupant["to_head_frequency"] == pytest.approx(4.68, abs=0.25)
    assert occupant["h_point"] == pytest.approx(1e3 * (0.098 - 55.2 * GRAVITY / 5e4), abs=0.3)


def test_the_page_shows_apparent_mass_and_the_way_to_the_head_beside_the_vibration(chain):
    with style():
        titles = [section.title for section in ride_sections(chain)]
        pictures = occupant_pictures(occupant_signals(chain))
    assert titles == ["Seat vibration", "Occupant"]
    assert [each.description.split(":")[0] for each in pictures] == [
        "Apparent mass of the occupant",
        "Transmissibility from seat to head",
    ]


@pytest.mark.parametrize(
    ("magnitude", "trusted", "peak"),
    [
        ((0, 1, 3, 2, 1), (0, 1, 1, 1, 1), (3.0, 2.0)),
        ((0, 1, 9, 3, 2), (0, 1, 0, 1, 1), None),  # beside a line that is not trusted
        ((0, 1, 2, 3, 9), (0, 1, 1, 1, 1), None),  # at the end of the lines
        ((9, 8, 3, 2, 1), (0, 1, 1, 1, 1), None),  # at their beginning
        ((0, 3, 1, 2, 1), (0, 1, 1, 1, 1), None),  # a lower maximum elsewhere is not the peak
        ((0, 2.9, 3, 2, 1), (0, 1, 1, 1, 1), None),  # it has hardly begun to fall where the trusted lines begin
        ((0, 2, 2.9, 3, 2.9, 2), (0, 1, 1, 1, 1, 1), (3.0, 3.0)),
        ((75, 75, 75 * (1 + 1e-14), 75, 75), (0, 1, 1, 1, 1), None),  # a rigid mass
        ((0, 1, 3, 2, 1), (0, 0, 0, 0, 0), None),
    ],
)
def test_a_peak_lies_between_lower_lines_that_are_trusted_too(magnitude, trusted, peak):
    values = numpy.array(magnitude, dtype=float)
    frequency = numpy.arange(float(len(values)))
    result = Transmissibility(frequency, values, 0.0 * values, numpy.ones(len(values)), 9)
    found = peak_of(result, numpy.array(trusted, dtype=bool))
    assert found == peak
    said = peak_sentence(result, numpy.array(trusted, dtype=bool))
    assert said.startswith("No peak can be read" if peak is None else f"Peak: 3 at {peak[1]:g} Hz")


def test_a_short_ride_that_does_not_show_its_peak_names_none(tmp_path):
    run_offline(resolved("seat_ride", "duration=5"), tmp_path / "bag")
    short = read_recording(open_bag(tmp_path / "bag"))
    # its model peaks at 77.3 kg and 4.59 Hz, and loses its coherence there
    assert "apparent_mass" not in values_of(short)
    with style():
        (picture,) = occupant_pictures(occupant_signals(short))
    assert "No peak can be read from this record" in picture.caption


def test_a_seat_at_rest_has_no_section_of_its_occupant(tmp_path):
    still = recording(tmp_path, "vibration={kind: sine, frequency: 4, amplitude: 0}", "duration=10")
    occupant = values_of(still)
    assert "h_point" in occupant
    assert not {"apparent_mass", "to_head", "peak"} & set(occupant)
    with style():
        assert occupant_pictures(occupant_signals(still)) == []


def test_a_cushion_compressed_beyond_its_table_is_said_before_the_numbers_and_on_the_terminal(tmp_path, capsys):
    scene = resolved("seat_ride", "vibration={kind: sine, frequency: 3, amplitude: 60}", "duration=2")
    outcome = run_offline(scene, tmp_path / "bag")
    found = read_recording(open_bag(tmp_path / "bag"))
    summary = summarise_recording(found)
    (sentence,) = summary["warnings"]
    assert "beyond 0.85" in sentence
    assert facts.warnings(found) == [sentence]

    print_outcome({**GIVEN, "summary": summary}, SimpleNamespace(stopped=outcome.stopped))
    assert f"  warning: {sentence}\n" in capsys.readouterr().out

    # the H-point of an occupant in the air is that of nobody who sits
    contact = found.contacts["seat"]
    touching = contact.normal > 0.0
    assert touching.mean() < 0.9
    expected = 0.098 - contact.approach[touching].mean()
    assert values_of(found)["h_point"] == pytest.approx(1e3 * expected, rel=1e-12)


def test_a_ride_within_the_range_of_its_foam_has_no_warning(chain):
    assert "warnings" not in summarise_recording(chain)


def test_an_occupant_without_a_head_has_its_apparent_mass_alone(tmp_path):
    occupant = values_of(recording(tmp_path, "seat.occupant.percentile=95"))
    assert occupant["apparent_mass"] == pytest.approx(113.5, rel=0.03)
    assert "to_head" not in occupant
