"""System *inertia*: Newton and Euler about the centre of mass, beside the regressor about the sensor's point."""

import numpy
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from scipy.spatial.transform import Rotation
from tests.identify import foreign_bag

from contact_sim_lab.papers.identifiability.regressor import BodyMotion, batch, recursive, regressor
from contact_sim_lab.papers.identifiability.system_inertia import inertia
from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.bag.errors import BagError

MASS, CENTRE = 3.2, numpy.array([0.03, -0.02, 0.05])
ABOUT_CENTRE = numpy.array([[0.021, 0.002, -0.001], [0.002, 0.034, 0.003], [-0.001, 0.003, 0.027]])
ABOUT_SENSOR = ABOUT_CENTRE + MASS * (CENTRE @ CENTRE * numpy.eye(3) - numpy.outer(CENTRE, CENTRE))
WANTED = numpy.array([MASS, *(MASS * CENTRE), *numpy.diag(ABOUT_SENSOR), *ABOUT_SENSOR[[0, 0, 1], [1, 2, 2]]])


def moving(time, spatial=True):
    """Wrench by the balance of the centre of mass: f = m (a_c - g), tau_O = I_c alpha + w x I_c w + c x f."""
    w = numpy.stack([3 * numpy.sin(2 * time), 2 * numpy.cos(3 * time + 0.3), 1.5 * numpy.sin(4 * time + 1)], axis=1)
    a = numpy.stack([6 * numpy.cos(2 * time), -6 * numpy.sin(3 * time + 0.3), 6 * numpy.cos(4 * time + 1)], axis=1)
    s = numpy.stack([1.5 * numpy.sin(3 * time), 0.8 * numpy.cos(5 * time), 9.81 + numpy.sin(2.5 * time)], axis=1)
    if not spatial:  # in the plane x y
        w, a, s = w * [0, 0, 1], a * [0, 0, 1], s * [1, 1, 0]
    of_centre = s + numpy.cross(a, CENTRE) + numpy.cross(w, numpy.cross(w, CENTRE))
    force = MASS * of_centre
    torque = a @ ABOUT_CENTRE + numpy.cross(w, w @ ABOUT_CENTRE) + numpy.cross(CENTRE, force)
    return BodyMotion(s, w, a, force, torque)


def test_the_regressor_times_the_parameters_is_the_wrench():
    motion = moving(numpy.linspace(0.0, 2.0, 9))
    found = regressor(motion) @ WANTED
    assert found == pytest.approx(numpy.concatenate([motion.force, motion.torque], axis=1), rel=1e-12, abs=1e-13)


def test_batch_and_recursive_find_all_ten_and_agree():
    motion = moving(numpy.linspace(0.0, 4.0, 81))
    fit, course = batch(motion), recursive(motion)
    assert fit.rank == 10
    assert fit.parameters == pytest.approx(WANTED, rel=1e-10)
    assert course[-1] == pytest.approx(fit.parameters, rel=1e-10)
    assert numpy.isnan(course[0]).all()
    noise = numpy.random.default_rng(2).normal(0.0, 0.01, (2, 81, 3))
    noisy = motion._replace(force=motion.force + noise[0], torque=motion.torque + 0.1 * noise[1])
    fit = batch(noisy)
    assert recursive(noisy)[-1] == pytest.approx(fit.parameters, rel=1e-9)
    # Of ten errors in their deviations none is beyond five.
    assert numpy.abs((fit.parameters - WANTED) / fit.deviations).max() < 5.0


def test_a_planar_motion_names_what_it_does_not_identify():
    """In the plane x y: mass, mc_x, mc_y, Izz about O and, by the moment about x and y, mc_z with Ixz and Iyz."""
    fit = batch(moving(numpy.linspace(0.0, 4.0, 81), spatial=False))
    assert fit.rank == 7
    assert fit.hidden == ["Ixx", "Iyy", "Ixy"]
    known = numpy.isfinite(fit.deviations)
    assert fit.parameters[known] == pytest.approx(WANTED[known], rel=1e-9)


def write_imu(path, motion, time, wrench_time=None):
    """Imu and WrenchStamped of others, by rosbags."""
    store, kinds = foreign_bag.STORE, {"/imu": "sensor_msgs/msg/Imu", "/wrench": "geometry_msgs/msg/WrenchStamped"}
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        rows = {topic: writer.add_connection(topic, kind, typestore=store) for topic, kind in kinds.items()}
        vector = store.types["geometry_msgs/msg/Vector3"]
        still = store.types["geometry_msgs/msg/Quaternion"](*Rotation.identity().as_quat())
        for place, instant in enumerate(time):
            head = foreign_bag._header(instant, "sensor")
            imu = store.types[kinds["/imu"]](head, still, numpy.zeros(9), vector(*motion.spin[place]), numpy.zeros(9),
                                             vector(*motion.specific_force[place]), numpy.zeros(9))  # fmt: skip
            stamp = foreign_bag.ORIGIN + round(instant * 1e9)
            writer.write(rows["/imu"], stamp, store.serialize_cdr(imu, kinds["/imu"]))
            late = foreign_bag._header(instant if wrench_time is None else wrench_time[place], "sensor")
            push = store.types["geometry_msgs/msg/Wrench"](vector(*motion.force[place]), vector(*motion.torque[place]))
            message = store.types[kinds["/wrench"]](late, push)
            writer.write(rows["/wrench"], stamp, store.serialize_cdr(message, kinds["/wrench"]))


def test_a_bag_with_imu_and_wrench_gives_them(tmp_path):
    time = numpy.linspace(0.0, 4.0, 801)
    write_imu(tmp_path / "bag", moving(time), time)
    result = inertia(tmp_path / "bag", {})
    found = numpy.array([row["batch"] for row in result.rows])
    # The rate of the spin is that of a spline through it.
    assert found == pytest.approx(WANTED, rel=1e-4)
    assert "rank 10 of 10 from 801 samples" in result.note


def test_inputs_that_hold_no_such_motion_are_refused(tmp_path):
    time = numpy.linspace(0.0, 1.0, 11)
    write_imu(tmp_path / "bag", moving(time), time, time + 5.0)
    with pytest.raises(PaperError, match="0 samples of /imu lie within the time of the wrench; 4 are needed"):
        inertia(tmp_path / "bag", {})
    foreign_bag.write_odometry(tmp_path / "odometry", (time, *(numpy.zeros((11, 3)), numpy.tile(numpy.eye(3), (11, 1, 1))),
                                                       numpy.zeros((11, 3)), numpy.zeros((11, 3))))  # fmt: skip
    with pytest.raises(BagError, match="no topic of Imu"):
        inertia(tmp_path / "odometry", {})
    path = tmp_path / "motion.csv"
    path.write_text("sx,sy\n1,2\n", encoding="utf-8")
    with pytest.raises(PaperError, match="columns sx, sy, sz, wx"):
        inertia(path, {})
