"""The guards of `compiled/guards.py` with the error of the impact model."""

from __future__ import annotations

import functools

from contact_sim_pkg.compiled import guards
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "check_fields",
    "check_not_negative",
    "check_number",
    "check_poisson_ratio",
    "check_positive",
    "check_values",
]

check_number = functools.partial(guards.require, error=ImpactError)
check_fields = functools.partial(guards.require_fields, error=ImpactError)
check_not_negative = functools.partial(guards.require_not_negative, error=ImpactError)
check_poisson_ratio = functools.partial(guards.require_poisson_ratio, error=ImpactError)
check_positive = functools.partial(guards.require_positive, error=ImpactError)
check_values = functools.partial(guards.require_values, error=ImpactError)
