"""The nodes of `examples/nodes`: a shaker in place of the bench's, and a listener beside it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.bench_process import ENVIRONMENT, LONGEST, Nodes, needs_ros, resolved

from contact_sim_pkg.bag.reader import open_bag

pytestmark = needs_ros
EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "nodes"


def test_a_shaker_of_ones_own_drives_a_run_that_a_listener_hears(tmp_path):
    """1.5 m/s² at 4 Hz: the bag holds that sine, block by block, and the largest force is the one printed."""
    scene = resolved("seat_ride", "duration=1.5", "pace=max")
    nodes = Nodes(scene, tmp_path)
    pipe = subprocess.PIPE
    own = [
        subprocess.Popen([sys.executable, EXAMPLES / name], env=ENVIRONMENT, stdout=pipe, stderr=pipe, text=True)
        for name in ("listener.py", "shaker.py")
    ]
    try:
        for name in ("contact_simulator", "bag_logger"):
            nodes.start(name)
        assert set(nodes.wait().values()) == {0}
        said = [process.communicate(timeout=LONGEST) for process in own]
    finally:
        nodes.end()
        for process in own:
            process.kill()
    assert [process.returncode for process in own] == [0, 0], said
    assert said[1][0] == "150 blocks sent\n"

    bag = open_bag(nodes.bag)
    assert bag.complete
    blocks = bag.columns("platform/vibration")
    time = 0.01 * np.arange(150)[:, None] + 0.001 * np.arange(11)
    assert blocks["acceleration_z"] == pytest.approx(1.5 * np.sin(8.0 * np.pi * time), abs=1e-12)
    force = bag.columns("seat/force")["normal"].reshape(-1)
    largest = [force[:1000].max(), force[1000:].max()]
    assert said[0][0].splitlines() == [f"{place} s: {value:.0f} N" for place, value in enumerate(largest)]
