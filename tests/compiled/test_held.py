"""Tuples that compiled code holds between two calls."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.held import Held, hold
from contact_sim_pkg.compiled.jit import entry


class _Kept(NamedTuple):
    values: Vector
    factor: float
    absent: None = None


@entry
def _scaled(kept: Held[_Kept], first: int) -> float:
    total = 0.0
    for value in kept.value.values[first:]:
        total += kept.value.factor * value
    kept.value.values[0] = total
    return total


def test_both_sides_see_the_same_arrays() -> None:
    values = numpy.array([1.0, 2.0, 4.0])
    kept = hold(_Kept(values, 0.5))
    assert _scaled(kept, 1) == 3.0
    values[2] = 6.0
    assert _scaled(kept, 1) == 4.0
    assert values[0] == kept.value.values[0] == 4.0


def test_what_is_held_outlives_its_maker() -> None:
    kept = [hold(_Kept(numpy.full(1000, float(number)), 2.0)) for number in range(20)]
    assert [_scaled(each, 999) for each in kept] == [2.0 * number for number in range(20)]
