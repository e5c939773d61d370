"""Rules between keys of the tire's effects: each fault names its place, its value and what is allowed."""

import pytest

FIELD = {"normal_elastic": {}, "contact_field": {}}


def faults(maker, effects, **keys):
    return maker.faults("tire", {"effects.tire": {**FIELD, **effects}, **keys})


BELT = {"brush": {}, "sidewall_compliance": {}, "contact_field": {}}
SPIN = BELT | {"wheel_spin": {}}


@pytest.mark.parametrize(
    ("effects", "sentence"),
    [
        ({"rigid_ring": {"belt_mass": 40}}, "belt_mass: 40 kg is not below tire.wheel_mass (40 kg)"),
        ({"brush": {"coefficient_static": 0.5}}, "coefficient_kinetic: 0.8 is above coefficient_static (0.5)"),
        (SPIN | {"wheel_spin": {"points": [[0, 0, -1]]}}, "wheel_spin.points.0.2: -1 N m is outside 0 to 100000 N m"),
        (
            SPIN | {"wheel_spin": {"points": [[0, 0, 0]], "brake": 1}},
            "wheel_spin.brake: brake and points are both given",
        ),
        (
            BELT | {"sidewall_compliance": {"yaw": 1e8}},
            "yaw: the belt swings on it with 2906 Hz; it must be at most 1000 Hz",
        ),
        ({"tread_viscoelasticity": {"branches": [[0.1, 0.0]]}}, "branches.0.1: 0 s is outside 1e-06 to 10000 s"),
        ({"tread_viscoelasticity": {"branches": [[0.1, 1.0], [-1, 1.0]]}}, "branches.1.0: -1 is outside 0 to 100"),
    ],
)
def test_values_of_an_effect_that_do_not_go_together_are_refused(maker, effects, sentence):
    (fault,) = faults(maker, effects)
    assert sentence in fault


@pytest.mark.parametrize(
    ("effects", "sentence"),
    [
        (
            {"inflation": {"sidewall_angle": 0.6, "sidewall_chord": 0.2}},  # atan(0.2 / 0.172)
            "inflation.sidewall_angle: the sidewalls carry all of the inflation at 0.6 rad: a chord of 0.2 m beside",
        ),
        ({"inflation": {}, "rolling_loss": {"branches": [[0.1, 0.0]]}}, "rolling_loss.branches.0.1: 0 s is outside"),
    ],
)
def test_values_of_an_inflated_tire_that_do_not_go_together_are_refused(maker, effects, sentence):
    (fault,) = maker.faults("tire", {"effects.tire": effects})
    assert sentence in fault


def test_a_radius_on_the_rim_is_refused(maker):
    (fault,) = maker.faults("tire", {"effects.tire": {"inflation": {"size": "205/55 R16", "radius": 0.22}}})
    assert "inflation.radius: a radius of 0.22 m is less than 0.025 m above the rim of 205/55 R16, 0.2032 m" in fault


@pytest.mark.parametrize(
    ("slip", "sentence"),
    [
        ({"points": [[1.0, 0, 0]]}, "slip.points.0.0: the first time is 1 s; it must be 0"),
        ({"points": [[0, 0, 0], [0, 0, 0]]}, "slip.points.1.0: time 0 s does not come after 0 s"),
        ({"points": [[0, -1.5, 0]]}, "slip.points.0.1: -1.5 is outside -1 to 10"),
        ({"points": [[0, 0, 2]]}, "slip.points.0.2: 2 rad is outside -1.5 to 1.5 rad"),
        ({"points": [[0, 0, 0]], "angle": 0.1}, "slip.angle: angle and points are both given"),
    ],
)
def test_a_slip_programme_out_of_order_or_range_is_refused(maker, slip, sentence):
    (fault,) = faults(maker, {"brush": {}}, slip=slip)
    assert sentence in fault


def test_a_slip_that_nothing_uses_is_refused(maker):
    (fault,) = faults(maker, {}, slip={"angle": 0.1})
    assert "acts through the effect brush" in fault


def test_a_seat_has_no_slip(maker):
    (fault,) = maker.faults("seat", {"slip": {"angle": 0.1}})
    assert "the rig seat has no slip" in fault


def test_a_wheel_that_spins_takes_no_slip(maker):
    (fault,) = faults(maker, SPIN, slip={"longitudinal": -0.1})
    assert "the rim turns by effects.tire.wheel_spin; give its drive and brake" in fault
