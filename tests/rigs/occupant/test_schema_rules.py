"""What a scene of the rig occupant is refused for, in one sentence each."""

import pytest

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved, read_resolved


@pytest.mark.parametrize(
    ("scene", "value", "where", "sentence"),
    [
        (
            "seat_ride_full",
            "backrest.mass=20",
            "backrest.mass",
            "with its own mass; remove it (backrest.mass=null)",
        ),
        ("seat_ride_full", "effects.backrest.shell_modes={}", "effects.backrest.shell_modes", "in the rig backrest"),
        ("seat_ride_full", "effects.backrest.friction={}", "effects.backrest.friction", "in the rig backrest"),
        ("seat_ride_full", "seat.pan_tilt=0", "seat.pan_tilt", "nothing presses the occupant"),
        ("seat_ride_full", "backrest.preload=1e4", "backrest.preload", "lift the occupant from the pan"),
        ("seat_ride_full", "backrest.back.radius_up=1.2", "backrest.back.radius_up", "does not act on a cushion"),
        ("seat_ride_full", "backrest.mat.rows=30", "backrest.mat.rows", "does not act on a cushion"),
        ("seat_ride", "seat.pan_tilt=0.1", "seat.pan_tilt", "in the rig occupant"),
        ("seat_slap", "backrest.angle=0.1", "backrest.angle", "in the rig occupant"),
    ],
)
def test_what_does_not_belong_to_one_trunk_is_refused(scene, value, where, sentence):
    with pytest.raises(SceneError) as caught:
        load_resolved(scene, value)
    (fault,) = caught.value.faults
    assert fault.where == where
    assert sentence in fault.sentence


def test_what_a_cushion_does_not_use_may_stand_at_its_default():
    resolved = load_resolved(
        "seat_ride_full", "backrest.mat.rows=40", "seat.cushion_modulus=4e4", "seat.body.thigh_rise=0.02"
    )
    assert read_resolved(resolved.to_yaml()) == resolved


def test_friction_on_a_tilted_pan_needs_a_frame_with_mass():
    with pytest.raises(SceneError, match=r"seat\.occupant has none"):
        load_resolved("seat_ride_full", "seat.occupant.model=wan_schimmels", "effects.seat.friction={}")


def test_a_push_of_the_feet_holds_the_occupant_on_a_level_pan():
    data = load_resolved("seat_ride_full", "seat.pan_tilt=0", "backrest.preload=50").data
    assert (data["seat"]["pan_tilt"], data["backrest"]["preload"], data["backrest"]["angle"]) == (0.0, 50.0, 0.384)
    assert "mass" not in data["backrest"]


def test_a_back_by_itself_keeps_its_mass_and_its_weight():
    data = load_resolved("seat_slap").data["backrest"]
    assert data["preload"] == pytest.approx(data["mass"] * 9.81)
    assert "angle" not in data
