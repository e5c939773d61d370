"""The picture of `bench material`: E' and tan(beta) over temperature or, with a master curve, over
the reduced speed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy
from matplotlib.figure import Figure

from contact_sim_pkg.report.drawing import save_picture
from contact_sim_pkg.rigs.impact.material.estimate import EstimatedValue, MaterialEstimate
from contact_sim_pkg.rigs.impact.material.report import MaterialReport

__all__ = ["write_figure"]


def write_figure(report: MaterialReport, path: Path, *, overwrite: bool = False) -> Path:
    """Draw every impact as a dot, every group with its interval; the ending of ``path`` names the
    format.

    Raises FileRefusedError, see `drawing.save_picture`.
    """
    figure = Figure(figsize=(7.4, 6.0), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    places, label, logarithmic = _places(report)
    for axes, name, of in ((upper, "E'", _storage), (lower, "tan_beta", _tangent)):
        # On a master curve single impacts have no place.
        if report.master is None:
            _impacts(axes, report, name)
        _intervals(axes, report.estimates, places, of)
        axes.grid(visible=True, which="both", alpha=0.3)
        if logarithmic:
            axes.set_xscale("log")
    upper.set_yscale("log")
    upper.set_ylabel("E' [Pa]")
    lower.set_ylabel("tan β")
    lower.set_xlabel(label)
    return save_picture(figure, path, overwrite=overwrite, dpi=120)


def _places(report: MaterialReport) -> tuple[list[float], str, bool]:
    if report.master is not None:
        reference = report.master.reference_temperature
        return list(report.master.reduced_speed), f"impact speed at {reference:.4g} K [m/s]", True
    if report.impacts.temperature is not None:
        return [e.temperature or 0.0 for e in report.estimates], "T [K]", False
    return [e.speed for e in report.estimates], "V0 [m/s]", False


def _impacts(axes: Any, report: MaterialReport, name: str) -> None:
    of = "V0" if report.impacts.temperature is None else "T"
    points = [(row[of], row[name]) for row in report.rows if row[name] is not None]
    if points:
        axes.plot(*zip(*points, strict=True), ".", color="0.7", markersize=3, label="single impacts")


def _intervals(axes: Any, estimates: list[MaterialEstimate], places: list[float], of: Any) -> None:
    values = [of(estimate) for estimate in estimates]
    centre = numpy.array([value.value for value in values])
    low = numpy.array([value.value if value.low is None else value.low for value in values])
    high = numpy.array([value.value if value.high is None else value.high for value in values])
    axes.errorbar(places, centre, yerr=numpy.array([centre - low, high - centre]), fmt="o", markersize=4, capsize=2)


def _storage(estimate: MaterialEstimate) -> EstimatedValue:
    return estimate.storage_modulus


def _tangent(estimate: MaterialEstimate) -> EstimatedValue:
    return estimate.loss_tangent
