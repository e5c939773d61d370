"""A valid scene of each rig, and the way to load it with changes."""

import json
from pathlib import Path

import pytest

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene

ELASTIC = {"normal_elastic": {}}
ROLLING = {"duration": 1.0, "travel": {"speed": 10.0}, "road": {"kind": "flat"}}
BASES = {
    "seat": {
        "rig": "seat",
        "duration": 1.0,
        "vibration": {"kind": "sine", "frequency": 4.0, "amplitude": 1.0},
        "effects": {"seat": ELASTIC},
    },
    "tire": {"rig": "tire", **ROLLING, "effects": {"tire": ELASTIC}},
    "backrest": {
        "rig": "backrest",
        "duration": 1.0,
        "vibration": {"kind": "sine", "frequency": 5.0, "amplitude": 1.0, "axis": "x"},
        "effects": {"backrest": ELASTIC},
    },
    "impact": {"rig": "impact", "duration": 1.0, "effects": {"impact": ELASTIC}},
    "roller": {"rig": "roller", "duration": 1.0, "effects": {"roller": ELASTIC}},
    "block": {"rig": "block", "duration": 1.0, "effects": {"block": {"rigid_contact": {}}}},
    "car": {"rig": "car", **ROLLING, "effects": {"tire": ELASTIC, "seat": ELASTIC}},
}


class SceneMaker:
    """Writes scene files (JSON is YAML 1.2) and loads them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def write(self, base, changes=None):
        """The base scene with values put in at dotted paths; a value of ... takes the key out."""
        data = json.loads(json.dumps(BASES[base]))
        for path, value in (changes or {}).items():
            *parents, last = path.split(".")
            section = data
            for key in parents:
                section = section.setdefault(key, {})
            if value is ...:
                del section[last]
            else:
                section[last] = value
        file = self.folder / f"{base}.yaml"
        file.write_text(json.dumps(data, indent=1, ensure_ascii=False), encoding="utf-8")
        return file

    def load(self, base, changes=None, overrides=()):
        """The validated scene."""
        return load_scene(self.write(base, changes), overrides)

    def faults(self, base, changes=None, overrides=()):
        """`where: sentence` of each fault; none where the scene is valid."""
        try:
            self.load(base, changes, overrides)
        except SceneError as error:
            return [f"{fault.where}: {fault.sentence}" for fault in error.faults]
        return []


@pytest.fixture(scope="session")
def maker(tmp_path_factory):
    """Makes and loads scenes."""
    return SceneMaker(tmp_path_factory.mktemp("scenes"))


@pytest.fixture(params=list(BASES))
def rig(request):
    """Each rig in turn."""
    return request.param
