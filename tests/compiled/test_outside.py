"""Kernels of other packages: an edit of any of their files is seen, and ours stay warm beside it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.compiled.test_jit import Start

PLUGIN = {
    "other/__init__.py": "",
    "other/constants.py": "FACTOR = 7.0\n",
    "other/deep.py": """
from constants_of_a_third import OFFSET
from contact_sim_pkg.compiled.jit import kernel
from other.constants import FACTOR

@kernel
def scaled(value):
    return FACTOR * value + OFFSET
""",
    "other/effect.py": """
from typing import NamedTuple
from contact_sim_pkg.compiled.jit import entry, kernel_overload
from contact_sim_pkg.laws.slot import acted
from .deep import scaled

class Spring(NamedTuple):
    value: float

@kernel_overload(acted)
def _spring(effect, value):
    if getattr(effect, "instance_class", None) is Spring:
        return lambda effect, value: scaled(value) + effect.value

@entry
def own(value):
    return scaled(value)
""",
    "constants_of_a_third.py": "OFFSET = 0.0\n",
}

SLOT = """
from contact_sim_pkg.compiled.jit import entry

def acted(effect, value):
    raise NotImplementedError

@entry
def force(effect, value):
    return acted(effect, value)

@entry
def force_of_held(held, value):
    return acted(held.value, value)
"""

PROGRAM = """
import json
import numpy
from contact_sim_pkg.laws.caller import total
from contact_sim_pkg.compiled.held import hold
from contact_sim_pkg.laws.slot import force, force_of_held
from other.effect import Spring, own
answer = {"ours": total(numpy.ones(3)), "own": own(2.0), "acted": force(Spring(1.0), 2.0)}
answer["held"] = force_of_held(hold(Spring(1.0)), 2.0)
hits = {"ours": total, "own": own, "acted": force, "held": force_of_held}
print(json.dumps({**answer, "hits": {name: sum(each.stats.cache_hits.values()) for name, each in hits.items()}}))
"""


@pytest.fixture
def plugin(tmp_path):
    """Our small package with a slot, and beside it another's package that acts there."""
    start = Start(tmp_path)
    (start.laws / "slot.py").write_text(SLOT)
    folder = tmp_path / "elsewhere"
    for name, text in PLUGIN.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)

    def run():
        path = f"{start.package.parent}:{folder}"
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM], env=start.environment(PYTHONPATH=path), cwd=tmp_path, check=True,
            capture_output=True, text=True,
        )  # fmt: skip
        return json.loads(done.stdout)

    return folder, run, start


def directories(start) -> set[Path]:
    return {path for path in start.cache.iterdir() if path.is_dir()}


@pytest.mark.parametrize(
    ("file", "before", "after", "own", "acted"),
    [
        ("other/constants.py", "7.0", "16.0", 32.0, 33.0),
        ("other/deep.py", "* value", "* value * value", 28.0, 29.0),
        ("constants_of_a_third.py", "0.0", "0.5", 14.5, 15.5),
    ],
)
def test_an_edit_in_any_file_of_a_plug_in_is_seen_and_ours_stay_warm(plugin, file, before, after, own, acted):
    """Its own kernels and ours that were compiled for its types, held ones too; the expected numbers by hand."""
    folder, run, _ = plugin
    warm = {"ours": 1, "own": 1, "acted": 1, "held": 1}
    assert run() == {"ours": 6.0, "own": 14.0, "acted": 15.0, "held": 15.0, "hits": dict.fromkeys(warm, 0)}
    assert run()["hits"] == warm
    (folder / file).write_text((folder / file).read_text().replace(before, after))
    edited = {"ours": 1, "own": 0, "acted": 0, "held": 0}
    assert run() == {"ours": 6.0, "own": own, "acted": acted, "held": acted, "hits": edited}


def test_old_directories_are_pruned_by_set(plugin):
    """Ours stays whatever often a plug-in is edited, and of the plug-in's sets three stay."""
    folder, run, start = plugin
    for number in range(6):
        for path in directories(start) if number else ():
            os.utime(path, (1e9 + number, 1e9 + number))  # a day passes; ours is used again
        (folder / "other/constants.py").write_text(f"FACTOR = {number}.0\n")
        assert run()["own"] == 2.0 * number
    names = [path.name.partition(".") for path in directories(start)]
    assert [dot for _, dot, _ in names].count("") == 1
    assert len(names) == 1 + 3
