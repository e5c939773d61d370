"""The state at rest, against the elliptic Hertz contact computed apart."""

import math

import pytest
from tests.report import rolling_bag as known

from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import tire_reference

TIRE = {"wheel_mass": 40.0, "body_mass": known.MASS - 40.0}
ELASTIC = {
    "radius_rolling": known.RADIUS_X, "radius_lateral": known.RADIUS_Y, "young_modulus": known.YOUNG,
    "poisson_ratio": known.POISSON,
}  # fmt: skip


def scene_of(elastic, **effects):
    return {"rig": "tire", "tire": TIRE, "effects": {"tire": {"normal_elastic": elastic, **effects}}}


def test_reference_is_the_hertz_contact_under_the_standing_load():
    along, across, peak, approach = known.ellipse(known.STANDING)

    found = tire_reference(scene_of(ELASTIC))

    assert found.load == pytest.approx(known.STANDING)
    assert found.body.modulus == pytest.approx(known.MODULUS)
    expected = (along, across, peak, approach)
    assert (found.semi_axis_x, found.semi_axis_y, found.peak_pressure, found.approach) == pytest.approx(expected)


def test_a_crown_flatter_along_than_across_turns_the_ellipse():
    turned = {**ELASTIC, "radius_rolling": known.RADIUS_Y, "radius_lateral": known.RADIUS_X}
    along, across, *_ = known.ellipse(known.STANDING)

    found = tire_reference(scene_of(turned))

    assert (found.semi_axis_x, found.semi_axis_y) == pytest.approx((across, along))


@pytest.mark.parametrize(
    "scene",
    [
        {}, {"rig": "seat", "tire": None}, {"rig": "tire", "tire": TIRE}, scene_of({"radius_rolling": 0.3}),
        *(
            scene_of({**ELASTIC, **wrong})
            for wrong in ({"radius_rolling": 0.0}, {"young_modulus": "soft"}, {"radius_lateral": -1.0}, {"poisson_ratio": 1.0})
        ),
    ],
)  # fmt: skip
def test_a_scene_without_an_elliptic_contact_has_no_reference(scene):
    assert tire_reference(scene) is None


def test_a_belt_makes_the_footprint_longer_and_the_pressure_lower_and_carries_the_same_load():
    field = {"length": 0.3, "width": 0.44, "rows": 48, "cols": 64, "tolerance": 1e-6, "corrector_passes": 0}
    stiff = {"tension": 9900.0, "foundation": 1e13}
    soft = {"tension": 9900.0, "foundation": 6.3e5}

    def reference(belt):
        return tire_reference(scene_of(ELASTIC, contact_field=field, envelopment=belt))

    along, _across, peak, approach = known.ellipse(known.STANDING)
    close, far = reference(stiff), reference(soft)
    assert close.peak_pressure == pytest.approx(peak, rel=0.03)  # by cells
    assert close.approach == pytest.approx(approach, rel=0.01)
    assert far.peak_pressure < 0.9 * peak
    assert far.semi_axis_x > 1.1 * along
    assert far.approach > 1.5 * approach


def test_the_area_at_rest_is_that_of_the_ellipse():
    along, across, *_ = known.ellipse(known.STANDING)

    assert tire_reference(scene_of(ELASTIC)).area == pytest.approx(math.pi * along * across)


def test_the_state_at_rest_of_a_tire_with_a_belt_does_not_carry_the_tolerance_of_the_run():
    def reference(tolerance):
        field = {"length": 0.28, "width": 0.44, "rows": 48, "cols": 64, "tolerance": tolerance, "corrector_passes": 1}
        belt = {"tension": 9900.0, "foundation": 1.5e6}
        return tire_reference(scene_of({**ELASTIC, "young_modulus": 6e6}, contact_field=field, envelopment=belt))

    coarse, fine = reference(1e-2), reference(1e-7)

    assert coarse.peak_pressure == pytest.approx(fine.peak_pressure, rel=1e-6)
    assert 2.0 * fine.semi_axis_x * fine.semi_axis_y < fine.area < 4.0 * fine.semi_axis_x * fine.semi_axis_y
