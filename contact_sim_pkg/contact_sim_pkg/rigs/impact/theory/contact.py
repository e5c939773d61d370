"""One contact of a sphere under its own weight, phase by phase: loaded, released, perhaps
loaded again, until the bodies part.

``m x'' = m g - F(x, x')`` with the law of ``rigs/impact/theory/closed_form/force.py``. A loaded
phase is solved by Taylor series (``rigs/impact/theory/closed_form/scaled_motion.py``), a released
one, between the loss of force and the end of the overlap, is a parabola: the sample recovers there
without pushing, and turns what it still stores into heat. A sphere that falls back before the
overlap has ended is caught by the sample as soon as the law pushes again, ``A x + B x' > 0``. A
sphere that comes to rest never parts: such a contact is followed in phases of bounded length.

Source: Goloshchapov eqs 8, 9 and 54.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.checks import check_fields, check_number, check_positive, check_values
from contact_sim_pkg.rigs.impact.theory.closed_form.force import lowest_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import (
    DEPTH,
    DURATION,
    END,
    LOST,
    PEAK,
    PEAK_FORCE,
    PEAK_TIME,
    REACHED_ROOT,
    REACHED_SPEED,
    REACHED_TIME,
    RESTITUTION,
    RESULTS,
    TURNING_TIME,
    sample_from,
    solve_from,
)
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = [
    "LOADED",
    "PARTED",
    "RELEASED",
    "ContactLaw",
    "ContactPhase",
    "Turns",
    "next_phase",
    "sample",
    "static_depth",
    "stored",
    "touch",
]

LOADED, RELEASED, PARTED = "loaded", "released", "parted"
LONGEST = 60.0  # of a loaded phase, in units of L/V: about twenty contact times


class ContactLaw(NamedTuple):
    """Sphere and law of one contact."""

    mass: float  # [kg]
    gravity: float  # [m/s^2] into the half-space, >= 0
    elastic: float  # A [N/m^1.5]
    viscous: float  # B [N s/m^1.5], 0 without loss
    end: str  # end rule, "force" or "gap"


class Turns(NamedTuple):
    """First turning point and largest force of a contact, seen in its first phase; times from its
    touch.
    """

    compression_time: float  # [s]
    depth: float  # [m]
    peak_time: float  # [s]
    peak_force: float  # [N]


class ContactPhase(NamedTuple):
    """A part of a contact; SI units, times from its own begin."""

    kind: str  # LOADED or RELEASED
    law: ContactLaw
    depth: float  # [m] at its begin
    speed: float  # [m/s] at its begin, closing positive
    duration: float  # [s]
    last_depth: float  # [m] at its end
    last_speed: float  # [m/s] at its end
    heat: float  # [J] that the sample turns into heat in it
    next_kind: str  # what follows: LOADED, RELEASED or PARTED
    turns: Turns | None = None


class _Units(NamedTuple):
    """Scales of a loaded phase."""

    length: float  # [m]
    speed: float  # [m/s]
    severity: float
    weight: float

    @property
    def time(self) -> float:
        return self.length / self.speed


def touch(law: ContactLaw, speed: float) -> ContactPhase:
    """First phase of the contact that begins at depth 0 with ``speed`` > 0 [m/s].

    Raises ImpactError for a law or a speed outside its range, ValueError for another end rule.
    """
    _check_law(law)
    check_positive("impact speed", speed, "m/s")
    return _loaded(law, 0.0, speed, first=True)


def next_phase(before: ContactPhase) -> ContactPhase:
    """The phase behind one whose ``next_kind`` is not PARTED; raises ImpactError where it is."""
    if before.next_kind == PARTED:
        raise ImpactError("next phase: the bodies have parted, there is none")
    if before.next_kind == LOADED:
        return _loaded(before.law, before.last_depth, before.last_speed, first=False)
    return _released(before.law, before.last_depth, before.last_speed)


def static_depth(law: ContactLaw) -> float:
    """Depth in [m] at which the sphere rests under its weight. Raises ImpactError for a law outside
    its range.
    """
    _check_law(law)
    return _static_depth(law)


def _static_depth(law: ContactLaw) -> float:
    return float((law.mass * law.gravity / law.elastic) ** (2.0 / 3.0))


def stored(law: ContactLaw, depth: float) -> float:
    """Elastic energy ``2/5 A x^(5/2)`` in [J]; 0 for depths [m] below 0. Raises ImpactError for a
    law outside its range.
    """
    _check_law(law)
    check_number("depth", depth, "m")
    return _stored(law, depth)


def _stored(law: ContactLaw, depth: float) -> float:
    return float(0.4 * law.elastic * max(depth, 0.0) ** 2.5)


def sample(phase: ContactPhase, times: Vector) -> tuple[Vector, Vector, Vector]:
    """Depth [m], speed [m/s] and heat [J] since its begin at rising ``times`` [s] within the phase,
    each [times].

    Values at its ends outside it. Raises ImpactError for times that are not finite or do not rise.
    """
    t = numpy.clip(check_values("times", times, "s", shape=(None,), rising=True), 0.0, phase.duration)
    law = phase.law
    if phase.kind == RELEASED:
        depth = phase.depth + (phase.speed + 0.5 * law.gravity * t) * t
        stored = numpy.array([_stored(law, float(x)) for x in depth])
        return depth, phase.speed + law.gravity * t, _stored(law, phase.depth) - stored
    units = _units(law, phase.depth, phase.speed)
    depth, speed, heat = (numpy.zeros(len(t)) for _ in range(3))
    root, pace = math.sqrt(phase.depth / units.length), phase.speed / units.speed
    sample_from(units.severity, units.weight, u=root, v=pace, times=t / units.time, depth=depth, speed=speed, heat=heat)
    return depth * units.length, speed * units.speed, heat * law.mass * units.speed**2


def _check_law(law: ContactLaw) -> None:
    check_fields("contact law", law, positive="mass elastic", not_negative="gravity viscous")
    lowest_force(law.end)


def _units(law: ContactLaw, depth: float, speed: float) -> _Units:
    """Scales by the energy at hand, so that no quantity is far from 1."""
    energy = 0.5 * law.mass * speed**2 + _stored(law, depth) + law.mass * law.gravity * max(depth, _static_depth(law))
    typical = math.sqrt(2.0 * energy / law.mass)
    length = float((law.mass * typical**2 / law.elastic) ** 0.4)
    severity = law.viscous * math.sqrt(length) * length / (law.mass * typical)
    return _Units(length, typical, severity, law.gravity * length / typical**2)


def _loaded(law: ContactLaw, depth: float, speed: float, *, first: bool) -> ContactPhase:
    units, out = _units(law, depth, speed), numpy.zeros(RESULTS)
    pulls = lowest_force(law.end) < 0.0
    root, pace = math.sqrt(depth / units.length), speed / units.speed
    # Scaled motion up to the loss of the force.
    steps = solve_from(
        units.severity, units.weight, pulls=pulls, u=root, v=pace, kind=PEAK if first else END, limit=LONGEST, out=out
    )
    if steps > 0:
        out[REACHED_TIME], out[REACHED_SPEED] = out[DURATION], -out[RESTITUTION]
    # The bodies part there, or the sample is released behind the sphere.
    last_depth = float(out[REACHED_ROOT] ** 2 * units.length)
    parts = steps > 0 and (pulls or law.viscous == 0.0 or last_depth <= 1.0e-14 * units.length)
    turns = None
    if first:
        force = law.mass * units.speed**2 / units.length
        turns = Turns(
            float(out[TURNING_TIME]) * units.time, float(out[DEPTH]) * units.length, float(out[PEAK_TIME]) * units.time,
            float(out[PEAK_FORCE]) * force,
        )  # fmt: skip
    return ContactPhase(
        kind=LOADED,
        law=law,
        depth=depth,
        speed=speed,
        duration=float(out[REACHED_TIME]) * units.time,
        last_depth=0.0 if parts else last_depth,
        last_speed=float(out[REACHED_SPEED]) * units.speed,
        heat=float(out[LOST]) * law.mass * units.speed**2,
        next_kind=PARTED if parts else LOADED if steps == 0 else RELEASED,
        turns=turns,
    )


def _released(law: ContactLaw, depth: float, speed: float) -> ContactPhase:
    """Parabola from ``depth`` > 0, moving out, to depth 0 or to where the law pushes again,
    whichever comes first.
    """
    parting = _first_root(0.5 * law.gravity, speed, depth)
    ratio = law.elastic / law.viscous
    # The law pushes again where A x + B v changes its sign.
    slope = ratio * speed + law.gravity
    pushing = _first_root(0.5 * law.gravity * ratio, slope, ratio * depth + speed, rising=True)
    duration = min(parting, pushing)
    last = depth + (speed + 0.5 * law.gravity * duration) * duration
    parts = parting <= pushing
    last_depth = 0.0 if parts else last
    return ContactPhase(
        kind=RELEASED,
        law=law,
        depth=depth,
        speed=speed,
        duration=duration,
        last_depth=last_depth,
        last_speed=speed + law.gravity * duration,
        heat=_stored(law, depth) - _stored(law, last_depth),
        next_kind=PARTED if parts else LOADED,
    )


def _first_root(square: float, slope: float, value: float, *, rising: bool = False) -> float:
    """Least t > 0 with ``square t^2 + slope t + value = 0``, or the later one, where the function
    rises; infinite without any.
    """
    if square == 0.0:
        root = -value / slope if slope != 0.0 else math.inf
        return root if root > 0.0 and (not rising or slope > 0.0) else math.inf
    inside = slope**2 - 4.0 * square * value
    if inside < 0.0:
        return math.inf
    half = -0.5 * (slope + math.copysign(math.sqrt(inside), slope))
    roots = sorted(root for root in (half / square, value / half if half != 0.0 else math.inf) if root > 0.0)
    if rising:
        roots = [root for root in roots if 2.0 * square * root + slope > 0.0]
    return roots[0] if roots else math.inf
