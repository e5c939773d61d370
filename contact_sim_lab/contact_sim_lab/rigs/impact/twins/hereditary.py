"""The hereditary integral `I(t) = int J(t - s) dF(s)` sample by sample: every segment by Gauss
quadrature, O(N^2).

Slow twin of `rigs/impact/theory/viscoelastic/hereditary.py`, for any compliance J(t). Source: Lee
and Radok (1960).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy
from numpy.typing import NDArray

__all__ = ["integral"]

Vector = NDArray[numpy.float64]


def integral(compliance: Callable[[Vector], Vector], times: Vector, force: Vector) -> Vector:
    """Hereditary integral [times] [N/Pa] for a force linear between samples; the first force is a
    step.

    times: [times] [s]; force: [times] [N]; compliance: time [s] -> [1/Pa].
    """
    nodes, weights = numpy.polynomial.legendre.leggauss(64)
    out = numpy.zeros(len(times))
    for n, now in enumerate(times):
        total = float(compliance(numpy.array([now - times[0]]))[0] * force[0])
        for i in range(n):
            step = times[i + 1] - times[i]
            inside = times[i] + 0.5 * step * (nodes + 1.0)
            total += 0.5 * (force[i + 1] - force[i]) * float(numpy.sum(weights * compliance(now - inside)))
        out[n] = total
    return out
