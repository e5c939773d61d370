"""In which axes a wrench of others is read, how it is turned into those of the world, and that it is reported."""

import numpy
import pytest
from scipy.spatial.transform import Rotation
from tests.identify import foreign_bag

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.identify.readers.body_states import read_body_states
from contact_sim_pkg.identify.readers.wrenches import read_wrench

TIME = 0.01 * numpy.arange(40)
SPIN = numpy.array([0.3, -2.0, 1.0])
FORCE, TORQUE = numpy.array([3.0, -2.0, 1.5]), numpy.array([0.1, 0.3, -0.2])
ROUNDING = 2e-9  # of the forces: stamps are whole nanoseconds


def turns(time):
    """The rotation of the body: a constant spin, which Slerp meets exactly."""
    return Rotation.from_rotvec(numpy.multiply.outer(time, SPIN)) * Rotation.from_rotvec([0.4, 0.5, -0.6])


STATES = (TIME, numpy.zeros((40, 3)), turns(TIME).as_matrix(), numpy.zeros((40, 3)), numpy.tile(SPIN, (40, 1)))


def recorded_push(path, pushes, axes="auto", frame="base_link"):
    """The wrench as read from a bag with the poses."""
    foreign_bag.write_pose_and_twist(path, STATES, pushes=pushes, push_frame=frame)
    return read_wrench(path, "/push", read_body_states(path), axes)


def steady(time):
    """The same force and torque at each time."""
    return [(each, FORCE, TORQUE) for each in time]


@pytest.mark.parametrize(
    ("frame", "axes", "why"),
    [
        ("map", "world", "its frame_id is that of the poses, 'map'"),
        ("base_link", "body", "'base_link' is not that of the poses, 'map', and is taken as the body's"),
        ("", "body", "a guess, since its frame_id is empty and that of the poses is 'map'"),
    ],
)
def test_a_wrench_is_read_in_the_axes_of_its_frame_and_that_is_told(tmp_path, frame, axes, why):
    found = recorded_push(tmp_path / "bag", steady(TIME), frame=frame)
    expected = turns(TIME) if axes == "body" else Rotation.identity(40)
    assert found.samples.time == pytest.approx(TIME, abs=1e-12)
    assert abs(found.samples.force - expected.apply(FORCE)).max() < 1e-12
    assert abs(found.samples.torque - expected.apply(TORQUE)).max() < 1e-12
    other = {"world": "body", "body": "world"}[axes]
    assert found.reading == f"the wrench of /push is read in {axes} axes: {found.reading.split(': ', 1)[1]}"
    assert why in found.reading
    assert found.reading.endswith(f"if it is not so: --force-axes {other}")


@pytest.mark.parametrize("frame", ["map", "base_link", ""])
@pytest.mark.parametrize("axes", ["world", "body"])
def test_axes_that_are_asked_for_are_taken(tmp_path, frame, axes):
    found = recorded_push(tmp_path / "bag", steady(TIME), axes, frame)
    expected = turns(TIME) if axes == "body" else Rotation.identity(40)
    assert abs(found.samples.force - expected.apply(FORCE)).max() < 1e-12
    assert found.reading == f"the wrench of /push is read in {axes} axes: --force-axes {axes}"


def test_a_wrench_of_few_samples_goes_straight_in_the_body_and_is_turned_at_each_pose(tmp_path):
    sparse = numpy.array([0.0133, 0.1471, 0.3069])
    found = recorded_push(tmp_path / "bag", [(time, (1.0 + time) * FORCE, -time * TORQUE) for time in sparse])
    within = TIME[(sparse[0] < TIME) & (sparse[-1] > TIME)]
    assert found.samples.time == pytest.approx(numpy.sort(numpy.concatenate([sparse, within])), abs=1e-12)
    time = found.samples.time[:, None]
    assert abs(found.samples.force - turns(time[:, 0]).apply((1.0 + time) * FORCE)).max() < ROUNDING
    assert abs(found.samples.torque - turns(time[:, 0]).apply(-time * TORQUE)).max() < ROUNDING


def test_a_wrench_beyond_the_poses_is_turned_within_their_time_only(tmp_path):
    found = recorded_push(tmp_path / "bag", steady(numpy.array([-5.0, -0.013, 0.104, 0.397, 7.0])))
    assert found.samples.time == pytest.approx(numpy.sort([*TIME, 0.104]), abs=1e-12)
    assert abs(found.samples.force - turns(found.samples.time).apply(FORCE)).max() < ROUNDING


def test_a_wrench_in_world_axes_keeps_all_its_samples(tmp_path):
    time = numpy.array([-5.0, 0.104, 7.0])
    found = recorded_push(tmp_path / "bag", steady(time), frame="map")
    assert found.samples.time == pytest.approx(time, abs=1e-12)


@pytest.mark.parametrize("time", [[-2.0, -1.0], [0.5, 0.6], [0.1]])
def test_a_wrench_in_body_axes_at_no_time_of_the_poses_is_refused(tmp_path, time):
    with pytest.raises(
        BagError, match=r"the poses that would turn it from body axes go from 0 to 0\.39 s; record both"
    ):
        recorded_push(tmp_path / "bag", steady(time))


def test_samples_out_of_order_are_sorted_and_a_second_one_of_a_stamp_is_told(tmp_path):
    pushes = steady(TIME[::-1])
    pushes += [pushes[3], (TIME[7], 2.0 * FORCE, TORQUE)]
    found = recorded_push(tmp_path / "bag", pushes, frame="map")
    assert found.samples.time == pytest.approx(TIME, abs=1e-12)
    assert (found.samples.force == FORCE).all()
    (note,) = found.notes
    assert "1 messages on /push have the stamp of another one and other values" in note
