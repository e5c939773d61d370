"""What a body within its hull can be: bounds on its moments of inertia over the mass, and what
noise alone would make up.

The mass lies within the hull: in a plane `0 < J/m <= max |p|^2` over the hull's points p. In space
the second moments `M = tr(S)/2 - S = int x x^T dm / m`, S = I0/m, obey `0 <= a.M a <= max (p.a)^2`
for every direction a: from below that is the triangle inequality of the moments of inertia.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.geometry import size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import IdentificationProblem

__all__ = ["HIDDEN", "against_the_wrench", "impossible", "made_up"]

HIDDEN = 1e-6  # component of a parameter in what is not identified, above which it counts as not identified itself
SIGNIFICANT = 1.0 / 3.0  # standard deviation over the value, above which noise could have made it up
SIGMAS = 5.0  # how far beyond a bound
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
