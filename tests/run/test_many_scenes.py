"""Many scenes in one process: each run closes compilation for itself alone."""

import subprocess
import sys

import pytest

RUN = """
import sys
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import forecast_of
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

for name in sys.argv[1:]:
    scene = resolve(load_scene(name, [set_value("duration=0.05")]))
    forecast_of(scene)
    outcome = run_offline(scene, None)
    print(name, outcome.blocks * scene.data["block_length"], outcome.failure)
"""
SCENES = ("seat_ride", "block_fall", "roller_flutter", "impact_rubber_drop", "seat_slap", "seat_ride")


@pytest.mark.fault("C4")
@pytest.mark.parametrize("scenes", [SCENES, SCENES[::-1]], ids=["forth", "back"])
def test_a_process_runs_any_number_of_scenes_in_any_order(scenes):
    """In a process of its own: here another test may have compiled what a scene needs."""
    done = subprocess.run([sys.executable, "-c", RUN, *scenes], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert [line.split() for line in done.stdout.splitlines()] == [[name, "0.05"] for name in scenes]
