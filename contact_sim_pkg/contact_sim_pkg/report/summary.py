"""The numbers of a run that a person or a script needs first.

A run that a signal ends still prints them, so what only one rig needs and takes long to load is
loaded there.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.compare.estimated import accuracy_numbers
from contact_sim_pkg.report.energy import relative_residual, throughput
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rig_reports import contact_numbers, ledger_scope, rig_warnings, summary_numbers
from contact_sim_pkg.report.series import ContactSeries, CostSeries, FieldSeries, LedgerSeries, Recording
from contact_sim_pkg.report.signal.episodes import slap_numbers


def summarise(bag: Bag) -> dict[str, Any]:
    """Summary numbers of a bag; see `summarise_recording`. Raises BagError where the bag cannot be
    read.
    """
    return summarise_recording(read_recording(bag))


def summarise_recording(recording: Recording) -> dict[str, Any]:
    """Summary numbers, ready for JSON: SI units in the names, None where a number is not defined.

    Sections that the run does not have are absent: `slaps` without contact episodes, `energy`
    without a ledger, `solver` without cost messages, the pressure of a contact without a field,
    `warnings` where there is nothing to warn of. Rigs add sections and numbers of their contacts
    (`records.report`).
    """
    summary: dict[str, Any] = {
        "scene": recording.scene.get("name"),
        "rig": recording.scene.get("rig"),
        "simulated_s": round(recording.duration, 9),
        "contacts": {
            name: {
                **force_numbers(series),
                **field_numbers(recording.fields.get(name)),
                **contact_numbers(name, recording),
            }
            for name, series in recording.contacts.items()
        },
    }
    # Sections by what the recording holds
    if recording.episodes is not None:
        summary["slaps"] = slap_numbers(recording.episodes)
    summary |= summary_numbers(recording)
    if warnings := rig_warnings(recording):
        summary["warnings"] = warnings
    if recording.ledger is not None:
        summary["energy"] = energy_numbers(recording.ledger) | _scope(recording)
    if recording.cost is not None:
        summary["solver"] = solver_numbers(recording.cost)
        if accuracy := accuracy_numbers(recording):
            summary["accuracy"] = accuracy
    summary["messages"] = {topic.name: topic.messages for topic in recording.topics}
    defined: dict[str, Any] = _without_nan(summary)
    return defined


def force_numbers(contact: ContactSeries) -> dict[str, Any]:
    """Load in [N], share of the time without contact (0 .. 1), number of lift-offs: from a load to
    none.
    """
    separated = contact.normal <= 0.0
    return {
        "load_mean_N": float(contact.normal.mean()),
        "load_min_N": float(contact.normal.min()),
        "load_max_N": float(contact.normal.max()),
        "lifted_share": float(separated.mean()),
        "lift_offs": int(np.count_nonzero(separated[1:] & ~separated[:-1])),
    }


def field_numbers(field: FieldSeries | None) -> dict[str, Any]:
    """Largest pressure and when, mean contact area over all recorded instants; empty without a
    field.
    """
    if field is None:
        return {}
    return {
        "peak_pressure_Pa": float(field.peak.max()),
        "peak_pressure_time_s": field.highest_time,
        "contact_area_mean_m2": float(field.area.mean()),
    }


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
    """Steps, events and iterations over the run; wall time of the physics; largest field residual
    and jump.
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
        "stretches": int(cost["stretches"].sum()),
        "stretches_repeated": int(cost["stretches_repeated"].sum()),
        "coupling_error_max": float(cost["coupling_error"].max()),
        "physics_wall_s": wall,
        "physics_real_time_factor": simulated / wall if wall > 0.0 else math.nan,
    }


def _without_nan(value: Any) -> Any:
    """The same tree with None for numbers that are not finite: JSON has no nan."""
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    return None if isinstance(value, float) and not math.isfinite(value) else value
