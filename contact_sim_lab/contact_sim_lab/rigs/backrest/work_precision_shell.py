"""Work-precision study of the shell's linear response: 1, 4, 9 and 25 modes against a plate's
single series and against 40 401 modes.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_lab.rigs.backrest.twin_shell import plate_centre_deflection
from contact_sim_pkg.rigs.backrest.shell import MODE_COUNTS, ShallowShell, shell_modes, static_deflection

__all__ = ["PART", "WORK_PRECISION", "rows"]

Field = NDArray[numpy.float64]

PART = "shell response"
BACK = ShallowShell(
    length_1=0.40, length_2=0.50, thickness=0.030, young=0.6e6, poisson=0.45, density=1050.0, radius_1=0.6, radius_2=1.5
)
PLATE = BACK._replace(radius_1=math.inf, radius_2=math.inf)
DAMPING = 0.1
MIDDLE = numpy.array([[0.20, 0.25]])
SHAKEN = numpy.array([[0.16, 0.175]])  # 0.4 L1, 0.35 L2
LOAD = numpy.array([20.0])
MANY = 201**2
OWN = f"own code, {MANY} modes"
STATIC, STEADY = "static deflection", "steady amplitude at 5.25 Hz"


def rows() -> list[Row]:
    """Deflection at the crown: 20 N in the middle, at rest; the same force as an amplitude at (0.4
    L1, 0.35 L2).
    """
    rigidity = PLATE.young * PLATE.thickness**3 / (12.0 * (1.0 - PLATE.poisson**2))
    levy = plate_centre_deflection(PLATE.length_1, PLATE.length_2, rigidity, float(LOAD[0]))
    questions: tuple[tuple[str, str, Callable[[int], float], float, str], ...] = (
        ("plate", STATIC, lambda count: _static(PLATE, count), levy, "Lévy's single series, 30 digits"),
        ("back", STATIC, lambda count: _static(BACK, count), _static(BACK, MANY), OWN),
        ("back", STEADY, lambda count: steady_amplitude(BACK, count), steady_amplitude(BACK, MANY), OWN),
    )
    found: list[Row] = []
    for case, quantity, answer, expected, reference in questions:
        for count in MODE_COUNTS:
            name = f"{count} mode{'s' if count > 1 else ''}"
            fidelity = FidelityLevel(name, milliseconds(functools.partial(answer, count)))
            value = answer(count)
            error = relative(value, expected)
            found.append(row(PART, case, quantity, fidelity, reference, error, value=value, expected=expected))
    return found


def _static(shell: ShallowShell, count: int) -> float:
    return float(static_deflection(shell, count, LOAD, MIDDLE, MIDDLE)[0])


def steady_amplitude(shell: ShallowShell, count: int, frequency: float = 5.25) -> float:
    """Amplitude [m] at the crown under `20 N sin(2 pi f t)` at (0.4 L1, 0.35 L2), modal damping
    0.1.
    """
    modes, at_force = shell_modes(shell, count, MIDDLE), shell_modes(shell, count, SHAKEN)
    omega = 2.0 * math.pi * frequency
    stiffness = modes.modal_mass * (modes.frequencies**2 - omega**2 + 2j * DAMPING * modes.frequencies * omega)
    return float(abs((modes.shapes[0] * at_force.shapes[0] * LOAD[0] / stiffness).sum()))


WORK_PRECISION = (WorkPrecision(PART, rows),)
