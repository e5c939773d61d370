"""Goals of the integrator and of the contact laws: error and time of single contacts, beside scipy
and closed forms.
"""

from __future__ import annotations

import statistics

import numpy
from numpy.typing import NDArray

from contact_sim_lab.laws import hard_cases_friction
from contact_sim_lab.laws import hard_cases_impact as impacts_of
from contact_sim_lab.laws import seat_slap as work_of
from contact_sim_lab.laws.one_mass import runs as one_mass
from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_lab.twins import impact
from contact_sim_lab.twins.belt_slider import period_of_rigid_law
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.integrate.root_steps import RootStepWorkspace, make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.point_contact import EVENT_FUNCTIONS, STATES
from contact_sim_pkg.laws.one_mass.single import empty_mode, run
from contact_sim_pkg.studies.effects.effect_cost import absent_effect_cost

__all__ = ["GOALS", "absent_effect", "impacts", "seat_slap", "steel", "stick_slip"]

SLAP_ERROR = 1e-8  # [m]
SLAP_TOLERANCES = tuple(10.0**-power for power in range(4, 12))
TOLERANCES = tuple(10.0 ** (-0.25 * quarter) for quarter in range(16, 49))  # 1e-4 to 1e-12
Modes = NDArray[numpy.int64]
DAMPINGS = (0.05, 0.2, 0.5, 1.0, 3.0)
IMPACTS = 200  # in one compiled loop


def seat_slap() -> list[Measured]:
    """Time to an error of 1e-8 m, and each solver's error and time over the tolerances, at equal
    error beside ours.
    """
    own = work_of.own_work()
    enough = work_of.cheapest(own, SLAP_ERROR)
    cost, note = (
        (None, "no tolerance reaches it") if enough is None else (enough.cost, f"tolerance {enough.tolerance:.1e}")
    )
    found = [Measured("seat slap to 1e-8 m", cost, "µs per simulated s", most=100.0, note=note)]
    # Error that a run has over the one it was requested to have
    shares = [impacts_of.slap_error(tolerance) / tolerance for tolerance in SLAP_TOLERANCES]
    note = "1e-4 to 1e-11, larger of position and speed over those of the motion"
    found.append(
        Measured("seat slap, largest error over requested tolerance", max(shares), "times", most=10.0, note=note)
    )
    found.append(
        Measured("seat slap, least error over requested tolerance", min(shares), "times", least=0.1, note=note)
    )
    found += [_work_of(run) for run in own]
    # Peers at equal error
    for method in ("LSODA", "DOP853"):
        peer = work_of.scipy_work(method)
        best = work_of.cheapest(peer, SLAP_ERROR)
        ratio = None if best is None or enough is None else best.cost / enough.cost
        least = 50.0 if method == "LSODA" else None
        found.append(Measured(f"seat slap to 1e-8 m: scipy {method} over ours", ratio, "times", least=least))
        found += [_work_of(run, own) for run in peer]
    return found


def _work_of(run: work_of.SlapCost, own: list[work_of.SlapCost] | None = None) -> Measured:
    """One run as a row: its time, and in the note its error and how much less ours takes with an
    error as small.
    """
    note = f"error {run.error:.1e} m"
    equal = None if own is None else work_of.cheapest(own, run.error)
    if equal is not None:
        note += f", {run.cost / equal.cost:.0f} times ours with an error as small"
    return Measured(f"seat slap, {run.solver} at {run.tolerance:.0e}", run.cost, "µs per simulated s", note=note)


@entry
def _many(
    rig: PointContact,
    mode: Modes,
    start: Vector,
    scale: Vector,
    work: RootStepWorkspace,
    times: Vector,
    out: Vector,
    count: int,
) -> None:
    """The same impact `count` times over, so that the call from Python does not count."""
    state = start.copy()
    for _ in range(count):
        state[:] = start
        work.step[0] = 0.0
        run(rig, mode, state, scale, work, times, out)


def impacts() -> list[Measured]:
    """Worst error of the restitution over five damping numbers, and the median time of an impact,
    at the tolerance that is enough.
    """
    found = []
    for requested, most in ((1e-6, 6.0), (1e-9, 25.0)):
        for tolerance in TOLERANCES:
            if all(max(impacts_of.phase_errors(damping, tolerance)) <= requested for damping in DAMPINGS):
                break
        microseconds = statistics.median(_impact_time(damping, tolerance) for damping in DAMPINGS)
        note = f"tolerance {tolerance:.1e}; worst of 5 damping numbers and 20 approach phases"
        found.append(Measured(f"impact, restitution to {requested:.0e}", microseconds, "µs", most=most, note=note))
    worst = impacts_of.tolerance_is_met().value
    return [*found, Measured("impact, error over requested tolerance", worst, "times", most=10.0, note="1e-3 to 1e-11")]


def _impact_time(damping: float, tolerance: float) -> float:
    """Microseconds of an impact."""
    speed, law = impacts_of.SPEED, impacts_of.LAW
    rig = one_mass.free_impact(impacts_of.MASS, law, damping / speed)
    depth = impact.deepest_approach(impacts_of.MASS, speed, law.coefficient, law.exponent, damping / speed)
    lasts = impact.elastic_impact(impacts_of.MASS, speed, law.coefficient, law.exponent)[0]
    gap = 0.001
    times, scale = (
        numpy.array([0.0, gap / speed + lasts * (3.0 + 3.0 * damping)]),
        numpy.array([depth, speed]) * tolerance,
    )
    start: Vector = numpy.array([gap, -speed])
    out, work, mode = numpy.zeros((2, STATES)), make_workspace(STATES, EVENT_FUNCTIONS, one_mass.ORDER), empty_mode()
    return 1e6 * median_time(lambda: _many(rig, mode, start, scale, work, times, out, IMPACTS)) / IMPACTS


def steel() -> list[Measured]:
    """A contact of 69 µs with an outer tick of 1 ms: worst error of duration, depth and force
    within 100 steps.
    """
    for tolerance in TOLERANCES:
        duration, depth, force, steps = impacts_of.steel_impact(tolerance)
        worst = max(duration, depth, force)
        if worst <= 1e-8:
            break
    note = f"tolerance {tolerance:.1e}"
    return [
        Measured("steel ball: worst error of duration, depth, force", worst, "", most=1e-8, note=note),
        Measured("steel ball: steps for it", float(steps), "steps", most=100.0, note="rejected ones included"),
    ]


def stick_slip() -> list[Measured]:
    """Period of the rigid law, extrapolated from stiff friction springs, against the closed form;
    and what tolerances deliver.
    """
    exact = period_of_rigid_law(hard_cases_friction.stick_slip(1.0, 0.0)[1])
    error = abs(hard_cases_friction.period_of_the_rigid_law().value / exact - 1.0)
    worst = hard_cases_friction.error_follows_the_tolerance().value
    return [
        Measured("stick-slip period: relative error", error, "", most=1e-9),
        Measured("stick-slip, error over requested tolerance", worst, "times", most=10.0, note="1e-3 to 1e-11"),
    ]


def absent_effect() -> list[Measured]:
    """The rig with the dissipation left out, beside the same rig written by hand without it: at
    most 2 % or 1 ns a step.
    """
    with_effect, absent, by_hand = absent_effect_cost()
    allowed = max(2.0, 100.0 / by_hand)
    return [
        Measured("absent effect: extra time of a step", 100.0 * (absent / by_hand - 1.0), "%", most=allowed),
        Measured("a step with the dissipation", with_effect, "ns"),
        Measured("a step with the dissipation absent", absent, "ns"),
        Measured("a step of the rig by hand", by_hand, "ns"),
    ]


GOALS = (
    GoalPart("seat slap", seat_slap),
    GoalPart("impacts", impacts),
    GoalPart("steel ball", steel),
    GoalPart("stick-slip", stick_slip),
    GoalPart("absent effect", absent_effect),
)
