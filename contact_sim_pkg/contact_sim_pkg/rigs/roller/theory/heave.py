"""A roller that runs over a wavy track: heave, contact load, separation and impact, cell by cell of
the track.

    m z'' = F - F_N - 2 zeta kappa m z',      k_c F^(2/3) + k_b F = Delta_0 + W(s) - z,      F = 0
    where the right side is not above 0

z, the height W of the track and the roller's way are counted outwards; Delta_0 is the approach at
rest under F_N. Linearised this is eq 20 with `kappa^2 = k_lin / m`, `1 / k_lin = (2/3) k_c
F_N^(-1/3) + k_b`. Each cell is passed in equal steps of the classical fourth-order rule, W and k_c
straight over the cell. Source: Rolling Contact, eq 20 and figure 15.

Energy: kinetic m z'^2 / 2, of the press F_N z, stored `U = (2/5) k_c F^(5/3) + k_b F^2 / 2`. The
track supplies `F W' - (3/5) F^(5/3) k_c'`, the damper takes `2 zeta kappa m z'^2`; both are summed
by the same rule.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_not_negative, require_positive, require_values
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach

__all__ = [
    "Heave",
    "Path",
    "closed_path",
    "contact_energy",
    "linear_stiffness",
    "make_heave",
    "natural_frequency",
    "ride",
]

Values = NDArray[numpy.float64]

LARGEST_PHASE = 0.06
"""kappa h of a step: `(kappa h)^6 / 144` of the amplitude is lost in a step, 4e-8 in a period."""


class Heave(NamedTuple):
    """Mass on its contact."""

    mass: float  # m [kg]
    damping_ratio: float  # zeta [1]
    load: float  # F_N [N], pressed on
    contact_coefficient: float  # k_c [m/N^(2/3)]
    bending_compliance: float  # k_b [m/N]; 0: the shaft does not bend


class Path(NamedTuple):
    """What passes under the roller, straight from place to place."""

    height: Values  # [cells + 1] W [m], outwards
    coefficient: Values  # [cells + 1] k_c [m/N^(2/3)]


def closed_path(heave: Heave, heights: Values) -> Path:
    """Round a track of `heights` [cells] [m], of the same k_c everywhere. Raises `ValueError` for
    heights that are not finite.
    """
    heights = require_values("track: heights", heights, "m", shape=(None,))
    if len(heights) == 0:
        raise ValueError("track: no heights, at least 1 is needed")
    return Path(numpy.append(heights, heights[0]), numpy.full(len(heights) + 1, heave.contact_coefficient))


def make_heave(
    mass: float, damping_ratio: float, load: float, contact_coefficient: float, bending_compliance: float
) -> Heave:
    """Checked values. Raises `ValueError` for values that are not finite, or not above 0 (zeta,
    k_b: below 0).

    mass: [kg]; load: [N]; contact_coefficient: k_c [m/N^(2/3)]; bending_compliance: k_b [m/N].
    """
    return Heave(
        require_positive("heave: mass", mass, "kg"),
        require_not_negative("heave: zeta", damping_ratio),
        require_positive("heave: load", load, "N"),
        require_positive("heave: k_c", contact_coefficient, "m/N^(2/3)"),
        require_not_negative("heave: k_b", bending_compliance, "m/N"),
    )


@entry
def linear_stiffness(heave: Heave) -> float:
    """k_lin [N/m] at the load at rest. Not checked: `make_heave` is."""
    soft = 2.0 / 3.0 * heave.contact_coefficient / heave.load ** (1.0 / 3.0)
    return float(1.0 / (soft + heave.bending_compliance))


@entry
def natural_frequency(heave: Heave) -> float:
    """kappa [rad/s]. Not checked: `make_heave` is."""
    return math.sqrt(linear_stiffness(heave) / heave.mass)


@entry
def contact_energy(contact_coefficient: float, bending_compliance: float, load: float) -> float:
    """U [J] that contact and shaft store under a load >= 0 [N]. Not checked."""
    return float(0.4 * contact_coefficient * load ** (5.0 / 3.0) + 0.5 * bending_compliance * load * load)


@entry
def ride(heave: Heave, path: Path, cell_time: float, turns: int, state: Values, loads: Values, motion: Values) -> float:
    """`turns` times over the `path`, each cell in `cell_time` [s]; returns the share of time
    without contact.

    `state` (z [m], z' [m/s]) goes on in place; with two values more, the energies [J] that the
    track has supplied and the damper taken. `loads` [cells] [N] takes the mean over the turns of
    the contact load at each cell, `motion` [cells, 2] z and z' there in the last turn. Not checked.
    """
    kappa = natural_frequency(heave)
    # Steps that resolve the natural motion.
    steps = max(1, int(math.ceil(kappa * cell_time / LARGEST_PHASE)))  # noqa: RUF046  # a float in compiled code
    step = cell_time / steps
    rest = heave.contact_coefficient * heave.load ** (2.0 / 3.0) + heave.bending_compliance * heave.load
    loads[:] = 0.0
    free = 0
    total = HeaveState(state[0], state[1], 0.0, 0.0)
    for _ in range(turns):
        for j in range(loads.shape[0]):
            # Height and coefficient are linear over a cell.
            rise = (path.height[j + 1] - path.height[j]) / steps
            soften = (path.coefficient[j + 1] - path.coefficient[j]) / steps
            load = load_of_approach(path.coefficient[j], heave.bending_compliance, rest + path.height[j] - total.z)
            loads[j] += load / turns
            motion[j, 0], motion[j, 1] = total.z, total.v
            for i in range(steps):
                free += 1 if load == 0.0 else 0
                # Loads are sampled at the cells' starts, the heave goes on in steps.
                start = Place(rest + path.height[j] + rise * i, path.coefficient[j] + soften * i)
                end = Place(rest + path.height[j] + rise * (i + 1), path.coefficient[j] + soften * (i + 1))
                total, load = _step(heave, kappa, start, end, step, total, load)
    state[0], state[1] = total.z, total.v
    if state.shape[0] > 2:
        state[2] += total.supplied
        state[3] += total.dissipated
    return free / (turns * loads.shape[0] * steps)


class HeaveState(NamedTuple):
    """Of the heave, and energies since the start of a ride."""

    z: float  # [m]
    v: float  # [m/s]
    supplied: float  # [J] by the track
    dissipated: float  # [J]


class Place(NamedTuple):
    """Of the path."""

    height: float  # [m] W + Delta_0
    coefficient: float  # k_c [m/N^(2/3)]


@kernel
def _step(
    heave: Heave, kappa: float, start: Place, end: Place, step: float, now: HeaveState, load: float
) -> tuple[HeaveState, float]:
    """One step of the classical rule; `load` belongs to its start. Returns state and load at its
    end.
    """
    drag, k_b = 2.0 * heave.damping_ratio * kappa, heave.bending_compliance
    middle, k_middle = 0.5 * (start.height + end.height), 0.5 * (start.coefficient + end.coefficient)
    z, v = now.z, now.v
    # The four slopes of the classical Runge-Kutta rule.
    a1 = (load - heave.load) / heave.mass - drag * v
    v2 = v + 0.5 * step * a1
    f2 = load_of_approach(k_middle, k_b, middle - z - 0.5 * step * v)
    a2 = (f2 - heave.load) / heave.mass - drag * v2
    v3 = v + 0.5 * step * a2
    f3 = load_of_approach(k_middle, k_b, middle - z - 0.5 * step * v2)
    a3 = (f3 - heave.load) / heave.mass - drag * v3
    v4 = v + step * a3
    f4 = load_of_approach(end.coefficient, k_b, end.height - z - step * v3)
    a4 = (f4 - heave.load) / heave.mass - drag * v4
    # Work of the road and of the damper by the same rule.
    pushed = (end.height - start.height) / 6.0 * (load + 2.0 * f2 + 2.0 * f3 + f4)
    if end.coefficient != start.coefficient:
        softened = load ** (5.0 / 3.0) + 2.0 * f2 ** (5.0 / 3.0) + 2.0 * f3 ** (5.0 / 3.0) + f4 ** (5.0 / 3.0)
        pushed -= 0.1 * (end.coefficient - start.coefficient) * softened
    lost = drag * heave.mass * step / 6.0 * (v * v + 2.0 * v2 * v2 + 2.0 * v3 * v3 + v4 * v4)
    # New state.
    z += step / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
    v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    after = HeaveState(z, v, now.supplied + pushed, now.dissipated + lost)
    return after, load_of_approach(end.coefficient, k_b, end.height - z)
