"""An exported bag against the recorded one, read by foreign readers: rosbags and the mcap library."""

import numpy
import pytest
from mcap.reader import make_reader
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML
from tests.bench_process import resolved
from tests.standard.records import axle_of

from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.wall_time import began_at, export_wall_time, wall_time_texts
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.standard.convert import sample_stamps
from contact_sim_pkg.standard.export import export_standard
from contact_sim_pkg.standard.places import places_of

JAZZY = get_typestore(Stores.ROS2_JAZZY)
BEGAN = 1_777_890_600_250_000_000  # 2026-05-04T10:30:00.250Z
G = 9.81


def read(path):
    """By topic: log time and message, as rosbags reads them."""
    found = {}
    with Reader(path) as reader:
        for connection, time, data in reader.messages():
            found.setdefault(connection.topic, []).append((time, JAZZY.deserialize_cdr(data, connection.msgtype)))
    return found


@pytest.fixture(scope="module")
def shown(exported_car):
    return read(exported_car)


@pytest.fixture(scope="module")
def recorded(recorded_car):
    return open_bag(recorded_car)


def stamp_of(message):
    return message.header.stamp.sec * 10**9 + message.header.stamp.nanosec


@pytest.mark.parametrize("contact", ["tire", "seat"])
def test_the_sum_of_each_image_times_the_area_of_a_cell_is_the_recorded_load(recorded, shown, contact):
    patches = dict(recorded.decoded(f"{contact}/patch"))
    images = shown[f"/view/{contact}/pressure"]
    assert len(images) == 6  # 0.3 s at 20 Hz
    for time, image in images:
        patch = patches[time]
        force = numpy.frombuffer(image.data, "<f4").sum(dtype=float) * patch.cell_x * patch.cell_y
        assert force == pytest.approx(patch.load, rel=1e-6)
        assert stamp_of(image) == time
    points = shown[f"/view/{contact}/cloud"][-1][1]
    pressure = numpy.frombuffer(points.data, "<f4").reshape(-1, 4)[:, 3]
    assert pressure.sum(dtype=float) * patch.cell_x * patch.cell_y == pytest.approx(patch.load, rel=1e-6)


def motion_at(recorded, body, field):
    """Of a coordinate by time [ns], at every sample."""
    found = {}
    for time, motion in recorded.decoded("bench/motion"):
        values = numpy.reshape(getattr(motion, field), (len(motion.bodies), motion.samples))[motion.bodies.index(body)]
        found.update({time + place * 1_000_000: value for place, value in enumerate(values)})
    return found


@pytest.mark.parametrize(("place", "body"), [("axle", "wheel_z"), ("floor", "body_z"), ("seat", "seat_frame_z")])
def test_an_imu_is_the_recorded_acceleration_and_gravity(recorded, shown, place, body):
    acceleration = motion_at(recorded, body, "acceleration")
    for time, imu in shown[f"/view/imu/{place}"]:
        assert imu.linear_acceleration.z == acceleration[time] + G
        assert imu.orientation_covariance[0] == -1.0


def test_the_frames_follow_the_motion_and_the_travel(recorded, shown):
    position = motion_at(recorded, "wheel_z", "position")
    radius = 0.5 * 16 * 0.0254 + 0.55 * 0.205  # 205/55 R16
    for time, tree in shown["/tf"]:
        frames = {each.child_frame_id: each.transform.translation for each in tree.transforms}
        assert frames["wheel"].z == pytest.approx(radius + position[time], abs=1e-12)
        assert frames["base_link"].x == pytest.approx(15.0 * time * 1e-9)  # 15 m/s


def test_a_higher_rate_gives_every_sample_of_a_series(recorded, tmp_path):
    export_standard(recorded, tmp_path / "std", rate=1000.0)
    found = read(tmp_path / "std")
    loads = [message.data for _, message in found["/view/tire/load"]]
    assert loads == numpy.concatenate([force.normal for _, force in recorded.decoded("tire/force")]).tolist()
    assert len(found["/view/tire/pressure"]) == recorded.count("tire/patch")


def test_wrenches_are_copied_and_definitions_stand_in_the_bag(recorded, exported_car):
    bag = open_bag(exported_car)
    assert [m.data for m in bag.messages("tire/wrench")] == [m.data for m in recorded.messages("tire/wrench")]
    assert bag.topics["/tf"].type_hash == "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
    for name in bag.topics:
        assert next(bag.decoded(name), None) is not None  # by the definition in the bag


def test_a_bag_with_nothing_to_show_is_refused(bare, tmp_path):
    empty = open_bag(bare.path.parent)
    empty.topics = {}
    with pytest.raises(BagError, match="no topic that a standard message shows"):
        export_standard(empty, tmp_path / "std")


def test_the_namespace_of_a_bag_is_kept_but_not_on_tf(recorded, tmp_path):
    names = ["tire/patch", "tire/wrench", "bench/motion"]
    with BagWriter(tmp_path / "rig1", recorded_topics(names, lambda name: f"/rig1/{name}"), reserve_bytes=0) as writer:
        for name in names:
            for message in recorded.messages(name):
                writer.write(name, message.log_time, message.data)
    export_standard(open_bag(tmp_path / "rig1"), tmp_path / "std")
    assert {"/rig1/view/tire/pressure", "/rig1/tire/wrench", "/tf"} <= set(read(tmp_path / "std"))


@pytest.mark.parametrize(
    "scene",
    [
        {"effects": 5},
        {"effects": {"tire": {"inflation": {"size": 3}}}},
        {"travel": {"points": "no"}},
        {"travel": {"speed": "x"}},
    ],
)
def test_a_scene_that_is_none_is_one_sentence(scene):
    with pytest.raises(BagError, match="does not say where its bodies are"):
        places_of(scene)


@pytest.mark.parametrize("period", [0.0, -1.0, float("nan"), 1e9])
def test_samples_at_no_distance_are_one_sentence(period):
    with pytest.raises(MessageError, match=r"samples .* s apart"):
        sample_stamps(axle_of()._replace(sample_period=period), 0)


def summary_of(path):
    with next(path.glob("*.mcap")).open("rb") as file:
        return make_reader(file).get_summary()


@pytest.fixture(scope="module")
def in_wall_time(recorded, tmp_path_factory):
    path = tmp_path_factory.mktemp("wall") / "car"
    export_wall_time(recorded, path, BEGAN)
    return path


def test_log_publish_summary_and_metadata_are_all_in_wall_time(recorded, in_wall_time):
    information = YAML(typ="safe").load((in_wall_time / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    first, last = BEGAN, BEGAN + recorded.end
    assert information["starting_time"]["nanoseconds_since_epoch"] == first
    assert information["files"][0]["starting_time"]["nanoseconds_since_epoch"] == first
    assert information["duration"]["nanoseconds"] == last - first
    statistics, chunks = summary_of(in_wall_time).statistics, summary_of(in_wall_time).chunk_indexes
    assert (statistics.message_start_time, statistics.message_end_time) == (first, last)
    assert min(chunk.message_start_time for chunk in chunks) == first
    assert max(chunk.message_end_time for chunk in chunks) == last
    with next(in_wall_time.glob("*.mcap")).open("rb") as file:
        found = [(message.log_time, message.publish_time) for _, _, message in make_reader(file).iter_messages()]
    assert sorted(found) == sorted((BEGAN + m.log_time, BEGAN + m.publish_time) for m in recorded.messages())


def test_a_player_that_seeks_to_the_start_of_the_metadata_plays_everything(recorded, in_wall_time):
    with Reader(in_wall_time) as reader:  # what a player does: seek to the start, and to the middle
        start = YAML(typ="safe").load((in_wall_time / "metadata.yaml").read_text())["rosbag2_bagfile_information"][
            "starting_time"
        ]["nanoseconds_since_epoch"]
        assert reader.start_time == start
        assert len([*reader.messages(start=start)]) == recorded.count()
        half = recorded.end // 2
        later = [*reader.messages(start=start + half)]
    assert len(later) == sum(message.log_time >= half for message in recorded.messages())
    with next(in_wall_time.glob("*.mcap")).open("rb") as file:
        assert len([*make_reader(file).iter_messages(starting_at=start)]) == recorded.count()


def test_header_stamps_stay_simulated_time_and_our_reader_gives_it_back(recorded, in_wall_time):
    bag = open_bag(in_wall_time)
    assert [*bag.messages()] == [*recorded.messages()]
    assert bag.end == recorded.end
    assert (bag.scene, bag.metadata["wall_time"]) == (recorded.scene, str(BEGAN))


def test_the_start_is_a_date_or_follows_from_the_file(recorded):
    assert began_at(recorded, "2026-05-04T10:30:00.250Z") == BEGAN
    assert began_at(recorded, "2026-05-04T12:30:00.250+02:00") == BEGAN
    assert began_at(recorded) == recorded.path.stat().st_mtime_ns - recorded.end
    for wrong in ("yesterday", "2026-13-01", "1960-01-01"):
        with pytest.raises(BagError, match="--begin"):
            began_at(recorded, wrong)


def test_standard_messages_can_be_in_wall_time_too(recorded, tmp_path):
    export_standard(recorded, tmp_path / "std", texts=wall_time_texts(BEGAN))
    times = {time for messages in read(tmp_path / "std").values() for time, _ in messages}
    assert min(times) == BEGAN


def test_the_command_writes_both_beside_the_bag_and_never_over_one(recorded_car, tmp_path, capsys):
    bag = tmp_path / "car"
    bag.mkdir()
    for name in ("car_0.mcap", "metadata.yaml"):
        (bag / name).write_bytes((recorded_car / name).read_bytes())
    assert main(["export", str(bag), "--ros-std", "--rate", "10"]) == 0
    assert main(["export", str(bag), "--wall-time", "--begin", "2026-05-04T10:30:00.250Z"]) == 0
    assert read(tmp_path / "car_std")["/view/tire/area"][-1][0] == 200_000_000
    assert summary_of(tmp_path / "car_wall").statistics.message_start_time == BEGAN
    capsys.readouterr()
    assert main(["export", str(bag), "--ros-std"]) == 2
    assert "exists already" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ([], "Missing --csv"),
        (["--csv", "--wall-time"], "--wall-time and --csv exclude each other"),
        (["--ros-std", "--begin", "2026-01-01"], "--begin needs --wall-time"),
        (["--wall-time", "--rate", "5"], "--rate needs --ros-std"),
        (["--ros-std", "--topic", "tire/force"], "--topic and --ros-std exclude each other"),
    ],
)
def test_options_that_do_not_fit_are_refused(recorded_car, capsys, options, sentence):
    assert main(["export", str(recorded_car), *options]) == 2
    assert sentence in capsys.readouterr().err


def test_tables_of_the_exported_bag_leave_out_what_has_none_and_say_so(exported_car, tmp_path, capsys):
    assert main(["export", str(exported_car), "--csv", "--out", str(tmp_path / "all")]) == 0
    printed = capsys.readouterr()
    assert "/view/markers has no fields of numbers or texts to write into a table; it is left out" in printed.err
    names = {path.name for path in (tmp_path / "all").iterdir()}
    assert {"view_tire_load.csv", "view_imu_seat.csv", "seat_wrench.csv"} <= names
    assert not {"view_markers.csv", "tf.csv"} & names

    named = ["--topic", "view/tire/load", "--topic", "view/markers"]
    assert main(["export", str(exported_car), "--csv", *named, "--out", str(tmp_path / "named")]) == 2
    assert "/view/markers has no fields of numbers" in capsys.readouterr().err
    assert not (tmp_path / "named").exists(), "refused before the first file"


def test_a_bag_is_never_overwritten(exported_car, capsys):
    assert main(["export", str(exported_car), "--ros-std", "--overwrite"]) == 2
    assert "--overwrite replaces tables; --ros-std writes a bag, which needs a new --out" in capsys.readouterr().err


def test_the_motion_of_a_seat_rig_without_a_tire_is_relative_to_its_floor_and_its_accelerations_are_not(tmp_path):
    """As `docs/view.md` says: the floor rests in its frame; the second derivative of the way of a body is its
    acceleration less that of the floor.
    """
    run_offline(resolved("seat_ride", "duration=1"), tmp_path / "bag")
    blocks = [message for _, message in open_bag(tmp_path / "bag").decoded("bench/motion")]
    bodies = blocks[0].bodies

    def rows(field):
        return numpy.concatenate([numpy.reshape(getattr(each, field), (len(bodies), -1)) for each in blocks], axis=1)

    floor, seat = bodies.index("floor_z"), bodies.index("seat_frame_z")
    accelerations = rows("acceleration")
    assert not rows("position")[floor].any()
    assert accelerations[floor].std() > 0.1
    # the mean of an acceleration over ten samples against the change of the velocity
    changes = numpy.diff(rows("velocity")[seat][::10]) / (10 * blocks[0].sample_period)

    def error(acceleration):
        means = [
            0.5 * (a[:-1] + a[1:]).mean() for a in (acceleration[k : k + 11] for k in range(0, 10 * len(changes), 10))
        ]
        return numpy.abs(changes - means).max()

    assert error(accelerations[seat] - accelerations[floor]) < 0.1 * error(accelerations[seat])
