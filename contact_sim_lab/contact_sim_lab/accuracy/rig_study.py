"""`bench accuracy RIG`: rows, table and picture of the studies of a rig."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from contact_sim_lab.accuracy import work_precision
from contact_sim_lab.accuracy.work_precision_plot import write_plot
from contact_sim_lab.accuracy.work_precision_table import sections

__all__ = ["sections", "study", "write_plot"]


def study(rig: str, progress: Callable[[str], None]) -> list[dict[str, Any]]:
    """All rows of a rig; UsageError for one without studies."""
    if rig not in work_precision.measured_rigs():
        known = ", ".join(work_precision.measured_rigs())
        raise click.UsageError(f"the rig {rig} has no study of formulas (there are {known}); name a scene of it")
    return work_precision.study(rig, progress)
