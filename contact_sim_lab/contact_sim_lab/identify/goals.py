"""Goals of the identification: error of m/J and of the impulses without noise, and what noise
leaves from ten impacts.
"""

from __future__ import annotations

from contact_sim_lab.identify import hard_cases as cases
from contact_sim_lab.records.goal import GoalPart, Measured

__all__ = ["GOALS", "goals"]

NOTE = f"{cases.DRAWS} draws of {cases.IMPACTS} impacts, one sample before and after each, 1 mm/s and 10 mrad/s"


def goals() -> list[Measured]:
    """Errors against the goals."""
    ratio = float(cases.reported_noise().value)
    return [
        Measured("m/J from states at 1 kHz without noise: error", float(cases.between_samples().value), "", 1e-9),
        Measured("c_n/m, c_t/m of every impact without noise: error", float(cases.impulses().value), "", 1e-9),
        Measured(
            "mass with a known force: error", abs(float(cases.mass_with_force().value) / cases.MASS - 1.0), "", 1e-9
        ),
        Measured("m/J with noise: rms error", 100.0 * float(cases.noise().value), "%", 0.15, note=NOTE),
        Measured("the same over the reported standard deviation, less 1", abs(ratio - 1.0), "", 0.3, note=NOTE),
    ]


GOALS = (GoalPart("identification", goals),)
