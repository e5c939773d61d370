"""In which axes a twist of others is read, which twist goes with which pose, and that both are reported."""

import numpy
import pytest
from scipy.spatial.transform import Rotation
from tests.identify import foreign_bag

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.identify.readers.body_states import read_body_states

TIME = 0.01 * numpy.arange(40)
SPIN = numpy.array([0.3, -2.0, 1.0])
TURNS = Rotation.from_rotvec(TIME[:, None] * SPIN) * Rotation.from_rotvec([0.4, 0.5, -0.6])
VELOCITY = numpy.array([1.0, 2.0, -1.0])
STATES = (
    TIME, TIME[:, None] * VELOCITY, TURNS.as_matrix(), numpy.tile(VELOCITY, (40, 1)), numpy.tile(SPIN, (40, 1)),
)  # fmt: skip


def is_as_moved(recorded):
    """Whether the states are those of the motion: world axes."""
    found = numpy.stack([recorded.states.velocity, recorded.states.angular_velocity])
    return bool(abs(found - numpy.stack(STATES[3:])).max() < 1e-12)


@pytest.mark.parametrize(
    ("child", "axes", "why"),
    [
        ("map", "world", "its child_frame_id is its frame_id, 'map'"),
        ("base_link", "body", "frame of its child_frame_id, 'base_link'"),
        ("", "body", "its child_frame_id is empty"),
    ],
)
def test_the_twist_of_odometry_is_in_the_axes_of_its_child(tmp_path, child, axes, why):
    foreign_bag.write_odometry(tmp_path / "bag", STATES, child=child)
    recorded = read_body_states(tmp_path / "bag")
    assert is_as_moved(recorded)
    (line,) = recorded.reading
    assert f"the twist of /odom is read in {axes} axes" in line
    assert why in line


@pytest.mark.parametrize(
    ("frame", "axes", "why"),
    [
        ("map", "world", "its frame_id is that of the poses, 'map'"),
        ("base_link", "body", "'base_link' is not that of the poses, 'map', and is taken as the body's"),
        ("", "body", "a guess, since its frame_id is empty"),
    ],
)
def test_the_axes_of_a_twist_are_told_and_so_is_the_option_for_others(tmp_path, frame, axes, why):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", STATES, frame)
    recorded = read_body_states(tmp_path / "bag")
    assert is_as_moved(recorded)
    (line,) = recorded.reading
    other = {"world": "body", "body": "world"}[axes]
    assert f"the twist of /twist is read in {axes} axes" in line
    assert why in line
    assert line.endswith(f"--twist-axes {other}")


@pytest.mark.parametrize(("asked", "moved"), [("world", True), ("body", False)])
@pytest.mark.parametrize("write", [foreign_bag.write_odometry, foreign_bag.write_pose_and_twist])
def test_axes_that_are_asked_for_are_taken(tmp_path, write, asked, moved):
    write(tmp_path / "bag", STATES, **({"child": "map"} if write is foreign_bag.write_odometry else {}))
    recorded = read_body_states(tmp_path / "bag", twist_axes=asked)
    assert is_as_moved(recorded) is moved
    assert recorded.reading[0].endswith(f"is read in {asked} axes: --twist-axes {asked}")


def test_poses_and_twists_without_a_partner_are_counted(tmp_path):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", STATES, every=2)
    recorded = read_body_states(tmp_path / "bag")
    assert recorded.states.time == pytest.approx(TIME[::2])
    assert "20 of 40 poses on /pose have no twist" in recorded.reading[1]
    assert "0 of 20 twists on /twist no pose" in recorded.reading[1]


def test_a_twist_that_is_late_by_a_sample_leaves_one_of_each_alone(tmp_path):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", STATES, late=0.01)
    recorded = read_body_states(tmp_path / "bag")
    assert "1 of 40 poses on /pose have no twist" in recorded.reading[1]
    assert "1 of 40 twists on /twist no pose" in recorded.reading[1]


def test_a_third_of_the_twists_is_too_few(tmp_path):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", STATES, every=3)
    with pytest.raises(BagError, match="of 40 poses on /pose only 14 have a twist"):
        read_body_states(tmp_path / "bag")
