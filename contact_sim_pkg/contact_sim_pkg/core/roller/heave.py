"""A roller that runs over a wavy track: heave, contact load, separation and impact, cell by cell of the track.

    m z'' = F - F_N - 2 zeta kappa m z',      k_c F^(2/3) + k_b F = Delta_0 + W(s) - z,      F = 0 where the right side is not
    above 0

z, the height W of the track and the roller's way are counted outwards; Delta_0 is the approach at rest under F_N. Linearised
this is eq 20 with `kappa^2 = k_lin / m`, `1 / k_lin = (2/3) k_c F_N^(-1/3) + k_b`. Each cell is passed in equal steps of the
classical fourth-order rule, W straight over the cell. Source: the paper on rolling vibro-impact, eq 20 and figure 15.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.jit import entry, kernel
from contact_sim_pkg.core.roller.load_split import load_of_approach

__all__ = ["Heave", "linear_stiffness", "make_heave", "natural_frequency", "ride"]

Values = NDArray[numpy.float64]

LARGEST_PHASE = 0.06
"""kappa h of a step: `(kappa h)^6 / 144` of the amplitude is lost in a step, 4e-8 in a period."""


class Heave(NamedTuple):
    """Mass on its contact."""

    mass: float  # m [kg]
    damping_ratio: float  # zeta [-]
    load: float  # F_N [N], pressed on
    contact_coefficient: float  # k_c [m/N^(2/3)]
    bending_compliance: float  # k_b [m/N]; 0: the shaft does not bend


def make_heave(
    mass: float, damping_ratio: float, load: float, contact_coefficient: float, bending_compliance: float
) -> Heave:
    """Checked values. Raises `ValueError` for values that are not finite, or not above 0 (zeta, k_b: below 0)."""
    values = (mass, damping_ratio, load, contact_coefficient, bending_compliance)
    if not all(math.isfinite(value) for value in values) or min(mass, load, contact_coefficient) <= 0.0:
        raise ValueError(
            f"heave: mass, load and k_c must be finite and above 0, they are {mass}, {load}, {contact_coefficient}"
        )
    if damping_ratio < 0.0 or bending_compliance < 0.0:
        raise ValueError(f"heave: zeta and k_b must be at least 0, they are {damping_ratio}, {bending_compliance}")
    return Heave(*(float(value) for value in values))


@entry
def linear_stiffness(heave: Heave) -> float:
    """k_lin [N/m] at the load at rest."""
    soft = 2.0 / 3.0 * heave.contact_coefficient / heave.load ** (1.0 / 3.0)
    return float(1.0 / (soft + heave.bending_compliance))


@entry
def natural_frequency(heave: Heave) -> float:
    """kappa [rad/s]."""
    return math.sqrt(linear_stiffness(heave) / heave.mass)


@entry
def ride(
    heave: Heave, track: Values, cell_time: float, turns: int, state: Values, loads: Values, motion: Values
) -> float:
    """`turns` turns of the `track` [cells] [m], each cell in `cell_time` [s]; returns the share of time without contact.

    `state` (z [m], z' [m/s]) goes on in place. `loads` [cells] [N] takes the mean over the turns of the contact load at each cell,
    `motion` [cells, 2] z and z' there in the last turn.
    """
    kappa = natural_frequency(heave)
    steps = max(1, int(math.ceil(kappa * cell_time / LARGEST_PHASE)))  # noqa: RUF046  # a float in compiled code
    step = cell_time / steps
    rest = heave.contact_coefficient * heave.load ** (2.0 / 3.0) + heave.bending_compliance * heave.load
    cells = track.shape[0]
    loads[:] = 0.0
    free = 0
    z, v = state[0], state[1]
    for _ in range(turns):
        for j in range(cells):
            start, end = track[j], track[j + 1 if j + 1 < cells else 0]
            load = load_of_approach(heave.contact_coefficient, heave.bending_compliance, rest + start - z)
            loads[j] += load / turns
            motion[j, 0], motion[j, 1] = z, v
            for i in range(steps):
                free += 1 if load == 0.0 else 0
                low, high = start + (end - start) * i / steps, start + (end - start) * (i + 1) / steps
                z, v, load = _step(heave, kappa, rest, low, high, step, z, v, load)
    state[0], state[1] = z, v
    return free / (turns * cells * steps)


@kernel
def _step(
    heave: Heave, kappa: float, rest: float, low: float, high: float, step: float, z: float, v: float, load: float
) -> tuple[float, float, float]:
    """One step of the classical rule; `load` belongs to its start. Returns place, speed and load at its end."""
    drag, middle = 2.0 * heave.damping_ratio * kappa, rest + 0.5 * (low + high)
    k_c, k_b = heave.contact_coefficient, heave.bending_compliance
    a1 = (load - heave.load) / heave.mass - drag * v
    v2 = v + 0.5 * step * a1
    a2 = (load_of_approach(k_c, k_b, middle - z - 0.5 * step * v) - heave.load) / heave.mass - drag * v2
    v3 = v + 0.5 * step * a2
    a3 = (load_of_approach(k_c, k_b, middle - z - 0.5 * step * v2) - heave.load) / heave.mass - drag * v3
    v4 = v + step * a3
    a4 = (load_of_approach(k_c, k_b, rest + high - z - step * v3) - heave.load) / heave.mass - drag * v4
    z += step / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
    v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return z, v, load_of_approach(k_c, k_b, rest + high - z)
