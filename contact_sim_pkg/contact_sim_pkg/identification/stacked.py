"""Stacked nonlinear least squares with errors in all variables.

Unknown are the state of every flight and the parameters. Samples are fitted, weighted by their noise; the balances of all
contacts are kept exactly. Each flight is condensed by QR to its state, the states are eliminated through the balances, and
what is left is a whitened regressor G of the parameters alone: rank, estimate and covariance come from its singular values.
A Gauss-Newton step is exact least squares; velocity, spin, position and orientation all carry their noise, so that large
noise does not pull the estimate down as a plain regression does.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from scipy.linalg import block_diag, cholesky, solve_triangular

from .balance import Balance, Side, balance, lasting_balance
from .coulomb import friction_balance
from .errors import IdentificationError
from .flight import FlightState, Motion, motion, moved
from .instant import impact_balance
from .problem import Contact, Problem, start_of
from .rank import Split, split
from .rotation import Array, logarithm

__all__ = ["Estimate", "estimate"]

ITERATIONS = 40
CONVERGED = 1e-12  # last change of a parameter over its size
WHITE = 1e-13  # smallest pivot of a balance's covariance, relative


class Estimate(NamedTuple):
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


class _Condensed(NamedTuple):
    """One flight after QR: `triangle dz + coupling dp = rest` and `tail dp = tail_rest`, unit noise."""

    triangle: Array  # [12, 12]
    coupling: Array  # [12, p]
    rest: Array  # [12]
    tail: Array  # [., p]
    tail_rest: Array


def estimate(problem: Problem, start: Array, scale: Array, flights: list[FlightState] | None = None) -> Estimate:
    """Fit flights and parameters.

    Args:
        problem: samples, flights, contacts.
        start: parameters to begin with, [p].
        scale: size of each parameter, [p].
        flights: states to begin with; those of the first samples where there are none.

    Raises:
        IdentificationError: there is no flight.
    """
    if not problem.flights:
        raise IdentificationError("there is no flight of the body in the motion; at least one is needed")
    parameters = start.copy()
    states = flights or [start_of(problem.states, flight) for flight in problem.flights]
    change, iterations = numpy.inf, 0
    while iterations < ITERATIONS:
        step, moves = _Linear(problem, parameters, states, scale).step()
        parameters = parameters + step
        states = [moved(state, move) for state, move in zip(states, moves, strict=True)]
        last, change = change, float(max(abs(step / scale).max(initial=0.0), _size(moves, states)))
        iterations += 1
        if change <= CONVERGED or (change < 1e-10 and change > 0.3 * last):
            break
    linear = _Linear(problem, parameters, states, scale)
    spread, sensitivity = linear.state_covariance()
    return Estimate(
        parameters, linear.covariance(), linear.split, scale, states, linear.sides, spread, sensitivity,
        linear.residuals, iterations, change < 1e-6, *linear.misfit(),
    )  # fmt: skip


def _size(moves: Array, states: list[FlightState]) -> float:
    """Largest change of a state over the size of its kind."""
    sizes = [
        max((float(abs(getattr(state, name)).max()) for state in states), default=0.0) + 1e-3
        for name in ("position", "velocity", "angular_velocity")
    ]
    scale = numpy.repeat([sizes[0], sizes[1], 1.0, sizes[2]], 3)
    return float(abs(moves / scale).max())


class _Linear:
    """The problem linearised at parameters and states."""

    def __init__(self, problem: Problem, parameters: Array, states: list[FlightState], scale: Array) -> None:
        self.problem, self.parameters, self.scale = problem, parameters, scale
        self.residuals: list[Array] = []
        self._condensed: list[_Condensed] = []
        links = _link_times(problem)
        motions = [self._flight(number, state, links[number]) for number, state in enumerate(states)]
        self.sides = [_sides(contact, motions, links) for contact in problem.contacts]
        self._balances()
        tails = [flight.tail for flight in self._condensed]
        rests = [flight.tail_rest for flight in self._condensed]
        self._regressor = numpy.concatenate([self._white_regressor, *tails])
        self._rest = numpy.concatenate([self._white_rest, *rests])
        if not (numpy.isfinite(self._regressor).all() and numpy.isfinite(self._rest).all()):
            raise IdentificationError(
                "the fit of the flights diverges: the states do not move as a free body; check gravity, wrench and the "
                "axes of the twist"
            )
        self.split = split(self._regressor * scale)

    def step(self) -> tuple[Array, Array]:
        """Gauss-Newton step of the parameters [p] and of the states [flights, 12]."""
        kept = self.split
        scaled = kept.identified.T @ ((kept.left.T @ self._rest) / kept.values)
        step = scaled * self.scale
        errors = self._white.T @ (self._white_rest - self._white_regressor @ step)  # those of sweeps come last
        moves = numpy.empty((len(self._condensed), 12))
        for number, flight in enumerate(self._condensed):
            right = flight.rest - flight.coupling @ step + errors[12 * number : 12 * number + 12]
            moves[number] = solve_triangular(flight.triangle, right)
        return step, moves

    def covariance(self) -> Array:
        """Covariance of the parameters in the identified directions, [p, p]."""
        kept = self.split
        root = kept.identified.T / kept.values * self.scale[:, None]
        return numpy.asarray(root @ root.T)

    def state_covariance(self) -> tuple[Array, Array]:
        """Covariance of all states at given parameters, and how an error of the parameters moves them."""
        inverse = block_diag(*(numpy.linalg.inv(flight.triangle) for flight in self._condensed))
        white = self._white[:, : len(inverse)]
        kept = numpy.eye(len(inverse)) - white.T @ white
        coupling = numpy.concatenate([flight.coupling for flight in self._condensed])
        return inverse @ kept @ inverse.T, -inverse @ (coupling + white.T @ self._white_regressor)

    def misfit(self) -> tuple[float, int]:
        """Root mean square of what the parameters leave of all balances and flights, and how many equations are left over.

        The last row of a flight's triangle is the noise of its samples, whatever the parameters are: it does not count.
        """
        squares, rows = float(self._white_rest @ self._white_rest), len(self._white_rest)
        for flight in self._condensed:
            squares += float(numpy.sum(flight.tail_rest[:-1] ** 2))
            rows += max(0, len(flight.tail_rest) - 1)
        freedom = max(0, rows - self.split.rank)
        return float(numpy.sqrt(squares / freedom)) if freedom else 0.0, freedom

    def _flight(self, number: int, state: FlightState, links: Array) -> Motion:
        """Condense a flight; its motion at the times of its contacts."""
        problem = self.problem
        first, last = problem.flights[number]
        times = numpy.concatenate([problem.states.time[first : last + 1], links])
        order = numpy.argsort(times, kind="stable")
        back = numpy.argsort(order, kind="stable")
        sorted_motion = motion(state, self.parameters, self.scale, problem.model, times[order])
        whole = Motion(*(field[back] for field in sorted_motion))
        count = last - first + 1
        rest = _measured(problem, first, last, whole)
        self.residuals.append(rest)
        noise = problem.step_noise if first == last and problem.step_noise is not None else problem.noise
        spreads = numpy.array([noise.position, noise.velocity, noise.rotation, noise.angular_velocity])
        weights = numpy.repeat(1.0 / spreads, 3)
        self._condensed.append(_condensed(whole, rest, weights, standing=not (times != state.time).any()))
        return Motion(*(field[count:] for field in whole))

    def _balances(self) -> None:
        """Whiten the balances of all contacts: `white e + regressor dp = rest`, rows of `white` orthonormal.

        e are the errors of all states, then those of each balance whose contact lasts.
        """
        problem = self.problem
        balances = [
            _balance(problem, contact, sides, self.parameters)
            for contact, sides in zip(problem.contacts, self.sides, strict=True)
        ]
        total, states = sum(len(found.value) for found in balances), 12 * len(self._condensed)
        width = states + total * any(contact.sweep is not None for contact in problem.contacts)
        errors, regressor = numpy.zeros((total, width)), numpy.zeros((total, problem.model.unknowns))
        rest, place = numpy.zeros(total), 0
        for contact, found in zip(problem.contacts, balances, strict=True):
            lines = slice(place, place + len(found.value))
            self._eliminate(contact, found, errors[lines], regressor[lines], rest[lines])
            if contact.sweep is not None:
                own = slice(states + place, states + lines.stop)
                errors[lines, own] = contact.sweep.deviation * numpy.eye(lines.stop - place)
            place = lines.stop
        if total:
            gram = errors @ errors.T
            sizes = numpy.sqrt(numpy.diag(gram))
            lower = cholesky(gram / sizes / sizes[:, None] + WHITE * numpy.eye(total), lower=True) * sizes[:, None]
            errors, regressor, rest = (solve_triangular(lower, part, lower=True) for part in (errors, regressor, rest))
        self._white, self._white_regressor, self._white_rest = errors, regressor, rest

    def _eliminate(self, contact: Contact, found: Balance, errors: Array, regressor: Array, rest: Array) -> None:
        """Put one balance into its rows, the states replaced by those of the flights."""
        regressor += found.by_parameters
        rest -= found.value
        for number, by_state in ((contact.before, found.by_before), (contact.after, found.by_after)):
            flight = self._condensed[number]
            through = solve_triangular(flight.triangle, by_state.T, trans="T").T
            errors[:, 12 * number : 12 * number + 12] += through
            regressor -= through @ flight.coupling
            rest -= through @ flight.rest


def _balance(problem: Problem, contact: Contact, sides: tuple[Side, Side], parameters: Array) -> Balance:
    """What a contact says: of the moment, of the known friction, or of both, one below the other."""
    parts = []
    if contact.turns:
        known = (*sides, parameters, problem.model, problem.shape, problem.ground, contact.point)
        law = impact_balance if contact.located else balance
        found = law(*known) if contact.sweep is None else lasting_balance(*known, contact.sweep)
        parts.append(Balance(*(problem.rows @ field for field in found)))
    if contact.slides:
        parts.append(friction_balance(problem, contact, sides, parameters))
    return Balance(*(numpy.concatenate(fields) for fields in zip(*parts, strict=True)))


def _condensed(whole: Motion, rest: Array, weights: Array, *, standing: bool) -> _Condensed:
    """QR of a flight's samples; a single sample that is the state itself needs none."""
    count, unknowns = len(rest), whole.by_parameters.shape[2]
    if standing and count == 1:
        nothing = numpy.zeros((0, unknowns))
        return _Condensed(numpy.diag(weights), numpy.zeros((12, unknowns)), weights * rest[0], nothing, nothing[:, 0])
    rows = numpy.concatenate([whole.by_state[:count], whole.by_parameters[:count], rest[..., None]], axis=2)
    triangle = _triangle((weights[:, None] * rows).reshape(12 * count, -1))
    return _Condensed(
        triangle[:12, :12], triangle[:12, 12 : 12 + unknowns], triangle[:12, -1], triangle[12:, 12 : 12 + unknowns],
        triangle[12:, -1],
    )  # fmt: skip


def _triangle(rows: Array) -> Array:
    """R of a QR decomposition."""
    return numpy.asarray(numpy.linalg.qr(rows, mode="r"))


def _measured(problem: Problem, first: int, last: int, predicted: Motion) -> Array:
    """Measured minus predicted, [n, 12] in the order dx, dv, rotation, dw."""
    chosen, count = slice(first, last + 1), last - first + 1
    states = problem.states
    turned = states.rotation[chosen] @ numpy.swapaxes(predicted.rotation[:count], -1, -2)
    parts = (
        states.position[chosen] - predicted.position[:count],
        states.velocity[chosen] - predicted.velocity[:count],
        logarithm(turned),
        states.angular_velocity[chosen] - predicted.angular_velocity[:count],
    )
    return numpy.concatenate(parts, axis=1)


def _link_times(problem: Problem) -> list[Array]:
    """Times of the contacts of each flight: those that end it, then those that begin it."""
    found: list[list[float]] = [[] for _ in problem.flights]
    for contact in problem.contacts:
        found[contact.before].append(contact.begin)
        found[contact.after].append(contact.end)
    return [numpy.array(sorted(set(times))) for times in found]


def _sides(contact: Contact, motions: list[Motion], links: list[Array]) -> tuple[Side, Side]:
    sides = []
    for number, time in ((contact.before, contact.begin), (contact.after, contact.end)):
        at = motions[number]
        place = int(numpy.searchsorted(links[number], time))
        state = FlightState(
            time, at.position[place], at.velocity[place], at.rotation[place], at.angular_velocity[place]
        )
        sides.append(Side(state, at.by_state[place], at.by_parameters[place]))
    return sides[0], sides[1]
