"""Stacked nonlinear least squares with errors in all variables.

Unknown are the state of every flight and the parameters. Samples are fitted, weighted by their
noise; the balances of all contacts are kept exactly. Each flight is condensed by QR to its state,
the states are eliminated through the balances, and what is left is a whitened regressor G of the
parameters alone: rank, estimate and covariance come from its singular values. A Gauss-Newton step
is exact least squares; velocity, spin, position and orientation all carry their noise, so that
large noise does not pull the estimate down as a plain regression does.

Source: Identifiability eqs 19 to 39, with errors in all variables.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.balance import Side, Split
from contact_sim_pkg.identify.contact.linearised import DIVERGES, Linearised
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.flight import FlightState, moved
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import IdentificationProblem, start_of

__all__ = ["ParameterEstimate", "estimate"]


ITERATIONS = 40
WILD = 1e3  # change of a state over the size of its kind: no fit of this motion
CONVERGED = 1e-12  # last change of a parameter over its size


class ParameterEstimate(NamedTuple):
    """Parameters, flights and what is known of them."""

    parameters: Array  # [p]; where a direction is not identified, its start
    covariance: Array  # [p, p]; of the identified directions
    directions: Split  # identified and not, in units of `scale`
    scale: Array  # [p]
    flights: list[FlightState]
    sides: list[tuple[Side, Side]]  # of each contact
    state_covariance: Array  # [12 flights, 12 flights], for states with the parameters estimated
    state_by_parameters: Array  # [12 flights, p]: -d state / d error of p, through which their errors are shared
    residuals: list[Array]  # of each flight, unweighted: [n, 12]
    iterations: int
    converged: bool
    misfit: (
        float  # how far contacts and flights contradict each other, root mean square in standard deviations: about 1
    )
    freedom: int  # equations beyond the unknowns, of which `misfit` is the mean


def estimate(
    problem: IdentificationProblem, start: Array, scale: Array, flights: list[FlightState] | None = None
) -> ParameterEstimate:
    """Fit flights and parameters.

    Args:
        problem: samples, flights, contacts.
        start: parameters to begin with, [parameters].
        scale: size of each parameter, [parameters].
        flights: states to begin with; those of the first samples where there are none.

    Raises:
        IdentificationError: there is no flight, or the fit diverges.
    """
    if not problem.flights:
        raise IdentificationError("there is no flight of the body in the motion; at least one is needed")
    parameters = start.copy()
    states = flights or [start_of(problem.states, flight) for flight in problem.flights]
    change, iterations = numpy.inf, 0
    while iterations < ITERATIONS:
        step, moves = Linearised(problem, parameters, states, scale).step()
        if not _size(moves, states) <= WILD:
            raise IdentificationError(DIVERGES)
        parameters = parameters + step
        states = [moved(state, move) for state, move in zip(states, moves, strict=True)]
        last, change = change, float(max(abs(step / scale).max(initial=0.0), _size(moves, states)))
        iterations += 1
        if change <= CONVERGED or (change < 1e-10 and change > 0.3 * last):
            break
    linear = Linearised(problem, parameters, states, scale)
    spread, sensitivity = linear.state_covariance()
    misfit, freedom = linear.misfit()
    return ParameterEstimate(
        parameters=parameters, covariance=linear.covariance(), directions=linear.split, scale=scale, flights=states,
        sides=linear.sides, state_covariance=spread, state_by_parameters=sensitivity, residuals=linear.residuals,
        iterations=iterations, converged=change < 1e-6, misfit=misfit, freedom=freedom,
    )  # fmt: skip


def _size(moves: Array, states: list[FlightState]) -> float:
    """Largest change of a state over the size of its kind."""
    sizes = [
        max((float(abs(getattr(state, name)).max()) for state in states), default=0.0) + 1e-3
        for name in ("position", "velocity", "angular_velocity")
    ]
    scale = numpy.repeat([sizes[0], sizes[1], 1.0, sizes[2]], 3)
    return float(abs(moves / scale).max())
