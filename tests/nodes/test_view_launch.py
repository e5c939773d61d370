"""The launch file of the view, by a stand-in for launch: what it starts, and with which layout."""

import runpy
import sys
import types

import pytest
from tests.bench_process import PACKAGE

MODULES = (
    "launch", "launch.actions", "launch.conditions", "launch.substitutions", "launch_ros", "launch_ros.actions",
    "launch_ros.parameter_descriptions", "ament_index_python", "ament_index_python.packages",
)  # fmt: skip


class Made:
    """What the stand-in makes of every class of launch: its arguments."""

    def __init__(self, *arguments, **named):
        self.arguments, self.named = arguments, named


@pytest.fixture
def description(monkeypatch):
    for name in MODULES:
        module = types.ModuleType(name)
        module.__getattr__ = lambda _: Made
        monkeypatch.setitem(sys.modules, name, module)
    sys.modules["ament_index_python.packages"].get_package_share_directory = lambda _: str(PACKAGE)
    return runpy.run_path(str(PACKAGE / "launch" / "view.launch.py"))["generate_launch_description"]().arguments[0]


def test_it_starts_the_view_and_rviz_on_request_with_the_shipped_layout(description):
    nodes = {each.named["executable"]: each.named for each in description if "executable" in each.named}
    declared = {each.arguments[0]: each.named["default_value"] for each in description if "default_value" in each.named}
    assert set(nodes) == {"bench_view", "rviz2"}
    assert nodes["rviz2"]["condition"].arguments[0].arguments == ("rviz",)
    assert declared["rviz"] == "false"
    assert nodes["rviz2"]["arguments"] == ["-d", str(PACKAGE / "config" / "bench.rviz")]
    assert nodes["bench_view"]["parameters"][0]["rate"].named["value_type"] is float
    assert float(declared["rate"]) == 20.0
