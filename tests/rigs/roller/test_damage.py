"""The dangerous share over the load, as it is read in a run."""

import numpy
import pytest
from tests.rigs.roller.test_simulation import of, run
from tests.run.scenes import resolved

from contact_sim_pkg.records.messages import RollerTrack, RollerVolumes
from contact_sim_pkg.rigs.roller.damage import damage_table
from contact_sim_pkg.rigs.roller.model import build_roller
from contact_sim_pkg.rigs.roller.settings import volume_settings
from contact_sim_pkg.rigs.roller.theory.volumes import box_volume, dangerous_volumes

SMALL = tuple(f"effects.roller.subsurface.cells_{axis}={number}" for axis, number in (("x", 16), ("y", 16), ("z", 12)))


@pytest.mark.parametrize("load", [26.5, 53.0, 79.5, 150.0, 238.5, 500.0])
def test_between_its_rows_the_table_is_the_volume_under_that_load(load):
    """Steps of the shipped programme, whose loads are no rows of the table: to 1.5 % of few cells."""
    model = build_roller(resolved("roller_programme", *SMALL))
    curvatures = model.programme.curvatures_at(0.0)
    working = box_volume(model.contact(26.5, 0.0, curvatures))
    volumes = dangerous_volumes(model.contact(load, 0.0, curvatures), model.poisson_ratio, *volume_settings(model))
    assert numpy.interp(load, *damage_table(model)) == pytest.approx(volumes.any / working, rel=0.015)


def test_the_table_rises_from_the_load_at_which_a_limit_is_met():
    """Limit of all stress at p0 of 100 N: 0 up to that load, for the largest stress is the pressure itself; more beyond."""
    scene = resolved("roller_corrugation", *SMALL)
    plain = build_roller(scene)
    pressure = plain.contact(100.0, 0.0, plain.programme.curvatures_at(0.0)).peak_pressure
    limits = (f"effects.roller.subsurface.normal_limit={pressure}", "effects.roller.subsurface.shear_limit=1e12")
    loads, shares = damage_table(build_roller(resolved("roller_corrugation", *SMALL, *limits)))
    assert loads[shares > 0.0].min() == pytest.approx(100.0, rel=0.08)
    assert (numpy.diff(shares) >= 0.0).all()
    assert shares[-1] > 0.0


def test_below_both_limits_a_run_wears_nothing():
    """p0 1.22 GPa of 26.5 N under limits of 1.4 GPa."""
    limits = ("effects.roller.subsurface.normal_limit=1.4e9", "effects.roller.subsurface.shear_limit=1.4e9")
    short = ("duration=0.1", "effects.roller.subsurface.instants=[0.0]", *limits, *SMALL)
    _scene, messages = run("roller_programme", *short)
    assert of(messages, RollerVolumes)[0].volume.max() == 0.0
    tracks = of(messages, RollerTrack)
    assert tracks[-1].lowered == 0.0
    assert (tracks[-1].height == tracks[0].height).all()


def test_a_fixed_yaw_is_that_of_the_contact_and_its_volumes():
    """Straight cylinders at 0.7 rad: at a yaw of 0 they would touch in a line."""
    model = build_roller(resolved(
        "roller_steady", "roller.programme=null", "roller.profile_radius=0", "roller.shaft_profile_radius=0", "roller.yaw=0.7",
        "effects.roller.subsurface.instants=[0.0]", "roller.radius=0.3", "roller.load=70",
    ))  # fmt: skip
    assert model.held_yaw == 0.7
    assert model.contact(70.0, model.held_yaw, model.programme.curvatures_at(0.0)).peak_pressure > 0.0
