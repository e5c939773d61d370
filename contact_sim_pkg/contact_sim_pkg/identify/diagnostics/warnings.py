"""Consistency warnings of an identification: contradictions beyond noise, contacts that touch
nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.diagnostics.agreement import SLIGHT, contradicts
from contact_sim_pkg.identify.diagnostics.noise import first_guess, from_residuals
from contact_sim_pkg.identify.diagnostics.notes import FREE_MOTION_MISSING, ContactNote, NoteKind
from contact_sim_pkg.identify.diagnostics.possible import against_the_wrench, impossible
from contact_sim_pkg.identify.geometry import size
from contact_sim_pkg.identify.motion.free_fall import missing_acceleration
from contact_sim_pkg.identify.motion.heights import mean_gap
from contact_sim_pkg.identify.motion.turning import missing_spin_rate, spin_scale
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem
from contact_sim_pkg.identify.sweep import FEW

__all__ = ["consistency_warnings"]

SIGMAS = 5.0  # how far from zero a mean of all flights or impacts
LEAST_SCALE = 1e-5  # of the spin: less is that of stamps which were rounded
SMOOTH = 5.0  # times the noise of neighbouring samples: what flights leave is no noise


def consistency_warnings(
    found: ParameterEstimate, notes: Iterable[ContactNote], problem: IdentificationProblem
) -> list[str]:
    """One sentence for each inconsistency; none where everything fits.

    Args:
        found: the estimate.
        notes: of the contacts that are not used.
        problem: the problem that it solves.
    """
    warnings, kinds = [], [note.kind for note in notes]
    # The fit as a whole: convergence, misfit, sign of the mass, possible inertia.
    if not found.converged:
        warnings.append("the search has not converged: the numbers are not to be trusted")
    if contradicts(found):
        friction = ", the friction coefficient" if any(contact.slides for contact in problem.contacts) else ""
        warnings.append(
            f"contacts and flights contradict each other by {found.misfit:.3g} times what the noise explains: check the shape, the "
            f"ground, gravity, the wrench{friction}, the stamps and the noise; the standard deviations are too small"
        )
    if against_the_wrench(found, problem):
        warnings.append(
            f"the body moves against the known wrench, as if 1/m were {found.parameters[-1]:.3g} 1/kg: check the sign of the "
            "wrench, its axes and its stamps"
        )
    warnings += impossible(found, problem)
    warnings += [*_falling(found, problem), *_turning(found, problem), *_above(found, problem)]
    # Single contacts: too few samples, nothing touched, contradictions.
    short = [contact for contact in problem.contacts if _hidden(contact, problem)]
    if short:
        longest = 1e3 * max(contact.end - contact.begin for contact in short)
        warnings.append(
            f"{len(short)} contacts last up to {longest:.2g} ms with fewer than {len(FEW)} samples each, so that the course of "
            "their force is open: record faster if the contact is soft, check ground and shape if it is not"
        )
    nothing = kinds.count(NoteKind.NOTHING_TOUCHED)
    if nothing:
        warnings.append(f"{nothing} contacts touch no known surface: check the shape, its axes, and the ground")
    alone = kinds.count(NoteKind.CONTRADICTS)
    if alone:
        warnings.append(
            f"{alone} contacts contradict the others and are left out: two impacts taken as one? See their notes"
        )
    strange = sum(kind in FREE_MOTION_MISSING for kind in kinds)
    if strange:
        warnings.append(
            "the body does not move as a free one where it is off the ground: see the notes of the contacts"
        )
    return warnings


def _falling(found: ParameterEstimate, problem: IdentificationProblem) -> list[str]:
    """Flights that do not fall as gravity and wrench say: all of them by the same, or by more than
    neighbouring samples differ.
    """
    fastest = float(abs(problem.states.velocity).max())
    missing = missing_acceleration(found, problem)
    # The same acceleration is missing in all flights
    length = float(numpy.linalg.norm(missing.value))
    if length > SIGMAS * missing.deviation and length * missing.longest > SLIGHT * fastest:
        x, y, z = missing.value
        line = (
            f"the flights accelerate by ({x:.3g}, {y:.3g}, {z:.3g}) m/s^2 more than gravity and the known wrench make them "
            f"(standard deviation {missing.deviation:.2g}): check gravity, its direction, the wrench, "
            "and impacts that the samples smear or miss"
        )
        return [line]
    # The fit leaves more than neighbouring samples differ by
    left, rough = from_residuals(found.residuals, problem.states).velocity, first_guess(problem.states).velocity
    if left > SMOOTH * rough and left > SLIGHT * fastest:
        line = (
            f"the flights leave {left:.2g} m/s of the velocities, {left / rough:.2g} times what neighbouring samples differ by: "
            "check gravity, the wrench and the axes of the twist; of filtered samples the standard deviations are too small"
        )
        return [line]
    return []


def _turning(found: ParameterEstimate, problem: IdentificationProblem) -> list[str]:
    """Flights whose rotation and spin contradict each other, or what inertia and torque make of
    them.
    """
    scale = spin_scale(found, problem)
    if abs(scale.excess) > max(SIGMAS * scale.deviation, LEAST_SCALE):
        line = (
            f"the rotations turn about {_factor(scale.excess)} times as fast as the spin says (standard deviation "
            f"{scale.deviation:.2g}): check the scale and the axes of the spin, the torque, and the stamps"
        )
        return [line]
    # The same angular acceleration is missing in all flights
    fastest, missing = float(abs(problem.states.angular_velocity).max()), missing_spin_rate(found, problem)
    length = float(numpy.linalg.norm(missing.value))
    if length > SIGMAS * missing.deviation and length * missing.longest > SLIGHT * fastest:
        x, y, z = missing.value
        line = (
            f"the flights gain ({x:.3g}, {y:.3g}, {z:.3g}) rad/s of spin a second more than inertia and the known torque make them "
            f"(standard deviation {missing.deviation:.2g}): check the torque"
        )
        return [line]
    # The fit leaves more than neighbouring samples differ by
    left, rough = from_residuals(found.residuals, problem.states), first_guess(problem.states)
    spins, turns = left.angular_velocity / rough.angular_velocity, left.rotation / rough.rotation
    size = max(left.rotation, left.angular_velocity / max(fastest, 1e-300))
    if max(spins, turns) > SMOOTH and size > SLIGHT:
        line = (
            f"the flights leave {left.rotation:.2g} rad of the rotations and {left.angular_velocity:.2g} rad/s of the spins, up to "
            f"{max(spins, turns):.2g} times what neighbouring samples differ by: check the torque, the axes of the spin, the "
            "stamps, and single samples that are wrong"
        )
        return [line]
    return []


def _factor(excess: float) -> str:
    """1 + excess, with two digits of the excess."""
    places = max(3, 2 - math.floor(math.log10(abs(excess)))) if abs(excess) < 1.0 else 3
    return f"{1.0 + excess:.{places}f}"


def _above(found: ParameterEstimate, problem: IdentificationProblem) -> list[str]:
    """Impacts that happen above or below the ground."""
    gap = mean_gap(found, problem)
    if abs(gap.value) <= SIGMAS * gap.deviation:
        return []
    side = "above" if gap.value > 0.0 else "below"
    line = (
        f"impacts happen {abs(gap.value):.2g} m {side} the ground in the mean (standard deviation {gap.deviation:.1g} m): check "
        "the shape, its axes, and the ground"
    )
    return [line]


def _hidden(contact: ContactSpan, problem: IdentificationProblem) -> bool:
    """Whether a contact lasts, and too few samples show how."""
    swept = contact.sweep
    if swept is None or swept.samples >= len(FEW):
        return False
    return swept.quadrature > SLIGHT * size(problem.shape) * float(abs(problem.states.velocity).max())
