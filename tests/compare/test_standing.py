"""Loads and masses that the rigs state of their scenes."""

import pytest

from contact_sim_pkg.compare.judgement import standing_of
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.resolve import load_resolved

SCENES = [name for rig in rigs().values() for name in rig.scenes]


@pytest.mark.parametrize("name", SCENES)
def test_loads_and_masses_are_those_of_contacts_of_the_rig(name):
    scene = load_resolved(name)
    contacts = {contact.name for contact in rigs()[scene.rig].contacts}
    standing = standing_of(scene)
    assert {*standing.loads, *(body.contact for body in standing.bodies.values())} <= contacts
    assert all(load >= 0.0 for load in standing.loads.values())
    assert all(body.mass > 0.0 for body in standing.bodies.values())


def test_a_wheel_carries_the_quarter_car():
    """40 and 300 kg, 9.81 m/s^2; the belt is 7 of the 40 kg."""
    standing = standing_of(load_resolved("tire_bump", "effects.tire.rigid_ring={}"))
    assert standing.loads == {"tire": pytest.approx(3335.4)}
    assert {name: body.mass for name, body in standing.bodies.items()} == {"wheel_z": 33.0, "belt_z": 7.0}


def test_a_shell_has_no_single_mass():
    assert standing_of(load_resolved("seat_slap")).bodies["occupant_x"].mass == 45.6
    without = ("effects.backrest.friction=null", "backrest.sliding=null", "backrest.preload=20")
    assert standing_of(load_resolved("seat_slap", *without, "effects.backrest.shell_modes={}")).bodies == {}
