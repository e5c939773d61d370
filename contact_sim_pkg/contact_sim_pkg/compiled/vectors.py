"""Compiled helpers on rows of numbers."""

from __future__ import annotations

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel


@kernel
def copy_row(source: Vector, target: Vector) -> None:
    """Write ``source`` [numbers] into ``target`` [numbers].

    In place of ``target[:] = source``, for which numba compiles the text of an error about shapes
    into every caller: 2 s.
    """
    for i in range(source.shape[0]):
        target[i] = source[i]
