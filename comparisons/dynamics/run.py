"""Measure and show; runs in the comparison's own environment (`python -m comparisons.dynamics` makes it)."""

from __future__ import annotations

import json
import statistics
import sys
import time
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from comparisons.dynamics.picture import draw
from comparisons.dynamics.problems import PROBLEMS, measure
from comparisons.environment import left_out
from contact_sim_pkg.files import check_output

__all__ = ["main"]

SOLVERS = {
    "this project": ("with_ours", "Ours"), "MuJoCo": ("with_mujoco", "MuJoCo"), "PyBullet": ("with_pybullet", "PyBullet"),
}  # fmt: skip
PICTURE = Path(sys.prefix) / "compare_dynamics.png"
LONGEST = 3.0  # [s] of a run that is repeated
REPEATS = 3


@click.command()
@click.option("--quick", is_flag=True, help="Steps of 1 ms and more only.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object on standard output, and nothing else.")
@click.option("--plot", default=PICTURE, show_default=True, type=click.Path(path_type=Path), help="The picture (PNG).")
@click.option("--overwrite", is_flag=True, help="Write over a picture that exists.")
def main(quick: bool, as_json: bool, plot: Path, overwrite: bool) -> None:
    """Run the same six problems by this project and by others: error and time of each, at each of its steps."""
    overwrite = overwrite or plot == PICTURE  # its own, made again each time
    check_output(plot, overwrite=overwrite)
    rows: list[dict[str, Any]] = []
    about: dict[str, str] = {}
    missing: dict[str, str] = {}
    reasons = left_out()
    for name, (module_name, class_name) in SOLVERS.items():
        try:
            module = import_module(f"comparisons.dynamics.{module_name}")
        except ImportError as error:
            missing[name] = reasons.get(name, str(error))
            continue
        about[name] = f"{module.version()}: {module.SETTINGS}"
        for step in module.STEPS:
            if not quick or step >= 1e-3:
                click.echo(f"{name}, {1e3 * step:g} ms", err=True)
                rows += _rows(name, getattr(module, class_name)(step), step)
    click.echo(
        json.dumps({"solvers": about, "left out": missing, "rows": rows}) if as_json else _text(rows, about, missing)
    )
    draw(rows, plot, overwrite=overwrite)
    click.echo(f"picture: {plot}", err=True)


def _rows(name: str, engine: Any, step: float) -> list[dict[str, Any]]:
    found = []
    for problem in PROBLEMS:
        outcome = measure(problem, engine, step)  # warms up as well
        times = []
        for _ in range(REPEATS):
            began = time.thread_time()
            measure(problem, engine, step)
            times.append(time.thread_time() - began)
            if times[-1] > LONGEST:
                break
        cost = 1e3 * statistics.median(times) / outcome.simulated
        found.append(
            {"problem": problem, "solver": name, "step_ms": 1e3 * step, "error": outcome.error, "unit": outcome.unit,
             "ms_per_simulated_s": cost}
        )  # fmt: skip
    return found


def _text(rows: list[dict[str, Any]], about: dict[str, str], missing: dict[str, str]) -> str:
    lines = [f"{name} {text}" for name, text in about.items()] + [
        f"{name} is left out: {why}" for name, why in missing.items()
    ]
    for problem in PROBLEMS:
        those = [row for row in rows if row["problem"] == problem]
        lines += [
            "",
            f"{problem} (error {those[0]['unit']})",
            f"{'solver':<14}{'step [ms]':>10}{'error':>11}{'ms/s':>11}",
        ]
        lines += [
            f"{row['solver']:<14}{row['step_ms']:>10g}{row['error']:>11.2g}{row['ms_per_simulated_s']:>11.3g}"
            for row in those
        ]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
