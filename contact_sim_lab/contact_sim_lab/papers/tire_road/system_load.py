"""System *load*: the load of a wheel over the uncertainty of its road: one run a seed, mean and spread
(Tire/Road Contact, closing remark of section 3).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.library import load_scene, run, series

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["LoadOverSeeds", "load_over_seeds", "loads_of"]

Array = NDArray[numpy.float64]

TOPIC = "tire/force"


class LoadOverSeeds(NamedTuple):
    """Loads of all runs."""

    time: Array  # [samples] [s]
    loads: Array  # [seeds, samples] [N], contact and asperities

    @property
    def mean(self) -> Array:
        """Over the seeds [samples] [N]."""
        return numpy.asarray(self.loads.mean(axis=0))

    @property
    def spread(self) -> Array:
        """Standard deviation over the seeds [samples] [N]."""
        return numpy.asarray(self.loads.std(axis=0, ddof=1))


def load_over_seeds(path: Path | None, values: Values) -> SystemResult:
    """Loads of a scene, a shipped one by its name or a file, over so many seeds from the first on.

    Raises PaperError for a scene without a tire on a road.
    """
    assert path is not None
    found = loads_of(
        str(path), range(int(values["first"]), int(values["first"]) + int(values["seeds"])), float(values["duration"])
    )
    settled = found.time >= float(values["start"])
    if settled.sum() < 2:
        raise PaperError(f"start {values['start']:g} s: the runs end at {found.time[-1]:.6g} s; give an earlier one")
    loads = found.loads[:, settled]
    of_each, over_seeds = loads.std(axis=1), found.spread[settled]
    grand = float(loads.mean())
    rows = [
        {"quantity": "mean load", "value": grand, "unit": "N"},
        {"quantity": "spread over the seeds, rms over time", "value": float(numpy.sqrt((over_seeds**2).mean())), "unit": "N"},
        {"quantity": "of the mean load of a run", "value": float(loads.mean(axis=1).std(ddof=1)), "unit": "N"},
        {"quantity": "dynamic load coefficient of a run, mean", "value": float(of_each.mean()) / grand, "unit": ""},
        {"quantity": "its spread over the seeds", "value": float(of_each.std(ddof=1)) / grand, "unit": ""},
        {"quantity": "smallest and largest load", "value": float(loads.min()), "most": float(loads.max()), "unit": "N"},
    ]  # fmt: skip
    note = "" if found.spread.any() else "the road does not depend on the seed: give a scene with a random one"
    return SystemResult(rows, lambda canvas: _draw(canvas, found), note)


def loads_of(scene: str, seeds: range, duration: float = 0.0) -> LoadOverSeeds:
    """One offline run a seed; duration [s], 0: of the scene."""
    first, rows = None, []
    for seed in seeds:
        values = (f"seed={seed}", *((f"duration={duration!r}",) if duration > 0.0 else ()))
        resolved = load_scene(scene, *values)
        if resolved.rig not in ("tire", "car"):
            raise PaperError(
                f"scene {resolved.name}: rig {resolved.rig} has no wheel on a road; rig tire or car is needed"
            )
        force = series(run(resolved), TOPIC)
        load = numpy.asarray(force["normal"], float)
        if "impulses" in force.columns:
            load = load + force["impulses"]
        first = force.time if first is None else first
        rows.append(load)
    assert first is not None
    return LoadOverSeeds(numpy.asarray(first, float), numpy.array(rows))


def _draw(canvas: Canvas, found: LoadOverSeeds) -> None:
    axes = canvas.subplots()
    mean, spread = found.mean, found.spread
    axes.plot(found.time, found.loads.T, color="#9a9a96", linewidth=0.3, alpha=0.6)
    axes.fill_between(
        found.time, mean - spread, mean + spread, color="#136f96", alpha=0.3, linewidth=0.0, label="mean ± spread"
    )
    axes.plot(found.time, mean, color="#136f96", label=f"mean of {len(found.loads)} seeds")
    axes.set_xlabel("simulated time, s")
    axes.set_ylabel("F_z, N")
    axes.legend()
