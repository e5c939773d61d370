"""Time-temperature shift, with the impact speed as frequency (Goloshchapov eqs 106, 107).

WLF: ``lg a_T = -C1 (T - Tg)/(C2 + T - Tg)``; Arrhenius: ``lg a_T = U/(ln 10 R_g) (1/T - 1/Tg)``.
States of equal ``V a_T(T)`` are equal: what was measured at V1 over temperature holds for (V, T)
the value at T* with ``lg a_T(T*) = lg a_T(T) + lg(V/V1)``. Moduli, tan(beta) and k carry over;
the contact time is read at T* and multiplied by ``(V/V1)^(-1/5)``, which is geometry.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_number, check_positive
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "Arrhenius",
    "Shift",
    "Wlf",
    "carried_duration",
    "equivalent_temperature",
    "log_shift",
    "shift_note",
    "temperature_of_shift",
]

GAS_CONSTANT = 8.31446261815324  # [J/(mol K)], CODATA 2018, exact
WLF_RANGE = 100.0  # [K] above Tg


class Wlf(NamedTuple):
    """Williams, Landel and Ferry, from the glass temperature."""

    glass_temperature: float  # Tg [K], > 0
    c1: float = 17.44  # > 0
    c2: float = 51.6  # [K], > 0


class Arrhenius(NamedTuple):
    """One activation energy."""

    reference_temperature: float  # [K], > 0
    activation_energy: float  # U [J/mol], > 0


Shift = Wlf | Arrhenius


def log_shift(shift: Shift, temperature: float) -> float:
    """``lg a_T`` at ``temperature`` [K]. Raises ImpactError for WLF at T <= Tg - C2, where it has
    its pole.

    Also for a temperature or a parameter of the shift that is not above 0.
    """
    _check(shift)
    check_positive("temperature", temperature, "K")
    if isinstance(shift, Arrhenius):
        slope = shift.activation_energy / (math.log(10.0) * GAS_CONSTANT)
        return slope * (1.0 / temperature - 1.0 / shift.reference_temperature)
    above = temperature - shift.glass_temperature
    if temperature <= shift.glass_temperature - shift.c2:
        raise ImpactError(
            f"temperature {temperature:g} K: WLF has its pole at {shift.glass_temperature - shift.c2:g} K; "
            "above it only is there a shift"
        )
    return -shift.c1 * above / (shift.c2 + above)


def temperature_of_shift(shift: Shift, value: float) -> float:
    """T in [K] with ``lg a_T = value``.

    Raises ImpactError where there is none, and as `log_shift`.
    """
    _check(shift)
    check_number("shift", value)
    if isinstance(shift, Arrhenius):
        slope = shift.activation_energy / (math.log(10.0) * GAS_CONSTANT)
        # Arrhenius: lg a_T is linear in 1/T.
        inverse = 1.0 / shift.reference_temperature + value / slope
        if inverse <= 0.0:
            raise ImpactError(
                f"shift {value:.4g}: no temperature has it; the least is {-slope / shift.reference_temperature:.4g}"
            )
        return 1.0 / inverse
    if value <= -shift.c1:
        raise ImpactError(f"shift {value:.4g}: WLF ends above {-shift.c1:g}, whatever the temperature")
    # WLF solved for T.
    temperature = shift.glass_temperature - shift.c2 * value / (shift.c1 + value)
    if temperature <= 0.0:
        raise ImpactError(f"shift {value:.4g}: its temperature would be {temperature:.4g} K")
    return temperature


def equivalent_temperature(shift: Shift, temperature: float, speed: float, table_speed: float) -> float:
    """T* in [K] at which a table measured at ``table_speed`` stands for ``temperature`` [K] and
    ``speed``.

    Speeds or frequencies alike, > 0. Errors as `log_shift` and `temperature_of_shift`.
    """
    check_positive("speed", speed)
    check_positive("speed of the table", table_speed)
    return temperature_of_shift(shift, log_shift(shift, temperature) + math.log10(speed / table_speed))


def carried_duration(duration: float, speed: float, table_speed: float) -> float:
    """Contact time in [s] at ``speed`` from that read at T*: times ``(V/V1)^(-1/5)``; all > 0, else
    ImpactError.
    """
    check_positive("duration", duration, "s")
    check_positive("speed", speed)
    check_positive("speed of the table", table_speed)
    return float(duration * (speed / table_speed) ** -0.2)


def shift_note(shift: Shift, temperature: float) -> str | None:
    """A sentence outside Tg to Tg + 100 K, where WLF is not meant to hold; else None. Errors as
    `log_shift`.

    temperature: [K].
    """
    _check(shift)
    check_positive("temperature", temperature, "K")
    if isinstance(shift, Wlf) and not 0.0 <= temperature - shift.glass_temperature <= WLF_RANGE:
        low = shift.glass_temperature
        return f"temperature {temperature:g} K is outside {low:g} to {low + WLF_RANGE:g} K, the range of WLF"
    return None


def _check(shift: Shift) -> None:
    if isinstance(shift, Wlf):
        check_fields("WLF", shift, positive="glass_temperature c1 c2")
    else:
        check_fields("Arrhenius", shift, positive="reference_temperature activation_energy")
