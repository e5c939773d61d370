"""The numbers of a run that a person or a script needs first.

A run that a signal ends still prints them, so what only one rig needs and takes long to load is
loaded there.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.compare.estimated import accuracy_numbers
from contact_sim_pkg.report.energy import relative_residual, throughput
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.metrics.regimes import expected
from contact_sim_pkg.report.metrics.views import row_of, rows_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rig_reports import ledger_scope, rig_warnings
from contact_sim_pkg.report.series import CostSeries, LedgerSeries, Recording


def summarise(bag: Bag) -> dict[str, Any]:
    """Summary numbers of a bag; see `summarise_recording`. Raises BagError where the bag cannot be
    read.
    """
    return summarise_recording(read_recording(bag))


def summarise_recording(recording: Recording) -> dict[str, Any]:
    """Summary of a run, ready for JSON: its metrics, and the numbers of the bench, SI units in their names, None
    where a number is not defined.

    Sections that the run does not have are absent: `energy` without a ledger, `solver` without cost
    messages, `warnings` where there is nothing to warn of, `expected` where the scene expects nothing.
    """
    summary: dict[str, Any] = {
        "scene": recording.scene.get("name"),
        "rig": recording.scene.get("rig"),
        "simulated_s": round(recording.duration, 9),
        "metrics": rows_of(metrics_of(recording)),
    }
    # Sections by what the recording holds
    if warnings := rig_warnings(recording):
        summary["warnings"] = warnings
    if regime := expected(recording):
        summary["expected"] = row_of(regime)
    if recording.ledger is not None:
        summary["energy"] = energy_numbers(recording.ledger) | _scope(recording)
    if recording.cost is not None:
        summary["solver"] = solver_numbers(recording.cost)
        if accuracy := accuracy_numbers(recording):
            summary["accuracy"] = accuracy
    summary["messages"] = {topic.name: topic.messages for topic in recording.topics}
    defined: dict[str, Any] = _without_nan(summary)
    return defined


def energy_numbers(ledger: LedgerSeries) -> dict[str, Any]:
    """Work supplied and dissipated at the end in [J]; largest residual, plain and over the
    throughput (at least 1e-6 J).
    """
    return {
        "supplied_J": float(ledger.supplied[-1]),
        "dissipated_J": float(ledger.dissipated[-1]),
        "throughput_J": throughput(ledger),
        "residual_max_J": float(np.abs(ledger.residual).max()),
        "residual_relative": relative_residual(ledger),
    }


def _scope(recording: Recording) -> dict[str, Any]:
    """Motion that the ledger is of, and what is outside it; empty where it is of the whole rig."""
    scope = ledger_scope(recording)
    return {} if scope is None else {"of": scope.motion, "outside": list(scope.outside)}


def solver_numbers(cost: CostSeries) -> dict[str, Any]:
    """Steps, events and iterations over the run; wall time of the physics, blocks that took longer than they last, and the
    one that took longest; largest field residual and jump.
    """
    wall = float(cost["wall_time"].sum())
    # Real-time factor of the whole run, not the mean of its blocks
    simulated = float((cost["real_time_factor"] * cost["wall_time"]).sum())
    return {
        "blocks": int(cost["time"].size),
        "steps": int(cost["steps"].sum()),
        "rejected_steps": int(cost["rejected_steps"].sum()),
        "events": int(cost["events"].sum()),
        "field_iterations": int(cost["field_iterations"].sum()),
        "field_residual_max": float(cost["field_residual"].max()),
        "field_jump_max_N": float(cost["field_jump"].max()),
        "coupling_steps": int(cost["coupling_steps"].sum()),
        "coupling_steps_repeated": int(cost["coupling_steps_repeated"].sum()),
        "coupling_error_max": float(cost["coupling_error"].max()),
        "physics_wall_s": wall,
        "physics_real_time_factor": simulated / wall if wall > 0.0 else math.nan,
        "overruns": int((cost["real_time_factor"] < 1.0).sum()),
        "longest_block": _longest(cost),
    }


def _longest(cost: CostSeries) -> dict[str, Any]:
    """The block whose physics took longest: its time [s] and wall time [s], and its steps beside those of the median block."""
    place = int(cost["wall_time"].argmax())
    kind = "coupling_steps" if cost["coupling_steps"].any() else "steps"
    return {
        "at_s": float(cost["time"][place]), "wall_s": float(cost["wall_time"][place]),
        "of": kind.replace("_", " "), "steps": int(cost[kind][place]), "median_steps": float(np.median(cost[kind])),
    }  # fmt: skip


def longest_block_sentence(numbers: Mapping[str, Any]) -> str:
    """Which block of `solver_numbers` took longest; its steps say whether the physics or the machine was the cause."""
    longest = numbers["longest_block"]
    return (
        f"the longest, at {longest['at_s']:.5g} s, {1e3 * longest['wall_s']:.3g} ms "
        f"({longest['steps']} {longest['of']}, median {longest['median_steps']:g})"
    )


def _without_nan(value: Any) -> Any:
    """The same tree with None for numbers that are not finite: JSON has no nan."""
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
