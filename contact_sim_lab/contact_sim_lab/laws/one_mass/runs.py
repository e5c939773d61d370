"""Runs of the one-mass rigs with one requested tolerance, for the studies: state at given times,
and what it took.

Source: Driver and Seat eqs 7, 8, 10 and 11.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_lab.laws.one_mass import belt_slider, impact_works
from contact_sim_lab.laws.one_mass.belt_slider import BeltSlider, run_with_friction
from contact_sim_lab.laws.one_mass.impact_works import ImpactWorks
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate import dormand_prince
from contact_sim_pkg.integrate.root_steps import EVENTS, REJECTED, STEPS, RootStepWorkspace, make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.single import point_contact, run
from contact_sim_pkg.laws.parameters import NormalDissipative, NormalElastic

__all__ = ["OneMassCourse", "RunFailureError", "free_impact", "impact_speeds", "integrate", "seat_slap"]

# Of the integrator: its steps are not cut short by a drive, and it is the less expensive one below
# a tolerance of 1e-4.
ORDER = 8
EVENT_FUNCTIONS = {
    PointContact: point_contact.EVENT_FUNCTIONS,
    ImpactWorks: impact_works.EVENT_FUNCTIONS,
    BeltSlider: belt_slider.EVENT_FUNCTIONS,
}


class RunFailureError(RuntimeError):
    """The integrator ended with a status other than DONE; the message is its sentence."""


class OneMassCourse(NamedTuple):
    """States at the requested times, and the integrator's counts."""

    states: Vector  # [times, states]
    status: int
    accepted: int
    rejected: int
    events: int


def integrate(
    rig: PointContact | ImpactWorks | BeltSlider,
    start: Vector,
    scale: Vector,
    times: Vector,
    mode: int = 0,
    strict: bool = True,
) -> OneMassCourse:
    """Integrate `rig` from `start` through `times` [s]; `scale` [states]: error allowed per step.

    `mode`: friction mode at the start (0 sticks, 1 and -1 slip). Raises RunFailureError where
    `strict` and the run fails.
    """
    event_count = EVENT_FUNCTIONS[type(rig)]
    state = numpy.array(start, dtype=float)
    out = numpy.full((len(times), len(state)), numpy.nan)
    rest = (numpy.array([mode]), state, numpy.asarray(scale, dtype=float))
    instants = numpy.asarray(times, float)
    work: RootStepWorkspace | dormand_prince.DormandPrinceWorkspace
    # The integrator of the driven rigs locates friction events
    if isinstance(rig, BeltSlider):
        work = dormand_prince.make_workspace(len(state), event_count)
        status = run_with_friction(rig, *rest, work, instants, out)
    else:
        work = make_workspace(len(state), event_count, ORDER)
        status = run(rig, *rest, work, instants, out)
    if strict and status != DONE:
        raise RunFailureError(SENTENCES[status])
    counts = work.counters
    return OneMassCourse(out, int(status), int(counts[STEPS]), int(counts[REJECTED]), int(counts[EVENTS]))


def free_impact(mass: float, elastic: NormalElastic, damping: float | None) -> PointContact:
    """One mass against a support at rest, without gravity; `damping` [s/m] or None without
    dissipation.
    """
    return PointContact(mass, 0.0, 0.0, 0.0, elastic, None if damping is None else NormalDissipative(damping))


def impact_speeds(
    rig: PointContact, speed: float, depth: float, tolerance: float, gap: float, end: float
) -> OneMassCourse:
    """Free impact at `speed` [m/s] from `gap` [m] above the support, to `end` [s]; tolerance
    relative to `depth` and `speed`.
    """
    scale = numpy.array([depth, speed]) * tolerance
    return integrate(rig, numpy.array([gap, -speed]), scale, numpy.array([0.0, end]))


def seat_slap() -> tuple[PointContact, Vector, Vector]:
    """Seat slap: 60 kg on a one-sided foam law over a floor at 5 Hz and 1.3 g.

    Returns the rig, its start [m, m/s] and the scales [m, m/s] of the motion, both [states].
    """
    mass, gravity = 60.0, 9.81
    frequency = 2.0 * numpy.pi * 5.0
    amplitude = 1.3 * gravity / frequency**2
    sunk = 1.5 * gravity / (2.0 * numpy.pi * 5.5) ** 2
    law = NormalElastic(mass * gravity / sunk**1.5, 1.5)
    rig = PointContact(mass, gravity, amplitude, frequency, law, NormalDissipative(1.0))
    return rig, numpy.array([-sunk, amplitude * frequency]), numpy.array([0.05, 1.0])
