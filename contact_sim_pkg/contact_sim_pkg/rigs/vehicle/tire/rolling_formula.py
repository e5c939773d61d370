"""The Magic Formula under a rolling tire: slips that relax, forces at every sample, and their works.

The slips of the wheel, u = kappa and tan(alpha), act after a way of the relaxation length sigma:

    sigma du'/ds + u' = u,  F = F(u'_x, u'_y, F_z)

exact for a slip that is straight and a sigma that is constant between two samples. F_z is the load of the sample, whatever
carries it; without one there is no force. Nothing of it acts on the vertical motion.

Works between two samples, by the trapezoid: supplied at axle and rim ``F_x kappa - F_y tan(alpha)`` a metre and
``-M_y (1 + kappa) / R_e``; lost at the road ``F_x kappa' - F_y tan(alpha')`` and the whole of the latter. The difference is
kept in the carcass, whose deflection sigma u' makes the lag: with a constant sigma sigma times the integral of F over u'. The
lag is an assumption on the carcass, so these books close by construction.

Source: Pacejka, Tire and Vehicle Dynamics (2012), 4.3.2 and 7.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.tire.brush.belt_motion import BELT_SAMPLES
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.formulas import Forces, at_load, forces_at
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.relaxation import relaxation_lengths
from contact_sim_pkg.rigs.vehicle.tire.model import FormulaParts

__all__ = ["Followed", "RollingFormula", "formula_cautions", "relaxed"]

LEAST_LOAD = 1e-6  # of the nominal one: below it there is no contact
NOTHING = Forces(0.0, 0.0, 0.0, 0.0, 0.0)

Samples = NDArray[numpy.float64]


class Followed(NamedTuple):
    """At the first of some samples, the instant of their fields."""

    slip: float  # of the wheel
    slip_angle: float  # [rad]
    force_x: float  # [N]
    force_y: float
    moment_z: float  # [N m]
    dissipated: float  # [J] at the road, since the instant before
    entries: tuple[float, ...]  # kinetic, potential, stored, supplied, dissipated [J] since the start


class RollingFormula:
    """Slips and works of one tire; ``follow`` from interval to interval, in order."""

    STATE = State(("_at", "_slip", "_force", "_works", "_published"))

    def __init__(self, parts: FormulaParts) -> None:
        """Before a run."""
        self._parts = parts
        self.reset()

    def reset(self) -> None:
        """An unstrained tire."""
        # Of the sample before: travel [m], slip and tan(alpha) of the wheel
        self._at: Samples = numpy.full(3, math.nan)
        self._slip: Samples = numpy.zeros(2)  # relaxed: kappa', tan(alpha')
        self._force: Samples = numpy.zeros(3)  # F_x, F_y [N], M_y [N m]
        self._works: Samples = numpy.zeros(3)  # [J] supplied by the slips, lost at the road, rolling
        self._published = 0.0  # [J] lost at the road up to the last instant that was followed

    def follow(
        self, times: Samples, travel: Samples, speed: Samples, load: Samples, approach: Samples, slope: Samples, out: Samples
    ) -> Followed:  # fmt: skip
        """Follow the samples of an interval: [samples] of time [s], travel [m], speed [m/s], load [N], deflection of the axle
        [m] and effective slope of the road. Written: out [samples, 8], the columns of a sample of `brush/belt_motion.py`.
        """
        first: Followed | None = None
        columns = (each.tolist() for each in (times, travel, speed, load, approach, slope))
        for row, (time, place, fast, pressed, deep, climb) in enumerate(zip(*columns, strict=True)):
            slip, angle = self._parts.slips.at(time)
            radius = self._parts.unloaded - max(deep, 0.0) / 3.0
            forces = self._step(place, (slip, math.tan(angle)), pressed, fast, radius)
            rolling = forces.rolling if fast != 0.0 else 0.0
            out[row] = (
                forces.longitudinal, forces.lateral, forces.aligning, forces.longitudinal - climb * pressed, forces.lateral,
                rolling - radius * forces.longitudinal, forces.aligning, (1.0 + slip) * fast / radius,
            )  # fmt: skip
            if first is None:
                supplied, lost, rolled = self._works.tolist()
                entries = (0.0, 0.0, supplied - lost, supplied + rolled, lost + rolled)
                first = Followed(
                    slip, angle, forces.longitudinal, forces.lateral, forces.aligning, lost - self._published, entries
                )
                self._published = lost
        assert first is not None
        assert out.shape[1] == BELT_SAMPLES
        return first

    def _step(self, place: float, wheel: tuple[float, float], load: float, speed: float, radius: float) -> Forces:
        """Forces at a sample, at a ``place`` [m] of the travel and slips of the ``wheel``, kappa and tan(alpha)."""
        before, slips, force = self._at.tolist(), self._slip.tolist(), self._force.tolist()
        way = 0.0 if math.isnan(before[0]) else place - before[0]
        forces, now = NOTHING, list(wheel)  # off the road nothing holds the tread back
        if load > LEAST_LOAD * self._parts.formula.keys["FNOMIN"]:
            at = at_load(self._parts.formula.keys, load, self._parts.inflation, speed)
            lengths = relaxation_lengths(self._parts.formula, at, self._parts.inflation)
            now = [
                relaxed(old, from_, to, abs(way), length)
                for old, from_, to, length in zip(slips, before[1:], wheel, lengths, strict=True)
            ]
            forces = forces_at(at, now[0], math.atan(now[1]))
        rolling = forces.rolling * (1.0 + wheel[0]) / radius if speed != 0.0 else 0.0
        if way != 0.0:
            half = 0.5 * abs(way)
            self._works += (
                half * (force[0] * before[1] - force[1] * before[2] + forces.longitudinal * wheel[0] - forces.lateral * wheel[1]),
                half * (force[0] * slips[0] - force[1] * slips[1] + forces.longitudinal * now[0] - forces.lateral * now[1]),
                -half * (force[2] + rolling),
            )  # fmt: skip
        self._at[:], self._slip[:] = (place, *wheel), now
        self._force[:] = forces.longitudinal, forces.lateral, rolling
        return forces


def relaxed(old: float, start: float, end: float, way: float, length: float) -> float:
    """Slip u' after a ``way`` [m] >= 0 from ``old`` on, while that of the wheel goes straight from ``start`` to ``end``:
    ``length u'' + u' = u`` of first order, [m] >= 0; 0: at once. At no way ``old``.
    """
    if length <= 0.0 or math.isnan(start):
        return end if length <= 0.0 else old
    if way == 0.0:
        return old
    lag = (end - start) * length / way
    return end - lag + (old - start + lag) * math.exp(-way / length)


def formula_cautions(parts: FormulaParts, load: float, unused: str) -> Iterator[str]:
    """What a run by the formula does not do as its file means it: keys that nothing uses, conditions that were not measured,
    under a standing ``load`` [N].
    """
    formula, slips = parts.formula, parts.slips
    if unused:
        yield f"tire: of {formula.file} these keys are not used: {', '.join(unused.split())}"
    conditions = (
        ("FZ", "the load at rest", (load,), "N"), ("PRES", "the inflation", (parts.inflation,), "Pa"),
        ("KPU", "the slip", slips.first.tolist(), ""), ("ALP", "the slip angle", slips.second.tolist(), "rad"),
    )  # fmt: skip
    for word, what, values, unit in conditions:
        low, high = formula.ranges.get(f"{word}MIN", -math.inf), formula.ranges.get(f"{word}MAX", math.inf)
        outside = [value for value in values if not low <= value <= high]
        if outside and low < high:
            worst = max(outside, key=lambda value: max(low - value, value - high))
            yield (
                f"tire: {what} is {worst:.4g} {unit}".rstrip()
                + f", {formula.file} was fitted from {low:.4g} to {high:.4g}"
            )
