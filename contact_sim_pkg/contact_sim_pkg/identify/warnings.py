"""Consistency warnings of an identification: contradictions beyond noise, contacts that touch
nothing.

Contacts that agree with each other: the sum of squares that the best parameters leave, against
its chi-square distribution.

Where all contacts together leave more than noise explains, those are left out, one after the other,
without which the least is left, until the others agree. More than half stay, with an equation more
than they determine. Where more would have to go, all are used, and the contradiction is reported.
Where all of them fit nothing, half is enough, with SURE equations. One impact that was two within a
sample is such a contact. Source: data snooping of geodesy, W. Baarda, A testing procedure for use
in geodetic networks, 1968.

What a body within its hull can be: bounds on its moments of inertia over the mass, and what
noise alone would make up.

The mass lies within the hull: in a plane `0 < J/m <= max |p|^2` over the hull's points p. In space
the second moments `M = tr(S)/2 - S = int x x^T dm / m`, S = I0/m, obey `0 <= a.M a <= max (p.a)^2`
for every direction a: from below that is the triangle inequality of the moments of inertia.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy
from scipy.stats import chi2

from contact_sim_pkg.identify.contact.linearised import Linearised
from contact_sim_pkg.identify.contact.noise import (
    FREE_MOTION_MISSING,
    ContactNote,
    NoteKind,
    first_guess,
    from_residuals,
)
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.motion.geometry import size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import FEW, ContactSpan, IdentificationProblem
from contact_sim_pkg.identify.turning import mean_gap, missing_acceleration, missing_spin_rate, spin_scale

__all__ = [
    "HIDDEN",
    "SLIGHT",
    "against_the_wrench",
    "agreeing",
    "consistency_warnings",
    "contradicts",
    "impossible",
    "made_up",
]


SIGMAS = 5.0  # how far from zero a mean of all flights or impacts, or beyond a bound
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


QUANTILE = 0.9999
SURE = 2  # equations left over by which half of the contacts agree: a single one may do so by chance
SLIGHT = 1e-6  # standard deviation over the size of a parameter, contradictions counted, below which they do not matter


def contradicts(found: ParameterEstimate) -> bool:
    """Whether contacts and flights contradict each other by more than noise explains, and by so
    much that it matters.
    """
    if not found.freedom:
        return False
    spread = float((numpy.sqrt(numpy.diag(found.covariance)) / found.scale).max(initial=0.0))
    limit = float(numpy.sqrt(chi2.ppf(QUANTILE, found.freedom) / found.freedom))
    return found.misfit > limit and found.misfit * spread > SLIGHT


def agreeing(linear: Linearised, left_out: int, *, half: bool) -> list[int]:
    """Numbers of the contacts that agree; all where it is open which of them do.

    Args:
        linear: where the flights alone are.
        left_out: how many contacts besides contradicted the others before.
        half: whether half of them are enough.
    """
    everyone = list(range(len(linear.problem.contacts)))
    kept = everyone
    while kept and not _agree(linear, kept):
        without = [[each for each in kept if each != number] for number in kept]
        kept = min(without, key=lambda contacts: linear.contradiction(contacts)[0])
        majority = 2 * len(kept) - len(everyone) - left_out
        if majority < (0 if half else 1) or linear.redundancy(kept) < (1 if majority else SURE):
            return everyone
    return kept


def _agree(linear: Linearised, contacts: list[int]) -> bool:
    square, freedom = linear.contradiction(contacts)
    return freedom == 0 or square <= float(chi2.ppf(QUANTILE, freedom))


HIDDEN = 1e-6  # component of a parameter in what is not identified, above which it counts as not identified itself
SIGNIFICANT = 1.0 / 3.0  # standard deviation over the value, above which noise could have made it up
ROUNDING = 1e-6  # of the largest that is possible, beyond a bound where there is no noise
OUTSIDE = (
    "the inertia is not one of a body within this shape: two impacts taken as one, or another shape; check the contacts"
)


def made_up(found: ParameterEstimate, problem: IdentificationProblem) -> Array:
    """Which parameters noise alone could explain, [parameters]: deviation above a third of the
    value, or below zero where none can be.

    Products of inertia may be zero: theirs is compared with their size. 1/m and moments of inertia
    are above zero.
    """
    deviations, limits = numpy.sqrt(numpy.diag(found.covariance)), found.parameters.copy()
    if problem.axis is None:
        limits[3:6] = found.scale[3:6]
    return numpy.asarray((limits <= 0.0) | (deviations > SIGNIFICANT * limits))


def against_the_wrench(found: ParameterEstimate, problem: IdentificationProblem) -> bool:
    """Whether 1/m is identified, and below zero by more than its noise: the body goes where the
    known wrench does not push it.
    """
    if not problem.model.with_mass or abs(found.directions.missing[:, -1]).max(initial=0.0) > HIDDEN:
        return False
    return bool(found.parameters[-1] < -SIGMAS * float(numpy.sqrt(found.covariance[-1, -1])))


def impossible(found: ParameterEstimate, problem: IdentificationProblem) -> list[str]:
    """A sentence where the inertia, if all of it is identified, breaks a bound by more than its
    noise.
    """
    count = len(problem.model.basis)
    if abs(found.directions.missing[:, :count]).max(initial=0.0) > HIDDEN:
        return []
    covariance, largest = found.covariance[:count, :count], size(problem.shape) ** 2
    broken = [
        max(-value, value - limit) > SIGMAS * float(numpy.sqrt(slope @ covariance @ slope)) + ROUNDING * largest
        for slope, value, limit in _moments(found.parameters[:count], problem)
    ]
    return [OUTSIDE] if any(broken) else []


def _moments(inertia: Array, problem: IdentificationProblem) -> list[tuple[Array, float, float]]:
    """Moments that lie between zero and a limit: derivative by the parameters [q], value, limit in
    [m^2].
    """
    shape = problem.shape
    if problem.axis is not None:
        return [(numpy.ones(1), float(inertia[0]), size(shape) ** 2)]
    basis = 0.5 * numpy.trace(problem.model.basis, axis1=1, axis2=2)[:, None, None] * numpy.eye(3) - problem.model.basis
    _, axes = numpy.linalg.eigh(numpy.einsum("i,ijk->jk", inertia, basis))
    found = []
    for axis in axes.T:
        slope = numpy.einsum("j,ijk,k->i", axis, basis, axis)
        reach = float(abs(shape.points @ axis).max()) + shape.radius
        found.append((slope, float(slope @ inertia), reach**2))
    return found
