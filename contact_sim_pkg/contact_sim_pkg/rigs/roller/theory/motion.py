"""Tilt and yaw of a roller in time, by Gauss's implicit Runge-Kutta rules: they add no damping and
take none away.

    I_y psi'' + I_yz theta'' + G theta' + c_psi psi' + k_psi psi = M_psi,        G = i omega
    I_yz psi'' + I_z theta'' - G psi' + c_theta theta' + k_theta theta = M_theta

One stage is the implicit midpoint rule (order 2), two have order 4, three order 6. All are
symplectic: without friction and damping the energy errs within a bound that does not grow. The load
goes straight over a step.

Energy: kinetic and stored in the suspension, of the pressure `-F R (1 - cos psi)`, conserved where
f_r = 0, nothing is bent or damped and F rests. Rolling, bending and a changing load supply, damping
takes; both are summed by the same rule.

Sources: eqs 8 and 18 of Rolling Contact; Hairer, Lubich, Wanner (2006), Geometric Numerical
Integration, II.1.3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_count, require_fields, require_values
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.roller.theory.moments import Moments, moments_of_bent, moments_of_straight
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller
from contact_sim_pkg.rigs.roller.theory.yaw_ellipse import ellipse_at_yaw, empty_fit

__all__ = [
    "DIVERGED",
    "DONE",
    "LARGEST_TILT",
    "TiltYawEnergies",
    "accelerations",
    "energies",
    "energy",
    "gauss_rule",
    "integrate_tilt_yaw",
]

Values = NDArray[numpy.float64]

DONE, DIVERGED, NO_CONVERGENCE = 0, 1, 2

LARGEST_TILT = 0.2
"""[rad]: beyond it the roller has tipped over."""

ITERATIONS = 100


class TiltYawProblem(NamedTuple):
    """What the derivative of tilt and yaw depends on, but load and state."""

    roller: Roller
    curvatures: Curvatures
    bending: Bending | None
    modulus: float  # [Pa]
    fit: Values  # series of the contact ellipse over the yaw, see `yaw_ellipse.py`


class LoadStep(NamedTuple):
    """One step in time, over which the load is linear."""

    length: float  # [s]
    load: float  # [N] at the start
    load_end: float  # [N]


class StageArrays(NamedTuple):
    """Runge-Kutta rule and its scratch."""

    table: Values  # [stages + 1, stages + 1], see `gauss_rule`
    slopes: Values  # [stages, 4] time derivatives of the state
    trial: Values  # [4]


def gauss_rule(stages: int) -> Values:
    """Table of a Gauss rule, [stages + 1, stages + 1]: rows of `A | c`, the last row the weights.

    stages: 1 to 4, else `ValueError`.
    """
    stages = require_count("Gauss rule: stages", stages, most=4)
    roots, sizes = numpy.polynomial.legendre.leggauss(stages)
    nodes, weights = 0.5 * (roots + 1.0), 0.5 * sizes
    powers = numpy.arange(stages)
    vandermonde = nodes[:, None] ** powers
    integrals = nodes[:, None] ** (powers + 1) / (powers + 1)
    table = numpy.zeros((stages + 1, stages + 1))
    table[:stages, :stages] = integrals @ numpy.linalg.inv(vandermonde)
    table[:stages, stages] = nodes
    table[stages, :stages] = weights
    return table


@entry
def integrate_tilt_yaw(
    roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, loads: Values, step: float,
    table: Values, state: Values, record: Values,
) -> int:  # fmt: skip
    """Steps of `step` [s] over `loads` [steps + 1] [N]; `state` (psi, theta, psi', theta') changes
    in place; with two values more, the energies [J] that were supplied and dissipated.

    `record` [rows, 4] takes the state at the start and after every `steps / (rows - 1)` steps.
    Returns DONE, DIVERGED where the tilt passes `LARGEST_TILT`, NO_CONVERGENCE where the step is
    too long for its iteration; what is not reached is NaN. Not checked.
    """
    stages, steps = table.shape[0] - 1, loads.shape[0] - 1
    problem = TiltYawProblem(roller, curvatures, bending, modulus, empty_fit())
    scratch = StageArrays(table, numpy.zeros((stages, 4)), numpy.zeros(4))
    slopes = scratch.slopes
    # First guess of all stages: the rate at the start.
    _fill(problem, loads[0], state, slopes[0])
    for i in range(1, stages):
        _copy(slopes[0], slopes[i])
    every = steps // max(1, record.shape[0] - 1)
    record[:, :] = numpy.nan
    _copy(state, record[0])
    for n in range(steps):
        # Stages of this step, and the energies that they transfer.
        load_step = LoadStep(step, loads[n], loads[n + 1])
        if not _solve(problem, load_step, state, scratch):
            return NO_CONVERGENCE
        if state.shape[0] > 4:
            _sum_powers(problem, load_step, state, scratch)
        # New state.
        for j in range(4):
            for i in range(stages):
                state[j] += step * table[stages, i] * slopes[i, j]
        if not abs(state[0]) <= LARGEST_TILT:
            return DIVERGED
        if (n + 1) % every == 0 and (n + 1) // every < record.shape[0]:
            _copy(state, record[(n + 1) // every])
    return DONE


@kernel
def _solve(problem: TiltYawProblem, load_step: LoadStep, state: Values, scratch: StageArrays) -> bool:
    """Slopes of the stages by repeated substitution, from those of the step before.

    To rounding of the moments that make them; whether it converges.
    """
    step, load, load_end = load_step
    table, slopes, trial = scratch
    stages = table.shape[0] - 1
    before, terms = numpy.inf, _largest_term(problem.roller, load, state)
    for _ in range(ITERATIONS):
        change, size = 0.0, terms
        # Slopes of all stages from those of the last iteration.
        for i in range(stages):
            for j in range(4):
                total = 0.0
                for k in range(stages):
                    total += table[i, k] * slopes[k, j]
                trial[j] = state[j] + step * total
            here = load + table[i, stages] * (load_end - load)
            old_tilt, old_yaw = slopes[i, 2], slopes[i, 3]
            _fill(problem, here, trial, slopes[i])
            change = max(change, abs(slopes[i, 2] - old_tilt), abs(slopes[i, 3] - old_yaw))
            size = max(size, abs(slopes[i, 2]), abs(slopes[i, 3]))
        # Converged to rounding.
        if change <= 4e-16 * size or (change <= 1e-12 * size and change >= before):
            return True
        before = change
    return size == 0.0


@kernel
def _largest_term(roller: Roller, load: float, state: Values) -> float:
    """[rad/s^2] of what cancels in a state near rest."""
    about_y = max(roller.stiffness_tilt, load * roller.radius) * abs(state[0])
    about_z = roller.stiffness_yaw * abs(state[1])
    determinant = roller.inertia_tilt * roller.inertia_yaw - roller.inertia_product**2
    return float(max(about_y * roller.inertia_yaw, about_z * roller.inertia_tilt) / determinant)


@kernel
def _fill(problem: TiltYawProblem, load: float, state: Values, slope: Values) -> None:
    """Time derivative of a state."""
    roller, tilt, yaw = problem.roller, state[0], state[1]
    moment = _moments(problem, problem.bending, load, tilt, yaw)
    gyro = roller.inertia_spin * roller.spin
    about_y = moment.tilt - roller.stiffness_tilt * tilt - roller.damping_tilt * state[2] - gyro * state[3]
    about_z = moment.yaw - roller.stiffness_yaw * yaw - roller.damping_yaw * state[3] + gyro * state[2]
    determinant = roller.inertia_tilt * roller.inertia_yaw - roller.inertia_product**2
    slope[0], slope[1] = state[2], state[3]
    slope[2] = (roller.inertia_yaw * about_y - roller.inertia_product * about_z) / determinant
    slope[3] = (roller.inertia_tilt * about_z - roller.inertia_product * about_y) / determinant


@kernel
def _moments(problem: TiltYawProblem, bending: Bending | None, load: float, tilt: float, yaw: float) -> Moments:
    """`moments`, with the ellipse from its series over the yaw.

    `bending` is an argument of its own, for numba removes the branch of an absent effect for
    arguments alone.
    """
    if bending is not None and load > 0.0:
        ellipse = ellipse_at_yaw(problem.curvatures, problem.modulus, yaw, problem.fit)
        return moments_of_bent(problem.roller, bending, load, tilt, ellipse)
    return moments_of_straight(problem.roller, load, tilt)


@kernel
def _sum_powers(problem: TiltYawProblem, load_step: LoadStep, state: Values, scratch: StageArrays) -> None:
    """Add what a step supplies and dissipates, from its stages."""
    roller = problem.roller
    step, load, load_end = load_step
    table, slopes, trial = scratch
    stages, rise = table.shape[0] - 1, (load_end - load) / step
    for i in range(stages):
        for j in range(4):
            trial[j] = state[j]
            for k in range(stages):
                trial[j] += step * table[i, k] * slopes[k, j]
        here = load + table[i, stages] * (load_end - load)
        moment = _moments(problem, problem.bending, here, trial[0], trial[1])
        about_y = moment.tilt - here * roller.radius * math.sin(trial[0])
        supplied = about_y * trial[2] + moment.yaw * trial[3] - rise * _lowered(roller, trial[0])
        dissipated = roller.damping_tilt * trial[2] ** 2 + roller.damping_yaw * trial[3] ** 2
        state[4] += step * table[stages, i] * supplied
        state[5] += step * table[stages, i] * dissipated


@kernel
def _lowered(roller: Roller, tilt: float) -> float:
    """R (1 - cos psi) [m], by which a tilted roller gives way to the load."""
    return roller.radius * 2.0 * math.sin(0.5 * tilt) ** 2


@kernel
def _copy(values: Values, out: Values) -> None:
    for j in range(4):
        out[j] = values[j]


@entry
def accelerations(
    roller: Roller, curvatures: Values, bending: Bending | None, modulus: float, loads: Values, states: Values, out: Values
) -> None:  # fmt: skip
    """psi'' and theta'' [rows, 2] [rad/s^2] of states [rows, 4] under loads [rows] [N]; curvatures
    [rows, 4] as `Curvatures`.

    Not checked.
    """
    slope, fit = numpy.zeros(4), empty_fit()
    for i in range(loads.shape[0]):
        here = Curvatures(curvatures[i, 0], curvatures[i, 1], curvatures[i, 2], curvatures[i, 3])
        if i > 0 and not _equal(curvatures[i], curvatures[i - 1]):
            fit[0, 1] = -1.0
        problem = TiltYawProblem(roller, here, bending, modulus, fit)
        _fill(problem, loads[i], states[i], slope)
        out[i, 0], out[i, 1] = slope[2], slope[3]


@kernel
def _equal(values: Values, others: Values) -> bool:
    equal = True
    for j in range(values.shape[0]):
        equal = equal and values[j] == others[j]
    return equal


class TiltYawEnergies(NamedTuple):
    """Of tilt and yaw [J]."""

    kinetic: float
    stored: float  # in the suspension
    potential: float  # -F R (1 - cos psi)


@entry
def energies(roller: Roller, load: float, state: Values) -> TiltYawEnergies:
    """Under a load [N]; their sum is conserved where f_r = 0, nothing is bent, nothing damps and
    the load rests.

    Not checked: `energy` is.
    """
    kinetic = 0.5 * (roller.inertia_tilt * state[2] ** 2 + roller.inertia_yaw * state[3] ** 2)
    kinetic += roller.inertia_product * state[2] * state[3]
    stored = 0.5 * (roller.stiffness_tilt * state[0] ** 2 + roller.stiffness_yaw * state[1] ** 2)
    return TiltYawEnergies(kinetic, stored, -load * _lowered(roller, state[0]))


def energy(roller: Roller, load: float, state: Values) -> float:
    """Sum of `energies` [J] of a state (psi, theta, psi', theta') under a load [N].

    Raises `ValueError` for values that are not finite and a state of fewer than 4 numbers.
    """
    require_fields("roller", roller, finite=" ".join(Roller._fields))
    require("load", load, "N")
    if len(require_values("state", state, shape=(None,))) < 4:
        raise ValueError(f"state: {len(state)} numbers, 4 are needed")
    return float(sum(energies(roller, load, state)))
