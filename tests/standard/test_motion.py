"""Accelerometers at rest, in free fall and on a sine; frames against the motion and scipy's rotations."""

import numpy
import pytest
from scipy.spatial.transform import Rotation
from tests.standard.records import PERIOD, motion_of

from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.standard.motion import bodies_of, frames_of, imu_of, joints_of
from contact_sim_pkg.standard.places import BACKREST_TURN, Places, places_of

G = 9.81  # [m/s^2]
CAR = ("wheel_z", "body_z", "seat_frame_z", "occupant1_z", "occupant_x")
STAMP = 3_000_000_000
STILL = Places()


def place_of(transform):
    moved = transform.transform.translation
    return moved.x, moved.y, moved.z


def turn_of(transform):
    turn = transform.transform.rotation
    return Rotation.from_quat([turn.x, turn.y, turn.z, turn.w])


def tree_of(motion, places=STILL, contacts=(), sample=0):
    tree = frames_of(motion, sample, STAMP, places, contacts).transforms
    assert {each.header.stamp.sec for each in tree} == {3}
    return {each.child_frame_id: each for each in tree}


@pytest.mark.parametrize(("place", "frame"), [("axle", "wheel"), ("floor", "body"), ("seat", "seat_frame")])
def test_an_accelerometer_at_rest_measures_gravity_upward(place, frame):
    imu = imu_of(motion_of(CAR), place, 0, STAMP)
    found = imu.linear_acceleration
    assert (found.x, found.y, found.z) == (0.0, 0.0, G)
    assert imu.header.frame_id == frame
    assert imu.orientation_covariance[0] == -1.0


def test_an_accelerometer_in_free_fall_measures_nothing():
    imu = imu_of(motion_of(("floor_z",), acceleration=-G), "floor", 0, STAMP)
    assert imu.linear_acceleration.z == 0.0
    assert imu.header.frame_id == "floor"


def test_an_accelerometer_on_a_sine_measures_its_acceleration_at_each_sample():
    omega, amplitude = 2.0 * numpy.pi * 5.0, 0.01
    time = PERIOD * numpy.arange(10)
    acceleration = -amplitude * omega**2 * numpy.sin(omega * time)
    motion = motion_of(("wheel_z",), acceleration=acceleration[None, :])
    found = [imu_of(motion, "axle", sample, 0).linear_acceleration.z for sample in range(10)]
    assert found == pytest.approx(G + acceleration)


def test_there_is_no_accelerometer_on_a_body_that_the_run_has_not():
    assert imu_of(motion_of(("sphere_z",)), "axle", 0, STAMP) is None


def test_coordinates_are_the_components_of_their_body():
    names = (
        "block_x",
        "block_z",
        "block_pitch",
        "roller_tilt",
        "roller_yaw",
        "box_rotation_x",
        "box_rotation_z",
        "mode",
    )
    found = bodies_of(names, numpy.arange(1.0, 9.0))
    assert {name: (body.along.tolist(), body.about.tolist()) for name, body in found.items()} == {
        "block": ([1.0, 0.0, 2.0], [0.0, 3.0, 0.0]),
        "roller": ([0.0, 0.0, 0.0], [0.0, 4.0, 5.0]),
        "box": ([0.0, 0.0, 0.0], [6.0, 0.0, 7.0]),
    }


def test_a_frame_moves_with_its_body_from_its_rest_place():
    motion = motion_of(CAR, position=[-0.02, -0.19, -0.23, -0.24, 0.03])
    tree = tree_of(motion, Places(radius=0.316, width=0.2), ["tire", "seat"])
    assert place_of(tree["wheel"]) == pytest.approx((0.0, 0.0, 0.316 - 0.02))
    rest = tree_of(motion_of(CAR), Places(radius=0.316, width=0.2))
    for body, moved in (("body", (0, 0, -0.19)), ("seat_frame", (0, 0, -0.23)), ("occupant", (0.03, 0, 0))):
        found = numpy.subtract(place_of(tree[body]), place_of(rest[body]))
        assert found == pytest.approx(moved), body


def test_the_rig_moves_along_the_road_as_its_speed_says():
    """x = v^2 t / (2 v) from rest: 1/2 a t^2 with a = 2 m/s^2."""
    places = Places(travel=Travel([(0.0, 0.0), (10.0, 20.0)]))
    assert place_of(tree_of(motion_of(CAR), places)["base_link"]) == pytest.approx((0.5 * 2.0 * 3.0**2, 0.0, 0.0))


def test_all_frames_are_one_tree_below_the_fixed_frame():
    tree = tree_of(motion_of(CAR), Places(0.3, 0.2), ["tire", "seat", "backrest"])
    parents = {child: each.header.frame_id for child, each in tree.items()}
    assert parents["base_link"] == "bench"
    assert parents["seat_contact"] == "body"
    for frame in tree:
        seen = []
        while frame != "bench":
            assert frame not in seen
            seen.append(frame)
            frame = parents[frame]


def test_a_rotation_vector_becomes_the_quaternion_that_scipy_makes_of_it():
    generator = numpy.random.default_rng(4)
    names = tuple(f"block_rotation_{axis}" for axis in "xyz")
    for turn in [numpy.zeros(3), *generator.uniform(-1.8, 1.8, (20, 3)), numpy.array([1e-9, 0.0, 0.0])]:
        found = turn_of(tree_of(motion_of(names, position=turn))["block"])
        assert (found * Rotation.from_rotvec(turn).inv()).magnitude() < 1e-12


def test_the_frame_of_a_backrest_has_x_up_y_to_the_right_and_z_forward():
    matrix = Rotation.from_quat(BACKREST_TURN).as_matrix()
    assert matrix == pytest.approx(numpy.array([[0, 0, 1], [0, -1, 0], [1, 0, 0]]).astype(float), abs=1e-15)


@pytest.mark.parametrize(
    ("effects", "centre"),
    [
        ({"backrest": {"cushion": {}}}, 0.351),  # of the median back, over the lower edge: README of the rig
        ({"backrest": {"normal_elastic": {}}}, 0.0),  # its map counts from the crown
        ({"backrest": {"cushion": {}}, "tire": {"inflation": {"size": "205/55 R16"}}}, 0.351),
        ({"backrest": {"cushion": {}}, "tire": {"normal_elastic": {}}}, 0.351),
    ],
)
def test_the_centre_of_pressure_of_a_back_is_shown_in_the_middle_of_the_seat_back(effects, centre):
    names = ("body_z", "seat_frame_z", "seat_back_x")
    tree = tree_of(motion_of(names), places_of({"effects": effects}), ["backrest"])
    contact = tree["backrest_contact"]
    place = numpy.add(place_of(tree["body"]), place_of(contact)) + turn_of(contact).apply([centre, 0.0, 0.0])
    assert place == pytest.approx(place_of(tree["seat_back"]), abs=5e-3)


def test_joints_are_the_coordinates_at_a_sample():
    motion = motion_of(CAR, position=numpy.arange(50.0).reshape(5, 10), velocity=-numpy.arange(50.0).reshape(5, 10))
    joints = joints_of(motion, 4, STAMP)
    assert joints.name == list(CAR)
    assert joints.position.tolist() == [4.0, 14.0, 24.0, 34.0, 44.0]
    assert joints.velocity.tolist() == [-4.0, -14.0, -24.0, -34.0, -44.0]


def test_masses_of_the_occupant_stand_above_each_other_and_unknown_bodies_at_the_origin():
    places = Places()
    first, second = places.of_body("occupant1"), places.of_body("occupant2")
    assert second[2] > first[2] > places.of_body("seat_frame")[2] > 0.0
    assert places.of_body("occupant_head") == places.of_body("drum") == (0.0, 0.0, 0.0)
