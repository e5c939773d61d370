"""The installed types of the standard messages are those that the bytes are made for."""

import json
from pathlib import Path

import pytest
from tests.bench_process import needs_ros

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.standard.messages import type_hash
from contact_sim_pkg.standard.topics import standard_topics

TYPES = sorted({topic.type for topic in standard_topics(list(TOPICS)).values()})


@needs_ros
@pytest.mark.parametrize("type_name", TYPES)
def test_an_installed_type_has_the_hash_of_jazzy(type_name):
    """tf2_msgs too, which the workspace builds where ROS 2 comes without it."""
    from ament_index_python import get_package_share_directory

    package, _, name = type_name.split("/")
    description = json.loads((Path(get_package_share_directory(package)) / "msg" / f"{name}.json").read_text())
    hashes = {each["type_name"]: each["hash_string"] for each in description["type_hashes"]}
    assert hashes[type_name] == type_hash(type_name)
