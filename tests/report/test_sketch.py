"""The drawing of a rig and its conditions."""

import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from contact_sim_pkg.report.sketch import (
    Part,
    Sketch,
    conditions_of,
    drawing_of,
    drum,
    floor_part,
    mass,
    parts_of_scene,
    road_parts,
    spring_and_damper,
)


def heights(drawing):
    """Of the labels, by their text, upwards."""
    return {text: -float(y) for y, text in re.findall(r'y="([-\d.]+)">([^<]*)</text>', str(drawing))}


def test_parts_stand_on_each_other_and_no_label_on_another():
    parts = [
        Part(f"part {number}", f"{number} kg", glyph)
        for number, glyph in enumerate((mass, mass, spring_and_damper, mass))
    ]
    found = heights(drawing_of(parts, "rig"))
    order = [found[f"part {number}"] for number in range(4)]
    assert order == sorted(order)
    lines = sorted(found.values())
    assert min(above - below for below, above in pairwise(lines)) >= 14.9


def test_texts_of_a_scene_are_escaped():
    hostile = '<script>"&'
    ElementTree.fromstring(str(drawing_of([Part(hostile, hostile, mass)], hostile)))


def test_conditions_are_the_parts_as_one_line():
    assert conditions_of([Part("foam", "80 mm", mass), Part("speed", "20 m/s")]) == "foam 80 mm · speed 20 m/s"


def test_a_rig_that_lists_no_parts_has_its_excitation_contacts_and_masses():
    scene = {"road": {"kind": "none of ours"}, "effects": {"blade": {}}, "mower": {"deck_mass": 12.5, "width": 0.5}}
    assert conditions_of(parts_of_scene(scene)) == "road none of ours · blade contact · mower deck mass 12.5 kg"


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([[0.0, 20.0], [1.0, 12.0]], "20 → 12 m/s"),
        ([[0.0, 20.0], [1.0, 20.0]], "20 m/s"),
        ([[0.0, 10.0], [1.0, 20.0], [2.0, 15.0]], "10 to 20 m/s"),
    ],
)
def test_a_speed_says_which_way_it_goes(points, said):
    parts = road_parts({"road": {"kind": "flat"}, "travel": {"points": points}})
    assert [each.value for each in parts if each.name == "speed"] == [said]


def test_the_arrow_of_a_floor_lies_along_its_axis():
    """Its line is level for x and upright for z."""
    for axis, along in (("x", 1), ("z", 0)):
        (part,) = floor_part({"vibration": {"kind": "sine", "axis": axis}})
        sketch = Sketch()
        part.glyph(sketch, 0.0)
        line = re.search(r'class="move" points="([-\d.]+),([-\d.]+) ([-\d.]+),([-\d.]+)"', sketch.svg(0.0, ""))
        first, last = line.groups()[:2], line.groups()[2:]
        assert first[along] == last[along]


def test_a_drum_is_drawn_in_place_of_the_ground():
    from contact_sim_pkg.rigs.vehicle.tire.report.drawing import tire_parts
    from contact_sim_pkg.scene.resolve import load_resolved

    drawn = {
        name: [part.glyph for part in tire_parts(load_resolved(name).data)] for name in ("tire_drum", "tire_plate")
    }
    assert drawn["tire_drum"][0] is drum
    assert drum not in drawn["tire_plate"]
    ends, middle = (
        re.findall(r'points="([^"]+)"', str(drawing_of([Part("drum", "", drum)], "rig")))[0].split()[i] for i in (0, 12)
    )
    assert float(middle.split(",")[1]) < float(ends.split(",")[1]) - 10.0  # down is positive
