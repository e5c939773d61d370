"""What a run of a body calls is compiled before it starts: afterwards a call with no compiled
version is an error.
"""

import math
import subprocess
import sys

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.records.messages import BodyMotion
from contact_sim_pkg.run.rigs import make_simulation

LEFT_OUT = """
import sys
from contact_sim_pkg.compiled.jit import never_called
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

make_simulation(resolve(load_scene(sys.argv[1], [set_value(value) for value in sys.argv[2:]]))).prepare()
print(*sorted({entry.__module__.partition(".rigid.")[2] for entry in never_called() if ".rigid." in entry.__module__}))
"""
LAW = "effects.block.rigid_contact"
PLANE, SPACE = "contact.planar_impact", "impact.path"  # each for one number of axes alone
SPRINGS = "motion.compliant"


@pytest.mark.parametrize(
    ("scene", "others"),
    [
        (("block_fall",), {SPACE, SPRINGS}),
        (("block_slope", "block.motion=space"), {PLANE, SPRINGS}),
        (("block_zeno",), {PLANE, SPRINGS}),
        (("box_3d_tumble", f"{LAW}.facets=8"), {PLANE, SPRINGS}),
    ],
)
def test_the_warm_up_leaves_out_other_models_alone(scene, others):
    """In a process of its own: here another test may have called what the warm-up did not."""
    done = subprocess.run([sys.executable, "-c", LEFT_OUT, *scene], capture_output=True, text=True, check=True)
    # of `bodies.body`: gaps at a pose, for pictures and the springs
    assert set(done.stdout.split()) - {"bodies.body"} <= others


STRAIGHT = (
    "block.motion=space",
    "block.rotation=[0,0,0]",
    "block.angular_velocity=[0,0,0]",
    "block.velocity=[1.2,0.5,0]",
)
BODIES = (
    ("block.shape=box", "block.sides=[0.2,0.3,0.1]", "block.position=[0,0,0.05]"),
    ("block.shape=points", "block.points=[[0,0,0],[0.3,0,0],[0,0.3,0],[0,0,0.1]]", "block.position=[0,0,0.025]"),
)


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("facets", [0, 8])
def test_a_body_that_slides_straight_in_space_stops_and_rests(body, facets):
    """After ``v / (mu g)``, over ``v^2 / (2 mu g)``; with eight facets the friction along a vertex
    is the same.
    """
    velocity = (1.3, 0.0) if facets else (1.2, 0.5)
    values = (
        *STRAIGHT[:3],
        f"block.velocity=[{velocity[0]},{velocity[1]},0]",
        f"{LAW}.friction=0.3",
        f"{LAW}.facets={facets}",
    )
    simulation = make_simulation(resolved("box_3d_tumble", *values, *body, "duration=0.6"))
    simulation.prepare()
    with closed():
        messages = [message for block in range(simulation.blocks) for message in simulation.advance(block, {}).messages]
    last = decode(BodyMotion, [data for topic, _stamp, data in messages if topic == "bench/motion"][-1])
    way = 1.3**2 / (2.0 * 0.3 * 9.81)
    assert math.hypot(last.position[0, -1], last.position[1, -1]) == pytest.approx(way, abs=1e-9)
    assert abs(last.velocity[:, -1]).max() <= 1e-12
