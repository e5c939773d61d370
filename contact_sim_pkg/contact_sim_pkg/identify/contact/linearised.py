"""The stacked problem linearised at parameters and states: each flight condensed, the balances of
all contacts whitened.

Each flight is condensed by QR to its state, the states are eliminated through the balances, and
what is left is a whitened regressor G of the parameters alone.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy
from scipy.linalg import block_diag, cholesky, solve_triangular

from contact_sim_pkg.identify.contact.balance import Balance, Side, Split, balance, lasting_balance, split
from contact_sim_pkg.identify.contact.coulomb import friction_balance
from contact_sim_pkg.identify.contact.instant import impact_balance
from contact_sim_pkg.identify.contact.noise import sample_noise
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.flight import FlightMotion, FlightState, motion
from contact_sim_pkg.identify.motion.rotation import Array, logarithm
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["DIVERGES", "Linearised"]


WHITE = 1e-13  # smallest pivot of a balance's covariance, relative


DIVERGES = (
    "the fit of the flights diverges: the states do not move as a free body; check gravity, wrench, twist and its unit"
)


class _Balances(NamedTuple):
    """Balances before they are whitened: `errors e + regressor dp = rest`, e the errors of all
    states and sweeps.
    """

    errors: Array
    regressor: Array
    rest: Array


class _Condensed(NamedTuple):
    """One flight after QR: `triangle dz + coupling dp = rest` and `tail dp = tail_rest`, unit
    noise.
    """

    triangle: Array  # [12, 12]
    coupling: Array  # [12, p]
    rest: Array  # [12]
    tail: Array  # [., p]
    tail_rest: Array


class Linearised:
    """The problem linearised at parameters and states."""

    def __init__(
        self, problem: IdentificationProblem, parameters: Array, states: list[FlightState], scale: Array
    ) -> None:
        self.problem, self.parameters, self.scale = problem, parameters, scale
        self.residuals: list[Array] = []
        self._condensed: list[_Condensed] = []
        links = _link_times(problem)
        motions = [self._flight(number, state, links[number]) for number, state in enumerate(states)]
        self.sides = [_sides(contact, motions, links) for contact in problem.contacts]
        self._lines, self._balances = self._contacts()
        self._white, self._white_regressor, self._white_rest = self._whitened(range(len(problem.contacts)))
        self._regressor, self._rest = self._with_flights(self._white_regressor, self._white_rest)
        if not (numpy.isfinite(self._regressor).all() and numpy.isfinite(self._rest).all()):
            raise IdentificationError(DIVERGES)
        self.split = self._split(self._regressor)

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
        """Covariance of all states at given parameters, and how an error of the parameters moves
        them.
        """
        inverse = block_diag(*(numpy.linalg.inv(flight.triangle) for flight in self._condensed))
        white = self._white[:, : len(inverse)]
        kept = numpy.eye(len(inverse)) - white.T @ white
        coupling = numpy.concatenate([flight.coupling for flight in self._condensed])
        return inverse @ kept @ inverse.T, -inverse @ (coupling + white.T @ self._white_regressor)

    def misfit(self) -> tuple[float, int]:
        """Root mean square of what the parameters leave of all balances and flights, and how many
        equations are left over.
        """
        square, freedom = self._left(self._white_rest, self.split.rank)
        return float(numpy.sqrt(square / freedom)) if freedom else 0.0, freedom

    def redundancy(self, contacts: Sequence[int]) -> int:
        """Equations of these contacts beyond the directions that they add to those of the
        flights.
        """
        _, regressor, rest = self._whitened(contacts)
        alone, together = (self._split(self._with_flights(part, rest)[0]) for part in (regressor[:0], regressor))
        return len(rest) - (together.rank - alone.rank)

    def contradiction(self, contacts: Sequence[int]) -> tuple[float, int]:
        """Sum of squares that the best parameters would leave, were these the only contacts, and
        the equations left over.
        """
        _, regressor, rest = self._whitened(contacts)
        together, all_rest = self._with_flights(regressor, rest)
        kept = self._split(together)
        explained = kept.left.T @ all_rest
        square, freedom = self._left(rest, kept.rank)
        return max(0.0, square - float(explained @ explained)), freedom

    def _split(self, regressor: Array) -> Split:
        return split(regressor * self.scale, with_mass=self.problem.model.with_mass)

    def _left(self, rest: Array, rank: int) -> tuple[float, int]:
        """Sum of the squares of balances and flights, and their number beyond `rank`.

        The last row of a flight's triangle is the noise of its samples, whatever the parameters
        are: it does not count.
        """
        square, rows = float(rest @ rest), len(rest)
        for flight in self._condensed:
            square += float(numpy.sum(flight.tail_rest[:-1] ** 2))
            rows += max(0, len(flight.tail_rest) - 1)
        return square, max(0, rows - rank)

    def _flight(self, number: int, state: FlightState, links: Array) -> FlightMotion:
        """Condense a flight; its motion at the times of its contacts."""
        problem = self.problem
        first, last = problem.flights[number]
        times = numpy.concatenate([problem.states.time[first : last + 1], links])
        order = numpy.argsort(times, kind="stable")
        back = numpy.argsort(order, kind="stable")
        with numpy.errstate(over="ignore", invalid="ignore"):
            sorted_motion = motion(state, self.parameters, self.scale, problem.model, times[order])
        if not all(numpy.isfinite(field).all() for field in sorted_motion):
            raise IdentificationError(DIVERGES)
        whole = FlightMotion(*(field[back] for field in sorted_motion))
        count = last - first + 1
        rest = _measured(problem, first, last, whole)
        self.residuals.append(rest)
        noise = problem.step_noise if first == last and problem.step_noise is not None else problem.noise
        weights = 1.0 / sample_noise(noise, problem.rounding, problem.states, slice(first, last + 1))
        self._condensed.append(_condensed(whole, rest, weights, standing=not (times != state.time).any()))
        return FlightMotion(*(field[count:] for field in whole))

    def _contacts(self) -> tuple[list[slice], _Balances]:
        """The balances of all contacts by the errors of all states, then by those of each balance
        whose contact lasts.
        """
        problem = self.problem
        balances = [
            _balance(problem, contact, sides, self.parameters)
            for contact, sides in zip(problem.contacts, self.sides, strict=True)
        ]
        ends = numpy.cumsum([0, *(len(found.value) for found in balances)]).tolist()
        lines = [slice(first, last) for first, last in itertools.pairwise(ends)]
        total, states = ends[-1], 12 * len(self._condensed)
        width = states + total * any(contact.sweep is not None for contact in problem.contacts)
        errors, regressor, rest = (
            numpy.zeros((total, width)),
            numpy.zeros((total, problem.model.unknowns)),
            numpy.zeros(total),
        )
        # The states of the flights are eliminated; a sweep has an error of its own
        for contact, found, own in zip(problem.contacts, balances, lines, strict=True):
            self._eliminate(contact, found, errors[own], regressor[own], rest[own])
            if contact.sweep is not None:
                columns = slice(states + own.start, states + own.stop)
                errors[own, columns] = contact.sweep.deviation * numpy.eye(own.stop - own.start)
        return lines, _Balances(errors, regressor, rest)

    def _whitened(self, contacts: Sequence[int]) -> _Balances:
        """Balances of these contacts as `white e + regressor dp = rest`, rows of `white`
        orthonormal; e the errors.
        """
        chosen = [line for number in contacts for line in range(self._lines[number].start, self._lines[number].stop)]
        errors, regressor, rest = (part[chosen] for part in self._balances)
        if not len(chosen):
            return _Balances(errors, regressor, rest)
        gram = errors @ errors.T
        sizes = numpy.sqrt(numpy.diag(gram))
        lower = cholesky(gram / sizes / sizes[:, None] + WHITE * numpy.eye(len(chosen)), lower=True) * sizes[:, None]
        return _Balances(*(solve_triangular(lower, part, lower=True) for part in (errors, regressor, rest)))

    def _with_flights(self, regressor: Array, rest: Array) -> tuple[Array, Array]:
        """The same with what the flights say of the parameters below it."""
        return (
            numpy.concatenate([regressor, *(flight.tail for flight in self._condensed)]),
            numpy.concatenate([rest, *(flight.tail_rest for flight in self._condensed)]),
        )

    def _eliminate(self, contact: ContactSpan, found: Balance, errors: Array, regressor: Array, rest: Array) -> None:
        """Put one balance into its rows, the states replaced by those of the flights."""
        regressor += found.by_parameters
        rest -= found.value
        for number, by_state in ((contact.before, found.by_before), (contact.after, found.by_after)):
            flight = self._condensed[number]
            through = solve_triangular(flight.triangle, by_state.T, trans="T").T
            errors[:, 12 * number : 12 * number + 12] += through
            regressor -= through @ flight.coupling
            rest -= through @ flight.rest


def _balance(
    problem: IdentificationProblem, contact: ContactSpan, sides: tuple[Side, Side], parameters: Array
) -> Balance:
    """What a contact says: of the moment, of the known friction, or of both, one below the
    other.
    """
    parts = []
    if contact.turns:
        known = (*sides, parameters, problem.model, problem.shape, problem.ground, contact.point)
        law = impact_balance if contact.located else balance
        found = law(*known) if contact.sweep is None else lasting_balance(*known, contact.sweep)
        parts.append(Balance(*(problem.rows @ field for field in found)))
    if contact.slides:
        parts.append(friction_balance(problem, contact, sides, parameters))
    return Balance(*(numpy.concatenate(fields) for fields in zip(*parts, strict=True)))


def _condensed(whole: FlightMotion, rest: Array, weights: Array, *, standing: bool) -> _Condensed:
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


def _measured(problem: IdentificationProblem, first: int, last: int, predicted: FlightMotion) -> Array:
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


def _link_times(problem: IdentificationProblem) -> list[Array]:
    """Times of the contacts of each flight: those that end it, then those that begin it."""
    found: list[list[float]] = [[] for _ in problem.flights]
    for contact in problem.contacts:
        found[contact.before].append(contact.begin)
        found[contact.after].append(contact.end)
    return [numpy.array(sorted(set(times))) for times in found]


def _sides(contact: ContactSpan, motions: list[FlightMotion], links: list[Array]) -> tuple[Side, Side]:
    sides = []
    for number, time in ((contact.before, contact.begin), (contact.after, contact.end)):
        at = motions[number]
        place = int(numpy.searchsorted(links[number], time))
        state = FlightState(
            time, at.position[place], at.velocity[place], at.rotation[place], at.angular_velocity[place]
        )
        sides.append(Side(state, at.by_state[place], at.by_parameters[place]))
    return sides[0], sides[1]
