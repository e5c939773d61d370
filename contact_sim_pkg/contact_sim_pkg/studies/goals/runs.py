"""Goals of whole runs: start-up and real-time factor of the full bench on nodes and without."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from contact_sim_pkg.records.goal import GoalPart, Measured
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["GOALS", "offline", "on_nodes"]

SCENE = "car_full_bench"
RUNS = 3  # after one that compiles and is not counted
LONGEST = 300.0  # [s] for a run that compiles


def on_nodes() -> list[Measured]:
    """Warm start-up and real-time factor of the full bench on nodes, recorded, as a user starts it;
    medians of the runs.
    """
    facts: list[dict[str, Any]] = []
    note = ""
    with tempfile.TemporaryDirectory() as folder:
        for number in range(RUNS + 1):
            command = [sys.executable, "-m", "contact_sim_pkg.cli.main", "run", SCENE, "--pace", "max", "--json"]
            command += ["--out", str(Path(folder) / str(number))]
            # away from the checkout, whose folder of message files has the name of the package made
            # from them
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=LONGEST, check=False)
            if done.returncode != 0:
                note = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
                break
            facts.append(json.loads(done.stdout))
    warm = facts[1:]
    startup = statistics.median(each["startup_s"] for each in warm) if warm else None
    factor = statistics.median(each["real_time_factor"] for each in warm) if warm else None
    return [
        Measured(f"{SCENE} on nodes, recorded: warm start", startup, "s", most=2.0, note=note),
        Measured(f"{SCENE} on nodes, recorded: speed", factor, "× real time", least=3.0, note=note),
    ]


def offline() -> list[Measured]:
    """Real-time factor of the simulation alone, both fields on, without bag and nodes."""
    scene = load_resolved(SCENE, "duration=2.0")
    run_offline(scene, None)
    outcome = run_offline(scene, None)
    simulated = outcome.blocks * float(scene.data["block_length"])
    return [Measured(f"{SCENE} without nodes and bag", simulated / outcome.wall, "× real time")]


GOALS = (GoalPart("full bench on nodes", on_nodes), GoalPart("full bench without nodes", offline))
