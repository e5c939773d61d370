"""The drawing of a rig and its conditions."""

import re
from itertools import pairwise
from xml.etree import ElementTree

from contact_sim_pkg.report.sketch import Part, conditions_of, drawing_of, mass, parts_of_scene, spring_and_damper


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
