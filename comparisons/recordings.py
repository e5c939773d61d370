"""Records what the scenes publish in one checkout, and compares two such recordings value by value.

    python -m comparisons.recordings record FOLDER [--checkout CHECKOUT] [--all] [--hard]
    python -m comparisons.recordings compare FOLDER FOLDER

For moves of code that must keep the numbers: recorded before and after, on one machine, for bits may differ between
processors. Each recorded topic is compared but `bench/cost`, which reports wall time, and `bench/scene`, whose keys may be
renamed. A short scene a rig, or with `--all` every scene; with `--hard` the rows of `bench hard` too. Bags are read by rosbags
with the definitions that they hold. Status 1 where a value differs by more than 1e-9 of the largest of its field.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy
from rosbags.highlevel import AnyReader

from contact_sim_pkg.python_process import python_command

SHORT = {
    "tire_bump": 0.6, "tire_braking": 0.2, "seat_ride": 0.5, "seat_slap": 0.5, "seat_ride_full": 0.2, "car_full_bench": 0.2,
    "impact_rubber_drop": 1.2, "roller_flutter": 0.5, "roller_corrugation": 0.1, "block_fall": 0.5,
}  # fmt: skip
"""Scenes of the short tier and how long they run, [s]."""

LEFT_OUT = ("/bench/cost", "/bench/scene")
ALLOWED = 1e-9  # of the largest value of a field
ROOT = Path(__file__).resolve().parents[1]


def record(folder: Path, checkout: Path, every: bool, hard: bool) -> int:
    """Run the scenes of a checkout; one bag a scene below `folder`. Returns how many could not be run."""
    shipped = sorted(path.stem for path in checkout.glob("contact_sim_pkg/contact_sim_pkg/**/scenes/*.yaml"))
    folder.mkdir(parents=True)
    failed = 0
    for scene in shipped if every else SHORT:
        length = [] if every else ["--set", f"duration={SHORT[scene]}"]
        done = _bench(checkout, "run", scene, "--offline", *length, "--out", str(folder / scene))
        failed += done.returncode not in (0, 3)
        print(f"{scene}: status {done.returncode} {done.stderr[-300:].strip() if done.returncode else ''}", flush=True)
    if hard:
        (folder / "hard.json").write_text(_bench(checkout, "hard", "--json").stdout)
    return failed


def _bench(checkout: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join(filter(None, [str(checkout / "contact_sim_pkg"), os.environ.get("PYTHONPATH")]))
    command = python_command("contact_sim_pkg.cli.main", *arguments)
    return subprocess.run(command, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False)


def compare(first: Path, second: Path) -> int:
    """Print how the recordings differ, a line each scene and field; returns how many fields differ by more than allowed."""
    beyond = 0
    names = {path.name for path in first.iterdir()} | {path.name for path in second.iterdir()}
    for name in sorted(names - {"hard.json"}):
        if not ((first / name).is_dir() and (second / name).is_dir()):
            print(f"{name}: only in {first if (first / name).is_dir() else second}")
            beyond += 1
            continue
        differences = list(_differences(_columns(first / name), _columns(second / name)))
        beyond += sum(size > ALLOWED for _field, size in differences)
        print(f"{name}: {'equal' if not differences else f'{len(differences)} fields differ'}")
        for field, size in sorted(differences, key=lambda each: -each[1])[:20]:
            print(f"    {field}: {size:.3g} of its largest value")
    return beyond + _compare_hard(first / "hard.json", second / "hard.json")


def _compare_hard(first: Path, second: Path) -> int:
    if not (first.exists() and second.exists()):
        return 0
    before, after = (
        {f"{row['model']}: {row['case']}": row for row in json.loads(path.read_text())["rows"]}
        for path in (first, second)
    )
    changed = [name for name in before.keys() | after.keys() if before.get(name) != after.get(name)]
    print(f"bench hard: {len(before)} and {len(after)} rows, {len(changed)} differ")
    for name in sorted(changed):
        print(f"    {name}: {before.get(name)} | {after.get(name)}")
    return len(changed)


def _columns(bag: Path) -> dict[str, list[Any]]:
    """Topic and field -> its values, message by message."""
    found: dict[str, list[Any]] = {}
    with AnyReader([bag]) as reader:
        for connection, stamp, data in reader.messages():
            if not connection.topic.endswith(LEFT_OUT):
                message = reader.deserialize(data, connection.msgtype)
                found.setdefault(f"{connection.topic} stamp", []).append(stamp)
                for field, value in _leaves(message, connection.topic):
                    found.setdefault(field, []).append(value)
    return found


def _leaves(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    if is_dataclass(value):
        for field in fields(value):
            if not field.name.startswith("__"):
                yield from _leaves(getattr(value, field.name), f"{path}.{field.name}")
    elif isinstance(value, list):
        for each in value:
            yield from _leaves(each, f"{path}[]")
    else:
        yield path, value


def _differences(first: dict[str, list[Any]], second: dict[str, list[Any]]) -> Iterator[tuple[str, float]]:
    """Fields that are not equal to the bit, with the largest difference over the largest value; inf where the shape differs."""
    for field in sorted(first.keys() | second.keys()):
        before, after = first.get(field, []), second.get(field, [])
        if any(isinstance(value, str) for value in (*before, *after)):
            if before != after:
                yield field, numpy.inf
            continue
        a, b = (numpy.concatenate([numpy.zeros(0), *map(numpy.ravel, values)]) for values in (before, after))
        if a.shape != b.shape:
            yield f"{field} ({len(a)} and {len(b)} values)", numpy.inf
        elif not numpy.array_equal(a, b, equal_nan=True):
            largest = max(float(numpy.nanmax(abs(a))), float(numpy.nanmax(abs(b))))
            yield field, float(numpy.nanmax(abs(a - b))) / largest if largest > 0.0 else 0.0


def main(arguments: list[str]) -> int:
    """Record or compare; 0, or 1 where a scene failed or a value differs."""
    parser = argparse.ArgumentParser(prog="python -m comparisons.recordings", description=__doc__.partition("\n")[0])
    tasks = parser.add_subparsers(dest="task", required=True)
    recording = tasks.add_parser("record")
    recording.add_argument("folder", type=Path)
    recording.add_argument("--checkout", type=Path, default=ROOT)
    recording.add_argument("--all", action="store_true")
    recording.add_argument("--hard", action="store_true")
    comparing = tasks.add_parser("compare")
    comparing.add_argument("first", type=Path)
    comparing.add_argument("second", type=Path)
    given = parser.parse_args(arguments)
    if given.task == "compare":
        return int(compare(given.first, given.second) > 0)
    if given.folder.exists():
        parser.error(f"{given.folder} exists already; name a new folder")
    return int(record(given.folder, given.checkout, given.all, given.hard) > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
