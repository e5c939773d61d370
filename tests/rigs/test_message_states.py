"""Kernels write states as the numbers that the message definitions give them."""

from contact_sim_pkg.records.messages import ContactPoints, ContactShear
from contact_sim_pkg.rigs.backrest import entries
from contact_sim_pkg.rigs.vehicle.tire.brush import rolling_brush as brush


def test_states_of_the_brush_are_those_of_contact_shear():
    found = (brush.APART, brush.STICKS, brush.SLIPS)
    assert found == (ContactShear.APART, ContactShear.STICKS, ContactShear.SLIPS)


def test_states_of_the_back_are_those_of_contact_points():
    found = (entries.NO_CONTACT, entries.FRICTIONLESS, entries.STICKS, entries.SLIPS)
    assert found == (ContactPoints.APART, ContactPoints.TOUCHES, ContactPoints.STICKS, ContactPoints.SLIPS)
