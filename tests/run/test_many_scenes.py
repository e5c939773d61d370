"""Many scenes in one process: each run closes compilation for itself alone."""

import subprocess
import sys

import pytest

RUN = """
import sys
from contact_sim_pkg.compiled.jit import compiled_functions
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import forecast_of
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

for _ in range(2):
    for name in sys.argv[1:]:
        scene = resolve(load_scene(name, [set_value("duration=0.05")]))
        forecast_of(scene)
        outcome = run_offline(scene, None)
        print(name, outcome.blocks * scene.data["block_length"], outcome.failure)
    print("overloads", sum(len(function.overloads) for function in compiled_functions()))
"""
SCENES = ("seat_ride", "block_fall", "roller_flutter", "impact_rubber_drop", "seat_slap", "seat_ride")


@pytest.mark.fault("C4")
@pytest.mark.parametrize("scenes", [SCENES, SCENES[::-1]], ids=["forth", "back"])
def test_a_process_runs_any_number_of_scenes_in_any_order(scenes):
    """In a process of its own: here another test may have compiled what a scene needs. A second
    round adds no kernel to those of the first.
    """
    done = subprocess.run([sys.executable, "-c", RUN, *scenes], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    lines = [line.split() for line in done.stdout.splitlines()]
    overloads = [int(line[1]) for line in lines if line[0] == "overloads"]
    assert [line for line in lines if line[0] != "overloads"] == [[name, "0.05"] for name in scenes] * 2
    assert overloads[0] == overloads[1] > 0
