"""Goals of whole runs: start-up and real-time factor of the full bench on nodes and without, and its
report.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["GOALS", "latency", "offline", "on_nodes", "report"]

SCENE = "car_full_bench"
RUNS = 3  # after one that compiles and is not counted
REPORTED = 10.0, 20.0  # [s] of simulated time in the bags of the report
LONGEST = 300.0  # [s] for a run that compiles
OFFLINE = {SCENE: 8.0, "tire_texture": 2.5}  # least real-time factors
LATENCY_SECONDS = 60.0  # of the run whose latency is measured


def on_nodes() -> list[Measured]:
    """Warm start-up and real-time factor of the full bench on nodes, recorded, as a user starts it;
    medians of the runs.
    """
    facts: list[dict[str, Any]] = []
    note = ""
    with tempfile.TemporaryDirectory() as folder:
        for number in range(RUNS + 1):
            command = python_command("contact_sim_pkg.cli.main", "run", SCENE, "--pace", "max", "--json")
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


def latency(seconds: float = LATENCY_SECONDS) -> list[Measured]:
    """From a block of excitation to its forces at a subscriber, at the pace of the clock, recorded:
    median, 99th percentile and maximum over a run of this length, [s].
    """
    module = "contact_sim_lab.nodes.latency"  # a process of its own, with ROS
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            python_command(module, SCENE, str(seconds)),
            cwd=folder, capture_output=True, text=True, timeout=LONGEST + seconds, check=False,
        )  # fmt: skip
    found: dict[str, Any] = json.loads(done.stdout) if done.returncode == 0 else {}
    note = "" if found else (done.stderr.strip().splitlines() or ["no reason given"])[-1]

    def row(what: str, key: str, scale: float, unit: str, most: float | None = None, note: str = note) -> Measured:
        value = scale * found[key] if found else None
        return Measured(f"{SCENE} at real time, block in to force out: {what}", value, unit, most=most, note=note)

    return [
        row("p50", "p50", 1e3, "ms"), row("p99", "p99", 1e3, "ms", most=5.0),
        row("largest", "largest", 1e3, "ms", note=found.get("cause") or note),
        row("later than a block lasts", "overruns", 1.0, f"of {found.get('blocks', 0)}"),
    ]  # fmt: skip


def offline() -> list[Measured]:
    """Real-time factor of the simulation alone, fields on, without bag and nodes."""
    found = []
    for name, goal in OFFLINE.items():
        scene = load_resolved(name, "duration=2.0")
        run_offline(scene, None)
        outcome = run_offline(scene, None)
        simulated = outcome.blocks * float(scene.data["block_length"])
        found.append(Measured(f"{name} without nodes and bag", simulated / outcome.wall, "× real time", least=goal))
    return found


def report() -> list[Measured]:
    """Time of the report of 10 s of the full bench, as a user starts it, and that of ten minutes by
    extrapolation: what grows with the duration is the reading, measured on bags of 10 and 20 s.
    """
    short, long = REPORTED
    with tempfile.TemporaryDirectory() as folder:
        bags = {duration: Path(folder) / str(duration) for duration in REPORTED}
        for duration, bag in bags.items():
            run_offline(load_resolved(SCENE, f"duration={duration}"), bag)
        command = python_command("contact_sim_pkg.cli.main", "report", str(bags[short]))
        for _ in range(2):  # the first one may compile
            began = time.perf_counter()
            subprocess.run(command, cwd=folder, capture_output=True, timeout=LONGEST, check=True)
            wall = time.perf_counter() - began
        reading = [_reading_time(bag) for bag in bags.values()]
    slope = (reading[1] - reading[0]) / (long - short)
    return [
        Measured(f"report of {short:g} s of {SCENE}", wall, "s", most=5.0),
        Measured(f"report of ten minutes of {SCENE}, extrapolated", wall + (600.0 - short) * slope, "s", most=20.0),
    ]


def _reading_time(bag: Path) -> float:
    """[s] to read what a report draws."""
    return median_time(lambda: read_recording(open_bag(bag)), RUNS)


GOALS = (
    GoalPart("full bench on nodes", on_nodes),
    GoalPart("latency of the full bench", latency),
    GoalPart("full bench without nodes", offline),
    GoalPart("report of the full bench", report),
)
