"""The vehicle rig against a twin that shares no code with it, on the drives of the shipped scenes."""

import numpy
import pytest

from contact_sim_lab.rigs.vehicle.scene_drive import drive_of, fast_run, slow_run
from contact_sim_pkg.laws.parameters import TabulatedElastic
from contact_sim_pkg.scene.resolve import load_resolved

ON_A_SPRING = "effects.seat={normal_elastic: {}, normal_dissipative: {}}"
CASES = {
    "tire_half_space": (1.2,),
    "tire_half_space on a rigid ring": (1.2, "effects.tire.rigid_ring={}"),
    "tire_bump": (1.2,),
    "tire_bump on a rigid ring": (1.2, "effects.tire.rigid_ring={}"),
    "seat_ride": (0.5, ON_A_SPRING),
    "seat_ride on a viscoelastic cushion": (
        0.5,
        "effects.seat={normal_elastic: {}, general_dissipative: {coefficient: 8000, approach_exponent: 0.5}}",
    ),
    "car_full_bench": (0.5, ON_A_SPRING),
    "car_full_bench on a rigid ring": (0.3, ON_A_SPRING, "effects.tire.rigid_ring={}"),
    "tire_rough_road": (0.3,),
}


@pytest.mark.parametrize("name", CASES)
def test_the_rig_follows_its_twin_to_the_requested_tolerance(name):
    duration, *values = CASES[name]
    scene = load_resolved(name.split()[0], *values)
    drive = drive_of(scene, duration)
    asked = float(scene.data["integrator"]["relative_tolerance"])
    exact = slow_run(drive)[:-1]
    # A table has kinks in its curvature, every half millimetre
    contact = drive.model.tire_contact
    by_table = contact is not None and isinstance(contact.elastic, TabulatedElastic)
    for tolerance, bound in ((1e-6, 2e-5), (1e-8, 2e-7)) if by_table else ((1e-6, 1e-5), (1e-9, 1e-8)):
        states, _forces = fast_run(drive, drive.model.scale * (tolerance / asked))
        error = numpy.abs(states[:, :-2] - exact).max(axis=0) / numpy.abs(exact - exact[0]).max(axis=0)
        assert error.max() <= bound


@pytest.mark.parametrize(("name", "bound"), [("tire_half_space", 1e-8), ("tire_bump", 1e-7)])
def test_the_rig_follows_its_twin_through_lift_off(name, bound):
    scene = load_resolved(name, "road.height=0.12")
    drive = drive_of(scene, 1.4)
    asked = float(scene.data["integrator"]["relative_tolerance"])
    states, forces = fast_run(drive, drive.model.scale * (1e-10 / asked))
    assert (forces[:, 0] == 0.0).any(), "the tire does not leave the road"
    assert states[:, :-2] == pytest.approx(slow_run(drive)[:-1], abs=bound)


SHAKEN = "vibration={kind: sine, frequency: 5.0, amplitude: 14.0}"


@pytest.mark.parametrize(
    "law",
    [
        "{coefficient: 8000, approach_exponent: 0.5}",
        "{coefficient: 700, approach_exponent: 0}",
        "{coefficient: 8000, approach_exponent: 0.5, end: gap}",
    ],
)
def test_the_rig_follows_its_twin_where_the_general_law_ends_its_contacts(law):
    effects = f"effects.seat={{normal_elastic: {{}}, general_dissipative: {law}}}"
    scene = load_resolved("seat_ride", SHAKEN, effects)
    drive = drive_of(scene, 1.0)
    asked = float(scene.data["integrator"]["relative_tolerance"])
    states, forces = fast_run(drive, drive.model.scale * (1e-10 / asked))
    assert (forces[:, 4] == 0.0).any(), "the occupant does not leave the seat"
    assert (forces[:, 4] < 0.0).any() == ("gap" in law)
    assert states[:, :-2] == pytest.approx(slow_run(drive)[:-1], abs=1e-7)
