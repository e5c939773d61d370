"""Friction of a rolling tire: what is kept of the shear fields, and what the page says of it."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from tests.report import rolling_bag as known
from tests.report.page import Page

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import write_report
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import ShearReader

FRICTION_TOPICS = (*known.TOPICS, "tire/shear")


def message(force_x, force_y, sliding_share=0.5):
    return SimpleNamespace(
        rows=2, cols=3, cell_x=0.01, cell_y=0.02, origin_x=0.0, origin_y=0.0, slip=-0.1, slip_angle=0.05, force_x=force_x,
        force_y=force_y, moment_z=1.0, sliding_share=sliding_share, dissipated=3.0, shear_x=np.full(6, 3e3),
        shear_y=np.full(6, -4e3), state=np.array([0, 1, 2, 1, 2, 0], dtype=np.uint8),
    )  # fmt: skip


def passed(*messages):
    fields = ShearReader()
    for number, each in enumerate(messages):
        fields.add(0.1 * number, "", each)
    return fields.finish()


def test_the_fields_with_the_largest_forces_along_and_across_are_kept():
    series = passed(message(-100.0, 5.0), message(-900.0, 10.0), message(50.0, 400.0), message(0.0, 0.0))

    assert [each.time for each in series.largest] == pytest.approx([0.1, 0.2])
    np.testing.assert_allclose(series.largest[0].grid.pressure, 5e3)
    np.testing.assert_array_equal(series.largest[0].state, [[0, 1, 2], [1, 2, 0]])
    assert series.dissipated.sum() == 12.0


def test_a_footprint_that_slides_as_a_whole_is_kept_only_where_there_is_no_other():
    locked = message(-900.0, 0.0, sliding_share=1.0)

    assert passed(locked, message(-700.0, 0.0), locked).largest[0].force_x == -700.0
    assert passed(locked, locked).largest[0].force_x == -900.0


@pytest.mark.parametrize(("along", "across"), [(900.0, 10.0), (10.0, 900.0)])
def test_a_small_force_has_no_map_of_its_own(along, across):
    (only,) = passed(message(along, 0.0), message(0.0, across)).largest

    assert abs(only.force_x) + abs(only.force_y) == max(along, across)


def test_a_field_that_does_not_fill_its_grid_is_refused():
    broken = message(1.0, 1.0)
    broken.state = broken.state[:-1]

    with pytest.raises(BagError, match=r"the shear at 0\.000000 s does not fill its 2 x 3 cells"):
        passed(broken)


@pytest.fixture(scope="module")
def braking(tmp_path_factory):
    return known.rolling_bag(tmp_path_factory.mktemp("bags") / "braking", 100, FRICTION_TOPICS)


def test_friction_over_load_is_the_friction_of_the_closed_form(braking):
    recording = read_recording(braking)

    touching = recording.fields["tire"].load > 0.0
    ratio = recording.series["shear"].force_x[touching] / recording.fields["tire"].load[touching]
    np.testing.assert_allclose(ratio, -known.FRICTION, rtol=1e-5)


def test_the_page_shows_forces_over_time_and_slip_and_the_state_of_the_cells(braking, tmp_path):
    text = write_report(braking, tmp_path / "braking.html").read_text(encoding="utf-8")

    assert {"Friction of the tire over time", "Friction of the tire over slip"} <= set(Page(text).values("aria-label"))
    assert "Shear of the tire with stick and slip" in Page(text).values("aria-label")
    assert re.search(r"Largest resultant 0\.600 of the load", text)
    assert "dissipated 200 J" in text


def test_a_bag_without_shear_says_nothing_of_friction(rolling, tmp_path):
    text = write_report(rolling, tmp_path / "rolling.html").read_text(encoding="utf-8")

    assert "Friction of the tire" not in text
