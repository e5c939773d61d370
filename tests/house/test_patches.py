"""The patches apply, bring what they say, and edit few shared files by hand."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.house.patches import PATCHES, file_of, shared_files

ROOT = Path(__file__).resolve().parents[2]
TOPIC = """
import numpy
from contact_sim_pkg.bag.block_encoder import Output, encode_block
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import BodyMomentum
from contact_sim_pkg.records.registry import rigs

momentum = numpy.arange(6.0).reshape(2, 3)
record = BodyMomentum(block=4, sample_period=0.1, momentum=momentum)
[(topic, stamp, data)] = encode_block([Output("block/momentum", 10, record)])
assert numpy.array_equal(decode(BodyMomentum, data).momentum, momentum)
assert "momentum" in [topic.name for topic in rigs()["block"].contacts[0].topics]
"""
COLUMN = """
import numpy
from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.records.messages import SolverCost

given = {"block": 4, "wall_time": 0.1, "real_time_factor": 1.0}
assert SolverCost(**given).longest_coupling_step == 0.0
cost = SolverCost(**given, longest_coupling_step=0.25)
again = decode(SolverCost, encode(cost))
assert all(numpy.array_equal(getattr(again, name), getattr(cost, name)) for name in cost._fields)
"""


RIG = """
import numpy
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.scene.load import load_scene, shipped_names
from contact_sim_pkg.scene.resolve import resolve

assert "indenter" in rigs() and "indenter_press" in shipped_names()
simulation = make_simulation(resolve(load_scene("indenter_press")))
records = [output.record for block in range(simulation.blocks) for output in simulation.advance(block, {}).outputs]
normal = numpy.concatenate([record.normal for record in records if type(record).__name__ == "ContactForce"])
depth = 1e-3 * numpy.sin(2.0 * numpy.pi * numpy.arange(1000) / 1000)
assert numpy.allclose(normal, 2.0 * 0.01 * 1e6 * numpy.maximum(depth, 0.0), rtol=1e-9, atol=1e-9)
"""
EFFECT = """
from contact_sim_pkg.rigs.impact.effect_outputs import gauge_readings
from contact_sim_pkg.rigs.impact.model import build_impact
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

def readings(*assignments):
    scene = resolve(load_scene("impact_rubber_drop", [set_value(each) for each in assignments]))
    return gauge_readings(build_impact(scene), 1, 2.0, 4.0, 0.5)

assert readings() == [2.0, 4.0, 0.5]
assert readings("effects.impact.gauge_bias.share=0.25") == [2.5, 5.0, 0.625]
"""
OBSTACLE = """
import math, numpy
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

road = "{kind: half_round, position: 1.0, radius: 0.03}"
scene = resolve(load_scene("tire_bump", [set_value(f"road={road}"), set_value("duration=0.2"), set_value("travel={speed: 5}")]))
surface = make_sources(scene)["road/patch"].surface
found = surface.heights(numpy.array([0.96, 0.98, 1.0, 1.02]), numpy.zeros(1))[:, 0]
assert numpy.allclose(found, [0.0, math.sqrt(5e-4), 0.03, math.sqrt(5e-4)], rtol=1e-12, atol=1e-15), found
assert scene.road.shortest_wave(0.1).words == "the half_round has an edge, shorter than"
assert scene.road.is_reached(0.0, 0.98) and not scene.road.is_reached(0.0, 0.96)
"""
METRIC = """
import sys
sys.path.insert(0, "../examples/plugin_rig")
from types import SimpleNamespace
import numpy
from bouncer_rig.metrics import metrics

series = SimpleNamespace(normal=numpy.array([1.0, 0.0, 0.0, 2.0]))
found = {metric.key: metric.value for metric in metrics(SimpleNamespace(contacts={"foot": series}))}
assert found == {"foot.impacts": 1.0, "foot.in_the_air": 50.0}, found
"""
ACTS = """
import numpy
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.motion import entries
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

def of_body(*assignments):
    model = build(resolve(load_scene("car_ride", [set_value(each) for each in assignments])))
    state, out = numpy.zeros(model.states), numpy.zeros(model.states)
    state[2] = 0.05 - 9.81 * (model.quarter.body.mass + model.rig.seat.masses.sum()) / model.quarter.suspension.stiffness
    entries.forces_of_elements(model.rig.unloaded(), numpy.zeros(1, dtype=numpy.int64), state, -1.0, 0.0, out)
    ledger = entries.energies(model.rig.unloaded(), numpy.zeros(1, dtype=numpy.int64), state, -1.0, 0.0)
    return numpy.array([out[1], out[3], ledger[2]])

added = of_body("effects.tire.hardening.cubic=2e7") - of_body()  # [N], [N], [J] at 50 mm above rest
assert numpy.allclose(added, [2500.0, -2500.0, 31.25], rtol=1e-9), added
"""
USES = {
    "rig": RIG,
    "effect": EFFECT,
    "effect that acts": ACTS,
    "topic": TOPIC,
    "column": COLUMN,
    "obstacle": OBSTACLE,
    "metric": METRIC,
}


@pytest.mark.parametrize(("name", "use"), USES.items())
def test_a_patch_brings_what_it_says(tmp_path, name, use):
    for package in ("contact_msgs_defs", "contact_sim_pkg", "examples"):
        shutil.copytree(ROOT / package, tmp_path / package, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    patch = subprocess.run(
        ["git", "apply", "--verbose", str(file_of(name))],
        cwd=tmp_path, env={"GIT_CEILING_DIRECTORIES": str(tmp_path.parent), "PATH": "/usr/bin:/bin"},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert patch.returncode == 0, patch.stderr
    done = subprocess.run(
        [sys.executable, "-c", use], cwd=tmp_path / "contact_sim_pkg", capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", USES)
def test_few_shared_files_are_edited_by_hand(name):
    assert len(shared_files(name)) <= PATCHES[name].most
