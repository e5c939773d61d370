"""A load that the programme gives over time: no second one beside it, and the drawing says its range."""

import pytest

from contact_sim_pkg.rigs.roller.report.drawing import roller_parts
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value


def test_a_load_beside_the_loads_of_the_programme_is_refused():
    with pytest.raises(SceneError, match="300 N acts on nothing, since the programme gives the load over time"):
        load_scene("roller_steady", [set_value("roller.load=300.0")])
    assert load_scene("roller_flutter", [set_value("roller.load=250.0")]).roller.load == 250.0


def test_the_drawing_says_the_range_of_a_programme():
    plain = {"roller": {"load": 100.0, "radius": 0.02, "programme": None}}
    assert {each.name: each.value for each in roller_parts(plain)}["load"] == "100 N"
    plain["roller"]["programme"] = {"load": [72.0, 57.0, 60.0], "shaft_radius": [0.32, 0.32]}
    found = {each.name: each.value for each in roller_parts(plain)}
    assert (found["load"], found["shaft"]) == ("57 to 72 N", "radius 320 mm")
