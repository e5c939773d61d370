"""How well an energy ledger adds up."""

from __future__ import annotations

import numpy as np

from .series import LedgerSeries


def throughput(ledger: LedgerSeries) -> float:
    """Largest magnitude that any entry of the ledger reaches in [J]: the scale that a residual is measured by."""
    entries = (ledger.supplied, ledger.kinetic, ledger.potential, ledger.stored, ledger.dissipated)
    return max(float(np.abs(entry).max()) for entry in entries)


def relative_residual(ledger: LedgerSeries) -> float:
    """Largest |residual| over the throughput; 0 where nothing moved and nothing is missing."""
    largest = float(np.abs(ledger.residual).max())
    scale = throughput(ledger)
    if scale == 0.0:
        return 0.0 if largest == 0.0 else float("inf")
    return largest / scale
