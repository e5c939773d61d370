"""Residual of an energy ledger."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.report.series import LedgerSeries

AT_REST = 1e-6  # [J] smallest scale of a residual: a rig at rest exchanges only round-off, far below this


def throughput(ledger: LedgerSeries) -> float:
    """Largest magnitude that any entry of the ledger reaches in [J], NaN where one has a sample that is unknown."""
    entries = (ledger.supplied, ledger.kinetic, ledger.potential, ledger.stored, ledger.dissipated)
    return float(np.max([np.abs(entry).max() for entry in entries]))


def residual_scale(ledger: LedgerSeries) -> float:
    """What a residual is measured by in [J]: the throughput, but at least `AT_REST`."""
    return max(throughput(ledger), AT_REST)


def relative_residual(ledger: LedgerSeries) -> float:
    """Largest |residual| over `residual_scale` [1]."""
    return float(np.abs(ledger.residual).max()) / residual_scale(ledger)
