"""Wrenches of the contacts: their torque is that of the published pressure about the origin of the frame."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.run.offline import run_offline

SCENES = {
    "tire": ("tire_rough_road", "duration=0.3"),
    "seat": ("seat_ride", "duration=0.1", "effects.seat.contact_field={}"),
    "backrest": ("seat_ride_full", "duration=0.1"),
}


def recorded(folder, name, *assignments) -> Bag:
    run_offline(resolved(name, *assignments), folder / "bag")
    return open_bag(folder / "bag")


def torque_of(bag: Bag, contact: str):
    """Times [ns] and torques [messages, 3] [N m]."""
    columns = bag.columns(f"/{contact}/wrench")
    return columns["stamp"], numpy.stack([columns[f"wrench.torque.{axis}"] for axis in "xyz"], axis=1)


@pytest.mark.parametrize("contact", SCENES)
def test_the_torque_is_the_moment_of_the_pressure_about_the_origin(tmp_path, contact):
    """Sum of r x (0, 0, p dA) over the cells of each field that is published with a wrench."""
    bag = recorded(tmp_path, *SCENES[contact])
    stamps, torques = torque_of(bag, contact)
    patch = bag.columns(f"/{contact}/patch")
    compared = 0
    for i, stamp in enumerate(patch["stamp"]):
        rows, cols, cell_x, cell_y = (patch[name][i] for name in ("rows", "cols", "cell_x", "cell_y"))
        push = patch["pressure"][i].astype(float).reshape(rows, cols) * cell_x * cell_y
        x = patch["origin_x"][i] + cell_x * numpy.arange(rows)
        y = patch["origin_y"][i] + cell_y * numpy.arange(cols)
        arm = (push @ y).sum(), -(x @ push).sum()
        found = torques[stamps == stamp]
        if len(found):
            compared += 1
            assert found[0] == pytest.approx((*arm, 0.0), abs=1e-5 * push.sum())
    assert compared >= 10
    assert abs(torques).max() > 20.0


def test_the_torque_of_a_braking_tire_in_a_turn_is_the_moment_on_its_axle(tmp_path):
    """In steady rolling on level road M_y about the axle is torque.y - R_e F_x, R_e = R - d/3, d the deflection, and M_z is
    that about the origin. The wheel has rolled 20 m at one slip: many relaxation lengths.
    """
    steady = "slip={longitudinal: -0.03, angle: 0.03}", "travel={speed: 20}", "road={kind: flat}", "duration=1.0"
    bag = recorded(tmp_path, "tire_braking", *steady)
    _stamps, torque = torque_of(bag, "tire")
    along = bag.columns("/tire/wrench")["wrench.force.x"]
    axle, force = bag.columns("/tire/axle"), bag.columns("/tire/force")
    every = axle["moment_y"].size // len(along)
    moment_y, moment_z, deflection = (
        columns[name].ravel()[::every]
        for columns, name in ((axle, "moment_y"), (axle, "moment_z"), (force, "approach"))
    )
    assert along[-1] < -1000.0
    about_axle = torque[:, 1] - (0.316 - deflection / 3.0) * along
    # means over the ringing of the belt; the deflection of its vertical springs, 4 mm, is left out of d
    assert moment_y[-30:].mean() == pytest.approx(about_axle[-30:].mean(), rel=5e-3)
    assert abs(moment_z[-30:].mean()) > 10.0
    assert moment_z[-30:].mean() == pytest.approx(torque[-30:, 2].mean(), rel=1e-2)
