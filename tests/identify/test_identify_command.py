"""`bench identify` on bags of others and of ours."""

import json

import numpy
import pytest
from tests.identify import foreign_bag, motions

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.identify.readers.body_states import read_body_states
from contact_sim_pkg.records.messages import BodyMotion

BOX = ["--box", "0.1", "0.1", "0.1"]


def reported(capsys, *arguments):
    """What the command prints as JSON, its parameters by name."""
    assert main(["identify", *map(str, arguments), *BOX, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    return facts, {row["parameter"]: row for row in facts["parameters"]}


def refused(capsys, *arguments):
    """The sentence with which the command ends with 2."""
    assert main(["identify", *map(str, arguments)]) == 2
    text = capsys.readouterr().err.strip()
    assert "Traceback" not in text
    return text


def write_bench_motion(path, record):
    """`bench/motion` in blocks of 10 ms: a planar body."""
    with_pitch = numpy.arctan2(record.rotation[:, 0, 2], record.rotation[:, 0, 0])
    rows = numpy.stack([record.position[:, 0], record.position[:, 2], numpy.unwrap(with_pitch)])
    rates = numpy.stack([record.velocity[:, 0], record.velocity[:, 2], record.angular_velocity[:, 1]])
    writer = BagWriter(path, recorded_topics(("bench/motion",)), {})
    for block in range(len(record.time) // 10):
        part = slice(10 * block, 10 * block + 10)
        motion = BodyMotion(
            block=block,
            sample_period=1e-3,
            bodies=("block_x", "block_z", "block_pitch"),
            position=rows[:, part],
            velocity=rates[:, part],
            acceleration=numpy.zeros((3, 10)),
        )
        stamp = block * 10_000_000
        writer.write("bench/motion", stamp, encode(motion, stamp))
    writer.close()


def test_odometry_of_others_gives_inertia_impulses_and_what_cannot_be_known(tmp_path, capsys):
    record = motions.planar()
    foreign_bag.write_odometry(tmp_path / "bag", motions.states_of(record))
    facts, rows = reported(capsys, tmp_path / "bag", "--plot", tmp_path / "picture.png")
    assert rows["m/J"]["value"] == pytest.approx(600.0, rel=1e-9)
    assert rows["m/J"]["identified"] is True
    assert "mass is not identifiable without an external force" in facts["not_identifiable"][0]
    assert len(facts["contacts"]) == len(record.bounces)
    for contact, bounce in zip(facts["contacts"], record.bounces, strict=True):
        assert contact["normal_impulse_over_mass_m_s"] == pytest.approx(bounce.impulse[2] / motions.MASS, rel=1e-9)
    assert (tmp_path / "picture.png").stat().st_size > 20_000


@pytest.mark.parametrize("frame", ["map", "base_link"])
def test_pose_and_twist_of_others_are_read_in_either_frame(tmp_path, capsys, frame):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", motions.states_of(motions.planar()), frame)
    assert reported(capsys, tmp_path / "bag")[1]["m/J"]["value"] == pytest.approx(600.0, rel=1e-9)


def test_a_force_given_as_option_or_as_topic_tells_the_mass(tmp_path, capsys):
    force = (1.3, 0.0, 0.7)
    states = motions.states_of(motions.planar(0.6, force))
    pushes = [(time, force, (0.0, 0.0, 0.0)) for time in states.time]
    foreign_bag.write_pose_and_twist(tmp_path / "bag", states, pushes=pushes)
    for known in (("--force", *force), ("--force-topic", "/push")):
        rows = reported(capsys, tmp_path / "bag", *known)[1]
        assert rows["m"]["value"] == pytest.approx(motions.MASS, rel=1e-9)
        assert rows["J"]["value"] == pytest.approx(motions.MASS * motions.SIDE**2 / 6.0, rel=1e-9)


@pytest.mark.parametrize(
    ("turn", "normal", "weight"),
    [
        ([[1, 0, 0], [0, 0, 1], [0, -1, 0]], ("0", "1", "0"), ("0", "-9.81", "0")),
        ([[0, 1, 0], [1, 0, 0], [0, 0, -1]], ("0", "0", "-1"), ("0", "0", "9.81")),
    ],
    ids=["y up", "north east down"],
)
def test_a_weight_given_as_force_stands_for_gravity_and_fixes_the_mass(tmp_path, capsys, turn, normal, weight):
    states = motions.states_of(motions.planar())
    turned = [field @ numpy.transpose(turn) for field in (states.position, states.velocity, states.angular_velocity)]
    rotation = numpy.array(turn, dtype=float) @ states.rotation
    foreign_bag.write_odometry(tmp_path / "bag", (states.time, turned[0], rotation, *turned[1:]))
    rows = reported(capsys, tmp_path / "bag", "--gravity", "0", "--normal", *normal, "--force", *weight)[1]
    assert rows["m"]["value"] == pytest.approx(1.0, rel=1e-9)  # put in; the square has 1.3 kg
    assert rows["J"]["value"] == pytest.approx(1.0 / 600.0, rel=1e-9)


def test_a_bag_of_the_bench_is_read_without_naming_a_topic(tmp_path, capsys):
    write_bench_motion(tmp_path / "bag", motions.planar())
    assert reported(capsys, tmp_path / "bag")[1]["m/J"]["value"] == pytest.approx(600.0, rel=1e-9)
    assert read_body_states(tmp_path / "bag").frame == "bench"


def test_the_table_names_modes_and_what_is_not_known(tmp_path, capsys):
    foreign_bag.write_odometry(tmp_path / "bag", motions.states_of(motions.planar()))
    assert main(["identify", str(tmp_path / "bag"), *BOX]) == 0
    text = capsys.readouterr().out
    for words in (
        "m/J",
        "600",
        "Not identifiable",
        "without an external force",
        "stick",
        "slide",
        "noise of the samples",
    ):
        assert words in text


def test_table_and_json_tell_how_the_bag_was_read(tmp_path, capsys):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", motions.states_of(motions.planar()), every=2)
    lines = reported(capsys, tmp_path / "bag")[0]["reading"]
    assert "the twist of /twist is read in world axes" in lines[0]
    assert "have no twist of the same stamp" in lines[1]
    assert main(["identify", str(tmp_path / "bag"), *BOX]) == 0
    text = capsys.readouterr().out
    assert all(line in text for line in lines)


def test_axes_are_told_where_the_motion_is_refused_too(tmp_path, capsys):
    short = tuple(field[:3] for field in motions.states_of(motions.planar()))
    foreign_bag.write_odometry(tmp_path / "bag", short)
    text = refused(capsys, tmp_path / "bag", *BOX)
    assert "needs at least 4" in text
    assert "the twist of /odom is read in body axes" in text


def test_bad_input_ends_with_one_sentence(tmp_path, capsys):
    states = motions.states_of(motions.planar())
    bag = tmp_path / "bag"
    foreign_bag.write_odometry(bag, states)
    assert "cannot be opened: No such file" in refused(capsys, tmp_path / "nowhere", *BOX)
    assert "--box X Y Z" in refused(capsys, bag)
    assert "has no topic /other; of Odometry or PoseStamped it has /odom" in refused(
        capsys, bag, *BOX, "--topic", "/other"
    )
    assert "lengths above 0 m" in refused(capsys, bag, "--box", "0.1", "0", "0.1")
    assert "is not a valid float" in refused(capsys, bag, *BOX, "--force", "a", "0", "0")
    assert "goes with --force-topic" in refused(capsys, bag, *BOX, "--force", "1", "0", "0", "--force-axes", "body")
    assert "normal that is not zero" in refused(capsys, bag, *BOX, "--normal", "0", "0", "0")
    assert "gravity acts downward" in refused(capsys, bag, *BOX, "--gravity", "-9.81")
    assert "noise of the rotation is 0 to 1e+06" in refused(capsys, bag, *BOX, "--noise", "1", "-1", "1", "1")
    assert "is no name of a picture" in refused(capsys, bag, *BOX, "--plot", tmp_path / "picture.qqq")
    (tmp_path / "corners.csv").write_text("0, 0, 0\n1, two, 3\n")
    assert "line 2" in refused(capsys, bag, "--hull", tmp_path / "corners.csv")
    (tmp_path / "text.mcap").write_text("this is no bag")
    assert "text.mcap is no bag" in refused(capsys, tmp_path / "text.mcap", *BOX)
    (tmp_path / "folder").mkdir()
    assert "holds no bag files" in refused(capsys, tmp_path / "folder", *BOX)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--sphere", "1e300"], "from its centre of mass, not 1e+300 m"),
        (["--box", "1e-300", "1e-300", "1e-300"], "from its centre of mass, not 5e-301 m"),
        ([*BOX, "--force", "1e300", "0", "0"], "the external force needs three components of at most 1e+12"),
        (
            [*BOX, "--force", "1e-300", "0", "0"],
            "the external force is at most 1e-300 (N, N m): give one of 1e-09 or more",
        ),
        ([*BOX, "--ground", "1e300"], "a height of at most 1e+09 m"),
        ([*BOX, "--gravity", "1e300"], "gravity acts downward and is 0 to 1e+06"),
        ([*BOX, "--friction", "inf"], "a friction coefficient is 0 to 1e+06"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_numbers_beyond_all_bodies_are_refused_before_anything_overflows(bag_of_a_square, capsys, options, said):
    assert said in refused(capsys, bag_of_a_square, *options)


@pytest.fixture(scope="module")
def bag_of_a_square(tmp_path_factory):
    path = tmp_path_factory.mktemp("square") / "bag"
    foreign_bag.write_odometry(path, motions.states_of(motions.planar()))
    return path


def test_a_pose_without_its_twist_is_refused(tmp_path, capsys):
    foreign_bag.write_pose_and_twist(tmp_path / "bag", motions.states_of(motions.planar()), late=0.0004)
    assert "twist of the same stamp" in refused(capsys, tmp_path / "bag", *BOX)


@pytest.mark.parametrize("jump", [0.3, 3.0])
def test_a_jump_of_the_position_in_a_bag_is_refused_by_sample_and_size(tmp_path, capsys, jump):
    states = motions.noisy(motions.states_of(motions.planar()), 1)
    states.position[400:, 0] += jump
    foreign_bag.write_odometry(tmp_path / "bag", states)
    sentence = refused(capsys, tmp_path / "bag", *BOX)
    assert f"the position jumps by {jump:g} m" in sentence
    assert "between samples 399 and 400" in sentence


def test_a_stamp_five_seconds_early_in_a_bag_is_refused(tmp_path, capsys):
    states = motions.noisy(motions.states_of(motions.planar()), 1)
    time = states.time + 10.0
    time[300] -= 5.0
    foreign_bag.write_odometry(tmp_path / "bag", states._replace(time=time))
    assert "stamp" in refused(capsys, tmp_path / "bag", *BOX)
