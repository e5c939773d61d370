"""Runs of shipped scenes behind the figures, each made once in a process."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.library import Series, load_scene, run, series

__all__ = ["at", "bag_of", "series_of"]


@lru_cache(maxsize=16)
def bag_of(scene: str, *values: str) -> Bag:
    """The bag of an offline run of a shipped scene, with ``values`` such as ``"duration=0.5"`` set."""
    return run(load_scene(scene, *values))


@lru_cache(maxsize=64)
def series_of(topic: str, scene: str, *values: str) -> Series:
    """A topic of `bag_of`, one row a sample."""
    return series(bag_of(scene, *values), topic)


def at(found: Series, time: float) -> dict[str, Any]:
    """Columns of the sample nearest to a time [s]."""
    place = int(numpy.argmin(numpy.abs(found.time - time)))
    return {name: _value(found[name], place) for name in found}


def _value(column: NDArray[Any], place: int) -> Any:
    return column[place]
