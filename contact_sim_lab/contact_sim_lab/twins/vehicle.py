"""Seat, tire and car rigs with point contacts, vertical motion, by scipy's DOP853 from event to
event; free of kernel code.

The drive (heights of road and cushion, acceleration of the floor) is linear in each segment, as in
the rigs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

__all__ = ["Law", "Occupant", "Quarter", "law_by_table", "normal_force", "power_law", "states_at_segments"]

State = NDArray[numpy.float64]
Rate = Callable[[float, State], State]
RELATIVE, ABSOLUTE = 1.0e-12, 1.0e-14


class Law(NamedTuple):
    """`F = E(x) (1 + damping x') + B x^p sgn(x') |x'|^q` for x > 0, never below `lowest`; E [N] of x
    [m] the elastic force.
    """

    elastic: Callable[[float], float]
    damping: float
    dissipation: tuple[float, float, float] = (0.0, 0.0, 1.0)  # B, p, q
    lowest: float = 0.0  # [N]; -inf where the contact may pull

    def unlimited(self, approach: float, rate: float) -> float:
        """The sum before it is limited, at an approach above 0."""
        b, p, q = self.dissipation
        viscous = b * approach**p * numpy.sign(rate) * abs(rate) ** q if b > 0.0 else 0.0
        return float(self.elastic(approach) * (1.0 + self.damping * rate) + viscous)

    def tension(self, approach: float, rate: float) -> float:
        """Positive while the contact does not pull; 1 where it may."""
        if self.lowest < 0.0:
            return 1.0
        if self.dissipation[0] == 0.0:
            return 1.0 + self.damping * rate
        return self.unlimited(max(approach, 1e-9), rate)


def power_law(coefficient: float, exponent: float) -> Callable[[float], float]:
    """`E(x) = coefficient x^exponent`."""
    return lambda approach: float(coefficient * approach**exponent)


def law_by_table(spacing: float, force: State) -> Callable[[float], float]:
    """Monotone cubic through `force` [N] at 0, `spacing`, 2 `spacing` ... [m] by scipy, straight beyond
    the last.
    """
    curve = PchipInterpolator(spacing * numpy.arange(len(force)), force)
    last = spacing * (len(force) - 1)
    slope = float(curve.derivative()(last))
    return lambda approach: float(curve(min(approach, last))) + slope * max(approach - last, 0.0)


class Belt(NamedTuple):
    """Belt ring [kg] on its sidewalls [N/m], [N s/m]; state [z_r, v_r] behind that of the quarter
    car.
    """

    mass: float
    stiffness: float
    damping: float


class Quarter(NamedTuple):
    """Wheel and body [kg], suspension [N/m], [N s/m]; state [z_w, z_b, v_w, v_b]."""

    wheel_mass: float
    body_mass: float
    stiffness: float
    damping: float
    law: Law
    belt: Belt | None = None

    @property
    def states(self) -> int:
        """Number of state variables."""
        return 4 if self.belt is None else 6


class Occupant(NamedTuple):
    """Masses [kg], the first in contact and perhaps 0, and links between any two [N/m], [N s/m];
    state [z_0 .. z_n, v_0 .. v_n], v_0 of a massless one being of no account.
    """

    masses: State
    ends: NDArray[numpy.int64]  # [links, 2]
    stiffness: State
    damping: State
    law: Law

    def matrix(self, values: State) -> State:
        """Matrix [masses, masses] of the links with these stiffnesses or dampings."""
        incidence = numpy.zeros((len(values), len(self.masses)))
        for row, (lower, upper) in zip(incidence, self.ends, strict=True):
            row[lower], row[upper] = -1.0, 1.0
        return incidence.T @ numpy.diag(values) @ incidence


class _Drive(NamedTuple):
    start: float
    height: tuple[float, float]  # [m], [m/s]
    cushion: tuple[float, float]
    acceleration: tuple[float, float]  # [m/s^2], [m/s^3]


def normal_force(law: Law, approach: float, rate: float) -> float:
    """Normal force [N]."""
    return max(law.lowest, law.unlimited(approach, rate)) if approach > 0.0 else 0.0


def states_at_segments(
    gravity: float, quarter: Quarter | None, occupant: Occupant | None, start: State, length: float,
    height: State, cushion: State, acceleration: State,
) -> State:  # fmt: skip
    """States at the ends of all segments of `length` [s], [segments + 1, states]; the drive is
    given at the segments' ends.
    """
    states = numpy.empty((len(height), len(start)))
    states[0] = start
    state, directions = numpy.array(start, dtype=float), None
    for i in range(len(height) - 1):
        pairs = ((values[i], (values[i + 1] - values[i]) / length) for values in (height, cushion, acceleration))
        drive = _Drive(i * length, *pairs)
        event_functions = _event_functions(quarter, occupant, drive)
        if directions is None:
            directions = [
                1.0 if event_function(drive.start, state) >= 0.0 else -1.0 for event_function in event_functions
            ]
        rate, end = _rate(gravity, quarter, occupant, drive), (i + 1) * length
        state = _segment(rate, event_functions, directions, drive.start, end, state)
        states[i + 1] = state
    return states


def _segment(
    rate: Rate,
    event_functions: list[Callable[[float, State], float]],
    directions: list[float],
    time: float,
    end: float,
    state: State,
) -> State:
    """One segment, from change of contact to change of contact; `directions` changes in place."""
    while True:
        for event_function, direction in zip(event_functions, directions, strict=True):
            event_function.terminal, event_function.direction = True, -direction  # type: ignore[attr-defined]
        found = solve_ivp(
            rate,
            (time, end),
            state,
            "DOP853",
            events=event_functions,
            rtol=RELATIVE,
            atol=ABSOLUTE,
            first_step=end - time,
        )
        state = numpy.asarray(found.y[:, -1])
        if found.status != 1:
            return state
        time = float(found.t[-1])
        for i, times in enumerate(found.t_events):
            if len(times):
                directions[i] = -directions[i]
        if time >= end:
            return state


def _at(pair: tuple[float, float], drive: _Drive, time: float) -> float:
    return pair[0] + pair[1] * (time - drive.start)


def _tire(quarter: Quarter, drive: _Drive, time: float, state: State) -> tuple[float, float]:
    tread, speed = (state[0], state[2]) if quarter.belt is None else (state[4], state[5])
    return float(_at(drive.height, drive, time) - tread), float(drive.height[1] - speed)


def _cushion(
    quarter: Quarter | None, occupant: Occupant, drive: _Drive, time: float, state: State
) -> tuple[float, float]:
    first = 0 if quarter is None else quarter.states
    speed = first + len(occupant.masses)
    floor, floor_speed = (0.0, 0.0) if quarter is None else (state[1], state[3])
    approach, cushion_speed = floor + _at(drive.cushion, drive, time) - state[first], floor_speed + drive.cushion[1]
    if occupant.masses[0] == 0.0:
        return float(approach), cushion_speed - _massless_speed(occupant, approach, cushion_speed, state[first:])
    return float(approach), float(cushion_speed - state[speed])


def _massless_speed(occupant: Occupant, approach: float, cushion_speed: float, state: State) -> float:
    """Speed of a massless seat interface, at which the forces on it cancel."""
    count = len(occupant.masses)
    stiffness, damping = occupant.matrix(occupant.stiffness)[0], occupant.matrix(occupant.damping)[0]
    held = stiffness @ state[:count] + damping[1:] @ state[count + 1 : 2 * count]

    def left(speed: float) -> float:
        return float(normal_force(occupant.law, approach, cushion_speed - speed) - held - damping[0] * speed)

    free = -held / damping[0]
    if left(free) == 0.0:
        return float(free)
    other = free + 1.001 * left(free) / damping[0]
    return float(brentq(left, free, other, xtol=1e-15 * max(1.0, abs(free), abs(other)), rtol=8.9e-16))


def _event_functions(
    quarter: Quarter | None, occupant: Occupant | None, drive: _Drive
) -> list[Callable[[float, State], float]]:
    """Approach and recovery of each contact."""
    event_functions: list[Callable[[float, State], float]] = []
    if quarter is not None:
        event_functions += [
            lambda t, y: _tire(quarter, drive, t, y)[0],
            lambda t, y: quarter.law.tension(*_tire(quarter, drive, t, y)),
        ]
    if occupant is not None:
        event_functions += [
            lambda t, y: _cushion(quarter, occupant, drive, t, y)[0],
            lambda t, y: occupant.law.tension(*_cushion(quarter, occupant, drive, t, y)),
        ]
    return event_functions


def _rate(gravity: float, quarter: Quarter | None, occupant: Occupant | None, drive: _Drive) -> Rate:
    def rates(time: float, state: State) -> State:
        out = numpy.empty_like(state)
        shake = _at(drive.acceleration, drive, time)
        carried = 0.0
        if occupant is not None:
            approach, rate = _cushion(quarter, occupant, drive, time, state)
            carried = normal_force(occupant.law, approach, rate)
            first = 0 if quarter is None else quarter.states
            weight = gravity + (shake if quarter is None else 0.0)
            own = state[first:].copy()
            if occupant.masses[0] == 0.0:
                floor_speed = 0.0 if quarter is None else state[3]
                own[len(occupant.masses)] = floor_speed + drive.cushion[1] - rate
            out[first:] = _occupant_rate(occupant, carried, weight, own)
        if quarter is not None:
            z_w, z_b, v_w, v_b = state[:4]
            link = quarter.stiffness * (z_w - z_b) + quarter.damping * (v_w - v_b)
            force = normal_force(quarter.law, *_tire(quarter, drive, time, state))
            # The rigid ring lies between road and wheel: the wheel feels its sidewalls
            if quarter.belt is not None:
                belt, (z_r, v_r) = quarter.belt, state[4:6]
                sidewalls = belt.stiffness * (z_r - z_w) + belt.damping * (v_r - v_w)
                out[4:6] = v_r, (force - sidewalls) / belt.mass - gravity
                force = sidewalls
            out[:2] = v_w, v_b
            out[2] = (force - link) / quarter.wheel_mass - gravity
            out[3] = (link - carried) / quarter.body_mass - gravity + shake
        return out

    return rates


def _occupant_rate(occupant: Occupant, carried: float, weight: float, state: State) -> State:
    count = len(occupant.masses)
    z, v = state[:count], state[count : 2 * count]
    force = -occupant.matrix(occupant.stiffness) @ z - occupant.matrix(occupant.damping) @ v
    force[0] += carried
    heavy = occupant.masses > 0.0
    return numpy.concatenate([v, numpy.where(heavy, force / numpy.where(heavy, occupant.masses, 1.0) - weight, 0.0)])
