"""The report of a backrest: which pictures it has, and that what it draws and tells is what the bag holds."""

import numpy as np
import pytest
from tests.report.page import Page
from tests.rigs.backrest.report import backrest_bag as known

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.pressure.closed_form.lame import LameFit
from contact_sim_pkg.records.messages import ContactPatch
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import write_report
from contact_sim_pkg.rigs.backrest.report.figures_domain import chosen_stages, fit_of, lame_curve
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve


@pytest.fixture(scope="module")
def page(backrest, tmp_path_factory):
    path = write_report(backrest, tmp_path_factory.mktemp("page") / "backrest.html")
    return Page(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def slapping(tmp_path_factory):
    """Half a second of seat_slip at an amplitude that slaps."""
    values = ("vibration.amplitude=14.715", "duration=0.5", "outputs.field_rate=200")
    scene = resolve(load_scene("seat_slip", [set_value(value) for value in values]))
    directory = tmp_path_factory.mktemp("bags") / "slapping"
    run_offline(scene, directory)
    return open_bag(directory)


def test_a_backrest_has_its_sections(page):
    assert page.headings == ["Time and maps", "Contact", "Against published", "Trust", "Set-up", "Files"]
    assert "Restitution and duration of each slap of the backrest" in page.folds
    assert page.tags.count("figure") == 3 + 5 + 1 + 1 + 1 + 1


def test_captions_tell_the_numbers_of_the_closed_form(page):
    text = " ".join(page.texts)
    slaps = known.touches(5.0).size
    assert f"{slaps} slaps that ended within the run" in text
    assert "0.5 to 0.5, mean 0.5" in text
    assert f"The slaps dissipated {slaps * 6} J in all" in text
    assert "S_ref = 80 cm²" in text
    assert "between 0 and 6, mean" in text
    assert "of 6 points carry; 1 marks" in text
    assert "restitution e, mean" in text, "the tile"


def test_a_contact_that_is_kept_has_no_section_of_slaps(tmp_path):
    bag = known.backrest_bag(tmp_path / "kept", slaps=False)
    kept = Page(write_report(bag).read_text(encoding="utf-8"))
    assert "Contact points on the contact domain of the backrest" in kept.folds
    assert not [text for text in kept.folds if "slap" in text]
    text = " ".join(kept.texts)
    assert "The contact never opens. No slap ended within the run." in text
    assert "At the start a = " in text
    assert "One mass has one contact point" in text


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0, 2.6, 12.0])
def test_the_drawn_curve_is_the_lame_curve_about_its_centre(exponent):
    fit = LameFit(0.25, 0.17, exponent, 0.03, -0.02, 0.0, True)
    x, y = lame_curve(fit)
    value = np.abs((x - 0.03) / 0.25) ** exponent + np.abs((y + 0.02) / 0.17) ** exponent
    assert value == pytest.approx(1.0, abs=1e-9)
    assert x.max() == pytest.approx(0.28)
    assert y.min() == pytest.approx(-0.19)


def test_the_domain_at_first_touch_and_largest_force_is_that_of_the_messages(slapping):
    field = read_recording(slapping).fields["backrest"]
    patches = [(each.log_time * 1e-9, decode(ContactPatch, each.data)) for each in slapping.messages("/backrest/patch")]
    loads = [patch.load for _, patch in patches]
    touch = next(k for k in range(1, len(loads)) if loads[k] > 0.0 and loads[k - 1] == 0.0)
    for shown, number in ((field.touch, touch), (field.heaviest, int(np.argmax(loads)))):
        time, patch = patches[number]
        fit = fit_of(shown.field)
        assert shown.time == pytest.approx(time)
        assert (fit.a, fit.b, fit.exponent) == pytest.approx((patch.lame_a, patch.lame_b, patch.lame_n), rel=1e-12)


def test_points_and_field_show_the_same_instants(slapping):
    recording = read_recording(slapping)
    field, points = recording.fields["backrest"], recording.points
    assert points.touch.time == field.touch.time
    assert points.heaviest.time == field.heaviest.time
    assert points.normal == pytest.approx(field.load, rel=1e-6)


def test_the_stages_hold_touch_and_heaviest_of_one_contact(slapping):
    field = read_recording(slapping).fields["backrest"]
    stages = chosen_stages(field)
    times = [each.time for each in stages]
    assert 2 < len(stages) <= 8
    assert times == sorted(set(times))
    assert field.heaviest in stages
    assert all(each.load > 0.0 for each in stages)
    before = field.load[np.searchsorted(field.time, times[0]) - 1]
    assert before == 0.0 or times[0] == field.event[0].time


def test_a_real_run_gives_a_page(slapping, tmp_path):
    page = Page(write_report(slapping, tmp_path / "page.html").read_text(encoding="utf-8"))
    described = page.values("aria-label")
    assert len([text for text in described if "backrest" in text]) == 9 + 1  # the film
    assert len(set(described)) == len(described)


def test_a_contact_that_is_kept_is_shown_at_its_very_start(tmp_path):
    recording = read_recording(known.backrest_bag(tmp_path / "kept", slaps=False))
    field = recording.fields["backrest"]
    assert field.touch is None
    assert field.first.time == recording.points.touch.time == 0.0
    assert field.first.load == pytest.approx(known.forces(np.zeros(1), 5.0, known.KEPT)[0][0], rel=1e-6)
