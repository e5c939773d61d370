"""The page of a rolling tire against the closed forms that its bag is made of."""

import re

import numpy as np
import pytest
from tests.report import rolling_bag as known
from tests.report.page import Page

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import write_report
from contact_sim_pkg.report.signal.lift_off import lifted_intervals
from contact_sim_pkg.report.signal.peaks import filtered_signals, peak_rows
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import tire_reference
from contact_sim_pkg.rigs.vehicle.tire.report.figures_footprint import STAGES, chosen_stages
from contact_sim_pkg.rigs.vehicle.tire.report.figures_road import Rolling, near_largest_load, whole_way
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import tire_metrics
from contact_sim_pkg.rigs.vehicle.tire.report.tables import footprint_table

HEAVY_TIME = known.HEAVY_BLOCK * known.BLOCK_LENGTH


@pytest.fixture(scope="module")
def recording(rolling):
    return read_recording(rolling)


@pytest.fixture(scope="module")
def reference(recording):
    return tire_reference(recording.scene)


@pytest.fixture(scope="module")
def text(rolling, tmp_path_factory):
    return write_report(rolling, tmp_path_factory.mktemp("page") / "rolling.html").read_text(encoding="utf-8")


def column(table, name):
    place = table.header.index(name)
    return {row[0]: row[place] for row in table.rows}


def test_on_a_flat_road_at_rest_the_pressure_is_that_of_the_reference(recording, reference):
    centre = recording.fields["tire"].event[0].field.pressure

    # The middle of the contact lies half a cell beside the nearest centres of cells.
    assert centre.max() / reference.peak_pressure == pytest.approx(1.0, abs=1e-3)


def test_eight_times_the_load_has_twice_the_pressure(recording, reference):
    table = footprint_table(recording.fields["tire"], reference)

    assert column(table, "largest")["peak pressure over that at rest"] == "2"
    heaviest = recording.fields["tire"].heaviest.field.pressure
    assert heaviest.max() / reference.peak_pressure == pytest.approx(2.0, abs=2e-3)


def test_the_dynamic_load_coefficient_is_the_spread_over_the_standing_load(recording):
    share_lifted, share_heavy = len(known.LIFTED_BLOCKS) / 100, 1 / 100
    mean = 1.0 - share_lifted + share_heavy * (known.HEAVY - 1.0)
    square = 1.0 - share_lifted + share_heavy * (known.HEAVY**2 - 1.0)

    metrics = {each.key: each for each in tire_metrics(recording)}

    assert metrics["tire.dlc"].value == pytest.approx((square - mean**2) ** 0.5)
    assert metrics["tire.lift_off"].value == pytest.approx(100.0 * share_lifted)
    assert metrics["tire.lift_off"].verdict == "outside"


def test_lift_off_is_found_with_its_instants(recording):
    contact = recording.contacts["tire"]

    np.testing.assert_allclose(lifted_intervals(contact), [[0.70, 0.73]])


def test_the_footprint_at_rest_is_the_ellipse_and_that_of_the_fields_is_no_more_than_a_cell_off(recording, reference):
    along, across, *_ = known.ellipse(known.STANDING)

    table = footprint_table(recording.fields["tire"], reference)

    at_rest, heavy = column(table, "at rest"), column(table, "at the largest load")
    assert float(at_rest["footprint length, mm"]) == pytest.approx(2e3 * along, rel=5e-3)
    assert float(at_rest["footprint width, mm"]) == pytest.approx(2e3 * across, rel=5e-3)
    assert float(heavy["footprint length, mm"]) == pytest.approx(2.0 * 2e3 * along, abs=2e3 * known.CELL_X)
    assert float(heavy["footprint width, mm"]) == pytest.approx(2.0 * 2e3 * across, abs=2e3 * known.CELL_Y)
    assert float(at_rest["mean pressure, kPa"]) == pytest.approx(2e-3 / 3.0 * reference.peak_pressure, rel=5e-3)


def test_peaks_stand_raw_and_filtered_side_by_side(recording):
    rows = {row.label: row for row in peak_rows(filtered_signals(recording.contacts["tire"], recording.motion))}

    force = rows["normal force, N"]
    assert (force.raw.value, force.raw.time) == (pytest.approx(known.HEAVY * known.STANDING), pytest.approx(HEAVY_TIME))
    assert force.filtered.time == pytest.approx(HEAVY_TIME + 0.0045, abs=6e-4)  # the middle of the ten samples
    up = rows["wheel acceleration, m/s², up"]
    assert up.raw.value == pytest.approx(known.WHEEL_AMPLITUDE)
    assert up.filtered.value == pytest.approx(known.WHEEL_AMPLITUDE, rel=1e-3)  # 10 Hz passes
    assert rows["wheel acceleration, m/s², down"].raw.value == pytest.approx(-known.WHEEL_AMPLITUDE)


def test_the_shown_segment_holds_the_largest_load_and_what_comes_after(recording, reference):
    field = recording.fields["tire"]

    rolling = Rolling(recording.contacts["tire"], field, recording.series["road"], reference)
    whole = whole_way(rolling)
    near = near_largest_load(rolling, whole)

    place = HEAVY_TIME * known.SPEED
    assert near.start == pytest.approx(place - 1.0)
    assert near.end == pytest.approx(place + 3.0)
    assert (whole.start, whole.end) == pytest.approx((0.0, 9.99))


def test_the_page_names_the_conditions_and_draws_the_rig(text):
    assert "· road cleat · tire wheel 40 kg · load 3.34 kN" in text
    drawing = text[text.index('class="sketch"') :].split("</svg>")[0]
    assert [each for each in ("road", "tire", "suspension", "body", "300 kg") if f">{each}</text>" not in drawing] == []


def test_the_stages_surround_the_largest_load(recording):
    stages = chosen_stages(recording.fields["tire"], recording.series["road"].travel)

    assert len(stages) == STAGES
    assert recording.fields["tire"].heaviest in stages
    np.testing.assert_allclose(np.diff([each.time for each in stages]), known.BLOCK_LENGTH)


def test_the_page_shows_the_rolling_tire(text):
    page = Page(text)
    names = [value for value in page.values("aria-label") if value]

    for start in (
        "Force, footprint and road of the tire", "Peaks of the tire", "Footprint of the tire", "Displacement of the tread",
        "Pressure over the reference maximum", "Stress below the tread",
    ):  # fmt: skip
        assert any(name.startswith(start) for name in names), start


@pytest.mark.parametrize(
    "expected",
    ["Largest: 2.00", "ν = 0.5", "Without load \\(shaded\\) for 3.00%", "E\\* = 4 MPa", "no phase, −3 dB at 100 Hz"],
)
def test_captions_state_the_numbers(text, expected):
    assert re.search(expected, text)


def test_the_largest_displacement_is_the_approach(text):
    *_, approach = known.ellipse(known.HEAVY * known.STANDING)

    found = float(re.search(r"Largest ([0-9.]+) mm, inside the contact", text)[1])

    assert found == pytest.approx(approach * 1e3, rel=5e-3)


def test_a_tire_without_field_keeps_force_and_peaks_and_has_no_map(tmp_path):
    topics = ("bench/scene", "road/patch", "tire/force", "bench/motion")

    page = Page(write_report(known.rolling_bag(tmp_path / "follower", 100, topics)).read_text(encoding="utf-8"))

    names = [value for value in page.values("aria-label") if value]
    assert "Peaks of the tire raw and filtered at 100 Hz" in names
    assert not any("ressure" in name or "Displacement" in name or "Stress" in name for name in names)


def test_a_tire_that_never_touches_still_gives_a_page(tmp_path, monkeypatch):
    monkeypatch.setattr(known, "load_of", lambda _: 0.0)

    text = write_report(known.rolling_bag(tmp_path / "air", 30)).read_text(encoding="utf-8")

    assert "Footprint of the tire at several instants" in text
    assert "Displacement of the tread" not in text


def test_a_wheel_that_stands_has_no_picture_over_distance(tmp_path, monkeypatch):
    monkeypatch.setattr(known, "SPEED", 0.0)

    page = Page(write_report(known.rolling_bag(tmp_path / "still", 30)).read_text(encoding="utf-8"))

    names = [value for value in page.values("aria-label") if value]
    assert not any(name.startswith("Force, footprint and road") for name in names)
    assert any(name.startswith("Displacement") for name in names)


def test_asperities_have_a_curve_of_their_own(tmp_path, monkeypatch):
    def force(block, stamp):
        zeros = np.zeros(known.SAMPLES)
        pushed = ContactForce(
            block=block,
            sample_period=1e-3,
            normal=zeros + 3000.0,
            tangential=zeros,
            approach=zeros,
            effective_height=zeros,
            impulses=zeros + 10.0 * block,
        )
        return encode(pushed, stamp, "tire_contact")

    monkeypatch.setitem(known._ENCODERS, "tire/force", force)
    bag = known.rolling_bag(tmp_path / "asperities", 30, ("bench/scene", "tire/force"))

    np.testing.assert_allclose(read_recording(bag).contacts["tire"].impulses[::10], 10.0 * np.arange(30))
    assert "The road&#39;s asperities push with up to 290 N beside it." in write_report(bag).read_text(encoding="utf-8")
