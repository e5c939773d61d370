"""When set-up starts over and when it leaves things alone."""

from pathlib import Path

import pytest

from set_up import stamps
from set_up.underlay import Underlay


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A small project that the stamps are taken of."""
    for name in ("ros2_ws/requirements.txt", "ros2_ws/requirements-build-tools.txt", "ros2_ws/colcon_defaults.yaml"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(name)
    (tmp_path / "ros2_ws/set_up").mkdir()
    for name in (*stamps._RECIPE, "workspace.py"):
        (tmp_path / "ros2_ws/set_up" / name).write_text(name)
    for name in ("contact_msgs_defs/msg/A.msg", "contact_sim_pkg/setup.py", "contact_sim_pkg/launch/a.launch.py"):
        path = tmp_path / name
        path.parent.mkdir(parents=True)
        path.write_text(name)
    (tmp_path / "contact_sim_pkg/contact_sim_pkg").mkdir()
    monkeypatch.setattr(stamps, "PROJECT", tmp_path)
    monkeypatch.setattr(stamps, "WORKSPACE", tmp_path / "ros2_ws")
    monkeypatch.setattr(stamps, "LOCK", tmp_path / "ros2_ws/requirements.txt")
    monkeypatch.setattr(stamps, "BUILD_TOOLS_LOCK", tmp_path / "ros2_ws/requirements-build-tools.txt")
    monkeypatch.setattr(stamps, "COLCON_DEFAULTS", tmp_path / "ros2_ws/colcon_defaults.yaml")
    return tmp_path


PYTHON = Underlay(None, Path("/usr/bin/python3"))


@pytest.mark.parametrize("name", ["requirements.txt", "requirements-build-tools.txt", "set_up/relocation.py"])
def test_the_environment_is_made_anew_when_lock_or_recipe_change(project, name):
    before = stamps.environment_key(PYTHON)
    (project / "ros2_ws" / name).write_text("changed")
    assert stamps.environment_key(PYTHON) != before


def test_the_environment_is_made_anew_for_another_python_or_another_ros(project):
    keys = {
        stamps.environment_key(underlay)
        for underlay in (PYTHON, Underlay(None, Path("/opt/python3")), Underlay(Path("/opt/ros/jazzy"), PYTHON.python))
    }
    assert len(keys) == 3


def test_the_environment_is_made_anew_when_the_project_was_moved(project, monkeypatch):
    before = stamps.environment_key(PYTHON)
    monkeypatch.setattr(stamps, "PROJECT", project / "elsewhere")
    assert stamps.environment_key(PYTHON) != before


@pytest.mark.parametrize(
    "name", ["contact_msgs_defs/msg/A.msg", "contact_msgs_defs/msg/B.msg", "contact_sim_pkg/setup.py"]
)
def test_the_workspace_is_built_anew_when_a_message_or_packaging_changes(project, name):
    before = stamps.workspace_key("environment")
    (project / name).write_text("changed")
    assert stamps.workspace_key("environment") != before


def test_an_edited_source_or_launch_file_needs_no_build_and_a_new_launch_file_does(project):
    before = stamps.workspace_key("environment")
    (project / "contact_sim_pkg/contact_sim_pkg/module.py").write_text("new")
    (project / "contact_sim_pkg/launch/a.launch.py").write_text("edited")
    assert stamps.workspace_key("environment") == before
    (project / "contact_sim_pkg/launch/b.launch.py").write_text("new")
    assert stamps.workspace_key("environment") != before


def test_a_stamp_holds_for_its_own_key_only(tmp_path):
    stamp = tmp_path / "x.stamp"
    assert not stamps.holds(stamp, "abc")
    stamps.write(stamp, "abc")
    assert stamps.holds(stamp, "abc")
    assert not stamps.holds(stamp, "abd")
    assert [path.name for path in tmp_path.iterdir()] == ["x.stamp"]
