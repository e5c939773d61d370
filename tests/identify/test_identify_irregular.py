"""`bench identify` on bags as sensors write them: slow, irregular, out of order, with gaps, doubled, noisy."""

import json

import numpy
import pytest
from tests.identify import foreign_bag, motions

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.identify.contact.noise import roundings
from contact_sim_pkg.identify.motion.states import BodyStates

INERTIA = 600.0


def inertia_of(bag, capsys, *options):
    """m/J and its standard deviation as the command tells them."""
    assert main(["identify", str(bag), "--box", "0.1", "0.1", "0.1", "--json", *options]) == 0
    (row,) = [row for row in json.loads(capsys.readouterr().out)["parameters"] if row["parameter"] == "m/J"]
    return row["value"], row["standard deviation"]


def kept(states, chosen):
    return tuple(field[chosen] for field in states)


@pytest.fixture(scope="module")
def states():
    return motions.states_of(motions.planar())


def test_200_samples_a_second_are_enough(states, tmp_path, capsys):
    foreign_bag.write_odometry(tmp_path / "bag", kept(states, slice(0, None, 5)))
    assert inertia_of(tmp_path / "bag", capsys)[0] == pytest.approx(INERTIA, rel=1e-9)


def test_samples_at_irregular_instants_are_taken_at_their_own_stamps(states, tmp_path, capsys):
    random = numpy.random.default_rng(4)
    foreign_bag.write_odometry(tmp_path / "bag", kept(states, numpy.flatnonzero(random.random(len(states[0])) < 0.4)))
    assert inertia_of(tmp_path / "bag", capsys)[0] == pytest.approx(INERTIA, rel=1e-9)


def test_messages_out_of_order_are_read_by_their_stamps(states, tmp_path, capsys):
    order = numpy.arange(len(states[0]))
    order[10:60:2], order[11:61:2] = order[11:61:2].copy(), order[10:60:2].copy()
    foreign_bag.write_odometry(tmp_path / "bag", kept(states, order))
    assert inertia_of(tmp_path / "bag", capsys)[0] == pytest.approx(INERTIA, rel=1e-9)


def test_a_message_that_was_recorded_twice_counts_once(states, tmp_path, capsys):
    foreign_bag.write_odometry(
        tmp_path / "bag", kept(states, numpy.sort(numpy.append(numpy.arange(len(states[0])), [7, 90])))
    )
    assert inertia_of(tmp_path / "bag", capsys)[0] == pytest.approx(INERTIA, rel=1e-9)


def test_of_two_states_at_one_stamp_the_first_is_used_and_it_is_told(states, tmp_path, capsys):
    time = states[0].copy()
    time[50] = time[49]
    foreign_bag.write_odometry(tmp_path / "bag", (time, *states[1:]))
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.1", "0.1", "0.1", "--json"]) == 0
    out, err = capsys.readouterr()
    assert "1 messages on /odom have the stamp of another one and other values: the first of each stamp is used" in err
    (row,) = [row for row in json.loads(out)["parameters"] if row["parameter"] == "m/J"]
    assert row["value"] == pytest.approx(INERTIA, rel=1e-9)


def test_a_bag_that_was_recorded_twice_over_counts_once(states, tmp_path, capsys):
    foreign_bag.write_odometry(tmp_path / "bag", kept(states, numpy.repeat(numpy.arange(len(states[0])), 2)))
    assert inertia_of(tmp_path / "bag", capsys)[0] == pytest.approx(INERTIA, rel=1e-9)


def test_messages_without_stamps_are_refused(states, tmp_path, capsys):
    foreign_bag.write_odometry(tmp_path / "bag", (0.0 * states[0], *states[1:]))
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.1", "0.1", "0.1"]) == 2
    assert f"the {len(states[0])} messages on /odom have 1 stamps" in capsys.readouterr().err


def test_stamps_that_are_late_by_chance_spoil_no_more_than_is_reported(states, tmp_path, capsys):
    """Stamps 20 us off: at 2 m/s that is 40 um, and 0.2 mm/s by gravity."""
    random = numpy.random.default_rng(8)
    late = states[0] + 2e-5 * random.normal(size=len(states[0]))
    foreign_bag.write_odometry(tmp_path / "bag", (late, *states[1:]))
    value, spread = inertia_of(tmp_path / "bag", capsys)
    assert value == pytest.approx(INERTIA, rel=5e-3)
    assert abs(value - INERTIA) < 4.0 * spread


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_noise_leaves_the_truth_within_what_is_reported(states, tmp_path, capsys, seed):
    random = numpy.random.default_rng(seed)
    time, position, rotation, velocity, spin = states
    noisy = (
        time, position + 1e-4 * random.normal(size=position.shape), rotation,
        velocity + 1e-3 * random.normal(size=velocity.shape), spin + 1e-2 * random.normal(size=spin.shape),
    )  # fmt: skip
    foreign_bag.write_odometry(tmp_path / "bag", noisy)
    value, spread = inertia_of(tmp_path / "bag", capsys)
    assert abs(value - INERTIA) < 4.0 * spread
    assert spread < 0.01 * INERTIA


@pytest.mark.parametrize("step", [1e-3, 1e-4, 1e-6])
def test_samples_that_were_rounded_still_show_their_impacts(states, tmp_path, capsys, step):
    """Most second differences of rounded samples are 0: the rounding is the noise all the same."""
    time, position, rotation, velocity, spin = states
    rounded = [numpy.round(values / step) * step for values in (position, velocity, spin)]
    foreign_bag.write_pose_and_twist(tmp_path / "bag", (time, rounded[0], rotation, rounded[1], rounded[2]))
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.1", "0.1", "0.1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["contacts"]) == len(motions.planar().bounces)
    (row,) = [row for row in found["parameters"] if row["parameter"] == "m/J"]
    assert row["value"] == pytest.approx(INERTIA, rel=0.02 if step == 1e-3 else 2e-3)
    assert found["noise"]["velocity_m_s"] >= 0.99 * step / numpy.sqrt(12.0)


def test_samples_in_single_precision_show_no_impacts_that_are_none(states, tmp_path, capsys):
    single = [field.astype(numpy.float32).astype(float) for field in (states[1], states[3], states[4])]
    foreign_bag.write_pose_and_twist(tmp_path / "bag", (states[0], single[0], states[2], single[1], single[2]))
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.1", "0.1", "0.1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["contacts"]) == len(motions.planar().bounces)
    assert found["consistency_warnings"] == []
    (row,) = [row for row in found["parameters"] if row["parameter"] == "m/J"]
    assert row["value"] == pytest.approx(INERTIA, rel=1e-5)


def test_a_value_that_is_no_number_is_told_as_that_alone(states, tmp_path, capsys):
    broken = states[4].copy()
    broken[100] = numpy.nan
    foreign_bag.write_odometry(tmp_path / "bag", (*states[:4], broken))
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.1", "0.1", "0.1"]) == 2
    error = capsys.readouterr().err
    assert "angular_velocity of sample 100 is not finite" in error
    assert "stamp of another" not in error


def test_rounding_is_not_taken_from_values_that_hardly_change():
    """Rounding of 1e-16 about 0 is no multiple of 1 m/s, and a constant none of anything."""
    random = numpy.random.default_rng(0)
    small, constant = 1e-16 * random.normal(size=100), numpy.full(100, 0.5)
    decimals = numpy.round(random.normal(size=100), 3)
    silent = numpy.column_stack([small, constant, random.normal(size=100)])
    rounded = numpy.column_stack([small, constant, decimals])
    found = roundings(BodyStates(numpy.arange(100.0), silent, numpy.tile(numpy.eye(3), (100, 1, 1)), rounded, silent))
    assert found == (0.0, 0.0, pytest.approx(1e-3 / numpy.sqrt(12.0)), 0.0)
