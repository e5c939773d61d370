"""Neighbours in memory that kernels compute with at once: `WIDTH` of them, eight, or one where numba's
inside was not tested (`tested.py`). The order of operations is that of the source, so both give the
same bits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.tested import IS_TESTED

__all__ = ["WIDTH", "load", "store", "transpose"]

if IS_TESTED or TYPE_CHECKING:
    from contact_sim_pkg.compiled.eight_lanes import WIDTH, load, store, transpose
else:
    WIDTH = 1

    @borrowing_kernel
    def load(array, index):
        """Element ``index`` of a contiguous array, in its order of memory."""
        return array.flat[index]

    @borrowing_kernel
    def store(array, index, value):
        """Write element ``index`` of a contiguous array."""
        array.flat[index] = value

    @borrowing_kernel
    def transpose(source, first, stride, target, first_there, stride_there):
        """A tile of one number."""
        target.flat[first_there] = source.flat[first]
