"""Which impacts are repeats of each other: those close in temperature and in speed."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts

__all__ = ["groups"]

Indices = NDArray[numpy.intp]


def groups(impacts: Impacts, options: Options) -> list[Indices]:
    """Impacts by rising temperature, then speed: a group spans at most the temperature span and the
    speed ratio of the options.
    """
    found = []
    everything = numpy.arange(len(impacts.speed))
    temperature = impacts.temperature
    parts = [everything] if temperature is None else _split(everything, temperature, options.temperature_span)
    for part in parts:
        found += _split(part, numpy.log(impacts.speed), float(numpy.log(options.speed_ratio)))
    return found


def _split(indices: Indices, values: NDArray[numpy.float64], span: float) -> list[Indices]:
    """Sorted by value; a new part begins where the value is more than ``span`` above the part's
    first.
    """
    ordered = indices[numpy.argsort(values[indices], kind="stable")]
    parts: list[list[int]] = []
    for index in ordered.tolist():
        if not parts or values[index] - values[parts[-1][0]] > span:
            parts.append([])
        parts[-1].append(index)
    return [numpy.sort(numpy.array(part, dtype=numpy.intp)) for part in parts]
