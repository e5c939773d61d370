"""Types of the arrays that kernels take."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

Vector = NDArray[numpy.float64]

Modes = NDArray[numpy.int64]  # what each friction contact of a rig does: see laws/friction.py
