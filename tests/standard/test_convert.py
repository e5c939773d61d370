"""Which standard topics a run has, what is made of a message, and the markers."""

import numpy
import pytest
from tests.standard.records import axle_of, hertz_patch, motion_of

from contact_sim_pkg.records.messages import ContactForce, RoadPatch
from contact_sim_pkg.run.outputs import wrench_of
from contact_sim_pkg.standard.convert import Converter, sample_stamps
from contact_sim_pkg.standard.messages import encoded, store
from contact_sim_pkg.standard.topics import standard_topics

CAR = (
    "bench/scene", "road/patch", "tire/force", "tire/wrench", "tire/patch", "tire/axle", "seat/force", "seat/wrench",
    "seat/patch", "bench/motion", "bench/energy",
)  # fmt: skip
SCENE = {"rig": "car", "travel": {"speed": 15.0}, "effects": {"tire": {"inflation": {"size": "205/55 R16"}}}}
BODIES = ("wheel_z", "body_z", "seat_frame_z", "occupant1_z")
STAMP = 40_000_000


def made(converter, source, record, *wanted, **options):
    return [*converter.convert(source, STAMP, record, wanted, **options)]


def test_a_run_has_the_topics_that_its_own_can_be_shown_as():
    assert set(standard_topics(["tire/force", "tire/patch", "bench/cost"])) == {
        f"view/tire/{name}" for name in ("load", "approach", "pressure", "cloud", "peak_pressure", "area")
    }
    assert {"/tf", "view/markers", "view/joints"} == set(standard_topics(["bench/motion"]))
    assert not [name for name in standard_topics(["bench/motion"]) if "imu" in name]
    assert standard_topics(["bench/cost", "somebody/elses"]) == {}


def test_only_what_is_wanted_is_made():
    converter = Converter(CAR, SCENE)
    assert made(converter, "tire/patch", hertz_patch()) == []
    assert [each.topic for each in made(converter, "tire/patch", hertz_patch(), "view/tire/area", "/tf")] == [
        "view/tire/area"
    ]


def test_scalars_are_the_fields_of_their_message_at_the_shown_samples():
    converter = Converter(CAR)
    force = ContactForce(
        block=4, sample_period=1e-3, normal=numpy.arange(10.0), tangential=numpy.zeros(10), approach=1e-3 * numpy.arange(10),
        effective_height=numpy.zeros(10),
    )  # fmt: skip
    found = made(converter, "tire/force", force, "view/tire/load", "view/tire/approach", samples=[0, 7])
    assert [(each.topic, each.stamp, each.message.data) for each in found] == [
        ("view/tire/load", STAMP, 0.0), ("view/tire/approach", STAMP, 0.0),
        ("view/tire/load", STAMP + 7_000_000, 7.0), ("view/tire/approach", STAMP + 7_000_000, 7e-3),
    ]  # fmt: skip
    patch = hertz_patch()
    found = made(converter, "tire/patch", patch, "view/tire/peak_pressure", "view/tire/area")
    assert [each.message.data for each in found] == [patch.peak, patch.area]


def test_the_force_on_the_axle_is_a_wrench_at_the_wheel():
    converter = Converter(CAR)
    (each,) = made(converter, "tire/axle", axle_of(moment_z=numpy.full(10, 3.0)), "view/tire/axle", samples=[2])
    force, torque = each.message.wrench.force, each.message.wrench.torque
    assert (force.x, force.y, force.z, torque.x, torque.y, torque.z) == (-12.0, 0.0, 4000.0, 0.0, 0.0, 3.0)
    assert each.message.header.frame_id == "wheel"
    assert sample_stamps(axle_of(), STAMP)[2] == each.stamp == STAMP + 2_000_000


def markers(converter):
    (each,) = made(converter, "bench/motion", motion_of(BODIES), "view/markers")
    return {marker.ns: marker for marker in each.message.markers if marker.ns != "force"}, {
        marker.header.frame_id: marker for marker in each.message.markers if marker.ns == "force"
    }


def test_an_arrow_begins_at_the_centre_of_pressure_of_its_wrench():
    converter = Converter(CAR, SCENE)
    made(
        converter, "tire/wrench", wrench_of((100.0, 0.0, 4000.0), (0.01 * 4000.0, -0.02 * 4000.0, 0.0)), "view/markers"
    )
    _, arrows = markers(converter)
    tail, tip = arrows["tire_contact"].points
    assert (tail.x, tail.y, tail.z) == pytest.approx((0.02, 0.01, 0.0))
    assert (tip.x - tail.x, tip.y - tail.y, tip.z) == pytest.approx((0.02, 0.0, 0.8))  # 1 m: 5 kN
    made(converter, "tire/wrench", wrench_of((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), "view/markers")
    tail, tip = markers(converter)[1]["tire_contact"].points
    assert (tail.x, tip.x, tip.z) == (0.0, 0.0, 0.0)


def test_the_line_of_the_road_holds_its_highest_bump():
    height = numpy.zeros((400, 5), numpy.float32)
    height[137, 2], height[20, 0] = 0.05, 0.9  # in the middle of the track, and beside it
    road = RoadPatch(
        block=4, travel_start=0.0, travel_end=0.1, first_row=-100, cell_x=0.005, cell_y=0.01, height=height
    )
    converter = Converter(CAR, SCENE)
    made(converter, "road/patch", road, "view/markers")
    line = markers(converter)[0]["road"]
    highest = max(line.points, key=lambda point: point.z)
    assert (highest.x, highest.z) == pytest.approx((37 * 0.005, 0.05))
    assert len(line.points) <= 50
    assert line.header.frame_id == "bench"


def test_the_markers_show_the_tire_in_its_size_and_stay_the_same_objects():
    converter = Converter(CAR, SCENE)
    first = [marker for group in markers(converter) for marker in group.values()]
    shown = markers(converter)[0]
    size = shown["tire"].scale  # 205/55 R16: 16 inches and twice 55 % of 205 mm
    assert (size.x, size.y, size.z) == pytest.approx((0.6319, 0.6319, 0.205))
    assert all(
        one is other for one, other in zip(first, [m for g in markers(converter) for m in g.values()], strict=True)
    )
    assert set(shown) == {"tire", "seat", "occupant"}
    identifiers = [(marker.ns, marker.id) for marker in first]
    assert len(set(identifiers)) == len(identifiers)


def test_every_message_can_be_read_as_its_topic_states():
    converter = Converter(CAR, SCENE)
    records = {
        "tire/patch": hertz_patch(),
        "seat/patch": hertz_patch(),
        "tire/axle": axle_of(),
        "bench/motion": motion_of(BODIES),
    }
    seen = set()
    for source, record in records.items():
        for each in made(converter, source, record, *converter.topics):
            data = encoded(each.message)
            assert len(data) % 4 == 0
            assert data[:4] == b"\0\1\0\0"
            store().deserialize_cdr(data, converter.topics[each.topic].type)
            seen.add(converter.topics[each.topic].type.rpartition("/")[2])
    assert seen == {"Image", "PointCloud2", "Float64", "WrenchStamped", "Imu", "JointState", "MarkerArray", "TFMessage"}
