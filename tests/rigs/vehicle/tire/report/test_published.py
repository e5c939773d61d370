"""The published curves of a tire beside a run of one like it."""

from types import SimpleNamespace

import pytest

from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.vehicle.tire.report.published import near_curves, published_section
from contact_sim_pkg.scene.resolve import load_resolved


def scene(*values):
    return load_resolved("tire_rough_road", *values).data


def recording(data, load=4000.0):
    stands = SimpleNamespace(load=load, deflection=0.0201, length=0.130)
    return Recording("bag", data, [], {}, [], {}, {}, None, None, None, 1.5)._replace(
        scene=data, series={"standing": stands}
    )


@pytest.mark.parametrize(
    ("values", "name", "deflection"),
    [
        (("effects.tire.inflation.pressure=220e3",), "220 kPa", 20.31),
        (("effects.tire.inflation.pressure=185e3",), "180 kPa", 23.12),
        (("effects.tire.inflation={size: 255/40ZR17, pressure: 2.1e5}",), "206.8 kPa", None),
    ],
)
def test_conditions_that_meet_bring_the_curves_of_the_nearest_inflation(values, name, deflection):
    first, second = near_curves(scene(*values))
    assert (first.up, second.up) == ("deflection, mm", "length, mm")
    assert first.name == second.name == name
    if deflection is not None:
        assert first.y[first.x.index(4000.0)] == deflection


@pytest.mark.parametrize(
    "values",
    [
        ("effects.tire.inflation.pressure=200e3",),  # between two, 9 % from both
        ("effects.tire.inflation={size: 225/45 R17}",),
        ("effects.tire.inflation.tread_modulus=6e6",),
    ],
)
def test_another_tire_or_inflation_has_none(values):
    assert near_curves(scene(*values)) == []
    assert published_section(recording(scene(*values))) is None


def test_a_tire_without_inflation_has_none():
    assert near_curves({"effects": {"tire": {"normal_elastic": {}}}}) == []


def test_the_picture_says_both_values_at_the_standing_load():
    with style():
        section = published_section(recording(scene("effects.tire.inflation.pressure=220e3")))
    (picture,) = section.pictures
    assert section.part == "published"
    assert (
        "Standing under 4000 N: deflection 20.1 mm, published 20.3 ± 1.02 mm; length 130 mm, published 132 ± 6.59 mm"
        in (picture.caption)
    )


def test_a_load_beyond_the_published_ones_has_none():
    assert published_section(recording(scene("effects.tire.inflation.pressure=220e3"), load=9000.0)) is None
