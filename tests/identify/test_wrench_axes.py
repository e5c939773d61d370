"""`bench identify` with a force that is fixed in the body: recorded in body axes, in world axes, and read in wrong ones."""

import json

import numpy
import pytest
from tests.identify import foreign_bag, motions, pushed_box

from contact_sim_pkg.cli.main import main

BOX = ["--box", "0.10", "0.14", "0.20"]
NOISE = {"position": 1e-4, "rotation": 1e-3, "velocity": 1e-3, "spin": 1e-2}


def write(path, states, frame, every=1):
    """Poses and twists in `map`, the force in the axes of the frame at every such sample."""
    exact = pushed_box.motion()
    axes = exact.rotation if frame == "map" else numpy.tile(numpy.eye(3), (len(exact.time), 1, 1))
    pushes = [(time, turn @ pushed_box.FORCE, (0.0, 0.0, 0.0)) for time, turn in zip(exact.time, axes, strict=True)]
    foreign_bag.write_pose_and_twist(path, states, pushes=pushes[::every], push_frame=frame)


def reported(capsys, path, *options):
    """What the command prints as JSON, and its row of the mass."""
    assert main(["identify", str(path), *BOX, "--force-topic", "/push", *options, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    (mass,) = (row for row in facts["parameters"] if row["parameter"] == "m")
    return facts, mass


@pytest.mark.parametrize(("frame", "every"), [("base_link", 1), ("base_link", 50), ("map", 1)])
def test_a_force_fixed_in_the_body_tells_the_mass_from_exact_motion(tmp_path, capsys, frame, every):
    """Between samples 1 ms apart the force turns by 5 to 10 mrad; straight lines miss up to (1e-2)^2 / 12 = 8e-6 of it."""
    write(tmp_path / "bag", pushed_box.motion(), frame, every)
    facts, mass = reported(capsys, tmp_path / "bag")
    assert len(facts["contacts"]) >= 2
    assert mass["value"] == pytest.approx(pushed_box.MASS, rel=8e-6)
    axes = {"base_link": "body", "map": "world"}[frame]
    assert "the twist of /twist is read in world axes" in facts["reading"][0]
    assert f"the wrench of /push is read in {axes} axes" in facts["reading"][1]


@pytest.mark.parametrize(("frame", "right", "wrong"), [("base_link", "body", "world"), ("map", "world", "body")])
def test_noisy_motion_agrees_with_the_force_in_its_axes_and_contradicts_it_in_others(
    tmp_path, capsys, frame, right, wrong
):
    write(tmp_path / "bag", motions.noisy(pushed_box.motion(), 3, **NOISE), frame)
    facts, mass = reported(capsys, tmp_path / "bag")
    assert facts["consistency_warnings"] == []
    assert abs(mass["value"] - pushed_box.MASS) < 4.0 * mass["standard deviation"] < 0.01 * pushed_box.MASS
    assert reported(capsys, tmp_path / "bag", "--force-axes", right)[0]["parameters"] == facts["parameters"]
    warnings = reported(capsys, tmp_path / "bag", "--force-axes", wrong)[0]["consistency_warnings"]
    assert any("the known wrench" in line for line in warnings)


def test_a_force_recorded_in_world_axes_at_a_lower_rate_than_the_states_misses_its_turning(tmp_path, capsys):
    """50 ms apart it turns by 0.25 to 0.5 rad between samples: straight lines miss 0.25^2 / 12 = 5e-3 to 2e-2 of it."""
    write(tmp_path / "bag", pushed_box.motion(), "map", 50)
    facts, mass = reported(capsys, tmp_path / "bag")
    assert 2e-3 < abs(mass["value"] / pushed_box.MASS - 1.0) < 2e-2
    assert any("the known wrench" in line for line in facts["consistency_warnings"])
