"""A run's loads and pressures over those of the tire at rest."""

from __future__ import annotations

from typing import Any

from .series import ContactSeries, FieldSeries
from .tire_reference import TireReference


def tire_numbers(contact: ContactSeries, field: FieldSeries | None, reference: TireReference | None) -> dict[str, Any]:
    """Ratios of a run, ready for JSON; those that need a field or a reference are absent without it.

    `dynamic_load_coefficient` is the standard deviation of the normal force over the standing load.
    """
    numbers: dict[str, Any] = {}
    if reference is not None:
        numbers["standing_load_N"] = reference.load
        numbers["load_max_over_standing"] = float(contact.normal.max()) / reference.load
        numbers["dynamic_load_coefficient"] = float(contact.normal.std()) / reference.load
    if reference is not None and field is not None:
        numbers["reference_peak_pressure_Pa"] = reference.peak_pressure
        numbers["peak_pressure_over_reference"] = float(field.peak.max()) / reference.peak_pressure
    return numbers
