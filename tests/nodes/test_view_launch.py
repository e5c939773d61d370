"""The launch file of the view, by a stand-in for launch: what it starts, what it refuses, how it ends."""

import os
import runpy
import sys
import types
from types import SimpleNamespace

import pytest
from tests.bench_process import PACKAGE

from contact_sim_pkg.python_process import SETTINGS

MODULES = (
    "launch", "launch.actions", "launch.events", "launch.events.process", "launch.substitutions", "launch_ros",
    "launch_ros.actions", "ament_index_python", "ament_index_python.packages",
)  # fmt: skip


class Made:
    """What the stand-in makes of every class of launch: its arguments."""

    def __init__(self, *arguments, **named):
        self.arguments, self.named = arguments, named

    def perform(self, context):
        return context.given[self.arguments[0]]


class AbsentError(LookupError):
    """Of the index of packages."""


@pytest.fixture
def launch_file(monkeypatch):
    """Names of the launch file; `installed` are the packages that the index has."""
    installed = {"contact_sim_pkg": str(PACKAGE)}

    def share(package):
        if package not in installed:
            raise AbsentError(package)
        return installed[package]

    for name in MODULES:
        module = types.ModuleType(name)
        module.__getattr__ = lambda _: Made
        monkeypatch.setitem(sys.modules, name, module)
    index = sys.modules["ament_index_python.packages"]
    index.get_package_share_directory, index.PackageNotFoundError = share, AbsentError
    names = runpy.run_path(str(PACKAGE / "launch" / "view.launch.py"))
    return SimpleNamespace(**names, installed=installed)


def context(launch_file, **given):
    defaults = {name: each[0] for name, each in launch_file.ARGUMENTS.items()}
    return SimpleNamespace(given={**defaults, **given}, launch_configurations=given, is_shutdown=False)


def test_it_starts_the_view_and_rviz_on_request_with_the_shipped_layout(launch_file):
    declared = launch_file.generate_launch_description().arguments[0]
    assert {each.arguments[0] for each in declared if each.arguments} == {*launch_file.ARGUMENTS, *SETTINGS}
    (view,) = launch_file.start_nodes(context(launch_file, namespace="rig1"))
    assert view.named["executable"] == "bench_view"
    assert view.named["namespace"] == "rig1"
    assert view.named["parameters"] == [{"rate": 20.0, "supervisor": os.getpid()}], "it ends with the launch"
    launch_file.installed["rviz2"] = "/opt/ros/jazzy/share/rviz2"
    _, rviz = launch_file.start_nodes(context(launch_file, rviz="true"))
    assert rviz.named["executable"] == "rviz2"
    assert rviz.named["arguments"] == ["-d", str(PACKAGE / "config" / "bench.rviz")]
    assert rviz.named["parameters"] == [{"use_sim_time": True}]


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"rviz": "true"}, "rviz:=true needs rviz2, which is not installed"),
        ({"rate": "fast"}, "rate:=fast is no number"),
        ({"ratee": "10"}, "ratee:= is no argument of this launch file; did you mean rate:="),
    ],
)
def test_what_cannot_be_is_refused_before_a_node_is_started(launch_file, given, sentence):
    with pytest.raises((RuntimeError, ValueError), match=sentence):
        launch_file.start_nodes(context(launch_file, **given))


def test_a_view_that_ends_badly_is_an_error_of_the_launch(launch_file):
    tried = context(launch_file)
    with pytest.raises(RuntimeError, match="bench_view ended with status 2"):
        launch_file.on_exit(SimpleNamespace(returncode=2), tried)
    assert launch_file.on_exit(SimpleNamespace(returncode=0), tried) is None
    tried.is_shutdown = True
    assert launch_file.on_exit(SimpleNamespace(returncode=-2), tried) is None
