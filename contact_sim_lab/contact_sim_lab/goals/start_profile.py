"""Where the processor time of a first start goes, function by function: all processes of `bench run`, with nothing compiled.

python -m contact_sim_lab.goals.start_profile [SCENE]
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from contact_sim_lab.goals.sampler import FOLDER
from contact_sim_pkg.cli.output.tables import show_sections
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.records.table import Section

__all__ = ["profile", "sections"]

USUAL, SIMULATED = "car_full_bench", 0.1  # [s] of the run behind the start
SHOWN = 30
HOOK = "from contact_sim_lab.goals.sampler import begin\nbegin()\n"


def profile(scene: str) -> tuple[float, list[Mapping[str, float]]]:
    """Start the scene once with an empty cache.

    Returns:
        The wall time of the whole command, [s], and for each of its processes, the dearest first, the processor time [s]
        under each name of `sampler.label`.

    Raises:
        ValueError: the scene does not run; with the command's last line.
    """
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "sitecustomize.py").write_text(HOOK, encoding="utf-8")
        path = os.pathsep.join(filter(None, [folder, os.environ.get("PYTHONPATH", "")]))
        environment = {**os.environ, "PYTHONPATH": path, "CONTACT_BENCH_CACHE": str(place / "cache"), FOLDER: folder}
        command = ["run", scene, "--offline", "--duration", str(SIMULATED), "--out", str(place / "bag")]
        began = time.perf_counter()
        done = subprocess.run(
            python_command("contact_sim_pkg.cli.main", *command), env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        wall = time.perf_counter() - began
        if done.returncode != 0:
            raise ValueError((done.stderr.strip().splitlines() or ["no reason given"])[-1])
        found: list[dict[str, float]] = [json.loads(file.read_text(encoding="utf-8")) for file in place.glob("*.json")]
    return wall, sorted(found, key=lambda counts: -sum(counts.values()))


def sections(wall: float, processes: list[Mapping[str, float]]) -> list[Section]:
    """Time by kind of work in each process, and the names that took most of it."""
    kinds: list[dict[str, Any]] = []
    names: defaultdict[str, float] = defaultdict(float)
    for number, counts in enumerate(processes, 1):
        kind: defaultdict[str, float] = defaultdict(float)
        for name, seconds in counts.items():
            names[name] += seconds
            word = name.partition(" ")[0]
            kind[word if word in ("compile", "import", "start") else "run"] += seconds
        row = {f"{word} [s]": round(kind[word], 2) for word in ("import", "compile", "run", "start")}
        kinds.append({"process": number, **row, "sum [s]": round(sum(counts.values()), 2)})
    most = sorted(names.items(), key=lambda each: -each[1])
    rows = [{"what": name, "s": round(seconds, 2)} for name, seconds in most[:SHOWN]]
    rest = sum(seconds for _, seconds in most[SHOWN:])
    return [
        Section("processes", kinds, f"the whole command took {wall:.1f} s of the clock"),
        Section("functions", rows, f"{len(most[SHOWN:])} more take {rest:.1f} s; processor time of all processes, by samples"),
    ]  # fmt: skip


def main() -> int:
    """Profile the scene of the command line; returns the exit status."""
    try:
        wall, processes = profile(sys.argv[1] if len(sys.argv) > 1 else USUAL)
    except ValueError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    show_sections(sections(wall, processes))
    return 0


if __name__ == "__main__":
    sys.exit(main())
