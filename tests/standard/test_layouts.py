"""Every topic, field and frame that a shipped layout names is in a bag of a car, exported as standard messages."""

import json
import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest
from rosbags.interfaces import Nodetype
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML
from tests.bench_process import PACKAGE

from contact_sim_pkg.bag.reader import open_bag

CONFIG = PACKAGE / "config"
RVIZ_CLASSES = {  # of rviz_default_plugins/plugins_description.xml, with the message that each takes
    "Grid": None,
    "TF": "tf2_msgs/msg/TFMessage",
    "MarkerArray": "visualization_msgs/msg/MarkerArray",
    "PointCloud2": "sensor_msgs/msg/PointCloud2",
    "Image": "sensor_msgs/msg/Image",
    "Wrench": "geometry_msgs/msg/WrenchStamped",
}
JAZZY = get_typestore(Stores.ROS2_JAZZY)


class Exported:
    """What a foreign reader finds in the exported bag."""

    def __init__(self, path):
        self.types, self.first = {}, {}
        with Reader(path) as reader:
            for connection, _, data in reader.messages():
                self.types[connection.topic] = connection.msgtype
                self.first.setdefault(connection.topic, JAZZY.deserialize_cdr(data, connection.msgtype))
        transforms = self.first["/tf"].transforms
        self.frames = {each.child_frame_id for each in transforms} | {each.header.frame_id for each in transforms}

    def holds(self, topic, fields):
        """Whether a topic has a number at the end of these fields."""
        if topic not in self.types:
            return False
        return is_number(self.types[topic], fields)

    def cloud_fields(self, topic):
        return {field.name for field in self.first[topic].fields}


def is_number(type_name, fields):
    definitions = dict(JAZZY.fielddefs[type_name][1])
    if not fields or fields[0] not in definitions:
        return False
    kind, detail = definitions[fields[0]]
    if kind is Nodetype.NAME:
        return is_number(detail, fields[1:])
    return kind is Nodetype.BASE and len(fields) == 1 and detail[0] != "string"


@pytest.fixture(scope="module")
def exported(exported_car):
    return Exported(exported_car)


def of_foxglove(layout):
    """Topics with the fields below them, of plots; topics alone; colour fields of clouds; frames."""
    plots, topics, colours, frames = [], [], [], []
    for panel in layout["configById"].values():
        for path in panel.get("paths", []):
            topic, *fields = path["value"].split(".")
            plots.append((topic, fields))
        topics += [*panel.get("topics", {}), *([panel["imageMode"]["imageTopic"]] if panel.get("imageMode") else [])]
        colours += [
            (name, each["colorField"]) for name, each in panel.get("topics", {}).items() if "colorField" in each
        ]
        frames += [panel["followTf"]] if "followTf" in panel else []
        frames += [layer["frameId"] for layer in panel.get("layers", {}).values()]
    return plots, topics, colours, frames


def test_the_foxglove_layout_names_what_is_there(exported):
    layout = json.loads((CONFIG / "bench_foxglove.json").read_text())
    plots, topics, colours, frames = of_foxglove(layout)
    assert len(plots) > 5
    assert [each for each in plots if not exported.holds(*each)] == []
    assert set(topics) <= set(exported.types)
    assert all(field in exported.cloud_fields(topic) for topic, field in colours)
    assert set(frames) <= exported.frames
    panels = re.findall(r'"((?:Plot|Image|3D)!\w+)"', json.dumps(layout["layout"]))
    assert sorted(panels) == sorted(layout["configById"])


def test_the_plotjuggler_layout_names_what_is_there(exported):
    """A layout of version 4: a curve is a topic and the field below it, as its reader of ROS messages flattens them."""
    root = ElementTree.parse(CONFIG / "bench_plotjuggler.pj4.xml").getroot()
    assert root.attrib == {"format": "PlotJuggler", "pj4_version": "4", "binding": "generic"}
    curves = [(curve.get("topic"), curve.get("field")) for curve in root.iter("curve")]
    assert len(curves) > 10
    joints = {("/view/joints", f"/{name}/position") for name in exported.first["/view/joints"].name}  # a field a joint
    assert [
        curve for curve in curves if curve not in joints and not exported.holds(curve[0], curve[1].split("/")[1:])
    ] == []
    assert not [curve for curve in root.iter("curve") if "name" in curve.attrib]  # the key of one session's data


def test_the_plotjuggler_layout_has_the_form_of_version_4():
    """What its loader refuses: another number of containers or parts than stated, two things in one area."""
    root = ElementTree.parse(CONFIG / "bench_plotjuggler.pj4.xml").getroot()
    (tabs,) = root.findall("tabbed_widget")
    assert tabs.find("Tab") is not None
    for tab in tabs.findall("Tab"):
        assert tab.get("tab_name")
        assert [part.tag for part in tab] == ["Container"] * int(tab.get("containers"))
        (splitter,) = tab.find("Container")
        sizes = [float(each) for each in splitter.get("sizes").split(";")]
        assert splitter.get("orientation") in "-|"
        assert len(splitter) == int(splitter.get("count")) == len(sizes)
        assert sum(sizes) == pytest.approx(1.0, abs=1e-6)
        assert all(area.tag == "DockArea" and [part.tag for part in area] == ["plot"] for area in splitter)
    named = [each.get("id") for each in root.iter() if "id" in each.attrib]
    assert len(named) == len(set(named))


def test_the_rviz_layout_names_what_is_there(exported):
    manager = YAML(typ="safe").load((CONFIG / "bench.rviz").read_text())["Visualization Manager"]
    for display in manager["Displays"]:
        kind = display["Class"].removeprefix("rviz_default_plugins/")
        assert kind in RVIZ_CLASSES
        if "Topic" in display:
            topic = display["Topic"]["Value"]
            assert exported.types[topic] == RVIZ_CLASSES[kind]
            if "Channel Name" in display:
                assert display["Channel Name"] in exported.cloud_fields(topic)
    frames = [manager["Global Options"]["Fixed Frame"], manager["Views"]["Current"]["Target Frame"]]
    frames += [display["Reference Frame"] for display in manager["Displays"] if "Reference Frame" in display]
    assert set(frames) <= exported.frames


@pytest.mark.parametrize(
    ("topic", "fields"),
    [("/tire/wrench", ["wrench", "force", "w"]), ("/tire/wrenches", ["wrench"]), ("/tire/wrench", ["wrench"])],
)
def test_a_wrong_topic_or_field_is_seen(exported, topic, fields):
    assert not exported.holds(topic, fields)


def test_the_frames_of_all_messages_are_in_the_tree(exported):
    named = {
        message.header.frame_id for message in exported.first.values() if hasattr(message, "header")
    } | {marker.header.frame_id for marker in exported.first["/view/markers"].markers}  # fmt: skip
    assert named <= exported.frames


def test_the_documented_commands_name_the_shipped_files():
    text = (PACKAGE.parent / "docs" / "view.md").read_text()
    commands = "".join(re.findall(r"```bash\n(.*?)```", text, re.DOTALL)).splitlines()
    for tool, name in (("rviz2", "rviz"), ("docker run", "foxglove.json"), ("plotjuggler", "plotjuggler.pj4.xml")):
        (file,) = CONFIG.glob(f"bench*{name}")
        assert len([line for line in commands if line.startswith(tool) and f"$CONFIG/{file.name}" in line]) == 1


def test_stamps_of_a_topic_rise(exported_car):
    times = {}
    for message in open_bag(exported_car).messages():
        times.setdefault(message.topic, []).append(message.log_time)
    assert all(first < second for stamps in times.values() for first, second in pairwise(stamps))
